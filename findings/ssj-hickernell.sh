#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: SSJ's DiscL2Hickernell is Hickernell's centred L2 discrepancy, as scipy's "CD", or its square.
# Seen: it is the root of his modified L2 discrepancy (scipy has none), 0.2696 where the centred one is 0.2496; SSJ has no centred one.
# DiscL2Star, DiscL2Symmetric and DiscL2Unanchored are roots, too: 0.1762 (scipy's "L2-star"), four times that, and 0.0943.
# Packages: ca.umontreal.iro.simul:ssj:3.3.2 (Maven Central), scipy==1.17.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mvn -q dependency:copy -Dartifact=ca.umontreal.iro.simul:ssj:3.3.2 -DoutputDirectory=.
cat >Values.java <<'END'
import umontreal.ssj.discrepancy.*;

class Values {
    public static void main(String[] arguments) {
        double[][] p = {{.25, .25}, {.75, .75}};
        System.out.println(new DiscL2Hickernell(p, 2, 2).compute(p, 2, 2));
        System.out.println(new DiscL2Star(p, 2, 2).compute(p, 2, 2));
        System.out.println(new DiscL2Symmetric(p, 2, 2).compute(p, 2, 2));
        System.out.println(new DiscL2Unanchored(p, 2, 2).compute(p, 2, 2));
    }
}
END
java -cp ssj-3.3.2.jar Values.java >values
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check scipy==1.17.1
venv/bin/python - <<'END'
from math import isclose, sqrt

from scipy.stats import qmc

hickernell, star, symmetric, unanchored = map(float, open("values"))
points = [[.25, .25], [.75, .75]]
centred, theirs = sqrt(qmc.discrepancy(points)), qmc.discrepancy(points, method="L2-star")
# The modified discrepancy by its definition: squares of L2 star over all projections; in one coordinate, of 1/4 and 3/4:
one = 1 / 3 - (1 - .25 ** 2 + 1 - .75 ** 2) / 2 + (.75 + 3 * .25) / 4
modified = sqrt(theirs ** 2 + 2 * one)
print(f"DiscL2Hickernell {hickernell:.6f}: centred {centred:.6f}, modified {modified:.6f}")
print(f"DiscL2Star {star:.6f}, scipy's L2-star {theirs:.6f}; DiscL2Symmetric {symmetric:.6f}; DiscL2Unanchored {unanchored:.6f}")
seen = isclose(hickernell, modified, rel_tol=1e-9) and not isclose(hickernell, centred, rel_tol=.01)
raise SystemExit(not (seen and isclose(star, theirs, rel_tol=1e-9) and isclose(symmetric, 4 * star, rel_tol=1e-9)))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the centred discrepancy of one set is one number in three packages, and "modified" and "mixture" are two names
# of one discrepancy.
# Seen: OpenTURNS's SpaceFillingC2 and pysampling's centered_l2_discrepancy are the root of SciPy's CD. pysampling's
# modified_l2_discrepancy is Hickernell's of 1998 (L2-star over all projections), neither SciPy's MD, which is the
# mixture discrepancy of Zhou, Fang & Ning 2013, nor its root.
# Packages: numpy==2.3.5 scipy==1.17.1 openturns==1.27.post1 pysampling==0.2.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 openturns==1.27.post1 pysampling==0.2.0
venv/bin/python - <<'END'
import openturns
import pysampling.measures
from scipy.stats import qmc
x = qmc.Halton(2, scramble=False).random(16)
cd, md = (qmc.discrepancy(x, method=method) for method in ("CD", "MD"))
c2 = openturns.SpaceFillingC2().evaluate(openturns.Sample(x))
centred, modified = (getattr(pysampling.measures, f"{name}_l2_discrepancy")(x) for name in ("centered", "modified"))
print(f"SciPy CD {cd:.6f}, root {cd ** .5:.6f}; OpenTURNS {c2:.6f}; pysampling {centred:.6f}")
print(f"SciPy MD {md:.6f}, root {md ** .5:.6f}; pysampling modified {modified:.6f}")
roots = max(abs(c2 - cd ** 0.5), abs(centred - cd ** 0.5)) < 1e-12
raise SystemExit(not (roots and min(abs(modified - md), abs(modified - md ** 0.5)) > 0.01))
END

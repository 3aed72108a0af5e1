#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: CylindN of sphere-n gives uniform points of the sphere in any number of dimensions, as SphereN beside it does:
# the mean square of each of n + 1 coordinates is 1 / (n + 1).
# Seen: only on the ordinary sphere. Archimedes' cylinder is used again in each further dimension, where it does not
# keep areas: the last coordinate is uniform in [-1, 1], mean square 1/3, whatever the dimension, and the first three
# share what is left: .22 each on the sphere of four coordinates, .10 on that of six, where 1/4 and 1/6 are right.
# Packages: numpy==2.3.5 lds-gen==0.6 sphere-n==0.7
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 lds-gen==0.6 sphere-n==0.7
venv/bin/python - <<'END'
import numpy as np
from lds_gen.sphere_n import SphereN
from sphere_n.cylind_n import CylindN

seen = True
for bases, first in (([2, 3], 1 / 3), ([2, 3, 5], 2 / 9), ([2, 3, 5, 7], 4 / 27), ([2, 3, 5, 7, 11], 8 / 81)):
    n = len(bases) + 1
    for kind in (CylindN, SphereN):
        if kind is SphereN and n == 3:
            continue  # it begins with four coordinates
        generator = kind(bases)
        generator.reseed(0)
        squares = np.square([generator.pop() for _ in range(8192)]).mean(axis=0)
        print(f"{kind.__name__} with {n} coordinates:", squares.round(3))
        right = [first] * 3 + [2 ** k / 3 ** (k + 1) for k in range(n - 4, -1, -1)] if kind is CylindN else [1 / n] * n
        seen = seen and np.allclose(squares, right, atol=.003)
raise SystemExit(not seen)
END

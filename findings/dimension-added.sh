#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: with an equal seed, the first two coordinates of three-dimensional points are the two-dimensional points, or
# a package never keeps them.
# Seen: it depends on the sequence, within each package and not alike in both: SciPy's Halton points keep their first
# coordinates, its Sobol' points and Latin hypercubes do not; QMCPy's lattice keeps them, its Halton and Sobol' points
# do not.
# Packages: numpy==2.3.5 scipy==1.17.1 qmcpy==2.4
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 qmcpy==2.4
venv/bin/python - <<'END'
import qmcpy
from scipy.stats import qmc

makers = {
    "scipy Sobol": (lambda d: qmc.Sobol(d, rng=1).random(8), False),
    "scipy LatinHypercube": (lambda d: qmc.LatinHypercube(d, rng=1).random(8), False),
    "scipy Halton": (lambda d: qmc.Halton(d, rng=1).random(8), True),
    "qmcpy DigitalNetB2": (lambda d: qmcpy.DigitalNetB2(d, seed=1).gen_samples(8), False),
    "qmcpy Halton": (lambda d: qmcpy.Halton(d, seed=1).gen_samples(8), False),
    "qmcpy Lattice": (lambda d: qmcpy.Lattice(d, seed=1).gen_samples(8), True),
}
changed = False
for name, (make, expected) in makers.items():
    kept = bool((make(2) == make(3)[:, :2]).all())
    print(name, "keeps" if kept else "changes", "the first coordinates")
    changed |= kept != expected
raise SystemExit(changed)
END

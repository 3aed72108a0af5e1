#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: SobolDesign and LatinDesign follow numpy.random.seed, as RandomDesign of the same package does.
# Seen: both take a generator of SciPy without a seed, and have no argument for one: other points at each call; runs
# that set NumPy's seed are not repeated.
# Packages: numpy==2.3.5 scipy==1.17.1 emukit==0.5.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 emukit==0.5.1
venv/bin/python -W ignore - <<'END'
import numpy
from emukit.core import ContinuousParameter, ParameterSpace
from emukit.core.initial_designs import RandomDesign
from emukit.core.initial_designs.latin_design import LatinDesign
from emukit.core.initial_designs.sobol_design import SobolDesign
space = ParameterSpace([ContinuousParameter("x", 0, 1), ContinuousParameter("y", 0, 1)])
repeats = {}
for design in (RandomDesign, LatinDesign, SobolDesign):
    sets = []
    for _ in range(2):
        numpy.random.seed(7)
        sets.append(design(space).get_samples(8))
    repeats[design.__name__] = bool((sets[0] == sets[1]).all())
print("the same points after numpy.random.seed(7):", repeats)
raise SystemExit(repeats != {"RandomDesign": True, "LatinDesign": False, "SobolDesign": False})
END

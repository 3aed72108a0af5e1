#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: 16 points of skopt.sampler.Sobol are a net behind a random digital shift or scrambling: one in each of 4 x 4
# squares.
# Seen: the default moves them by a random vector modulo 1, which keeps each coordinate stratified but not the net:
# with seed 1 only 10 of 16 squares have a point. With randomize=False all 16 have.
# Packages: numpy==2.3.5 scipy==1.17.1 scikit-optimize==0.10.2
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 scikit-optimize==0.10.2
venv/bin/python - <<'END'
import warnings
warnings.simplefilter("ignore")
from skopt.sampler import Sobol
def squares(**options):
    points = Sobol(**options).generate([(0.0, 1.0)] * 2, 16, random_state=1)
    return len({(int(4 * x), int(4 * y)) for x, y in points})
counts = squares(), squares(randomize=False)
print("squares with a point: %d by default, %d without randomize" % counts)
raise SystemExit(counts != (10, 16))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: FullFactorial asked for 5 points of the square gives a full grid: 4 or 6 points.
# Seen: it gives 5: a grid of 2 x 3 without one corner, so that coordinates no longer average to 1/2. clip=True gives
# the grid of 6.
# Packages: smt==2.15.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check smt==2.15.0
venv/bin/python - <<'END'
import numpy
from smt.sampling_methods import FullFactorial
square = numpy.array([[0.0, 1.0]] * 2)
part, whole = FullFactorial(xlimits=square)(5), FullFactorial(xlimits=square, clip=True)(5)
print("points %d, mean %s; with clip %d, mean %s" % (len(part), part.mean(0), len(whole), whole.mean(0)))
raise SystemExit(not (len(part) == 5 and len(whole) == 6 and abs(part.mean(0) - 0.5).max() > 0.05))
END

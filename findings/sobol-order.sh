#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: two packages with the direction numbers of Joe & Kuo give one unscrambled Sobol' sequence, point by point.
# Seen: the sets of 2^m points are equal, but the order is that of Gray code in SciPy and of plain binary in QMCPy:
# the third points differ, and so do all sets whose size is no power of two.
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
a = qmc.Sobol(2, scramble=False).random(4)
b = qmcpy.DigitalNetB2(2, randomize=False).gen_samples(4)
print("third points:", a[2], b[2], "equal as sets of 4:", sorted(map(tuple, a)) == sorted(map(tuple, b)))
raise SystemExit(not (sorted(map(tuple, a)) == sorted(map(tuple, b)) and (a[2] == [0.75, 0.25]).all() and (b[2] == [0.25, 0.75]).all()))
END

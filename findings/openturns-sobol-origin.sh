#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the first 2^m points of OpenTURNS' Sobol' sequence are a net in two dimensions, as those of others are.
# Seen: the sequence begins after the origin: of 16 intervals [i/16, (i+1)/16) its first 16 points leave one empty in
# either coordinate and put two into another; points 0 to 15 of SciPy put one into each.
# Packages: numpy==2.3.5 openturns==1.27 scipy==1.17.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 openturns==1.27 scipy==1.17.1
venv/bin/python - <<'END'
import numpy, openturns
from scipy.stats import qmc
theirs = numpy.array(openturns.SobolSequence(2).generate(16))
scipys = qmc.Sobol(2, scramble=False).random(16)
empty = lambda x: [int((numpy.bincount((x[:, k] * 16).astype(int), minlength=16) == 0).sum()) for k in (0, 1)]
print("first point", theirs[0], "empty of 16 intervals: OpenTURNS", empty(theirs), "SciPy", empty(scipys))
raise SystemExit(not (empty(theirs) == [1, 1] and empty(scipys) == [0, 0]))
END

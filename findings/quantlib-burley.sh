#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: 2^m points of Burley's hashed Owen scrambling, from the start, have one point in each interval of length
# 2^-m, in both coordinates.
# Seen: the first coordinate does; of the second one interval stays empty at every m from 2 to 12, and another has two
# points.
# Packages: numpy==2.3.5 QuantLib==1.44
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 QuantLib==1.44
venv/bin/python - <<'END'
import numpy, QuantLib
generator = QuantLib.Burley2020SobolRsg(2, 42)
x = numpy.array([generator.nextSequence().value() for _ in range(4096)])
changed = False
for m in range(2, 13, 2):
    n = 1 << m
    empty = [int((numpy.bincount((x[:n, k] * n).astype(int), minlength=n) == 0).sum()) for k in (0, 1)]
    print("%4d points: empty intervals %d and %d" % (n, *empty))
    changed |= empty != [0, 1]
raise SystemExit(changed)
END

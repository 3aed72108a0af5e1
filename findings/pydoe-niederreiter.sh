#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: 1,024 points of niederreiter_sequence in two dimensions are 1,024 different points, one in each interval of
# length 1/1024.
# Seen: they are 32 different points: the first coordinate takes four values, multiples of 1/7, the second eight.
# Packages: numpy==2.3.5 scipy==1.17.1 pydoe==1.6.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 pydoe==1.6.0
venv/bin/python - <<'END'
import pydoe
x = pydoe.niederreiter_sequence(1024, 2)
counts = len({tuple(p) for p in x}), len(set(x[:, 0])), len(set(x[:, 1]))
print("of 1024 points %d differ; the coordinates take %d and %d values" % counts)
raise SystemExit(counts != (32, 4, 8))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: rule="halton" gives the first n points, with the origin or from point 1 on, in any dimension.
# Seen: the first point depends on the dimension: number 8 of 4 dimensions, 12 of 5. So one dimension more changes all
# coordinates, although nothing is random.
# Packages: numpy==2.3.5 chaospy==4.3.21
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 chaospy==4.3.21
venv/bin/python - <<'END'
import chaospy


def first(dim):
    points = chaospy.J(*[chaospy.Uniform(0, 1) for _ in range(dim)]).sample(4, rule="halton")
    numerator = round(float(points[0, 0]) * 2**20)  # the radical inverse in base 2, back to the index
    return int(format(numerator, "020b")[::-1], 2)


firsts = {dim: first(dim) for dim in (2, 3, 4, 5)}
print("index of the first point by dimension:", firsts)
raise SystemExit(firsts[4] != 8 or firsts[5] != 12)
END

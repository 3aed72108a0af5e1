#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: korobov_design_matrix(n, d), "deterministic" by its documentation, gives the same lattice at each call, with n
# different values on each axis.
# Seen: without generator_param each call draws another generator, also one with a common factor with n: of 200 designs of
# 16 points about half have 8, 4 or 2 different values in the second column. With n prime all have n.
# Packages: diversipy 0.9, numpy 2.3.5 (PyPI)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check diversipy==0.9 numpy==2.3.5
cat >check.py <<'END'
import diversipy

def values(n):
    return [len(set(diversipy.korobov_design_matrix(n, 2)[:, 1])) for _ in range(200)]

composite, prime = values(16), values(17)
print({v: composite.count(v) for v in sorted(set(composite))}, set(prime))
raise SystemExit(0 if 40 < sum(v < 16 for v in composite) < 160 and set(prime) == {17} else 1)
END
venv/bin/python check.py

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: korobov_sequence and rank1_lattice give points of the unit cube, as the other sequences of the package do.
# Seen: both give whole numbers from 0 to n - 1, not divided by n, while halton_sequence is in [0, 1); and the default
# vector of rank1_lattice is drawn anew in each call, without a seed to set.
# Packages: numpy==2.3.5 scipy==1.17.1 pydoe==1.6.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 pydoe==1.6.0
venv/bin/python - <<'END'
import numpy, pydoe
korobov, lattice, halton = pydoe.korobov_sequence(7, 3), pydoe.rank1_lattice(101, 4), pydoe.halton_sequence(7, 3)
print("largest coordinates: korobov %g, lattice %g, halton %.3f" % (korobov.max(), lattice.max(), halton.max()))
vectors = {tuple(pydoe.rank1_lattice(101, 4)[1]) for _ in range(8)}
print("default lattices of 8 calls: %d different ones" % len(vectors))
whole = all((x == numpy.round(x)).all() for x in (korobov, lattice))
raise SystemExit(not (whole and korobov.max() == 6 and halton.max() < 1 and len(vectors) > 1))
END

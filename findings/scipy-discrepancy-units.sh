#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the four methods of scipy.stats.qmc.discrepancy are L2 norms, so all are in one unit.
# Seen: CD, WD and MD are squares of the discrepancies of Hickernell and of Zhou, Fang & Ning; L2-star alone is a
# root. For one point at 1/4 in one dimension, CD is 7/48 and L2-star is the root of 7/48, although both norms are
# equal there.
# Packages: numpy==2.3.5 scipy==1.17.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1
venv/bin/python - <<'END'
from scipy.stats import qmc
cd, star = (qmc.discrepancy([[0.25]], method=m) for m in ("CD", "L2-star"))
print("CD %.6f, L2-star %.6f, its square %.6f; 7/48 is %.6f" % (cd, star, star**2, 7 / 48))
raise SystemExit(not (abs(cd - 7 / 48) < 1e-12 and abs(star**2 - 7 / 48) < 1e-12))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: sobol_sequence(5, 2) has five rows, or refuses with a word about powers of two.
# Seen: it has eight rows, without a warning; halton_sequence(5, 2) beside it has five.
# Packages: numpy==2.3.5 scipy==1.17.1 pydoe==1.6.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 pydoe==1.6.0
venv/bin/python - <<'END'
import pydoe, warnings
warnings.simplefilter("error")
rows = len(pydoe.sobol_sequence(5, 2)), len(pydoe.halton_sequence(5, 2))
print("asked for 5 points: Sobol' %d, Halton %d" % rows)
raise SystemExit(rows != (8, 5))
END

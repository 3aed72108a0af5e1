#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: generate_lds_rvs(SequenceNum.PCG64, n, d) gives pseudo-random numbers of PCG64, as a baseline beside the two
# sequences.
# Seen: it gives a Sobol' sequence, point by point that of SequenceNum.NEW_JOE_KUO: a comparison with the baseline
# compares the sequence with itself.
# Packages: numpy==2.3.5 scipy==1.17.1 tklds==0.2.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 tklds==0.2.0
venv/bin/python - <<'END'
from tklds.constant import SequenceNum
from tklds.interface.generators import generate_lds_rvs
a, b = (generate_lds_rvs(kind, 1024, 8) for kind in (SequenceNum.PCG64, SequenceNum.NEW_JOE_KUO))
print("PCG64 begins with", a[:2].tolist(), "and equals NEW_JOE_KUO:", bool((a == b).all()))
raise SystemExit(not (a == b).all())
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: computeStarDiscrepancy takes the supremum over all boxes at the origin: .9 for one point at (.9, .9), by the
# empty box [0, .9) x [0, 1).
# Seen: it gives .19, the deviation of the closed box up to the point: boxes that leave the point out are not looked
# at.
# Packages: openturns==1.27
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check openturns==1.27
venv/bin/python - <<'END'
import openturns
sequence = openturns.LowDiscrepancySequence(openturns.SobolSequence(2))
value = sequence.computeStarDiscrepancy(openturns.Sample([[0.9, 0.9]]))
print("star discrepancy of {(.9, .9)}: %.4f; the box [0, .9) x [0, 1) is empty and has the volume .9" % value)
raise SystemExit(abs(value - 0.19) > 1e-9)
END

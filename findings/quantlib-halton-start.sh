#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: HaltonRsg(2) begins with (1/2, 1/3), as the parameters of a low-discrepancy sequence without a word on
# chance are.
# Seen: it begins at another place in each process and each object: the starts of the bases are random by default,
# and without a seed they come from the clock. randomStart=False gives (1/2, 1/3).
# Packages: QuantLib==1.44
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check QuantLib==1.44
venv/bin/python - <<'END'
import QuantLib as ql



def first(*arguments):
    halton = ql.HaltonRsg(2, *arguments)
    point = halton.nextSequence()
    return list(point.value())


firsts = [first() for _ in range(3)]
plain = first(0, False, False)
print("default:", *[tuple(round(x, 4) for x in p) for p in firsts], "without a random start:", plain)
raise SystemExit(len({tuple(p) for p in firsts}) < 2 or abs(plain[0] - .5) + abs(plain[1] - 1 / 3) > 1e-9)
END

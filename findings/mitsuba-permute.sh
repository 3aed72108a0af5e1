#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: mi.permute(i, size, seed) is a permutation of 0 .. size - 1 for any size, or refuses a size that is no power
# of two.
# Seen: for 5, 12 and 100 it takes all sizes without a word and gives numbers up to 7, 15 and 127: it permutes the
# bits of the next power of two. mi.permute_kensler beside it stays within any size.
# Packages: numpy==2.3.5 mitsuba==3.9.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 mitsuba==3.9.1
venv/bin/python - <<'END'
import mitsuba as mi

mi.set_variant("scalar_rgb")
changed = False
for size, beyond in ((5, True), (12, True), (16, False), (100, True)):
    largest = max(mi.permute(i, size, seed) for i in range(size) for seed in range(1, 9))
    kensler = [sorted(mi.permute_kensler(i, size, seed) for i in range(size)) for seed in range(1, 9)]
    print("size %d: permute up to %d, permute_kensler up to %d" % (size, largest, max(map(max, kensler))))
    changed |= (largest >= size) != beyond or any(k != list(range(size)) for k in kensler)
raise SystemExit(changed)
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: mi.RadicalInverse(max_base, scramble) gives in eval() radical inverses with the digits permuted: Faure's
# permutations with the default, scramble = -1, random ones with a seed, others for each seed.
# Seen: eval() permutes nothing, whatever scramble is: it is the plain van der Corput sequence, and no method of Python's
# class gives the other. permutation() has Faure's for -1 and random ones else, the same for each of five seeds: averages
# over scrambles of one's own with them are averages of one.
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


def plain(base, i):
    place, value = 1, 0
    while i:
        place /= base
        value += i % base * place
        i //= base
    return value


changed = any("scrambled" in name for name in dir(mi.RadicalInverse))
tables = {}
for scramble in (-1, 0, 1, 5, 1234, 1 << 30):
    inverse = mi.RadicalInverse(100, scramble)
    tables[scramble] = [[int(digit) for digit in inverse.permutation(k)] for k in range(6)]
    farthest = max(abs(inverse.eval(k, i) - plain(base, i)) for k, base in enumerate((2, 3, 5, 7)) for i in range(200))
    print("scramble %d: base 7 %s, eval() differs from plain digits by %.1g" % (scramble, tables[scramble][3], farthest))
    changed |= farthest > 1e-6
identity = [list(range(base)) for base in (2, 3, 5, 7, 11, 13)]
changed |= tables[-1] == identity or tables[1] == identity or any(tables[seed] != tables[1] for seed in tables if seed >= 0)
raise SystemExit(changed)
END

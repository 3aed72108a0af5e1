#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the first four words of numpy.random.Philox(key=0, counter=0) are the block of counter 0 and key 0, the
# known answer in Random123's table for philox4x64-10.
# Seen: they are the block of counter 1: the counter is raised before each block. The known answer comes with counter
# 2^256 - 1. Who continues a stream of another implementation by its counter is one block off.
# Packages: numpy==2.3.5
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5
venv/bin/python - <<'END'
import numpy as np

# philox4x64-10 of key 0 and counter 0: Salmon, Moraes, Dror & Shaw, Random123, kat_vectors.
KNOWN = [0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b]
first = [int(x) for x in np.random.Philox(key=0, counter=0).random_raw(4)]
before = [int(x) for x in np.random.Philox(key=0, counter=2**256 - 1).random_raw(4)]
print("counter 0:        ", " ".join("%016x" % x for x in first))
print("counter 2^256 - 1:", " ".join("%016x" % x for x in before))
raise SystemExit(first == KNOWN or before != KNOWN)
END

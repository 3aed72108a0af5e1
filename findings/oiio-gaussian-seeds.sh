#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: ImageBufAlgo.noise("gaussian") with seeds 1, 2, 3, ... gives independent pictures, as "white" does: the mean of n
# has a variance of 1 / n.
# Seen: of seeds 1 and 2 a pixel in five is equal, bit for bit, and their correlation is .21 (1 - pi / 4): where the polar
# method refuses a pair of numbers it goes on to those of the next seed. A mean over 16 seeds in a row has 1.5 times the
# variance of independent ones. Seeds far apart have nothing in common.
# Packages: OpenImageIO==3.2.2.0, numpy==2.4.6
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check OpenImageIO==3.2.2.0 numpy==2.4.6
venv/bin/python - <<'END'
import numpy as np
import OpenImageIO as oiio


def noise(kind, seed):
    buffer = oiio.ImageBuf(oiio.ImageSpec(256, 256, 1, oiio.FLOAT))
    oiio.ImageBufAlgo.zero(buffer)
    oiio.ImageBufAlgo.noise(buffer, kind, 0, 1, False, seed)
    return buffer.get_pixels(oiio.FLOAT).ravel().astype(float)


def pair(kind, one, other):
    a, b = noise(kind, one), noise(kind, other)
    equal, correlation = (a == b).mean(), np.corrcoef(a, b)[0, 1]
    print("%s, seeds %d and %d: %.3f equal, correlation %.3f" % (kind, one, other, equal, correlation))
    return equal, correlation


near, far, white = pair("gaussian", 1, 2), pair("gaussian", 1, 1001), pair("white", 1, 2)
row = 16 * np.mean([noise("gaussian", seed) for seed in range(1, 17)], axis=0).var()
apart = 16 * np.mean([noise("gaussian", 1000 * seed) for seed in range(1, 17)], axis=0).var()
print("16 times the variance of the mean of 16 seeds: in a row %.2f, 1000 apart %.2f" % (row, apart))
seen = all(abs(x - (1 - np.pi / 4)) < .02 for x in near) and max(map(abs, far + white)) < .02 and abs(apart - 1) < .05
raise SystemExit(not (seen and row > 1.3))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: solidAngles() of an EnvironmentMap add up to 4 pi in each of skylibs' formats of the whole sphere, up to the
# pixels on the edge of the format, and the better the more pixels it has.
# Seen: those of "latlong" and "angular" do. Those of "sphere", the mirror ball, add up to 1.77 times 4 pi with 64
# pixels across and to 1.76 times with 512: inside, each pixel has its right angle (orthographic pictures of a mirror
# ball keep areas), but pixels on the silhouette have up to 23 times that, or 180 times. Sums of light over a ball are
# wrong by as much.
# Packages: numpy==2.4.6 scipy==1.17.1 skylibs==0.6.6
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.4.6 scipy==1.17.1 skylibs==0.6.6
venv/bin/python -W ignore - <<'END'
import numpy as np
from envmap import EnvironmentMap

seen = True
for kind, right in (("latlong", 1), ("angular", 1), ("sphere", 1.765)):
    for size in (64, 512):
        angles = EnvironmentMap(size, kind).solidAngles()
        total = np.nansum(angles) / (4 * np.pi)
        median, largest = np.nanmedian(angles), np.nanmax(angles)
        print(f"{kind:8} {size:3}: {total:.4f} times 4 pi; most pixels {median:.3g}, largest {largest:.3g}")
        seen = seen and abs(total - right) < .01
        if kind == "sphere":
            seen = seen and np.isclose(median, 4 * (2 / size) ** 2, rtol=.001)
raise SystemExit(not seen)
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a panorama turned to a cube map (e2c) and back (c2e) is the panorama, somewhat smoothed; ten times there and
# back smooth it more.
# Seen: each trip moves it by half a pixel to the left and up, ten trips by five: c2e reads the faces half a pixel
# beside the places that e2c gives them. Its first and last columns look in one direction.
# Packages: numpy==2.3.5 scipy==1.17.1 py360convert==1.0.4
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 py360convert==1.0.4
venv/bin/python - <<'END'
import numpy as np
from py360convert import c2e, e2c

rows, columns = 256, 512
height, turn = (np.mgrid[:rows, :columns] + .5) / rows * np.pi
turn -= np.pi
first = np.stack([np.sin(height) * np.sin(turn), np.cos(height), np.sin(height) * np.cos(turn)], axis=-1)  # directions


def moved(panorama):
    """By how many pixels the middle rows have what lay farther right, and farther down, on average."""
    x, y, z = np.moveaxis(panorama[rows // 4:3 * rows // 4], -1, 0)
    right = (np.arctan2(x, z) - turn[0] + np.pi) % (2 * np.pi) - np.pi
    down = np.arctan2(np.hypot(x, z), y) - height[rows // 4:3 * rows // 4]
    return right.mean() / np.pi * rows, down.mean() / np.pi * rows


panorama, shifts = first, [moved(first)]
for trip in range(10):
    panorama = c2e(e2c(panorama, face_w=128, cube_format="dict"), rows, columns, cube_format="dict")
    shifts.append(moved(panorama))
    if trip in (0, 9):
        print("after %d: moved by %.2f and %.2f pixels" % (trip + 1, *shifts[-1]))
seam = np.abs(panorama[:, 0] - panorama[:, -1]).max()
print(f"difference of the first and last columns: {seam:.1g}, at first {np.abs(first[:, 0] - first[:, -1]).max():.1g}")
seen = np.allclose(shifts[0], 0) and np.allclose(shifts[1], .5, atol=.1) and np.allclose(shifts[10], 5, atol=1)
raise SystemExit(not (seen and seam < 1e-5))
END

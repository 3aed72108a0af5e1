#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: readers of Radiance pictures turn one that is stored from the bottom (`+Y 2 +X 2`) upright, and of `EXPOSURE=2`, by
# which the stored values have been multiplied, at least one of four takes account.
# Seen: OpenCV and Mitsuba refuse the first; OpenImageIO returns the rows as stored and notes Orientation 4. All ignore the
# second, and imageio, where OpenCV is installed, cuts values off at 1 and returns eight bits.
# Packages: numpy==2.4.6 opencv-python-headless==5.0.0.93 imageio==2.38.1 OpenImageIO==3.2.2.0 mitsuba==3.9.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.4.6 opencv-python-headless==5.0.0.93 imageio==2.38.1 \
    OpenImageIO==3.2.2.0 mitsuba==3.9.1
venv/bin/python - 2>/dev/null <<'END'
import cv2
import imageio.v3
import mitsuba
import numpy as np
import OpenImageIO

mitsuba.set_variant("scalar_rgb")
ROWS = bytes([128, 0, 0, 129] * 2 + [0, 128, 0, 130] * 2)  # red 1, then green 2


def write(name, size, more=""):
    with open(name, "wb") as out:
        out.write(f"#?RADIANCE\n{more}FORMAT=32-bit_rle_rgbe\n\n{size}\n".encode() + ROWS)


def opencv(name):
    picture = cv2.imread(name, cv2.IMREAD_UNCHANGED)
    return "refused" if picture is None else picture[:, 0, ::-1].tolist()


def oiio(name):
    picture = OpenImageIO.ImageBuf(name)
    return picture.get_pixels()[:, 0].tolist(), picture.spec().get_int_attribute("Orientation", 1)


def bitmap(name):
    try:
        return np.array(mitsuba.Bitmap(name))[:, 0].tolist()
    except RuntimeError:
        return "refused"


write("up.hdr", "-Y 2 +X 2")
write("down.hdr", "+Y 2 +X 2")
write("exposed.hdr", "-Y 2 +X 2", "EXPOSURE=2\n")
stored = [[1, 0, 0], [0, 2, 0]]
seen = {(read.__name__, name): read(f"{name}.hdr") for name in ("up", "down", "exposed") for read in (opencv, oiio, bitmap)}
seen["imageio", "exposed"] = imageio.v3.imread("exposed.hdr")[:, 0].tolist()
for what, values in seen.items():
    print(*what, values)
expected = {("oiio", name): (stored, 4 if name == "down" else 1) for name in ("up", "down", "exposed")}
expected |= {(reader, name): "refused" if name == "down" else stored for reader in ("opencv", "bitmap") for name in ("up", "down", "exposed")}
expected["imageio", "exposed"] = [[255, 0, 0], [0, 255, 0]]
raise SystemExit(seen != expected)
END

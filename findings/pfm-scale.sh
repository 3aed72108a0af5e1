#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: only the sign of the scale in a PFM file matters (byte order), or all readers that use its size multiply; all
# show the first row of the file at the bottom.
# Seen: with scale -2, OpenImageIO multiplies the pixels by 2, OpenCV divides them by 2, Pillow ignores it.
# OpenImageIO also has the first row of the file, the bottom one by the format, as its first row; the others turn the
# picture over.
# Packages: numpy==2.3.5 opencv-python-headless==5.0.0.93 OpenImageIO==3.2.2.0 pillow==13.0.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 opencv-python-headless==5.0.0.93 OpenImageIO==3.2.2.0 pillow==13.0.0
venv/bin/python - <<'END'
import cv2, numpy, OpenImageIO, PIL.Image
with open("a.pfm", "wb") as file:
    file.write(b"Pf\n2 2\n-2\n" + numpy.array([[1, 2], [3, 4]], "<f4").tobytes())
pixels = {
    "OpenImageIO": OpenImageIO.ImageBuf("a.pfm").get_pixels().reshape(2, 2, -1)[:, :, 0].tolist(),
    "OpenCV": cv2.imread("a.pfm", cv2.IMREAD_UNCHANGED).tolist(),
    "Pillow": numpy.array(PIL.Image.open("a.pfm")).tolist(),
}
for name, rows in pixels.items():
    print(name, rows)
expected = {"OpenImageIO": [[2, 4], [6, 8]], "OpenCV": [[1.5, 2], [0.5, 1]], "Pillow": [[3, 4], [1, 2]]}
raise SystemExit(pixels != expected)
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: imageio.v3.imread of a PFM gives the file's floats, whichever of its plug-ins reads it.
# Seen: with Pillow alone it gives them; once OpenCV is installed beside it, imageio takes that for PFM and returns uint8, rounded and
# clipped to 0 .. 255 without a warning (-1.5, 0.25, 2.75, 300.5 become 0, 0, 3, 255), although cv2 writes the floats. plugin="pillow"
# gives them again.
# Packages: imageio==2.38.1, pillow==13.0.0, numpy==2.4.6, opencv-python-headless==5.0.0.93
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check imageio==2.38.1 pillow==13.0.0 numpy==2.4.6
cat > read.py <<'END'
import sys

import imageio.v3 as iio
import numpy as np

values = np.array([[0.25, 2.75], [-1.5, 300.5]], "<f4")
with open("a.pfm", "wb") as file:
    file.write(b"Pf\n2 2\n-1.0\n" + np.flipud(values).tobytes())
plain, pillow = iio.imread("a.pfm"), iio.imread("a.pfm", plugin="pillow")
print(plain.dtype, plain.tolist(), "by plugin='pillow':", pillow.dtype, pillow.tolist())
expected = np.array([[0, 3], [0, 255]], np.uint8) if sys.argv[1] == "opencv" else values
raise SystemExit(not (plain.dtype == expected.dtype and np.array_equal(plain, expected) and np.array_equal(pillow, values)))
END
venv/bin/python read.py alone
venv/bin/pip install -q --disable-pip-version-check opencv-python-headless==5.0.0.93
venv/bin/python read.py opencv

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a reader of EXR gives a picture of the display window, with black around a smaller data window: here 8 x 6
# pixels, of which 4 x 3 are stored.
# Seen: OpenEXR's own module, OpenImageIO's buffer and Mitsuba give 4 x 3 pixels and no place; a crop compared pixel
# by pixel with its whole picture is compared with the wrong corner, or refused for its size.
# Packages: numpy==2.3.5 OpenEXR==3.5.3 OpenImageIO==3.2.2.0 mitsuba==3.9.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 OpenEXR==3.5.3 OpenImageIO==3.2.2.0 mitsuba==3.9.1
venv/bin/python - <<'END'
import numpy as np
import OpenEXR
import OpenImageIO as oiio
import mitsuba as mi

mi.set_variant("scalar_rgb")
grey = np.arange(12, dtype=np.float32).reshape(3, 4)
windows = {"dataWindow": (np.array([2, 1], np.int32), np.array([5, 3], np.int32)),
           "displayWindow": (np.array([0, 0], np.int32), np.array([7, 5], np.int32))}
header = {"type": OpenEXR.scanlineimage, "compression": OpenEXR.ZIP_COMPRESSION, **windows}
OpenEXR.File(header, {"RGB": np.dstack([grey] * 3)}).write("crop.exr")
sizes = {
    "OpenEXR": OpenEXR.File("crop.exr").channels()["RGB"].pixels.shape[:2],
    "OpenImageIO": oiio.ImageBuf("crop.exr").get_pixels().shape[:2],
    "Mitsuba": np.array(mi.Bitmap("crop.exr")).shape[:2],
}
print(sizes)
raise SystemExit(any(tuple(size) != (3, 4) for size in sizes.values()))
END

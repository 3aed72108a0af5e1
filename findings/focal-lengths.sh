#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: focal_length "50mm" in Mitsuba is for a film 36 mm wide: a horizontal angle of 39.6 degrees at each shape of the
# film; focalLength 50 of a USD camera is 50 of the stage's units, or 50 mm.
# Seen: Mitsuba takes the film's diagonal for that of 36 x 24 mm: 39.6 degrees at 3:2, 41.3 at 16:9, 34.0 for a square.
# USD's focal length and apertures are in tenths of the stage's unit, which is a millimetre only where the unit is a
# centimetre.
# Packages: numpy==2.3.5 mitsuba==3.9.1 usd-core==26.11
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 mitsuba==3.9.1 usd-core==26.11
venv/bin/python - <<'END'
import math
import mitsuba
from pxr import Gf
mitsuba.set_variant("scalar_rgb")
changed = Gf.Camera.FOCAL_LENGTH_UNIT != 0.1 or Gf.Camera.APERTURE_UNIT != 0.1
print("USD's focal length in units of the stage:", Gf.Camera.FOCAL_LENGTH_UNIT)
for width, height in ((360, 240), (640, 360), (100, 100)):
    camera = mitsuba.load_dict({"type": "perspective", "focal_length": "50mm",
                                "film": {"type": "hdrfilm", "width": width, "height": height}})
    seen = mitsuba.traverse(camera)["x_fov"]
    diagonal = 2 * math.degrees(math.atan(math.hypot(36, 24) / 100 * width / math.hypot(width, height)))
    print(f"{width} x {height}: {seen:.2f} degrees; of the diagonal: {diagonal:.2f}")
    changed |= abs(seen - diagonal) > 0.01
raise SystemExit(changed)
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: aperture A of a camera is the diameter of its lens, or its radius: with the focus at 10, the edge of a plate at
# 20 is blurred over a width of A, or 2 A, there.
# Seen: it is A / 2: the lens has a diameter of half the aperture. A depth of field taken from another renderer's lens
# radius r needs aperture 4 r.
# Packages: povray 3.7.0.10 (Debian), numpy==2.3.5
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5
cat >scene.pov <<'END_OF_SCENE'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { right 3*x/20 up .01*y direction z focal_point 10*z aperture A blur_samples 400 confidence .999999 variance 0 }
box { <0, -100, 20>, <100, 100, 21> pigment { rgb 1 } finish { emission 1 ambient 0 diffuse 0 } }
END_OF_SCENE
for a in 1 2 4; do
  povray +Iscene.pov +W300 +H1 -A Declare=A=$a +FP16 +Oblur$a.ppm -D +WT1 File_Gamma=1 >log 2>&1
done
venv/bin/python - <<'END_OF_CHECK'
import numpy as np

seen = True
for a in (1, 2, 4):
    with open(f"blur{a}.ppm", "rb") as file:
        values = np.frombuffer(file.read()[-1800:], ">u2")[::3] / 65535
    steps, x = np.diff(values), (np.arange(299) - 149) / 100
    middle = np.average(x, weights=steps)
    width = 4 * np.sqrt(np.average((x - middle) ** 2, weights=steps))  # of a disc whose edge has this deviation
    print(f"aperture {a}: blurred over {width:.2f}, from {x[steps > .001].min():.2f} to {x[steps > .001].max():.2f}")
    seen = seen and abs(width / (a / 2) - 1) < .1
raise SystemExit(not seen)
END_OF_CHECK

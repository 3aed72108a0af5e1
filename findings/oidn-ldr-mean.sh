#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: Open Image Denoise keeps the mean brightness of a noisy grey, and for a picture with all values in [0, 1] it
# matters little whether hdr is set.
# Seen: with hdr the mean of .5 or .2 is kept within .01. Without, the default, it is raised: uniform noise from 0 to 1
# becomes .68, normal noise of deviation .1 about .5 becomes .514, and a picture of which one pixel in five is 1 and the
# rest 0 becomes .85, not .2. A picture without noise is kept: the filter takes noise in [0, 1] for what is left of
# brighter noise cut off at 1.
# Packages: numpy==2.3.5 pyoidn==2.5.1.0 (with the libraries of Open Image Denoise 2.5.1)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 pyoidn==2.5.1.0
venv/bin/python - <<'END_OF_CHECK'
import numpy as np
import pyoidn

generator, size = np.random.default_rng(1), (128, 128)
pictures = {
    "constant 1/2": (np.full(size, .5), .5),
    "1/2 and normal noise of .1": (.5 + .1 * generator.standard_normal(size), .514),
    "uniform noise": (generator.random(size), .675),
    "1 in one pixel of five": (generator.random(size) < .2, .851)}
seen = True
for name, (grey, raised) in pictures.items():
    picture = np.repeat(np.float32(np.clip(grey, 0, 1))[..., None], 3, axis=2)
    results = (picture, pyoidn.denoise(picture, hdr=True), pyoidn.denoise(picture, hdr=False))
    mean, hdr, ldr = (float(p.mean()) for p in results)
    print(f"{name:26}: mean {mean:.3f}, denoised with hdr {hdr:.3f}, without {ldr:.3f}")
    seen = seen and abs(hdr - mean) < .02 and abs(ldr - raised) < .008
raise SystemExit(not seen)
END_OF_CHECK

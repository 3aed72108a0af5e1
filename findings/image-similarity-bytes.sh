#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: image-similarity-measures takes 8-bit pictures as such: PSNR with a peak of 255, RMSE in grey levels or in
# parts of 255, and a spectral angle (SAM) of 0 between a picture and itself.
# Seen: PSNR and RMSE take 4,095 as the peak unless told, so PSNR is 24.1 dB too high: 56.7 where it is 32.6. SAM
# multiplies bytes as bytes, modulo 256: a picture of noise is 89 degrees from itself, and 0 once it is made of floats.
# Packages: numpy==1.24.4 scikit-image==0.20.0 image-similarity-measures==0.3.6
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==1.24.4 scikit-image==0.20.0 image-similarity-measures==0.3.6
venv/bin/python -W ignore - <<'END'
import numpy as np
from image_similarity_measures.quality_metrics import psnr, rmse, sam

generator = np.random.default_rng(1)
first = generator.integers(0, 256, (64, 64, 3)).astype(np.uint8)
second = np.clip(first.astype(int) + generator.integers(-10, 11, first.shape), 0, 255).astype(np.uint8)
error = np.sqrt(np.square(first.astype(float) - second).mean())
right = 20 * np.log10(255 / error)
theirs, root = psnr(first, second), rmse(first, second)
own, floats = sam(first, first), sam(first.astype(float), first.astype(float))
print(f"PSNR {theirs:.2f} dB, with a peak of 255 it is {right:.2f}; RMSE {root:.5f}, in grey levels {error:.2f}")
print(f"SAM of a picture and itself: {own:.1f} degrees; as floats {floats:.1g}")
peak = abs(theirs - right - 20 * np.log10(4095 / 255)) < .01 and abs(root * 4095 / error - 1) < .01
raise SystemExit(not (peak and own > 80 and floats < .001))
END

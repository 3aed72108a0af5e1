# SPDX-License-Identifier: Apache-2.0
"""The area of a quarter disk in 1,024 pixels of 64 samples each: RMS errors of random and of Sobol' samples.

    python3 example.py
"""
import math

import numpy as np

import koksma_sampler as ks

DISK = 0  # the use of these samples
SPP = 64

pixel = ks.domain_of_pixel(seed=7, x=np.arange(32), y=np.arange(32)[:, None])[..., None]
for name, draw in (("white", ks.white), ("sobol", ks.sobol)):
    xy = draw(ks.domain_of_use(pixel, DISK), np.arange(SPP), 2)  # 32 x 32 pixels x 64 samples x 2
    area = ((xy ** 2).sum(-1) < 1).mean(-1)
    print(f"{name} {math.sqrt(((area - math.pi / 4) ** 2).mean()):.4f}")

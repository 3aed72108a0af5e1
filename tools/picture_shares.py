#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What keys over quadruples could gain at most in a picture: the numbers of docs/findings/screen-noise.md.

    tools/picture_shares.py SCENE USE,USE,...

Prints which share of the variance of a pixel's sample, summed over the picture, depends on one use of samples alone, and which two
uses couple (Sobol' 1993, by freezing): with 16 samples that share one point of the frozen uses, a pixel has the variance

    V = D + (T - D) / 16,   T of one sample, D of the mean over the other uses, so D = (16 V - T) / 15.

Keys over pairs leave what two uses couple white. After a Gaussian of 1.5 pixels they leave R of the mean square error of random
samples, in which those couplings still have their whole share S. So a quadruple that lost nothing elsewhere and left nothing of S
would have sqrt(1 - S / R) of the error. The package of this tree renders.
"""
import itertools
import os
import sys
import tempfile

import numpy as np

import koksma

FROZEN, SETS, PICTURES = 16, 1024, 32
DIMS = {"pixel": 2, "lens": 2, "time": 1, "light": 2, "lobe": 2, "lobe-choice": 1}


def variance(scene, pattern, spp, pictures, change=lambda picture: picture):
    """The variance of luminance over the seeds, one number a pixel."""
    seen = []
    for seed in range(pictures):
        picture = koksma.render(scene, pattern, spp, seed=seed).astype(float)
        seen.append(change(picture @ [.2126, .7152, .0722] if picture.shape[-1] == 3 else picture[..., 0]))
    return np.var(seen, 0, ddof=1)


def blurred(picture):
    """The picture after the Gaussian, without its margin."""
    w = np.exp(-np.arange(-6, 7)**2 / 4.5)
    for _ in range(2):
        picture = sum(w[k] / w.sum() * picture[k:len(picture) - 12 + k] for k in range(13)).T
    return picture


def main():
    if len(sys.argv) != 3 or not set(sys.argv[2].split(",")) <= set(DIMS):
        sys.exit(f"usage: picture_shares.py SCENE USE,USE,...; the uses are {', '.join(DIMS)}")
    scene, uses = sys.argv[1], sys.argv[2].split(",")
    total = variance(scene, "random", 1, 16 * PICTURES).mean()
    white = variance(scene, "random", 1, 8 * PICTURES, blurred)
    left = variance(scene, "ranking-keys", 1, 8 * PICTURES, blurred).mean() / white.mean()
    largest = np.sort(white.ravel())[-(white.size // 100):].sum() / white.sum()
    print(f"{scene}: pairs leave R = {left:.3f}; 1 % of the pixels have {largest:.3f} of the error after the filter")
    with tempfile.TemporaryDirectory() as folder:
        random = np.random.default_rng(1)
        for dim, k in itertools.product((1, 2), range(SETS)):
            np.savetxt(os.path.join(folder, f"{dim}_{k}.txt"), np.tile(random.random(dim), (FROZEN, 1)))

        def share(frozen):
            """D / T."""
            patterns = [f"{use}=file:{folder}/{DIMS[use]}_{{seed}}.txt" for use in frozen]
            v = variance(scene, ";".join(["random", *patterns]), FROZEN, PICTURES).mean()
            return (FROZEN * v / total - 1) / (FROZEN - 1)

        alone = {use: share([use]) for use in uses}
        for use in uses:
            print(f"{use} {alone[use]:.3f}")
        for a, b in itertools.combinations(uses, 2):
            coupled = share([a, b]) - alone[a] - alone[b]
            print(f"{a}+{b} {coupled:.3f}: at best {np.sqrt(1 - max(0, coupled) / left):.3f} of the error")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""poisson_disk_bias.py KOKSMA: the table of biases in docs/findings/blue-noise.md.

With m the mean error of T renders of a pixel and v their variance, m^2 - v / T is an unbiased estimate of the squared
bias; the reference's own variance, from its two halves, is taken off, too. Intervals: jackknife over 8 groups of seeds."""
import os
import subprocess
import sys
import tempfile

import numpy as np

TRIALS, GROUPS, STUDENT_975 = 32, 8, 2.365
PATTERNS = ("poisson-disk:d=0.2", "poisson-disk:d=0.2,torus=1", "jittered", "n-rooks")


def render(program, folder, scene, pattern, spp, seed):
    path = os.path.join(folder, "image.pfm")
    subprocess.run([program, "render", scene, "--size", "64x48", "-p", pattern, "-n", str(spp), "-s", str(seed), "-o", path,
                    "-q"], check=True, capture_output=True)
    with open(path, "rb") as file:
        kind, size, _, data = file.read().split(b"\n", 3)
    width, height = map(int, size.split())
    values = np.frombuffer(data, "<f4").reshape(height, width, -1).astype(float)
    return values @ [0.2126, 0.7152, 0.0722] if kind == b"PF" else values[..., 0]


def squared_bias(errors, own):
    """errors: [trial, y, x]; own: the variance of the reference."""
    return np.mean(errors.mean(0) ** 2) - np.mean(errors.var(0, ddof=1)) / len(errors) - own


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        for scene in ("checker", "ball"):
            halves = [render(program, folder, scene, "jittered", 16384, 900 + k) for k in range(2)]
            own = np.mean((halves[0] - halves[1]) ** 2) / 4
            for pattern in PATTERNS:
                errors = np.array([render(program, folder, scene, pattern, 16, seed) for seed in range(TRIALS)])
                errors -= (halves[0] + halves[1]) / 2
                square = squared_bias(errors, own)
                groups = errors.reshape(GROUPS, TRIALS // GROUPS, *errors.shape[1:]).mean(1)
                left = [squared_bias(np.delete(groups, k, 0), own) for k in range(GROUPS)]
                half = STUDENT_975 * np.sqrt((GROUPS - 1) ** 2 / GROUPS * np.var(left, ddof=1))
                print(f"{scene} {pattern}: mean absolute error {np.abs(errors).mean():.5f}, squared bias {square:.3g} "
                      f"+- {half:.2g}: root {np.sqrt(max(square, 0)):.4f}, upper end {np.sqrt(max(square + half, 0)):.4f}, "
                      f"{100 * square / np.mean(errors ** 2):.1f} % of the squared error", flush=True)


if __name__ == "__main__":
    main()

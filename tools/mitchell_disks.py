#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which law of disks gives table 3 of Mitchell 1992? Tries many and prints how far each is from the printed numbers.

    tools/mitchell_disks.py build/release/koksma [TRIALS] >laws.txt

The paper says: "some patterns were tested on a set of random disks on the unit torus. Once again, 100 trials were
averaged." It gives neither the radii, nor where the disks lie, nor what is averaged over them. A law here is a region
(one random disk a look, or the union of many) and a statistic of its errors nu/N - A. The score is the root mean
square of log(ours / printed) over the 15 cells; 100 looks at a normal error with unknown sign scatter by about 0.075
when their mean absolute value is taken. The radius of each law is chosen for the best score.

Point sets come from the program; everything else is computed here, from the definitions, with NumPy.
"""
import subprocess
import sys

import numpy as np

SIZES = (16, 256, 1600)
PRINTED = {
    "dart-throwing": (0.0840, 0.0120, 0.00368),
    "jittered": (0.0994, 0.0165, 0.00394),
    "zaremba": (0.0855, 0.0160, 0.00511),
    "random": (0.104, 0.0239, 0.00993),
    "n-rooks": (0.0908, 0.0224, 0.0104),
}


def point_sets(program, pattern, n, trials):
    """Sets of the pattern; of a deterministic one the same set again and again."""
    sets = []
    for seed in range(trials if pattern != "zaremba" else 1):
        text = subprocess.run([program, "generate", pattern, "-n", str(n), "--seed", str(seed)], check=True,
                              capture_output=True, text=True).stdout
        sets.append(np.array([[float(x) for x in line.split()] for line in text.splitlines() if line[0] not in "#"]))
    return sets


def disks(rng, law, radius, count):
    """Centres and radii. `radius` is the one radius, or the largest."""
    if law == "fixed":
        r = np.full(count, radius)
    elif law == "radius":
        r = radius * rng.random(count)
    elif law == "area":
        r = radius * np.sqrt(rng.random(count))
    return rng.random((count, 2)), r


def inside(points, centres, radii, place):
    """Which points each disk has: on the torus, or where it stays in, or is clipped by, the square."""
    d = np.abs(points[None, :, :] - centres[:, None, :])
    if place == "torus":
        d = np.minimum(d, 1 - d)
    return (d ** 2).sum(2) <= radii[:, None] ** 2


def clipped_area(centres, radii, grid=400):
    """Areas of disks cut off by the square, by a fine regular grid of columns."""
    x = (np.arange(grid) + 0.5) / grid
    half = np.sqrt(np.maximum(radii[:, None] ** 2 - (x[None, :] - centres[:, :1]) ** 2, 0))
    top, bottom = np.minimum(centres[:, 1:] + half, 1), np.maximum(centres[:, 1:] - half, 0)
    return np.maximum(top - bottom, 0).mean(1)


def single_errors(rng, points, law, radius, place, skip, looks):
    """Errors of `looks` random disks."""
    c, r = disks(rng, law, radius, looks)
    if place == "inside":
        c = r[:, None] + (1 - 2 * r[:, None]) * c
    area = clipped_area(c, r) if place == "clipped" else np.pi * r ** 2
    return inside(points[skip:], c, r, place).sum(1) / len(points) - area


def statistic(name, errors):
    """One number of a set's errors."""
    if name == "rms":
        return np.sqrt((errors ** 2).mean())
    if name == "mean abs":
        return np.abs(errors).mean()
    k = int(name.split()[-1])  # the largest of k
    return np.abs(errors)[: len(errors) // k * k].reshape(-1, k).max(1).mean()


def union(rng, area, radius):
    """Disks of one radius, as many as cover the share `area` of the torus, and what they cover exactly enough."""
    grid = (np.arange(512) + 0.5) / 512
    x, y = np.meshgrid(grid, grid)
    covered = np.zeros(x.shape, bool)
    centres = []
    while covered.mean() < area:
        c = rng.random(2)
        dx, dy = np.abs(x - c[0]), np.abs(y - c[1])
        covered |= np.minimum(dx, 1 - dx) ** 2 + np.minimum(dy, 1 - dy) ** 2 <= radius ** 2
        centres.append(c)
    return np.array(centres), covered.mean()


def score(ours):
    cells = [np.log(ours[p][i] / PRINTED[p][i]) for p in PRINTED for i in range(3)]
    return float(np.sqrt(np.mean(np.square(cells))))


def main():
    program, trials = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 20
    sets = {(p, n): point_sets(program, p, n, trials) for p in PRINTED for n in SIZES}
    rows = []
    for law in ("fixed", "radius", "area"):
        for place in ("torus", "inside", "clipped"):
            for skip in (0, 1):
                for name in ("rms", "mean abs", "largest of 3", "largest of 10", "largest of 100"):
                    best = None
                    for radius in (0.03, 0.06, 0.125, 0.25, 0.5):
                        rng = np.random.default_rng(1)
                        looks = 200
                        ours = {p: [np.mean([statistic(name, single_errors(rng, s, law, radius, place, skip, looks))
                                             for s in sets[p, n][:6]]) for n in SIZES] for p in PRINTED}
                        found = (score(ours), radius)
                        best = found if best is None or found < best else best
                    rows.append((best[0], f"one disk, {law}, {place}, {'first point not counted, ' if skip else ''}"
                                          f"{name}, up to r = {best[1]}"))
    for name in ("rms", "mean abs"):
        for radius in (0.03, 0.06, 0.1, 0.15, 0.25):
            for area in (0.1, 0.2, 0.5):
                rng = np.random.default_rng(1)
                ours = {p: [] for p in PRINTED}
                for p in PRINTED:
                    for n in SIZES:
                        errors = []
                        for _ in range(6):  # regions; the paper's is one
                            c, a = union(rng, area, radius)
                            for s in sets[p, n]:
                                hit = np.zeros(len(s), bool)
                                for k in range(0, len(c), 64):
                                    hit |= inside(s, c[k:k + 64], np.full(len(c[k:k + 64]), radius), "torus").any(0)
                                errors.append(hit.mean() - a)
                        ours[p].append(statistic(name, np.array(errors)))
                rows.append((score(ours), f"union of disks of r = {radius} that covers {area}, {name} over sets and 6 regions"))
    for value, what in sorted(rows):
        print(f"{value:.3f}  {what}")


if __name__ == "__main__":
    main()

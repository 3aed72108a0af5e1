#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Which law of disks gives table 3 of Mitchell 1992? Tries many and prints how well each explains the printed numbers.

    tools/mitchell_disks.py build/release/koksma [SETS [REGIONS]] >laws.txt

The paper says: "some patterns were tested on a set of random disks on the unit torus. Once again, 100 trials were
averaged." It gives neither the radii, nor where the disks lie, nor what is averaged over them. A law here is one random
disk a trial, or one region made of many disks for all trials (their union, or the points inside an odd number of them),
and a statistic of the errors nu/N - A over the 100 trials.

The score is chi-square: the sum over cells of (ln(printed / expected) / s)^2, where s is the relative standard deviation of
the statistic of 100 trials, found from our trials (about 0.0755 for a mean of absolute normal errors, sqrt(pi/2 - 1) / 10),
and that of our own estimate. Zaremba's points are one set: with one disk a trial its row averages 100 disks like the
others, but with one region its cells are single draws, whose size over the standard deviation stands beside the score and
is no part of it. p is the probability of a chi-square as large by chance, with two parameters fitted (the size of the
disks and their number or law).

Point sets come from the program; everything else is computed here, from the definitions, with NumPy.
"""
import subprocess
import sys

import numpy as np
from scipy.stats import chi2

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


STATISTICS = ("mean abs", "rms", "largest of 3", "largest of 10", "largest of 100")


def statistic(name, errors):
    """The statistic of errors, and its relative standard deviation over 100 trials."""
    values = np.abs(errors)
    if name == "rms":
        squares = values ** 2
        return np.sqrt(squares.mean()), squares.std() / squares.mean() / 20
    if name.startswith("largest"):
        k = int(name.split()[-1])
        values = values[:len(values) // k * k].reshape(-1, k).max(1)
    return values.mean(), values.std() / values.mean() / 10


def score(ours, patterns):
    """Chi-square over the cells of the patterns, and its p-value with two parameters fitted."""
    total = 0
    for p in patterns:
        for i in range(3):
            value, scatter, looks = ours[p, SIZES[i]]
            total += np.log(PRINTED[p][i] / value) ** 2 / (scatter ** 2 * (1 + 100 / looks)) if value > 0 else np.inf
    return total, chi2.sf(total, 3 * len(patterns) - 2)


def single_laws(sets):
    """One disk a trial: (chi-square, p, cells, words, size of Zaremba's draws)."""
    looks = 200
    for law in ("fixed", "radius", "area"):
        for place in ("torus", "inside", "clipped"):
            for skip in (0, 1):
                for radius in (0.03, 0.06, 0.125, 0.25, 0.5):
                    rng = np.random.default_rng(1)
                    errors = {key: np.concatenate([single_errors(rng, x, law, radius, place, skip, looks) for x in s[:6]])
                              for key, s in sets.items()}
                    for name in STATISTICS:
                        ours = {key: (*statistic(name, e), len(e)) for key, e in errors.items()}
                        yield (*score(ours, PRINTED), 15, f"one disk a trial, {law}, {place}, "
                               f"{'first point not counted, ' if skip else ''}{name}, up to r = {radius}", "")


def region(rng, count, radius, law, odd):
    """A region of many disks: centres, squared radii, and the area that it covers, on a grid of 1024 x 1024."""
    centres, r = disks(rng, law, radius, count)
    x = (np.arange(1024) + 0.5) / 1024
    inside_of = np.zeros((1024, 1024), np.int16)
    for c, q in zip(centres, r ** 2):
        dx, dy = np.abs(x - c[0]), np.abs(x - c[1])
        inside_of += (np.minimum(dx, 1 - dx)[:, None] ** 2 + np.minimum(dy, 1 - dy)[None, :] ** 2 <= q)
    return centres, r, (inside_of % 2 if odd else inside_of > 0).mean()


def region_errors(regions, points, odd):
    hits = [inside(points, c, r, "torus").sum(0) for c, r, _ in regions]
    return [(h % 2 if odd else h > 0).mean() - area for h, (_, _, area) in zip(hits, regions)]


def region_laws(sets, n_regions):
    """One region of many disks for all trials."""
    random = [p for p in PRINTED if p != "zaremba"]
    for odd in (False, True):
        for law in ("fixed", "radius", "area"):
            for count, radius in ((5, 0.25), (16, 0.1), (16, 0.2), (64, 0.06), (64, 0.1), (64, 0.15), (256, 0.03), (256, 0.06)):
                rng = np.random.default_rng(1)
                regions = [region(rng, count, radius, law, odd) for _ in range(n_regions)]
                errors = {key: np.array([region_errors(regions, x, odd) for x in s]).ravel() for key, s in sets.items()}
                area = np.mean([a for _, _, a in regions])
                for name in STATISTICS[:2]:
                    ours = {key: (*statistic(name, e), len(e)) for key, e in errors.items()}
                    draws = [PRINTED["zaremba"][i] / np.sqrt((errors["zaremba", SIZES[i]] ** 2).mean()) for i in range(3)]
                    expected = ", ".join(f"{p} " + " ".join(f"{ours[p, n][0]:.3g}" for n in SIZES) for p in PRINTED)
                    yield (*score(ours, random), 12, f"{'odd number' if odd else 'union'} of {count} disks, {law}, up to "
                           f"r = {radius}, covering {area:.2f}, {name}",
                           " zaremba " + " ".join(f"{d:.1f}" for d in draws) + f" sd; expected: {expected}")


def main():
    program = sys.argv[1]
    trials, n_regions = (int(sys.argv[i]) if len(sys.argv) > i else 20 for i in (2, 3))
    sets = {(p, n): point_sets(program, p, n, trials) for p in PRINTED for n in SIZES}
    for value, p, cells, what, beside in sorted([*single_laws(sets), *region_laws(sets, n_regions)]):
        print(f"{value:8.1f} of {cells} cells, p = {p:.2g}: {what}{beside}")


if __name__ == "__main__":
    main()

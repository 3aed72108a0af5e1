#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""brute_records.py PROGRAM [LARGEST]: the value of every set of `koksma list records`, from the definition alone.

    D* = the largest |#/n - x y| over all boxes [0, x) x [0, y) and [0, x] x [0, y] (with z in 3 dimensions),

x, y and z coordinates of points, or 1, in numpy, which shares no code with the library; L2 discrepancies as sums over all pairs
(Warnock 1972; Hickernell 1998; Hinrichs & Oettershagen 2016). The value that is listed must be that to 1e-14 (of L2 1e-11, as it
is the root of a difference of near numbers), and, where a value is published, not above it by more than the rounding of its
last digit, nor of l2-periodic above the best lattice {i (1, g) / n}. Sets of up to LARGEST points (8 when left out) are made again by `koksma optimise`
from the listed seed and steps.
"""
import json
import subprocess
import sys
import tempfile
from functools import reduce

import numpy as np


def run(*arguments):
    return subprocess.run([sys.argv[1], *arguments], check=True, capture_output=True, text=True).stdout


def star(points):
    """The numbers of points in all boxes at once: sums along each axis of the numbers at the corners of the grid."""
    sides = [np.append(np.unique(x), 1.0) for x in points.T]
    volumes = reduce(np.multiply.outer, sides)
    largest = 0.0
    for first in ("right", "left"):  # a point counts from the first side above it, or from its own
        counts = np.zeros([len(side) + 1 for side in sides])
        np.add.at(counts, tuple(np.searchsorted(side, x, first) for x, side in zip(points.T, sides)), 1)
        for axis in range(len(sides)):
            counts = counts.cumsum(axis)
        counts = counts[tuple(slice(-1) for _ in sides)]
        largest = max(largest, np.abs(counts / len(points) - volumes).max())
    return largest


def l2_star(x):
    d, n, high = x.shape[1], len(x), np.maximum(x[:, None], x[None])
    return np.sqrt(3.0**-d - 2 / n * ((1 - x**2) / 2).prod(1).sum() + (1 - high).prod(2).sum() / n**2)


def l2_periodic(x):
    t = np.abs(x[:, None] - x[None])
    return np.sqrt((0.5 - t + t**2).prod(2).mean() - 3.0**-x.shape[1])


def l2_centered(x):
    z = np.abs(x - 0.5)
    pairs = 1 + z[:, None] / 2 + z[None] / 2 - np.abs(x[:, None] - x[None]) / 2
    return np.sqrt((13 / 12)**x.shape[1] - 2 * (1 + z / 2 - z**2 / 2).prod(1).mean() + pairs.prod(2).mean())


def best_lattice(n):
    return min(l2_periodic(np.outer(np.arange(n), (1, g)) % n / n) for g in range(1, n // 2 + 1))


DEFINITIONS = {"star": (star, 1e-14), "l2-star": (l2_star, 1e-11), "l2-periodic": (l2_periodic, 1e-11),
               "l2-centered": (l2_centered, 1e-11)}
LARGEST = int(sys.argv[2]) if len(sys.argv) > 2 else 8
failed = count = 0
for row in (json.loads(line) for line in run("list", "records", "--json").splitlines()):
    with tempfile.NamedTemporaryFile(suffix=".npy") as file:
        run("generate", f"record:measure={row['measure']}", "-n", str(row["n"]), "-d", str(row["dim"]), "-o", file.name)
        points = np.load(file.name)
    count += 1
    digits = len(repr(row["published"] or 0.0).split(".")[1])
    define, near = DEFINITIONS[row["measure"]]
    if points.shape != (row["n"], row["dim"]) or not abs(define(points) - row["value"]) <= near:
        print(f"{row['measure']}, n = {row['n']}: listed {row['value']}, by brute force {define(points)} of {points.shape}")
        failed += 1
    if row["published"] and row["value"] > row["published"] + 0.51 * 10.0**-max(digits, 4):
        print(f"n = {row['n']}: {row['value']} is above the published {row['published']}")
        failed += 1
    if row["measure"] == "l2-periodic" and row["dim"] == 2 and row["value"] > best_lattice(row["n"]) + 1e-11:
        print(f"l2-periodic, n = {row['n']}: {row['value']} is above the best lattice's {best_lattice(row['n'])}")
        failed += 1
    if row["steps"] and row["n"] <= LARGEST:
        command = f"optimise {row['measure']} -n {row['n']} -d {row['dim']} --from latin-hypercube --seed {row['seed']} --steps {row['steps']}"
        with tempfile.NamedTemporaryFile(suffix=".npy") as made:
            run(*command.split(), "-q", "-o", made.name)
            if np.abs(np.load(made.name) - points).max() > 1e-9:
                print(f"koksma {command}: it makes another set")
                failed += 1
print(f"{count} records, {failed} failures")
sys.exit(failed > 0 or count < 100)

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""brute_records.py PROGRAM: the star discrepancy of every set of `koksma list records`, from the definition alone.

    D* = the largest |#/n - x y| over all boxes [0, x) x [0, y) and [0, x] x [0, y],

x and y coordinates of points, or 1, in numpy, which shares no code with the library. The value that is listed must be that to
1e-14, and, where a value is published, not above it by more than the rounding of its last digit.
"""
import json
import subprocess
import sys
import tempfile

import numpy as np


def run(*arguments):
    return subprocess.run([sys.argv[1], *arguments], check=True, capture_output=True, text=True).stdout


def star(points):
    x, y = (np.append(np.unique(points[:, k]), 1.0) for k in (0, 1))
    largest = 0.0
    for below in (np.less, np.less_equal):
        counts = below(points[:, 0], x[:, None]).astype(float) @ below(points[:, 1], y[:, None]).astype(float).T
        largest = max(largest, np.abs(counts / len(points) - np.outer(x, y)).max())
    return largest


failed = count = 0
for row in (json.loads(line) for line in run("list", "records", "--json").splitlines()):
    with tempfile.NamedTemporaryFile(suffix=".npy") as file:
        run("generate", f"record:measure={row['measure']}", "-n", str(row["n"]), "-d", str(row["dim"]), "-o", file.name)
        points = np.load(file.name)
    count += 1
    digits = len(repr(row["published"] or 0.0).split(".")[1])
    if points.shape != (row["n"], row["dim"]) or abs(star(points) - row["value"]) > 1e-14:
        print(f"n = {row['n']}: listed {row['value']}, by brute force {star(points)} of {points.shape}")
        failed += 1
    if row["published"] and row["value"] > row["published"] + 0.51 * 10.0**-max(digits, 4):
        print(f"n = {row['n']}: {row['value']} is above the published {row['published']}")
        failed += 1
print(f"{count} records, {failed} failures")
sys.exit(failed > 0 or count < 100)

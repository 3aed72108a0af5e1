#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes src/patterns/shared/records.inc: make_records.py PROGRAM FOLDER

FOLDER has sets that `koksma optimise star -n N -o FOLDER/N.txt` wrote. Coordinates are rounded to multiples of 10^-12, and
the values are those that PROGRAM measures of the rounded sets. A set that is there already stays if it is not worse.
"""
import glob
import os
import sys

sys.dont_write_bytecode = True
import record_sets

# The best published values of the 2D star discrepancy that were at hand.
CLEMENT = {16: .0739, 20: .0604, 30: .0424}
OPENEVOLVE = {40: .033127, 50: .027842, 60: .023363, 80: .018192, 100: .015038, 140: .011511, 180: .010585, 220: .008913,
              260: .00831, 300: .007407, 340: .006956, 380: .006375, 420: .005625, 460: .004712, 500: .005086, 540: .004072,
              580: .003772, 620: .00386, 660: .0036, 700: .003789, 740: .003456, 780: .003104, 820: .002941, 860: .003162,
              900: .002957, 940: .002889, 980: .002803, 1020: .00245}

HEAD = """Made by tools/make_records.py of sets that `koksma optimise` found. A line RECORD(measure, dim, n, value, published,
   source) for each set, in order of n; 0: no published value was at hand. Then the coordinates of all sets, in that order,
   point by point, in units of 10^-12."""


def line(n, value):
    published, source = (CLEMENT[n], "clement2023") if n in CLEMENT else (OPENEVOLVE[n], "sadikov2025") if n in OPENEVOLVE else (0, "-")
    return f'RECORD(STAR, 2, {n}, {value!r}, {published}, "{source}")'


def main():
    program, folder = sys.argv[1:]
    sets = {len(points): (record_sets.measured(program, "star", points), points)
            for _, _, points in record_sets.read("records.inc")}
    for path in glob.glob(os.path.join(folder, "[0-9]*.txt")):
        points = [record_sets.rounded(row) for row in open(path, encoding="utf-8") if not row.startswith("#")]
        value = record_sets.measured(program, "star", points)
        if len(points) not in sets or value < sets[len(points)][0]:
            sets[len(points)] = (value, points)
    record_sets.write("records.inc", "points", HEAD, [(line(n, value), points) for n, (value, points) in sorted(sets.items())])


main()

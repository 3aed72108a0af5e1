#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes src/patterns/shared/records_made.inc: remake_records.py PROGRAM FOLDER

FOLDER has sets that `koksma optimise MEASURE -n N --seed S --steps K -o FOLDER/ANY.txt` wrote, of measures with a pair kernel or of
star in 3 dimensions. Of each measure, dim and n the best is kept, with the command that made it. Coordinates are rounded to multiples of 10^-12, and the
values are those that PROGRAM measures of the rounded sets. A set that is there already stays if it is not worse.
"""
import glob
import os
import re
import sys

sys.dont_write_bytecode = True
import record_sets

MEASURES = ["star", "l2-star", "l2-periodic", "l2-centered"]  # in the order of record.c

HEAD = """Made by tools/remake_records.py. A line RECORD(measure, dim, n, value, published, source) for each set, in order of
   measure, dim and n, with the command that made it; 0: no published value was at hand. Then the coordinates of all sets, in
   that order, point by point, in units of 10^-12."""


def known(program):
    for (name, dim, n, *_), behind, points in record_sets.read("records_made.inc"):
        measure = name.lower().replace("_", "-")
        yield ((MEASURES.index(measure), int(dim), int(n)),
               (record_sets.measured(program, measure, points), points, behind.strip(" /*")))


def line(key, value, command):
    return f'RECORD({MEASURES[key[0]].upper().replace("-", "_")}, {key[1]}, {key[2]}, {value!r}, 0, "-") /* {command} */'


def main():
    program, folder = sys.argv[1:]
    sets = dict(known(program))
    for path in sorted(glob.glob(os.path.join(folder, "*.txt"))):
        lines = open(path, encoding="utf-8").read().splitlines()
        head = dict(re.findall(r"^# (optimised for|seed|steps) (.*)$", "\n".join(lines), re.M))
        points = [record_sets.rounded(row) for row in lines if row[:1] != "#"]
        measure, dim, n = head["optimised for"], len(points[0]), len(points)
        command = f"koksma optimise {measure} -n {n}{f' -d {dim}' if dim != 2 else ''} --seed {head['seed']} --steps {head['steps']}"
        key, value = (MEASURES.index(measure), dim, n), record_sets.measured(program, measure, points)
        if key not in sets or value < sets[key][0]:
            sets[key] = (value, points, command)
    record_sets.write("records_made.inc", "points_made", HEAD,
                      [(line(key, value, command), points) for key, (value, points, command) in sorted(sets.items())])


main()

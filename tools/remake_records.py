#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes src/patterns/shared/records_made.inc: remake_records.py PROGRAM FOLDER

FOLDER has sets that `koksma optimise MEASURE -n N --seed S --steps K -o FOLDER/ANY.txt` wrote, of measures with a pair kernel or of
star in 3 dimensions. Of each measure, dim and n the best is kept, with the command that made it. Coordinates are rounded to multiples of 10^-12, and the
values are those that PROGRAM measures of the rounded sets. A set that is there already stays if it is not worse.
"""
import glob
import json
import os
import re
import subprocess
import sys
import tempfile

OUT = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "src/patterns/shared/records_made.inc")
MEASURES = ["star", "l2-star", "l2-periodic", "l2-centered"]  # in the order of record.c


def measured(program, measure, points):
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.write("".join(" ".join(f"0.{x:012d}" for x in point) + "\n" for point in points))
        file.flush()
        rows = subprocess.run([program, "measure", file.name, "-m", measure, "--json"], check=True, capture_output=True,
                              text=True).stdout
    return json.loads(rows)["value"]


def known():
    sets = {}
    if os.path.exists(OUT):
        text = open(OUT, encoding="utf-8").read()
        numbers = [int(x) for x in re.findall(r"\d{1,12}(?=,)", text.split("points_made[] = {")[1])]
        for name, dim, n, command in re.findall(r"^RECORD\((\w+), (\d+), (\d+), .*\) /\* (.*) \*/$", text, re.M):
            dim, n = int(dim), int(n)
            sets[MEASURES.index(name.lower().replace("_", "-")), dim, n] = (
                [tuple(numbers[i * dim:(i + 1) * dim]) for i in range(n)], command)
            numbers = numbers[n * dim:]
    return sets


def main():
    program, folder = sys.argv[1:]
    sets = {key: (measured(program, MEASURES[key[0]], points), points, command)
            for key, (points, command) in known().items()}
    for path in sorted(glob.glob(os.path.join(folder, "*.txt"))):
        lines = open(path, encoding="utf-8").read().splitlines()
        head = dict(re.findall(r"^# (optimised for|seed|steps) (.*)$", "\n".join(lines), re.M))
        points = [tuple(min(round(float(x) * 10**12), 10**12 - 1) for x in line.split()) for line in lines if line[:1] != "#"]
        measure, dim, n = head["optimised for"], len(points[0]), len(points)
        command = f"koksma optimise {measure} -n {n}{f' -d {dim}' if dim != 2 else ''} --seed {head['seed']} --steps {head['steps']}"
        key, value = (MEASURES.index(measure), dim, n), measured(program, measure, points)
        if key not in sets or value < sets[key][0]:
            sets[key] = (value, points, command)
    with open(OUT, "w", encoding="utf-8") as out:
        out.write("""/* SPDX-License-Identifier: Apache-2.0 */
/* Made by tools/remake_records.py. A line RECORD(measure, dim, n, value, published, source) for each set, in order of
   measure, dim and n, with the command that made it; 0: no published value was at hand. Then the coordinates of all sets, in
   that order, point by point, in units of 10^-12. */
#ifdef RECORD
""")
        for (measure, dim, n), (value, _, command) in sorted(sets.items()):
            out.write(f"RECORD({MEASURES[measure].upper().replace('-', '_')}, {dim}, {n}, {value!r}, 0, \"-\") /* {command} */\n")
        out.write("#else\nstatic const uint64_t points_made[] = {\n")
        for _, (_, points, _) in sorted(sets.items()):
            numbers = [f"{x}," for point in points for x in point]
            for i in range(0, len(numbers), 8):
                out.write(" ".join(numbers[i:i + 8]) + "\n")
        out.write("};\n#endif\n")


main()

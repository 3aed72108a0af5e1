#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes src/patterns/shared/records.inc: make_records.py PROGRAM FOLDER

FOLDER has sets that `koksma optimise star -n N -o FOLDER/N.txt` wrote. Coordinates are rounded to multiples of 10^-12, and
the values are those that PROGRAM measures of the rounded sets. A set that is there already stays if it is not worse.
"""
import glob
import json
import os
import re
import subprocess
import sys
import tempfile

OUT = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "src/patterns/shared/records.inc")
# The best published values of the 2D star discrepancy that were at hand.
CLEMENT = {16: .0739, 20: .0604, 30: .0424}
OPENEVOLVE = {40: .033127, 50: .027842, 60: .023363, 80: .018192, 100: .015038, 140: .011511, 180: .010585, 220: .008913,
              260: .00831, 300: .007407, 340: .006956, 380: .006375, 420: .005625, 460: .004712, 500: .005086, 540: .004072,
              580: .003772, 620: .00386, 660: .0036, 700: .003789, 740: .003456, 780: .003104, 820: .002941, 860: .003162,
              900: .002957, 940: .002889, 980: .002803, 1020: .00245}


def measured(program, points):
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.write("".join(f"0.{x:012d} 0.{y:012d}\n" for x, y in points))
        file.flush()
        rows = subprocess.run([program, "measure", file.name, "-m", "star", "--json"], check=True, capture_output=True,
                              text=True).stdout
    return json.loads(rows)["value"]


def known():
    sets = {}
    if os.path.exists(OUT):
        text = open(OUT, encoding="utf-8").read()
        numbers = [int(x) for x in re.findall(r"\d{1,12}(?=,)", text.split("points[] = {")[1])]
        for n in (int(m) for m in re.findall(r"^RECORD\(STAR, 2, (\d+),", text, re.M)):
            sets[n], numbers = list(zip(numbers[:2 * n:2], numbers[1:2 * n:2])), numbers[2 * n:]
    return sets


def main():
    program, folder = sys.argv[1:]
    sets = {n: (measured(program, points), points) for n, points in known().items()}
    for path in glob.glob(os.path.join(folder, "[0-9]*.txt")):
        rows = [line.split() for line in open(path, encoding="utf-8") if not line.startswith("#")]
        points = [tuple(min(round(float(x) * 10**12), 10**12 - 1) for x in row) for row in rows]
        value = measured(program, points)
        if len(points) not in sets or value < sets[len(points)][0]:
            sets[len(points)] = (value, points)
    with open(OUT, "w", encoding="utf-8") as out:
        out.write("""/* SPDX-License-Identifier: Apache-2.0 */
/* Made by tools/make_records.py of sets that `koksma optimise` found. A line RECORD(measure, dim, n, value, published,
   source) for each set, in order of n; 0: no published value was at hand. Then the coordinates of all sets, in that order,
   point by point, in units of 10^-12. */
#ifdef RECORD
""")
        for n, (value, _) in sorted(sets.items()):
            published, source = (CLEMENT[n], "clement2023") if n in CLEMENT else \
                (OPENEVOLVE[n], "sadikov2025") if n in OPENEVOLVE else (0, "-")
            out.write(f'RECORD(STAR, 2, {n}, {value!r}, {published}, "{source}")\n')
        out.write("#else\nstatic const uint64_t points[] = {\n")
        for _, (_, points) in sorted(sets.items()):
            numbers = [f"{x}," for point in points for x in point]
            for i in range(0, len(numbers), 8):
                out.write(" ".join(numbers[i:i + 8]) + "\n")
        out.write("};\n#endif\n")


main()

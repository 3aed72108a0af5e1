# SPDX-License-Identifier: Apache-2.0
"""What make_records.py and remake_records.py share: the files of the record pattern's sets, src/patterns/shared/*.inc.

Coordinates are whole numbers of units of 10^-12. A file has a line RECORD(measure, dim, n, ...) for each set, then the
coordinates of all sets in that order, point by point.
"""
import json
import re
import subprocess
import tempfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent / "src/patterns/shared"


def rounded(line):
    """The point of a line of a set's file."""
    return tuple(min(round(float(x) * 10**12), 10**12 - 1) for x in line.split())


def measured(program, measure, points):
    """What the program measures of these points."""
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.write("".join(" ".join(f"0.{x:012d}" for x in point) + "\n" for point in points))
        file.flush()
        rows = subprocess.run([program, "measure", file.name, "-m", measure, "--json"], check=True, capture_output=True,
                              text=True).stdout
    return json.loads(rows)["value"]


def read(name):
    """(what is in the brackets of RECORD and after them, points) for each set of a file; none if it is not there."""
    text = (FOLDER / name).read_text(encoding="utf-8") if (FOLDER / name).exists() else "#else"
    lines, coordinates = text.split("#else")
    numbers = [int(x) for x in re.findall(r"\d{1,12}(?=,)", coordinates)]
    for fields, behind in re.findall(r"^RECORD\((.*)\)(.*)$", lines, re.M):
        dim, n = (int(x) for x in fields.split(", ")[1:3])
        yield fields.split(", "), behind, [tuple(numbers[i * dim:(i + 1) * dim]) for i in range(n)]
        numbers = numbers[n * dim:]


def write(name, array, head, sets):
    """Writes a file whose array has that name, of (line, points)."""
    with open(FOLDER / name, "w", encoding="utf-8") as out:
        out.write(f"/* SPDX-License-Identifier: Apache-2.0 */\n/* {head} */\n#ifdef RECORD\n")
        out.writelines(line + "\n" for line, _ in sets)
        out.write(f"#else\nstatic const uint64_t {array}[] = {{\n")
        for _, points in sets:
            numbers = [f"{x}," for point in points for x in point]
            out.writelines(" ".join(numbers[i:i + 8]) + "\n" for i in range(0, len(numbers), 8))
        out.write("};\n#endif\n")

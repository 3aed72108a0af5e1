#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""scene_fields.py PROGRAM: docs/scenes.md lists the kinds of materials, lights and shapes with their fields as
`koksma list` does, row by row; its table of fields explains each of them, and nothing that no scene file has."""
import json
import re
import subprocess
import sys
from pathlib import Path

PROGRAM, ROOT = str(Path(sys.argv[1]).resolve()), Path(__file__).resolve().parent.parent.parent
page = (ROOT / "docs" / "scenes.md").read_text(encoding="utf-8")
failures, fields, kinds = [], set(), set()


def table(head):
    """The rows, as lists of cells, of the table whose first cells are these."""
    found = re.search(rf"^\| {head} \|.*\n\|[-|]*\|\n((?:\|.*\n)*)", page, re.M)
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in found[1].splitlines()] if found else []


for noun in "material", "light", "shape":
    listed = subprocess.run([PROGRAM, "list", noun + "s", "--json"], capture_output=True, text=True, check=True).stdout
    wanted = []
    for row in map(json.loads, listed.splitlines()):
        wanted.append([f"`{row[noun]}`", " ".join(f"`{name}`" for name in row["fields"].split()), row["what"]])
        fields |= set(re.findall(r"\w+", row["fields"]))
        kinds.add(row[noun])
    rows = table(noun)
    for row in wanted:
        if row not in rows:
            failures.append(f"lacks the row | {' | '.join(row)} |")
    failures += [f"has a row that `koksma list {noun}s` lacks: | {' | '.join(row)} |" for row in rows if row not in wanted]
sources = (ROOT / "src" / "render" / "scene" / "parse.c").read_text()
others = set(re.findall(r'"(\w+)"', " ".join(re.findall(r"KEYS\(([^)]*)\)", sources))))
if not fields or not others:
    failures.append("no fields found: nothing is compared")
explained = set()
for cells in table("field"):
    explained |= {name for cell in cells for code in re.findall(r"`([^`]+)`", cell) for name in re.findall(r"\w+", code)}
    for name in re.findall(r"`(?:camera\.)?(\w+)", cells[0]):
        if name not in fields | kinds | others:
            failures.append(f"explains '{name}', which no scene file has")
failures += [f"explains no '{name}'" for name in sorted((fields | others) - explained)]
for failure in failures:
    print("docs/scenes.md " + failure)
sys.exit(1 if failures else 0)

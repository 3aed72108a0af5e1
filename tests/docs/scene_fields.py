#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""scene_fields.py PROGRAM: the table of fields in docs/scenes.md explains every field of the materials, lights and shapes
that `koksma list` prints, and nothing that no scene file has."""
import json
import re
import subprocess
import sys
from pathlib import Path

PROGRAM, ROOT = str(Path(sys.argv[1]).resolve()), Path(__file__).resolve().parent.parent.parent
page = (ROOT / "docs" / "scenes.md").read_text(encoding="utf-8")
failures, fields, kinds = [], set(), set()

for noun in "material", "light", "shape":
    listed = subprocess.run([PROGRAM, "list", noun + "s", "--json"], capture_output=True, text=True, check=True).stdout
    for row in map(json.loads, listed.splitlines()):
        fields |= set(re.findall(r"\w+", row["fields"]))
        kinds.add(row[noun])
sources = (ROOT / "src" / "render" / "scene" / "parse.c").read_text()
others = set(re.findall(r'"(\w+)"', " ".join(re.findall(r"KEYS\(([^)]*)\)", sources))))
if not fields or not others:
    failures.append("no fields found: nothing is compared")
explained = set()
for line in re.search(r"^\| field \|.*\n\|[-|]*\|\n((?:\|.*\n)*)", page, re.M)[1].splitlines():
    cells = re.split(r"(?<!\\)\|", line)[1:-1]
    explained |= {name for cell in cells for code in re.findall(r"`([^`]+)`", cell) for name in re.findall(r"\w+", code)}
    for name in re.findall(r"`(?:camera\.)?(\w+)", cells[0]):
        if name not in fields | kinds | others:
            failures.append(f"explains '{name}', which no scene file has")
failures += [f"explains no '{name}'" for name in sorted((fields | others) - explained)]
for failure in failures:
    print("docs/scenes.md " + failure)
sys.exit(1 if failures else 0)

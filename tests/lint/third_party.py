#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""THIRD_PARTY.md names the origin of every table of numbers, binary file, published number and library.

A table is a run of at least 20 numbers, or of 8 numbers with 6 digits or more, in a source file; everything in tests/ that
is not named itself is covered by the line for tests/. Exit code 1: something is not named, or something named is gone.
"""
import os
import re
import subprocess
import sys

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
text = open("THIRD_PARTY.md", encoding="utf-8").read()
named = [path for path in re.findall(r"`([^`\s]+)`", text) if "/" in path]
libraries = text.split("## Libraries")[1].lower()
problems = [f"THIRD_PARTY.md names {path}, which does not exist" for path in named
            if not os.path.exists(path) and not path.startswith("build/")]


def is_named(path):
    """Whether THIRD_PARTY.md names this file or a directory above it."""
    return any(path == name or (name.endswith("/") and path.startswith(name)) for name in named)


def has_table(source):
    """Whether the text has a long run of numbers that commas separate."""
    number = r"[-+]?(?:0x[0-9a-fA-F]+|\d+\.?\d*(?:[eEp][-+]?\d+)?)[uUlLfF]*"
    for run in re.finditer(rf"(?:[\s{{}}\[\]]*{number}[\s{{}}\[\]]*,){{8,}}", re.sub(r"/\*.*?\*/", "", source, flags=re.S)):
        numbers = re.findall(number, run.group())
        digits = [len(re.sub(r"^0x|[eEp][-+]?\d+$|[^0-9a-fA-F]", "", n).lstrip("0")) for n in numbers]
        if len(numbers) >= 20 or sum(d >= 6 for d in digits) >= 8:
            return True
    return False


listed = subprocess.run(["sh", "-c", ". tests/lint/files.sh; files '*'"], capture_output=True, text=True, check=True)
for path in listed.stdout.split("\n"):
    if not path or not os.path.isfile(path) or is_named(path):
        continue
    with open(path, "rb") as file:
        content = file.read()
    if b"\0" in content:
        problems.append(f"{path}: a binary file; THIRD_PARTY.md must say where it comes from")
        continue
    source = content.decode("utf-8", "replace")
    if path.startswith(("src/", "include/", "cli/", "python/", "explorer/", "tools/", "bench/")):
        if path.endswith((".c", ".h", ".inc", ".def", ".py", ".mjs", ".js")) and has_table(source):
            problems.append(f"{path}: a table of numbers; THIRD_PARTY.md must say where it comes from")
    if path.endswith(".json") and '"published"' in source:
        problems.append(f"{path}: published numbers; THIRD_PARTY.md must name their source")

# Libraries: what CMake looks for, and what comes from npm.
wanted = set()
cmake = re.sub(r"#.*", "", open("cmake/libraries.cmake", encoding="utf-8").read())
for arguments in re.findall(r"pkg_check_modules\(([^)]*)\)", cmake) + re.findall(r"koksma_optional\(((?!name)[^)]*)\)", cmake):
    words = re.sub(r'"[^"]*"', "", arguments).split()
    wanted.update(w.lower().split(">=")[0] for w in words[1:] if w not in ("REQUIRED", "IMPORTED_TARGET") and "$" not in w)
wanted.update(re.findall(r"npm install.* ([a-z][a-z-]+)\b", open("scripts/setup", encoding="utf-8").read()))
for name in sorted(wanted):
    if re.sub(r"^(cairo)-.*", r"\1", name) not in text.lower():
        problems.append(f"the library {name} is not named in THIRD_PARTY.md")
for path in ("random123", "embree", "mpi"):
    if path not in libraries:
        problems.append(f"the library {path} is not named in THIRD_PARTY.md")

print("\n".join(problems) or f"{len(named)} names, {len(wanted)} libraries")
sys.exit(1 if problems else 0)

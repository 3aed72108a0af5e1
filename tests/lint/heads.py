#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""heads.py: every file of C, Python, JavaScript and shell says at its top what it is for: before any code, beside the
licence line, stands a comment (in Python a docstring) of three words or more."""
import os
import re
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
LIST = ". tests/lint/files.sh; files '*.c' '*.py' '*.sh' '*.mjs' '*.cjs' 'scripts/*'"
SLASHES = (".c", ".mjs", ".cjs")


def head(name, text):
    """The words of the first comment that is more than a licence line."""
    text = re.sub(r"\A#!.*\n", "", text)
    text = re.sub(r"\A(#|//|/\*) SPDX-License-Identifier: \S+( \*/)?\n", "", text).lstrip("\n")
    if name.endswith(SLASHES):
        found = re.match(r"/\*(.*?)\*/", text, re.S) or re.match(r"((?://.*\n)+)", text)
    else:
        found = re.match(r'r?"""(.*?)"""', text, re.S) or re.match(r"((?:#.*\n)+)", text)
    return re.findall(r"[A-Za-z][\w'-]*", found[1]) if found else []


os.chdir(ROOT)
names = subprocess.run(["sh", "-c", LIST], capture_output=True, text=True, check=True).stdout.split()
short = []
for name in sorted(set(names)):
    with open(name, encoding="utf-8", errors="replace") as file:
        if len(head(name, file.read())) < 3:
            short.append(name)
if len(names) < 500:
    short.append("heads.py: only %d files found" % len(names))
for name in short:
    print(name + ": no comment at its top says what it is for")
sys.exit(1 if short else 0)

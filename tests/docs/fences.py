#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""fences.py PROGRAM DOCUMENT: does what a document says, in an empty folder.

A fenced block after "... as `NAME`:" becomes the file NAME; blocks of sh are run; a block of text is what the sh block
before it prints, to the letter. A ranking gets no time limit but few trials, and may end undecided (1): its work
must not depend on the speed of the machine. Blocks of console are examples and are not compared.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path


def run(script, folder, environment):
    return subprocess.run(["sh", "-e"], input=script, cwd=folder, env=environment, capture_output=True, text=True, timeout=3600,
                          check=False)


program, document = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
blocks = re.findall(r"([^\n]*)\n*\n```(\w+)\n(.*?)\n```", document.read_text(encoding="utf-8"), re.S)
failures, ran, said = [], 0, ""
with tempfile.TemporaryDirectory() as folder:
    (Path(folder) / "bin").mkdir()
    (Path(folder) / "bin/koksma").symlink_to(program)
    work = Path(folder) / "work"
    work.mkdir()
    environment = dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}")
    for before, kind, text in blocks:
        name = re.search(r"as `([\w.-]+)`:$", before)
        if name:
            (work / name[1]).write_text(text + "\n", encoding="utf-8")
        elif kind == "sh":
            few = r"\1 1000000 --max-trials 16 --one-size || [ $? -eq 1 ]"
            done = run(re.sub(r"(koksma rank .*--time-limit) \d+", few, text), work, environment)
            ran, said = ran + 1, done.stdout
            if done.returncode:
                failures.append(f"{text}\n  exit code {done.returncode}: {done.stderr.strip()}")
        elif kind == "text" and [line.rstrip() for line in said.splitlines()] != text.splitlines():
            failures.append(f"it says\n{text}\nand the program\n{said}")
        elif kind not in ("text", "console"):
            failures.append(f"a block of {kind} that has no name: {text[:40]}")
print("\n".join(failures) or f"{document.name}: {ran} blocks")
sys.exit(bool(failures) or not ran)

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_power.py PROGRAM FAULTS: output files after a loss of power.

The program with faults writes down each call that changes a file or folder, and a disk is made of every beginning of that
list (disk.py): all combinations of what comes through of files and of folders, some of them several times. Whatever is
chosen, the name must hold the old or the new content, whole; after the program's end with success the new one. As a check
of this test, the same lists without their fsyncs must be found wanting.
"""
import os
import random
import sys
import tempfile

import disk
import files

OLD = b"what was there before\n"
CASES = [
    (["generate", "random", "-n", "400", "-q"], "o.txt"), (["generate", "random", "-n", "400", "-q"], "o.npy"),
    (["generate", "random", "-n", "400", "-q"], "o.csv"), (["render", "ball", "--size", "32x24", "-n", "1", "-q"], "o.exr"),
    (["render", "ball", "--size", "32x24", "-n", "1", "-q"], "o.pfm"), (["render", "ball", "--size", "32x24", "-n", "1", "-q"], "o.png"),
    (["plot", "pattern:random@64"], "o.svg"), (["plot", "pattern:random@64"], "o.pdf"),
    (["study", "new"], "p.json"), (["study", "export", "done"], "o.csv"), (["study", "report", "done", "-q"], "done/report.html"),
    (["study", "report", "done", "-q"], "done/report.json"),
]
PLAN = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "faults", "inputs", "plan.json")


def states(now, lines, name):
    """(number of lines, content) of every beginning of the list; None: no such file."""
    chance = random.Random(1)
    for n in range(len(lines) + 1):
        if n:
            now.apply(lines[n - 1])
        for of_files in disk.WAYS:
            for of_folders in disk.WAYS:
                yield n, now.after(chance, of_files, of_folders).get(name)


def record(program, arguments, name, folder, old):
    """The disk before a run, its calls, and the new file."""
    path, log = os.path.join(folder, name), folder + ".log"
    for gone in (path, log):
        if os.path.exists(gone):
            os.remove(gone)
    if old:
        with open(path, "wb") as stream:
            stream.write(OLD)
    start = disk.Disk(folder)
    output = [] if name.startswith("done/") else ["-o", name]
    done = files.run(program, *arguments, *output, cwd=folder, env={"KOKSMA_FAULT": "none", "KOKSMA_FAULT_LOG": log})
    with open(path, "rb") as stream:
        return done, start, disk.read_log(log), stream.read()


def check_case(checks, program, arguments, name, folder, old):
    if arguments[:2] == ["study", "new"] and old:
        return  # it writes over no file
    done, start, lines, new = record(program, arguments, name, folder, old)
    what = f"{' '.join(arguments)} {name} over {'an old file' if old else 'nothing'}"
    checks.check(done is not None and done.code == 0, f"{what}: {done and done.err}")
    where = str(os.stat(os.path.dirname(os.path.join(folder, name))).st_ino)
    before = OLD if old else None
    seen = set()
    for n, content in states(start.copy(), lines, name):
        seen.add(content)
        if not checks.check(content in (before, new), f"{what}: after call {n} it may hold {len(content or b'')} bytes"):
            break
        if n == len(lines) and not checks.check(content == new, f"{what}: after success it may be gone"):
            break
    checks.check(seen == {before, new}, f"{what}: the old and the new file were not both seen")
    for left_out, must in (("file", "mixed"), ("folder", "lost")):
        bare = [line for line in lines if line[0] != "sync" or (line[1] == where) != (left_out == "folder")]
        bad = [content for n, content in states(start.copy(), bare, name)
               if (content not in (before, new) if must == "mixed" else n == len(bare) and content != new)]
        checks.check(bad, f"{what}: without fsync of the {left_out} this test finds nothing")


def main():
    program, faults = map(os.path.abspath, sys.argv[1:3])
    checks = files.Checks()
    with tempfile.TemporaryDirectory() as work:
        folder = os.path.join(work, "disk")
        os.mkdir(folder)
        done = files.run(program, "study", "run", PLAN, "-q", "-o", "done", cwd=folder)
        checks.check(done is not None and done.code == 0, f"study: {done and done.err}")
        for arguments, name in CASES:
            for old in (True, False):
                check_case(checks, faults, arguments, name, folder, old)
    checks.end()


if __name__ == "__main__":
    main()

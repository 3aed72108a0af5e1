#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_power.py PROGRAM FAULTS: output files after a loss of power.

The program with faults (tests/faults) writes down each call that changes a file or folder. A disk is made of every
beginning of that list, by POSIX's rules: what was written to a file before its last fsync is there, and of what came
after it any part may be, in any order, or torn; changes of a folder since its last fsync may be there or not, each for
itself. Whatever is chosen, the name must hold the old or the new content, whole; after the program's end with success
the new one. As a check of this test, the same lists without their fsyncs must be found wanting.
"""
import itertools
import os
import random
import sys
import tempfile

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
SUBSETS = 8  # random choices of what came through, beside all, nothing, and each alone and missing


class Disk:
    """What is certain of each file and folder, and what was changed since."""

    def __init__(self, folder, name, inode):
        self.synced = {inode: OLD} if inode else {}
        self.written = {}
        self.entries = {folder: {name: inode} if inode else {}}
        self.changes = {folder: []}

    def apply(self, line):
        word, *rest = line
        if word == "create":
            folder, inode, name = rest
            self.synced[inode], self.written[inode] = b"", []
            self.changes.setdefault(folder, []).append((name, inode))
        elif word == "write":
            self.written.setdefault(rest[0], []).append(bytes.fromhex(rest[1]))
        elif word == "sync" and rest[0] in self.changes:
            for change in self.changes[rest[0]]:
                self.change(self.entries.setdefault(rest[0], {}), change)
            self.changes[rest[0]] = []
        elif word == "sync":
            self.synced[rest[0]] = self.synced.get(rest[0], b"") + b"".join(self.written.get(rest[0], []))
            self.written[rest[0]] = []
        elif word == "rename":
            self.changes.setdefault(rest[0], []).append((rest[1], None, rest[2]))
        elif word == "unlink":
            self.changes.setdefault(rest[0], []).append((rest[1], None))

    @staticmethod
    def change(entries, change):
        """(name, inode): made; (name, None): gone; (from, None, to): renamed, which is nothing where `from` is not."""
        name, inode, *to = change
        if to and name in entries:
            entries[to[0]] = entries.pop(name)
        elif not to and inode is None:
            entries.pop(name, None)
        elif not to:
            entries[name] = inode

    def contents(self, folder, name, chance):
        """All contents that the name may have after a loss of power now; None: no such file."""
        changes = self.changes[folder]
        for kept in choices(len(changes), chance):
            entries = dict(self.entries[folder])
            # a rename that came through implies that the name's making did: the inode is what moves
            made = {n: i for n, i, *to in changes if i is not None and not to}
            for i, change in enumerate(changes):
                if kept[i] and len(change) == 3 and change[0] in made:
                    entries.setdefault(change[0], made[change[0]])
                if kept[i]:
                    self.change(entries, change)
            inode = entries.get(name)
            if inode is None:
                yield None
                continue
            pieces = self.written.get(inode, [])
            for came in choices(len(pieces), chance):
                yield self.synced.get(inode, b"") + b"".join(
                    piece if came[i] else bytes(len(piece)) for i, piece in enumerate(pieces))
            if pieces:  # torn: the size is there or not, and half of a piece
                yield self.synced.get(inode, b"")
                yield self.synced.get(inode, b"") + pieces[0][:len(pieces[0]) // 2]


def choices(n, chance):
    """Which of n changes came through."""
    if n <= 4:
        yield from itertools.product((False, True), repeat=n)
        return
    yield [False] * n
    yield [True] * n
    for i in {0, n // 2, n - 1}:
        yield [k == i for k in range(n)]
        yield [k != i for k in range(n)]
    for _ in range(SUBSETS):
        yield [chance.random() < 0.5 for _ in range(n)]


def states(disk, lines, folder, name):
    """(number of lines, content) of every beginning of the list."""
    chance = random.Random(1)
    for n in range(len(lines) + 1):
        if n:
            disk.apply(lines[n - 1])
        for content in disk.contents(folder, name, chance):
            yield n, content


def record(program, arguments, name, folder, old):
    """The calls of a run, and the inode of the folder and of the file that was there."""
    path, log = os.path.join(folder, name), os.path.join(folder, "log")
    for gone in (path, log):
        if os.path.exists(gone):
            os.remove(gone)
    if old:
        with open(path, "wb") as stream:
            stream.write(OLD)
    inode = str(os.stat(path).st_ino) if old else None
    output = [] if name.startswith("done/") else ["-o", name]
    done = files.run(program, *arguments, *output, cwd=folder, env={"KOKSMA_FAULT": "none", "KOKSMA_FAULT_LOG": log})
    with open(log, encoding="utf-8") as stream:
        lines = [line.split() for line in stream]
    with open(path, "rb") as stream:
        return done, lines, inode, stream.read()


def check_case(checks, program, arguments, name, folder, old):
    if arguments[:2] == ["study", "new"] and old:
        return  # it writes over no file
    done, lines, inode, new = record(program, arguments, name, folder, old)
    what = f"{' '.join(arguments)} {name} over {'an old file' if old else 'nothing'}"
    checks.check(done is not None and done.code == 0, f"{what}: {done and done.err}")
    where, base = str(os.stat(os.path.dirname(os.path.join(folder, name))).st_ino), os.path.basename(name)
    before = OLD if old else None
    seen = set()
    for n, content in states(Disk(where, base, inode), lines, where, base):
        seen.add(content)
        if not checks.check(content in (before, new), f"{what}: after call {n} it may hold {len(content or b'')} bytes"):
            break
        if n == len(lines) and not checks.check(content == new, f"{what}: after success it may be gone"):
            break
    checks.check(seen == {before, new}, f"{what}: the old and the new file were not both seen")
    for left_out, must in (("file", "mixed"), ("folder", "lost")):
        bare = [line for line in lines if line[0] != "sync" or (line[1] == where) != (left_out == "folder")]
        bad = [content for n, content in states(Disk(where, base, inode), bare, where, base)
               if (content not in (before, new) if must == "mixed" else n == len(bare) and content != new)]
        checks.check(bad, f"{what}: without fsync of the {left_out} this test finds nothing")


def main():
    program, faults = map(os.path.abspath, sys.argv[1:3])
    checks = files.Checks()
    with tempfile.TemporaryDirectory() as folder:
        done = files.run(program, "study", "run", PLAN, "-q", "-o", "done", cwd=folder)
        checks.check(done is not None and done.code == 0, f"study: {done and done.err}")
        for arguments, name in CASES:
            for old in (True, False):
                check_case(checks, faults, arguments, name, folder, old)
    checks.end()


if __name__ == "__main__":
    main()

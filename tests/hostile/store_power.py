#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""store_power.py KOKSMA FAULTS: studies after a loss of power.

The program with faults writes down what SQLite and the rest write, sync, truncate, rename and remove (disk.py). At drawn
moments, half of them just before an fsync, the folder is made as a disk may have it after a loss of power: what was not
synced is dropped, torn at sectors, in another order, or rubbish. Of such a folder

- `export` gives only rows of the undisturbed study, bit for bit, and all that the store had at its last sync (which is before
  and after each checkpoint); after the program's end with success all. It may be refused, with exit code 3 and one line,
  only before a first row was synced;
- `audit --rows all` makes the same rows again, and agrees, or refuses where `export` does;
- the next `run` ends with all rows, and with no files but those of an undisturbed study.

As a check of this test, the same list without the fsyncs of the database and its log must be found wanting.
KOKSMA_POWER_STATES is how many states are drawn of each study (default 40; with sanitizers 6, and of every second study).
"""
import os
import random
import shutil
import sys
import tempfile

import disk
import files

HERE = os.path.dirname(os.path.abspath(__file__))
PLAN = os.path.join(HERE, "../study/plan.json")
SANITIZED = os.environ.get("KOKSMA_SANITIZED") == "1"
STATES = int(os.environ.get("KOKSMA_POWER_STATES", "6" if SANITIZED else "40"))
RUN = ["study", "run", PLAN, "-q", "--threads", "2", "-o", "d"]
MORE = [*RUN, "--trials", "5"]
FRESH, KILLED = {}, {"KOKSMA_FAULT": "db", "KOKSMA_FAULT_MODE": "end", "KOKSMA_FAULT_AT": "150"}


def past(schema):
    def prepare():
        os.mkdir("d")
        shutil.copy(f"{HERE}/../study/stores/schema_{schema}.sqlite", "d/results.sqlite")
    return prepare


def without_database(program):
    """A run that was killed, whose database somebody removed, but not its log."""
    def prepare():
        faulty(program, RUN, KILLED, "../log")
        os.remove("../log")
        assert os.path.getsize("d/results.sqlite-wal")
        os.remove("d/results.sqlite")
    return prepare


def finished(program):
    def prepare():
        assert run(program, *RUN).code == 0
    return prepare


def run(program, *arguments):
    return files.run(program, *arguments)


def faulty(program, arguments, fault, log):
    return files.run(program, *arguments, env={"KOKSMA_FAULT": "none", "KOKSMA_FAULT_LOG": log, **fault})


def rows(export):
    return export.out.decode().splitlines()[1:]


def listing(folder):
    return {os.path.relpath(os.path.join(at, name), folder) for at, _, names in os.walk(folder) for name in names}


class Study:
    """A list of runs that was recorded, and what they should have given."""

    def __init__(self, checks, programs, name, prepare, runs):
        self.checks, (self.program, self.faults), self.name, self.last = checks, programs, name, runs[-1][0]
        shutil.rmtree("d", ignore_errors=True)
        prepare()
        self.start = disk.Disk(".")
        for arguments, fault in runs:
            done = faulty(self.faults, arguments, fault, "../log")
            checks.check(done is not None and done.code == (99 if fault else 0), f"{name}: {done and done.err}")
        self.lines = disk.read_log("../log")
        os.remove("../log")
        self.truth, self.left = rows(run(self.program, "study", "export", "d")), listing("d")
        checks.check(len(self.truth) > 20, f"{name}: few rows")

    def kept(self):
        """By the number of lines: the rows that are certain from there on."""
        certain, now, at, names = [], self.start.copy(), set(), ["d/results.sqlite", "d/results.sqlite-wal"]
        for n, line in enumerate(self.lines):
            now.apply(line)
            if line[0] == "sync" and line[1] in self.inodes_of(now, names):
                tree = now.after(random, "all", "all")
                content = tuple(map(tree.get, names))
                if content not in at:
                    at.add(content)
                    disk.make(tree, "../now")
                    export = run(self.program, "study", "export", "../now/d")
                    found = set(rows(export)) if export.code == 0 else set()
                    certain.append((n + 1, found))
        certain.append((len(self.lines), set(self.truth)))
        return certain

    def moments(self, chance):
        """Numbers of lines, in order: half of them just before a sync."""
        syncs = [n for n, line in enumerate(self.lines) if line[0] == "sync"]
        chance.shuffle(syncs)
        before = [syncs[i % len(syncs)] for i in range(STATES // 2)]
        others = [chance.randrange(len(self.lines) + 1) for _ in range(STATES - STATES // 2 - 3)]
        return sorted(before + others + 3 * [len(self.lines)])

    def states(self, lines, moments, chance):
        """(number of lines, tree) of a loss of power at each moment."""
        now, done = self.start.copy(), 0
        for n in moments:
            for line in lines[done:n]:
                now.apply(line)
            done = n
            yield n, now.after(chance)

    def wrong(self, certain, n, tree):
        """What is wrong of a state, or None; and whether it was refused."""
        must = next((found for at, found in reversed(certain) if at <= n), set())
        disk.make(tree, "../crash")
        export = run(self.program, "study", "export", "../crash/d")
        if export.code != 0:
            fine = export.code == 3 and export.err.count(b"\n") == 1 and not must
            return (None if fine else f"export: exit code {export.code}, {len(must)} rows synced: {export.err}"), True
        found = rows(export)
        if not set(found) <= set(self.truth) or len(set(found)) < len(found):
            return f"rows that are wrong: {[row for row in found if row not in self.truth][:2]}", False
        if not set(found) >= must:
            return f"{len(must - set(found))} of {len(must)} synced rows are gone", False
        return None, False

    def wrong_after(self, refused):
        audit = run(self.program, "study", "audit", "../crash/d", "--rows", "all", "-q")
        if audit.code != (3 if refused else 0):
            return f"audit: exit code {audit.code}: {audit.out} {audit.err}"
        again = run(self.program, *["../crash/d" if word == "d" else word for word in self.last])
        export = run(self.program, "study", "export", "../crash/d")
        if again.code or export.code:
            return f"run: exit code {again.code}, export {export.code}: {again.err} {export.err}"
        if rows(export) != self.truth:
            return "run: other rows"
        if listing("../crash/d") != self.left:
            return f"run: left {listing('crash/d') ^ self.left}"
        return None

    def check(self):
        chance = random.Random(3)
        certain, moments = self.kept(), self.moments(chance)
        refused, lost = 0, None
        for i, (n, tree) in enumerate(self.states(self.lines, moments, chance)):
            problem, was_refused = self.wrong(certain, n, tree)
            problem = problem or (self.wrong_after(was_refused) if i % 3 == 0 or n == len(self.lines) else None)
            self.checks.check(not problem, f"{self.name}: after call {n} of {len(self.lines)}: {problem}")
            refused += was_refused
        bare = [line if line[0] != "sync" or self.is_folder(line[1]) else ["nothing", line[1]] for line in self.lines]
        for n, tree in self.states(bare, moments, random.Random(4)):
            lost = lost or self.wrong(certain, n, tree)[0]
        self.checks.check(lost, f"{self.name}: without fsync this test finds nothing")
        syncs = sum(line[0] == "sync" for line in self.lines)
        print(f"{self.name}: {len(self.lines)} calls, {syncs} of them fsync; {len(moments)} losses of power, {refused} refused "
              f"before the first row; without fsync: {lost}")

    @staticmethod
    def inodes_of(now, names):
        folder = now.inodes[now.inodes[now.root].now["d"]].now
        return [folder.get(os.path.basename(name)) for name in names]

    def is_folder(self, inode):
        return any(line[0] in ("rename", "create", "mkdir", "link") and line[1] == inode for line in self.lines)


def main():
    programs = tuple(map(os.path.abspath, sys.argv[1:3]))
    checks = files.Checks()
    with tempfile.TemporaryDirectory() as work:
        os.mkdir(work + "/disk")
        os.chdir(work + "/disk")
        studies = [
                ("new study", lambda: None, [(RUN, FRESH)]),
                ("killed and continued", lambda: None, [(RUN, KILLED), (RUN, FRESH)]),
                ("more trials", finished(programs[0]), [(MORE, FRESH)]),
                ("upgrade of schema 3", past(3), [(RUN, FRESH)]),
                ("upgrade of schema 5", past(5), [(RUN, FRESH)]),
                ("database removed, log left", without_database(programs[1]), [(RUN, FRESH)])]
        for name, prepare, runs in studies[1::2] if SANITIZED else studies:
            Study(checks, programs, name, prepare, runs).check()
    checks.end()


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""faults.py PROGRAM [--all] [--only CASE] [--kind KIND]: runs commands of the program with one fault each.

PROGRAM is koksma-faults (faults.h says what it takes). A command of cases.txt is run without a fault, and then with the
first, second, ... call of each kind failing: once, from then on, or with the end of the process there. Whatever fails,
the run must come to its end in time, with exit code 0 and all that it gives without the fault, or with a documented exit
code and one line on stderr that says why. A file that it was to write must be as before or whole; a study's store must
pass SQLite's integrity check, and the same command once more must give the same rows as an undisturbed run.

With --all every call fails once, else a few calls of each kind, spread over the run.
"""
import argparse
import concurrent.futures
import os
import re
import resource
import shutil
import sqlite3
import subprocess
import sys
import tempfile

FOLDER = os.path.dirname(os.path.abspath(__file__))
KINDS = ["memory", "open", "read", "write", "sync", "close", "rename", "thread", "db"]
MODES = {kind: ["once", "on"] for kind in KINDS} | {
    "write": ["once", "on", "end"], "sync": ["once", "end"], "rename": ["once", "end"], "db": ["once", "on", "end"]}
SECONDS = 1800  # a run takes tenths of one; this finds those that never end, on machines under any load
ENDED = 99
OLD = b"what was there before\n"


class Case:
    """A line of cases.txt: NAME [seldom] [study] [search]: ARGUMENTS, with $KOKSMA_TESTS and $IN for folders. A search
    writes its file again with every better set, each of which is whole."""

    def __init__(self, line):
        head, self.arguments = line.split(":", 1)
        self.name, *flags = head.split()
        self.study, self.seldom, self.search = "study" in flags, "seldom" in flags, "search" in flags
        self.arguments = self.arguments.split()


def read_cases():
    with open(os.path.join(FOLDER, "cases.txt"), encoding="utf-8") as stream:
        return [Case(line) for line in stream if line.strip() and not line.startswith("#")]


class Runner:
    def __init__(self, program, shared):
        self.program, self.shared = program, shared

    def run(self, arguments, folder, fault=None, count=None):
        environment = dict(os.environ, TMPDIR=folder)
        if fault:
            environment |= {"KOKSMA_FAULT": fault[0], "KOKSMA_FAULT_AT": str(fault[1]), "KOKSMA_FAULT_MODE": fault[2]}
        if count:
            environment["KOKSMA_FAULT_COUNT"] = count
        words = [word.replace("$IN", self.shared) for word in arguments]
        return subprocess.run([self.program] + words, cwd=folder, env=environment, timeout=SECONDS,
                              stdin=subprocess.DEVNULL, capture_output=True, check=False)


def contents(folder):
    """The files below a folder, but for those of a store, which change with the time of day."""
    found = {}
    for where, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(where, name)
            if ".sqlite" not in name:
                with open(path, "rb") as stream:
                    found[os.path.relpath(path, folder)] = stream.read()
    return found


def is_whole(name, bytes_now, bytes_good, search):
    if search:  # an earlier set has as many lines, of other numbers
        shape = [[re.sub(rb"[0-9.e-]+", b"0", line), bytes_now[-1:]] for line in bytes_now.splitlines()]
        return shape == [[re.sub(rb"[0-9.e-]+", b"0", line), bytes_good[-1:]] for line in bytes_good.splitlines()]
    if name.endswith(".html"):  # it tells the time
        return bytes_now.rstrip().endswith(b"</html>")
    if name.endswith("report.json"):
        return bytes_now.startswith(b"{") and bytes_now.endswith(b"]}\n")
    return bytes_now == bytes_good


class Undisturbed:
    """What a case gives without a fault, and how many calls of a kind it makes."""

    def __init__(self, runner, case):
        with tempfile.TemporaryDirectory() as folder:
            count = os.path.join(folder, "count")
            done = runner.run(case.arguments, folder, ("none", 1, "once"), count)
            with open(count, encoding="ascii") as stream:
                lines = [line.split() for line in stream]
            self.calls = {kind: int(n) for kind, n in lines}
            os.remove(count)
            self.code, self.out, self.files = done.returncode, done.stdout, contents(folder)
            if done.returncode not in (0, 1) or done.stderr:
                raise SystemExit(f"{case.name}: without a fault: exit code {done.returncode}, {done.stderr.decode()}")
            self.rows = export(runner, folder) if case.study else None


def export(runner, folder):
    done = runner.run(["study", "export", "out"], folder)
    return done.stdout if done.returncode == 0 else done.stderr


def without_times(out):
    """All but small numbers: seconds are among them, and columns are as wide as those."""
    return re.sub(rb" +", b" ", re.sub(rb"\b\d(\.\d+)?(e-\d+)?", b"", out))


def problem_of_run(done, good, kind, mode):
    """What is wrong with how the program ended, or None."""
    lines = done.stderr.decode(errors="replace").splitlines()
    if done.returncode == good.code and not lines:
        return None if without_times(done.stdout) == without_times(good.out) else "exit code 0 with another output"
    if mode == "end" and done.returncode == ENDED:
        return None
    if done.returncode not in ((3, 4) if kind in ("open", "read", "db") else (4,)):
        return f"exit code {done.returncode}: {' / '.join(lines[:12])}"
    if len(lines) != 1 or not re.match(r"koksma [a-z]+: .{8,}|koksma: .{8,}", lines[0]):
        return f"exit code {done.returncode} with {len(lines)} lines: {' / '.join(lines)}"
    return None


def problem_of_files(now, good, code, mode, search):
    for name, bytes_now in now.items():
        base = os.path.basename(name)
        if base.startswith(".koksma-"):
            if mode != "end":
                return f"left {name} behind"
        elif name not in good.files:
            return f"made {name}"
        elif not is_whole(name, bytes_now, good.files[name], search) and not (code != good.code and bytes_now == OLD):
            return f"{name} is not whole: {len(bytes_now)} bytes of {len(good.files[name])}"
    missing = [name for name in good.files if name not in now]
    return f"exit code 0 without {missing[0]}" if code == good.code and missing else None


def problem_of_store(runner, case, good, folder):
    """The store is sound, and the same command goes on to the same rows."""
    path = os.path.join(folder, "out", "results.sqlite")
    if os.path.exists(path):
        kept = os.path.join(folder, "kept")
        shutil.copytree(os.path.join(folder, "out"), kept)
        with sqlite3.connect(os.path.join(kept, "results.sqlite")) as database:
            answer = database.execute("PRAGMA integrity_check").fetchall()
        database.close()
        if answer != [("ok",)]:
            return f"integrity_check: {answer}"
    if "run" in case.arguments or "reproduce" in case.arguments:
        again = runner.run(case.arguments, folder)
        if again.returncode != good.code:
            return f"does not go on: {again.stderr.decode()}"
        if export(runner, folder) != good.rows:
            return "other rows after it went on"
    return None


def try_fault(runner, case, good, fault):
    kind, _, mode = fault
    with tempfile.TemporaryDirectory() as folder:
        for name in good.files:
            if os.sep not in name and case.arguments[:2] != ["study", "new"]:  # which writes over no file
                with open(os.path.join(folder, name), "wb") as stream:
                    stream.write(OLD)
        try:
            done = runner.run(case.arguments, folder, fault)
        except subprocess.TimeoutExpired:
            return "did not end"
        return (problem_of_run(done, good, kind, mode) or
                problem_of_files(contents(folder), good, done.returncode, mode, case.search) or
                (problem_of_store(runner, case, good, folder) if case.study else None))


def chosen(case, kind, good, options):
    """Which calls fail. Some: the first, the last, and one between; of `seldom` cases an allocation or a write."""
    calls = good.calls[kind]
    if options.all:
        return range(1, calls + 1)
    if case.seldom:
        some = {1 + len(case.name) * 7 % calls} if calls and kind in ("memory", "write") else set()
    else:
        some = {1, calls * 2 // 5 + 1, calls} if calls else set()
    return sorted(some)


def plan(runner, options):
    for case in read_cases():
        if options.only and not re.fullmatch(options.only, case.name):
            continue
        good = Undisturbed(runner, case)
        for kind in KINDS:
            if options.kind and kind != options.kind:
                continue
            for at in chosen(case, kind, good, options):
                modes = MODES[kind] if options.all else [MODES[kind][at % len(MODES[kind])]]
                for mode in modes:
                    yield case, good, (kind, at, mode)


def make_inputs(runner, shared):
    """Files that the commands read, in $IN."""
    commands = [["generate", "n-rooks", "-n", "64", "-o", "points.txt"], ["generate", "sobol", "-n", "16", "-o", "points.npy"]]
    for name in ("a.png", "b.png", "b.exr", "c.pfm"):
        seed = str(len(commands))
        commands.append(["render", "ball", "--spp", "2", "--size", "8x8", "-q", "-o", name, "--seed", seed])
    commands.append(["render", "ball", "--spp", "2", "--size", "16x8", "-q", "-o", "e.exr"])
    commands.append(["study", "run", "./plan.json", "-q", "-o", "done"])
    for name in os.listdir(os.path.join(FOLDER, "inputs")):
        shutil.copy(os.path.join(FOLDER, "inputs", name), shared)
    for words in commands:
        done = runner.run(words, shared)
        if done.returncode:
            raise SystemExit(done.stderr.decode())


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--all", action="store_true", help="every call fails once")
    parser.add_argument("--only", help="cases whose name matches this regular expression")
    parser.add_argument("--kind", choices=KINDS)
    options = parser.parse_args()
    bad, n = 0, {}
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with tempfile.TemporaryDirectory() as shared:
        runner = Runner(options.program, shared)
        make_inputs(runner, shared)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            tries = [(case, fault, pool.submit(try_fault, runner, case, good, fault))
                     for case, good, fault in plan(runner, options)]
            for case, fault, answer in tries:
                n[fault[0]] = n.get(fault[0], 0) + 1
                if answer.result():
                    bad += 1
                    print(f"{case.name}: {fault[0]} {fault[1]} {fault[2]}: {answer.result()}", flush=True)
    print(", ".join(f"{kind} {count}" for kind, count in n.items()))
    print(f"{sum(n.values())} faults, {bad} problems")
    return 1 if bad or not n else 0


if __name__ == "__main__":
    sys.exit(main())

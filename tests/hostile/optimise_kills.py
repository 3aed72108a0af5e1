#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""optimise_kills.py KOKSMA: `koksma optimise` is killed (SIGKILL) at random moments, again and again on one file, with --from it
where it exists: 4 times for each method of `koksma list methods`, and with a target power (with sanitizers once, for two
methods). After each kill the file, if it is there, is a whole set with the value that its comment says, never worse than
after the kill before, and nothing but it and what the next run removes is left; a run that is not killed then goes on from
it. Values are those that `koksma measure` gives of the file; those of a sequence are its prefixes' geometric mean, and those
of a power come from its definition."""
import cmath
import glob
import json
import math
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

KOKSMA = os.path.abspath(sys.argv[1])
SANITIZED = os.environ.get("KOKSMA_SANITIZED") == "1"
KILLS, FILE, N = 1 if SANITIZED else 4, "best.txt", 8 if SANITIZED else 16
# method, its measure, further arguments
SEARCHES = [("star-plane", "star", []), ("star-space", "star", ["-d", "3"]), ("anneal", "l2-star", []), ("descent", "l2-periodic", []),
            ("exchange", "l2-centered", ["--keep", "latin"]), ("digital", "star", ["--keep", "sequence"]),
            ("perturb", "min-distance", []), ("witness", "extreme", []), ("descent", None, ["--power", "step"])]


def koksma(*arguments):
    return subprocess.run([KOKSMA, *arguments], capture_output=True, text=True, check=True).stdout


def search(case, seed, *more):
    _, measure, arguments = case
    start = ["-n", str(N)]
    if os.path.exists(FILE):
        start = ["--from", f"net-file:{FILE}@{N}"] if "sequence" in arguments else ["--from", FILE]
    return subprocess.Popen([KOKSMA, "optimise", *([measure] if measure else []), *arguments, *start, "--seed", str(seed), "-o", FILE,
                             "-q", "--json", *more], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def measured(source, measure):
    row = json.loads(koksma("measure", source, "-m", measure, "--json"))
    return row["value"]


def off_step(points):
    """The root mean square difference of the radial power from 0 below sqrt(n / pi) and 1 above."""
    rings = math.ceil(2 * math.sqrt(N))
    powers = {r: [] for r in range(1, rings + 1)}
    for kx in range(-rings, rings + 1):
        for ky in range(-rings, rings + 1):
            ring = math.floor(math.hypot(kx, ky) + 0.5)
            if ring in powers:
                powers[ring].append(abs(sum(cmath.exp(-2j * math.pi * (kx * x + ky * y)) for x, y in points))**2 / N)
    squares = [r * (sum(p) / len(p) - (r > math.sqrt(N / math.pi)))**2 for r, p in powers.items()]
    return math.sqrt(sum(squares) / sum(powers))


def value(case):
    """The value of the file, which its comment has too; large distances as small numbers."""
    _, measure, arguments = case
    text = open(FILE, encoding="utf-8").read()
    if "sequence" in arguments:
        logs = [math.log(measured(f"pattern:net-file:{FILE}@{n}", measure)) for n in (2, 4, 8, 16) if n <= N]
        found = math.exp(sum(logs) / len(logs))
    else:
        points = [[float(x) for x in line.split()] for line in text.splitlines() if line[0] != "#"]
        assert len(points) == N, f"{len(points)} points"
        found = measured(FILE, measure) if measure else off_step(points)
    comment = float(re.search(r"^# value (.*)$", text, re.M).group(1))
    assert abs(found - comment) < 1e-12, f"{case}: {found} is not {comment}"
    return -found if measure == "min-distance" else found


def whole_run(case, seed):
    run = search(case, seed, "--steps", "1")
    row = json.loads(run.communicate()[0])
    assert run.returncode == 0 and row["method"] == case[0], f"{case}: {row}"


def attack(case):
    began = time.monotonic()
    whole_run(case, 0)
    within_s, best, found = 1.5 * (time.monotonic() - began), math.inf, 0
    value(case)
    os.remove(FILE)
    for seed in range(KILLS):
        victim = search(case, seed, "--time-limit", "100")
        time.sleep(random.uniform(0, within_s))
        victim.send_signal(signal.SIGKILL)
        victim.communicate()
        assert victim.returncode == -signal.SIGKILL, f"{case}: ended before the kill with {victim.returncode}"
        if os.path.exists(FILE):
            now, found = value(case), found + 1
            assert now <= best, f"{case}: {now} after {best}"
            best = now
    whole_run(case, 0)
    assert value(case) <= best
    left = [name for name in glob.glob("*") + glob.glob(".*") if name != FILE]
    assert not left, f"left behind: {left}"
    os.remove(FILE)
    print(f"{case[0]}: {KILLS} kills, {found} with a set on disk, {best}")
    return found


def main():
    random.seed(int(os.environ.get("KOKSMA_KILLS_SEED", "7")))
    os.chdir(tempfile.mkdtemp())
    methods = {json.loads(line)["method"] for line in koksma("list", "methods", "--json").splitlines()}
    assert methods == {case[0] for case in SEARCHES}, methods
    cases = [case for case in SEARCHES if case[0] in ("star-plane", "digital")] if SANITIZED else SEARCHES
    found = sum(attack(case) for case in cases)
    assert SANITIZED or found > len(cases) * KILLS / 2


main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""optimise_kills.py KOKSMA: `koksma optimise` is killed (SIGKILL) at 60 random moments, again and again on one file, with --from
it where it exists. After each kill the file, if it is there, is a whole set with the value that its comment says, never worse than
after the kill before, and nothing but it and what the next run removes is left; a run that is not killed then goes on from it."""
import glob
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

KOKSMA = os.path.abspath(sys.argv[1])
KILLS, FILE = 60, "best.txt"


def search(seed, *more):
    start = ["--from", FILE] if os.path.exists(FILE) else ["-n", "24"]
    return subprocess.Popen([KOKSMA, "optimise", "l2-star", *start, "--seed", str(seed), "-o", FILE, "-q", *more],
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def value():
    comment = float(re.search(r"^# value (.*)$", open(FILE, encoding="utf-8").read(), re.M).group(1))
    rows = subprocess.run([KOKSMA, "measure", FILE, "-m", "l2-star", "--json"], capture_output=True, text=True, check=True).stdout
    measured = float(re.search(r'"value":([0-9.e-]+)', rows).group(1))
    assert abs(measured - comment) < 1e-12, f"{measured} is not {comment}"
    assert re.search(r'"n":24,', rows), rows
    return measured


def main():
    random.seed(int(os.environ.get("KOKSMA_KILLS_SEED", "7")))
    os.chdir(tempfile.mkdtemp())
    began = time.monotonic()
    assert search(0, "--steps", "1").wait() == 0
    within_s, best, found, killed = 1.5 * (time.monotonic() - began), value(), 0, 0
    os.remove(FILE)
    best = float("inf")
    for seed in range(KILLS):
        victim = search(seed, "--time-limit", "100")
        time.sleep(random.uniform(0, within_s))
        victim.send_signal(signal.SIGKILL)
        killed += victim.wait() == -signal.SIGKILL
        if os.path.exists(FILE):
            now, found = value(), found + 1
            assert now <= best, f"{now} after {best}"
            best = now
    assert search(0, "--steps", "1").wait() == 0 and value() <= best
    left = [name for name in glob.glob("*") + glob.glob(".*") if name != FILE]
    assert not left, f"left behind: {left}"
    print(f"{killed} kills, {found} with a set on disk, {best}")
    assert killed == KILLS and found > KILLS / 2


main()

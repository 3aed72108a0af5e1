#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench_python.py [--turns N] [--only TEXT]: what Python adds to the library's own call on the same memory, on one thread. A row
shows the least microseconds of a call in C and in Python, the ratio of their times, and its interval. --only: rows whose name
contains TEXT.

Turns of C and of Python alternate, and the ratio is the median of the ratios of neighbouring turns, in which a clock that
changes within seconds is nearly the same; every second pair has its turns in the other order, so that a drift cancels. The
interval is that of a median by ranks (the sign test), which needs nothing but independent pairs. The intervals of all rows
hold together with 95 %. A turn is processor time of at least 10 ms. The last lines judge by the whole interval: bulk rows
against 5 % over C, calls of 16 points against 10 microseconds by the least time, which other programs cannot lower.
"""
import argparse
import math
import os
import statistics
import sys
import time

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
os.environ.setdefault("KOKSMA_LIBRARY_DIR", os.path.join(ROOT, "build", "release", "src"))
sys.path.insert(0, os.path.join(ROOT, "python"))
from ctypes import byref  # noqa: E402

import numpy as np  # noqa: E402

import koksma  # noqa: E402
from koksma import _library, _points, _structs  # noqa: E402

ENOUGH_S, FEW, MOST_RATIO, MOST_US = 0.01, 16, 1.05, 10
RUN = _structs.Run(1)


def seconds(call, count):
    start = time.process_time()
    for _ in range(count):
        call()
    return (time.process_time() - start) / count


def rank_below(n, confidence):
    """The largest k such that the k-th smallest and the k-th largest of n values are an interval of their median: the chance
    that fewer than k of n tosses of a coin are heads is at most half of what is missing to the confidence. 0: there is none."""
    k, chance = 0, 0.0
    while k < n // 2:
        chance += math.comb(n, k) / 2**n
        if chance > (1 - confidence) / 2:
            break
        k += 1
    return k


def compare(bare, ours, turns, confidence):
    """Least microseconds of each, and the median ratio with its interval."""
    count = 1 + int(ENOUGH_S / max(seconds(bare, 1), 1e-7))
    seconds(ours, 1)
    c, python = [], []
    for turn in range(turns):
        for times, call in ((c, bare), (python, ours))[::-1 if turn % 2 else 1]:
            times.append(seconds(call, count))
    ratios, k = sorted(p / q for p, q in zip(python, c)), rank_below(turns, confidence)
    return 1e6 * min(c), 1e6 * min(python), statistics.median(ratios), ratios[k - 1], ratios[-k]


def generating(pattern, n):
    out = np.zeros((n, 2))
    spec, points = _library.spec("pattern", pattern), _points.view(out)
    return (lambda: _library.core().koksma_generate(byref(spec), 1, byref(RUN), byref(points)),
            lambda: koksma.generate(pattern, seed=1, threads=1, out=out))


def measuring(measure, n):
    array, value = koksma.generate("random", n), _structs.Value()
    spec, points = _library.spec("measure", measure), _points.view(array)
    return (lambda: _library.core().koksma_evaluate(byref(spec), byref(points), byref(RUN), byref(value)),
            lambda: koksma.measure(array, measure, threads=1))


ROWS = [(f"generate {pattern}, {n} points, out=", n, generating, pattern)
        for pattern in ("random", "jittered", "n-rooks", "sobol", "halton") for n in (FEW, 1 << 20, 1 << 22)]
ROWS += [(f"measure {measure}, {n} points", n, measuring, measure)
         for measure, sizes in (("star", (FEW, 512, 16384)), ("l2-star", (FEW, 1024, 65536)), ("extreme", (FEW, 256, 2048))) for n in sizes]


def named(rows):
    return "; ".join(rows) or "none"


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition(":")[2].partition(".")[0])
    parser.add_argument("--turns", type=int, default=41)
    parser.add_argument("--only", default="")
    a = parser.parse_args()
    rows = [row for row in ROWS if a.only in row[0]]
    confidence = 1 - 0.05 / max(1, len(rows))
    if not rows or not rank_below(a.turns, confidence):
        parser.error("no row has that name" if not rows else f"{a.turns} turns are too few for intervals of {len(rows)} rows")
    above, undecided, slow, bulk = [], [], [], 0
    for name, n, kind, spec in rows:
        c, python, ratio, low, high = compare(*kind(spec, n), a.turns, confidence)
        print(f"{name:36} C {c:9.1f} us  Python {python:9.1f} us  ratio {ratio:.3f} ({low:.3f} to {high:.3f})", flush=True)
        if n == FEW:
            slow += [f"{name}: {python:.1f} us, {c:.1f} of them in C"] if python >= MOST_US else []
            continue
        bulk += 1
        above += [name] if low > MOST_RATIO else []
        undecided += [name] if low <= MOST_RATIO < high else []
    print(f"Calls of {FEW} points that take {MOST_US} us or more: {named(slow)}.")
    print(f"Of {bulk} bulk rows {len(above)} take more than {MOST_RATIO} times as long as C beyond the uncertainty ({named(above)}), "
          f"{bulk - len(above) - len(undecided)} at most that, and {len(undecided)} are undecided ({named(undecided)}).")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What Python adds to the library's own call on the same memory, on one thread: microseconds of a call in C and in Python,
their difference and ratio. Processor time, the least of alternating turns. The difference is a fixed cost, but for what
the processor has to fetch again after a long call."""
import os
import sys
import time

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
os.environ.setdefault("KOKSMA_LIBRARY_DIR", os.path.join(ROOT, "build", "release", "src"))
sys.path.insert(0, os.path.join(ROOT, "python"))
from ctypes import byref  # noqa: E402

import numpy as np  # noqa: E402

import koksma  # noqa: E402
from koksma import _library, _points, _structs  # noqa: E402

TURNS, ENOUGH_S = 15, 0.01
RUN = _structs.Run(1)


def seconds(call, count):
    start = time.process_time()
    for _ in range(count):
        call()
    return (time.process_time() - start) / count


def compare(name, bare, ours):
    count = 1 + int(ENOUGH_S / max(seconds(bare, 1), 1e-7))
    turns = [(seconds(bare, count), seconds(ours, count)) for _ in range(TURNS)]
    c, python = (1e6 * min(column) for column in zip(*turns))
    print(f"{name:36} C {c:9.1f} us  Python {python:9.1f} us  {python - c:7.1f} more  ratio {python / c:.3f}", flush=True)


def generating(pattern, n):
    out = np.zeros((n, 2))
    spec, points = _library.spec("pattern", pattern), _points.view(out)
    compare(f"generate {pattern}, {n} points, out=", lambda: _library.core().koksma_generate(byref(spec), 1, byref(RUN), byref(points)),
            lambda: koksma.generate(pattern, seed=1, threads=1, out=out))


def measuring(measure, n):
    array, value = koksma.generate("random", n), _structs.Value()
    spec, points = _library.spec("measure", measure), _points.view(array)
    compare(f"measure {measure}, {n} points", lambda: _library.core().koksma_evaluate(byref(spec), byref(points), byref(RUN), byref(value)),
            lambda: koksma.measure(array, measure, threads=1))


for pattern in ("random", "jittered", "n-rooks", "sobol", "halton"):
    for n in (16, 1 << 20, 1 << 22):
        generating(pattern, n)
for measure, sizes in (("star", (16, 512, 16384)), ("l2-star", (16, 1024, 65536)), ("extreme", (16, 256, 2048))):
    for n in sizes:
        measuring(measure, n)

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""koksma.generate against the bare C call into the same memory, on one thread: bulk rates in million points a second,
and their ratio (the median of alternating runs)."""
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

N = 1 << 20


def timed(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


for pattern in ("random", "jittered", "n-rooks", "sobol", "halton"):
    out = np.zeros((N, 2))
    spec, points, run = _library.spec("pattern", pattern), _points.view(out), _structs.Run(1)
    bare, ours = [], []
    for _ in range(9):
        bare.append(timed(lambda: _library.core().koksma_generate(byref(spec), 1, byref(run), byref(points))))
        ours.append(timed(lambda: koksma.generate(pattern, seed=1, threads=1, out=out)))
    ratio = statistics.median(o / b for o, b in zip(ours, bare))
    print(f"{pattern:12} C {N / min(bare) / 1e6:7.1f}  Python {N / min(ours) / 1e6:7.1f}  time ratio {ratio:.3f}")

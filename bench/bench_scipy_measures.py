#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Milliseconds of scipy's discrepancies, in the form of bench-measures' rows. Says so when scipy is missing."""
import statistics
import sys
import time

try:
    import numpy
    from scipy.stats import qmc
except ImportError:
    sys.exit("scipy is not installed")

for name, method, n in (("l2-star", "L2-star", 1000), ("l2-star", "L2-star", 10000), ("l2-centered", "CD", 10000),
                        ("l2-wraparound", "WD", 10000), ("l2-mixture", "MD", 10000)):
    points = numpy.random.default_rng(1).random((n, 2))
    times = []
    for _ in range(3):
        start = time.process_time()
        qmc.discrepancy(points, method=method, workers=1)
        times.append(time.process_time() - start)
    print("%-14s %-11s %8d %2d %12.3f %10s %7s  %s" % (name, "random", n, 2, 1e3 * statistics.median(times), "-", "-",
                                                     "scipy in this run"))

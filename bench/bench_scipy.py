#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Million points a second of scipy's generators, in the form of bench-patterns' rows. Says so when scipy is missing."""
import statistics
import sys
import time

try:
    from scipy.stats import qmc
except ImportError:
    sys.exit("scipy is not installed")

for name, make, dim, n in (("sobol", lambda d: qmc.Sobol(d, scramble=False), 2, 65536),
                           ("sobol", lambda d: qmc.Sobol(d, scramble=False), 2, 1048576),
                           ("sobol", lambda d: qmc.Sobol(d, scramble=False), 4, 65536),
                           ("halton", lambda d: qmc.Halton(d, scramble=False), 2, 65536),
                           ("latin hypercube", qmc.LatinHypercube, 2, 65536)):
    times = []
    for _ in range(5):
        generator = make(dim)
        start = time.perf_counter()
        generator.random(n)
        times.append(time.perf_counter() - start)
    print("%-36s %dD %8d %10.4g %8s  %-16s %s" % ("(scipy %s)" % name, dim, n, n / statistics.median(times) * 1e-6, "-", "",
                                                 "this run"))

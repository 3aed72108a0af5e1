#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Million points a second of scipy's generators, by the names of Koksma's patterns: pattern, dimensions, points, rate.
bench-patterns reads these rows. Says so when scipy is missing."""
import statistics
import sys
import time

try:
    from scipy.stats import qmc
except ImportError:
    sys.exit("scipy is not installed")

MAKERS = {"sobol": lambda dim: qmc.Sobol(dim, scramble=False), "halton": lambda dim: qmc.Halton(dim, scramble=False),
          "n-rooks": qmc.LatinHypercube}

for name, dim, n in (("n-rooks", 2, 1024), ("n-rooks", 2, 65536), ("n-rooks", 2, 1048576),
                     ("halton", 2, 1024), ("halton", 2, 65536), ("halton", 2, 1048576), ("halton", 4, 1048576),
                     ("sobol", 2, 65536), ("sobol", 2, 1048576), ("sobol", 4, 65536), ("sobol", 4, 1048576)):
    times = []
    for _ in range(5):
        generator = MAKERS[name](dim)
        start = time.process_time()
        generator.random(n)
        times.append(time.process_time() - start)
    print("%s %d %d %.4g" % (name, dim, n, n / statistics.median(times) * 1e-6))

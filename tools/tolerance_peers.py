#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""tolerance_peers.py [RUNS | within RUNS]: integrals to a tolerance by Koksma, QMCPy and scipy, for docs/findings/coverage.md.

For functions that no table of this project has, in 3, 7 and 20 dimensions: of each method the medians of the numbers of
function values and of the true errors in RUNS runs, and of their ratios; "k of n done" where some runs state no error within the tolerance, as each
method has LIMIT values at most; ratios of points and of points for the same true error in each cell; "k of n within" where the true error of a run that states one exceeds it.

    koksma   koksma.integrate(f, dim, tolerance=...), with its defaults
    QMCPy    CubQMCSobolG (one scrambled net, bounds from Walsh coefficients) and CubQMCRepStudentT (replicates), 95 %
    scipy    qmc_quad has no tolerance: its n_points doubles from 256 until 8 estimates' half width of Student's 95 %
             interval is within the tolerance; values of earlier rounds count

"within RUNS" counts instead in how many of RUNS runs of Koksma the true error is within tolerances of 1e-2 to 1e-5, and needs no peer.

Needs numpy, scipy and qmcpy; run by hand with PYTHONPATH=python and KOKSMA_LIBRARY_DIR.
"""
import math
import statistics
import sys
import warnings
from fractions import Fraction

import numpy as np
import scipy.integrate
import scipy.stats

import koksma

LIMIT = 1 << 21
RUNS = int(sys.argv[-1]) if len(sys.argv) > 1 else 11


def irwin_hall(d, x, power):
    """The mean of max(x - S, 0)^power / power! for S the sum of d uniform numbers; power 0: the probability that S <= x."""
    x = Fraction(x)
    return float(sum((-1) ** k * math.comb(d, k) * (x - k) ** (d + power) for k in range(math.floor(x) + 1)) / math.factorial(d + power))


def smooth(d):
    j = np.arange(1, d + 1)
    return lambda x: np.exp((x / j).sum(axis=-1)), math.prod(k * math.expm1(1 / k) for k in range(1, d + 1))


def peak(d):
    a = 5 / np.arange(1, d + 1)
    mean = (np.arctan(0.7 * a) + np.arctan(0.3 * a)) / a
    return lambda x: (1 / (1 + (a * (x - 0.3)) ** 2) / mean).prod(axis=-1), 1.0


def kink(d):
    c = Fraction(d, 2) + Fraction(3, 10)
    return lambda x: np.maximum(float(c) - x.sum(axis=-1), 0), irwin_hall(d, c, 1)


def jump(d):
    c = Fraction(d, 2) + Fraction(3, 10)
    return lambda x: (x.sum(axis=-1) <= float(c)) * 1.0, irwin_hall(d, c, 0)


class Counted:
    def __init__(self, f):
        self.f, self.points = f, 0

    def __call__(self, x):
        self.points += x.size // x.shape[-1]
        return self.f(x)


def ours(f, d, tolerance, seed):
    found = koksma.integrate(f, d, tolerance=tolerance, seed=1000 * seed, max_points=LIMIT, threads=1)
    return found.value, found.reached


def qmcpy_by(name, **options):
    def run(f, d, tolerance, seed):
        import qmcpy

        criterion = getattr(qmcpy, name)
        integrand = qmcpy.CustomFun(qmcpy.Uniform(qmcpy.DigitalNetB2(d, seed=seed, **options)), f)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            more = {"alpha": 0.05} if criterion is qmcpy.CubQMCRepStudentT else {}
            value, data = criterion(integrand, abs_tol=tolerance, n_limit=LIMIT, **more).integrate()
        return float(np.squeeze(value)), float(np.squeeze(data.comb_bound_high - data.comb_bound_low)) <= 2 * tolerance
    return run


def scipys(f, d, tolerance, seed):
    n, quantile = 256, scipy.stats.t.ppf(0.975, 7)
    while True:
        found = scipy.integrate.qmc_quad(lambda x: f(x.T), np.zeros(d), np.ones(d), n_points=n, qrng=scipy.stats.qmc.Sobol(d, seed=seed))
        if quantile * found.standard_error <= tolerance or f.points + 16 * n > LIMIT:
            return found.integral, quantile * found.standard_error <= tolerance
        n *= 2


METHODS = {"koksma": ours, "QMCPy CubQMCSobolG": qmcpy_by("CubQMCSobolG"),
           "QMCPy CubQMCRepStudentT": qmcpy_by("CubQMCRepStudentT", replications=15), "scipy qmc_quad": scipys}



def cell(method, f, truth, d, tolerance):
    runs = []
    for seed in range(RUNS):
        counted = Counted(f)
        value, done = method(counted, d, tolerance, seed + 1)
        runs.append((abs(value - truth), counted.points, done))
        if not done and seed == 0 and d == 20:
            break  # at the limit all runs cost the same
    error, points, done = zip(*runs)
    stated = [e for e, _, ok in runs if ok]
    within = sum(e <= tolerance for e in stated)
    text = (f"{statistics.median(points):,.0f}; {statistics.median(error):.0e}" +
            (f"; {sum(done)} of {len(runs)} done" if not all(done) else "") +
            (f"; *{within} of {len(stated)} within*" if within < len(stated) else ""))
    return text, statistics.median(points), statistics.median(error), all(done) and within == len(stated)


#: Rates of the error by which points for the same true error are compared.
RATES = {"smooth": 1.5, "peak": 1.5, "kink": 1, "jump": 0.75}
found = []


def print_within():
    """Where a search ends as early as the interval allows, at tolerances between which the points do not double alike."""
    print("| function | d | tolerance | within | done | points |\n|---|---|---|---|---|---|")
    for make, tolerances in ((smooth, (3e-4, 1e-4, 3e-5)), (peak, (1e-3, 3e-4, 1e-4)), (kink, (1e-3, 7e-4, 5e-4)), (jump, (1e-2, 7e-3, 5e-3))):
        for d in (3, 7, 20):
            f, truth = make(d)
            for tolerance in tolerances:
                runs = []
                for seed in range(RUNS):
                    counted = Counted(f)
                    value, done = ours(counted, d, tolerance, seed + 1)
                    runs.append((abs(value - truth) <= tolerance, done, counted.points))
                stated = [within for within, done, _ in runs if done]
                print(f"| {make.__name__} | {d} | {tolerance:g} | {sum(stated)} of {len(stated)} | {len(stated)} of {RUNS} | "
                      f"{statistics.median(r[2] for r in runs):,.0f} |", flush=True)


if sys.argv[1:2] == ["within"]:
    print_within()
    sys.exit()
def ratios(rate, ours, theirs):
    """Of points; of true errors; of points for the same true error, which falls with this rate."""
    points, error = ours[1] / theirs[1], ours[2] / theirs[2]
    return points, error, points * error ** (1 / rate)


PEERS = list(METHODS)[1:]
print(f"| function | d | tolerance | {' | '.join(METHODS)} | ratios |\n|---|---|---|" + "---|" * (len(METHODS) + 1))
for tolerance in (1e-4, 1e-6):
    for make in (smooth, peak, kink, jump):
        for d in (3, 7, 20):
            f, truth = make(d)
            cells = [cell(m, f, truth, d, tolerance) for m in METHODS.values()]
            found.append((RATES[make.__name__], cells))
            beside = "; ".join("{0:.2g}, {2:.2g}".format(*ratios(RATES[make.__name__], cells[0], c)) for c in cells[1:])
            print(f"| {make.__name__} | {d} | {tolerance:g} | " + " | ".join(c[0] for c in cells) + f" | {beside} |", flush=True)

print("\nRatios: Koksma's points by those of each other method, and those by the points that it would take for Koksma's true error, in the order of the\n"
      "columns. Medians, from the least to the most: of the cells in which both are done and no bound failed, and below of all cells.\n"
      "\n| Koksma beside | cells | points | true error | points for the same true error |\n|---|---|---|---|---|")
for of_all in (False, True):
    for i, name in enumerate(PEERS, 1):
        table = [ratios(rate, cells[0], cells[i]) for rate, cells in found if of_all or (cells[0][3] and cells[i][3])]
        print(f"| {name} | {len(table)} | " + " | ".join(f"{statistics.median(r):.2g} ({min(r):.2g} to {max(r):.2g})" for r in zip(*table)) + " |")

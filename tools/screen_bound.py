#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The least error after a Gaussian that any samples of four coordinates can have: the bound of docs/findings/screen-noise.md.

    tools/screen_bound.py [search]

A filter with weights w (sum 1) over pixels of N samples is a sum of samples x_i with weights w_i, sum w_i^2 = s / N for s = sum w^2.
Over all half-spaces, their bounding hyperplanes uniform among those that meet the cube, its mean square error is, but for a factor,

    E = m - sum_ij w_i w_j |x_i - x_j|,   m = mean |u - v| of random points u, v of the cube,

if each sample alone is uniform, as unbiased pixels are in the mean over seeds; white noise has s m / N. Let

    H(r) = h + sum_k a_k F(t_k r),   a_k >= 0,   F(t) = the mean of cos(t z_1) over unit vectors z of four coordinates,

with H(r) <= -r for 0 <= r <= 2. F is positive definite, so sum_ij w_i w_j H(|x_i - x_j|) >= mean H(|u - v|) in the mean over seeds, and

    E >= m + sum_(i /= j) w_i w_j H(|x_i - x_j|) >= m + mean H(|u - v|) - (s / N) H(0).

This is Delsarte's linear programming bound. It holds for each window alone, so for all masks, keys and sequences. CERTIFICATES has t_k
and a_k; h is the largest that the check allows. `search` finds others by linear programming, which needs SciPy. The package of this
tree gives what keys over quadruples have.
"""
import sys

import numpy as np

import koksma

CERTIFICATES = {  # by the samples a pixel
    1: [(1.25, 0.218441), (1.75, 1.585337), (5.25, 0.182037), (5.5, 0.000905), (8.75, 0.02542), (9.0, 0.012452)],
    4: [(1.25, 2.429264), (3.75, 0.120465), (4.0, 0.152921), (6.75, 0.093046), (7.0, 0.001099), (9.75, 0.029595), (10.0, 0.012729),
        (13.0, 0.010159), (13.25, 0.006941), (16.5, 0.004344), (27.25, 0.000274)],
}

NODES, GRID, REACH = 16, 4000, 2.0
ANGLES = (np.arange(100) + 0.5) * np.pi / 100


def f(t):
    """F(t): the component z_1 = cos(angle) has the density 2 / pi sin(angle)^2; the midpoint rule is exact here."""
    return 2 / len(ANGLES) * np.cos(np.multiply.outer(t, np.cos(ANGLES))) @ np.sin(ANGLES)**2


def differences():
    """|u - v| at the nodes of Gauss's rule in four coordinates, and their weights: |u_k - v_k| has the density 2 (1 - z)."""
    z, w = np.polynomial.legendre.leggauss(NODES)
    z, w = (z + 1) / 2, (1 - z) / 2 * w
    square, weight = np.zeros(1), np.ones(1)
    for _ in range(4):
        square, weight = np.add.outer(square, z * z).ravel(), np.multiply.outer(weight, w).ravel()
    return np.sqrt(square), weight


def mean_of(t):
    """The mean of F(t |u - v|), which is smooth: by a polynomial through Chebyshev's nodes."""
    distance, weight = differences()
    of = np.polynomial.chebyshev.Chebyshev.interpolate(lambda r: f(t * r), 80, [0, REACH])
    return weight @ of(distance)


def gaussian_pairs(sigma=1.5, reach=6):
    """sum_p w_p w_(p + d) of the Gaussian of `koksma curve screen` along one axis, for d = -2 reach .. 2 reach."""
    w = np.exp(-np.arange(-reach, reach + 1)**2 / (2 * sigma * sigma))
    return np.convolve(w, w) / w.sum()**2


def gaussian_share():
    """sum w^2 of that Gaussian."""
    return float(max(gaussian_pairs())**2)


def measured(pattern, n, seeds=4, side=48):
    """The RMS error after the filter, and the plain one, of a pattern of images, in units of random points."""
    pairs, (distance, weight) = gaussian_pairs(), differences()
    reach, m, filtered, plain = len(pairs) // 2, weight @ distance, 0, 0
    for seed in range(seeds):
        x = np.asarray(koksma.generate(pattern, side * side * n, 4, seed=seed)).reshape(side, side, n, 4)
        for v in range(reach + 1):
            for u in range(-reach if v else 0, reach + 1):
                p, q = x[:side - v, max(0, -u):side - max(0, u)], x[v:, max(0, u):side - max(0, -u)]
                e = m - np.sqrt(((p[:, :, :, None] - q[:, :, None])**2).sum(-1)).mean()
                filtered += (2 if u or v else 1) * pairs[reach + u] * pairs[reach + v] * e / seeds
                plain += e / seeds if u == v == 0 else 0
    return float(np.sqrt(filtered * n / (gaussian_share() * m))), float(np.sqrt(plain * n / m))


def ratio(certificate, share):
    """A lower bound of the RMS error after the filter in units of that of as many random points. Between points of the grid H is
    above its chord by at most max |H''| step^2 / 8, and |F''| <= F''(0) = 1/4."""
    t, a = np.array(certificate).T
    if min(a) < 0:
        raise ValueError("a negative coefficient")
    r = np.linspace(0, REACH, GRID + 1)
    h = np.min(-r - f(np.multiply.outer(r, t)) @ a) - np.sum(a * t * t) / 4 * (REACH / GRID)**2 / 8
    mean = sum(c * mean_of(s) for s, c in zip(t, a))
    distance, weight = differences()
    m = weight @ distance
    return float(np.sqrt(max(0, (m + h + mean - share * (h + sum(a))) / (share * m))))


def search(share):
    """The best certificate of a list of t, with H checked at a list of distances."""
    from scipy.optimize import linprog  # pylint: disable=import-outside-toplevel
    t = np.linspace(.5, 50, 199)
    r = np.concatenate([np.linspace(0, .5, 201), np.linspace(.505, REACH, 200)])
    means = np.array([mean_of(s) for s in t])
    found = linprog(-np.append(means - share, 1 - share), A_ub=np.hstack([f(np.multiply.outer(r, t)), np.ones((len(r), 1))]), b_ub=-r,
                    bounds=[(0, None)] * len(t) + [(None, None)], method="highs")
    return [(round(float(s), 4), round(float(a), 6)) for s, a in zip(t, found.x) if a > 1e-7]


def main():
    for n in (1, 4):
        share = gaussian_share() / n
        certificate = search(share) if sys.argv[1:] == ["search"] else CERTIFICATES[n]
        filtered, plain = measured("ranking-keys:width=48,dims=4", n)
        print(f"{n} samples a pixel: at least {ratio(certificate, share):.4f} of random points {certificate};\n"
              f"  keys over quadruples {filtered:.3f}, before the filter {plain:.3f}")


if __name__ == "__main__":
    main()

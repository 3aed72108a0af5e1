#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The bound of errors after a filter (tools/screen_bound.py): its formula from the definition of a half-space, its certificates, and
that samples which were made for the filter are above it."""
import math
import os
import sys
import unittest

import numpy as np

import koksma

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "tools"))
import screen_bound  # noqa: E402  pylint: disable=import-error,wrong-import-position


def bessel(t):
    """F(t) = 2 J_1(t) / t in four dimensions, by its series."""
    return sum((-1)**k * (t / 2)**(2 * k) / (math.factorial(k) * math.factorial(k + 1)) for k in range(60))


class ScreenBound(unittest.TestCase):
    def test_mean_square_over_half_spaces_is_the_energy(self):
        """Weighted points x against a fine set u: the mean over half-spaces of the square of the difference of their shares, a small
        case from the definition, beside 2 mean w |x - u| - mean w w |x - x| - mean |u - u|."""
        rng = np.random.default_rng(63)
        x, u, w = rng.random((5, 4)), rng.random((40, 4)), np.array([.4, .2, .2, .1, .1])
        points, weights = np.concatenate([x, u]), np.concatenate([w, np.full(40, -1 / 40)])
        energy = -weights @ np.sqrt(((points[:, None] - points[None])**2).sum(-1)) @ weights
        a = rng.standard_normal((40000, 4))
        a /= np.sqrt((a * a).sum(1))[:, None]
        inside = points @ a.T < 4 * rng.random(40000) - 2  # a.x is within -2 .. 2
        mean_of_one = 8 / (3 * np.pi) / 2  # E |a.z| = |z| 4 / (3 pi) for a unit vector a
        square = np.mean((weights @ inside)**2) * 4 * 2  # the offsets have density 1 / 4; each pair counts twice
        self.assertAlmostEqual(square / mean_of_one / energy, 1, delta=.03)

    def test_certificates(self):
        distance, weight = screen_bound.differences()
        self.assertAlmostEqual(weight @ distance, .7776656535, delta=1e-7)  # the box integral of Bailey, Borwein & Crandall
        for t in (.1, 1, 5, 9):
            self.assertAlmostEqual(float(screen_bound.f(np.array([t]))[0]), bessel(t), delta=1e-9)
            near = np.linspace(0, 2, 9)
            self.assertAlmostEqual(float(screen_bound.mean_of(t)), float(weight @ screen_bound.f(t * distance)), delta=1e-9)
            self.assertTrue(np.all(abs(screen_bound.f(t * near)) <= 1))
        for n, least in ((1, .423), (4, .345)):
            share = screen_bound.gaussian_share() / n
            self.assertGreater(screen_bound.ratio(screen_bound.CERTIFICATES[n], share), least)
            self.assertLess(screen_bound.ratio(screen_bound.CERTIFICATES[5 - n], share), least)  # each is for its own number
        with self.assertRaises(ValueError):
            screen_bound.ratio([(1, -1)], .1)

    def test_measured_errors(self):
        filtered, plain = screen_bound.measured("random", 2, 3, 24)
        self.assertAlmostEqual(filtered, 1, delta=.1)
        self.assertAlmostEqual(plain, 1, delta=.05)
        filtered, plain = screen_bound.measured("ranking-keys:width=32,dims=4", 1, 2, 32)
        self.assertGreater(filtered, .423)
        self.assertLess(filtered, .8)
        self.assertAlmostEqual(plain, 1, delta=1e-9)

    def test_masks_are_above_it(self):
        mask = koksma.mask("gaussian:sigma=1.5", (32, 32), space="vector4", swaps=500)
        quality = koksma.mask_quality(mask, "gaussian:sigma=1.5", space="vector4")
        self.assertGreater(quality.error / quality.white, .423)
        self.assertLess(quality.error / quality.white, .6)


if __name__ == "__main__":
    unittest.main()

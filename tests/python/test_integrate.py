#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""koksma.integrate against the program KOKSMA (in the environment), closed forms, and scipy's quadrature of the
definitions."""
import json
import math
import os
import subprocess
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

import numpy as np

import koksma

SCRAMBLED = "sobol:scramble=owen"


def rows(*arguments):
    output = subprocess.run([os.environ["KOKSMA"], "integrate", *arguments, "--json", "-q"], check=True, capture_output=True,
                            text=True).stdout
    return [json.loads(line) for line in output.splitlines()]


class Integrate(unittest.TestCase):
    def test_same_numbers_as_the_program(self):
        said = rows("genz-gaussian:difficulty=3", "-p", SCRAMBLED, "-n", "16,64,256", "-d", "3", "-t", "8", "-s", "5")
        ours = koksma.integrate("genz-gaussian:difficulty=3", SCRAMBLED, [16, 64, 256], 3, trials=8, seed=5)
        for i, row in enumerate(said[:3]):
            self.assertEqual([row[k] for k in ("n", "rmse", "low", "high", "approximate", "mean", "sd", "gain")],
                             [ours.sizes[i], ours.rmse[i], ours.low[i], ours.high[i], ours.approximate[i], ours.mean[i], ours.sd[i], ours.gain[i]])
        self.assertEqual([said[3][k] for k in ("slope", "standard_error", "low", "high", "approximate", "sizes")],
                         [ours.slope, ours.slope_error, ours.slope_low, ours.slope_high, ours.slope_approximate, ours.slope_sizes])
        self.assertTrue(all(ours.approximate))  # of 8 sets
        self.assertFalse(any(koksma.integrate("x", "random", 16, trials=64).approximate))
        self.assertIn("genz-gaussian:difficulty=3", repr(ours))

    def test_callables_are_integrands(self):
        known = koksma.integrand("quarter-gaussian")
        ours = koksma.integrate(lambda x: np.exp(-(x**2).sum(axis=1)), SCRAMBLED, [16, 64, 256], trials=6,
                                integral=known.value, variance=known.variance)
        table = koksma.integrate("quarter-gaussian", SCRAMBLED, [16, 64, 256], trials=6)
        np.testing.assert_allclose(ours.rmse, table.rmse, rtol=1e-9)
        self.assertAlmostEqual(ours.slope, table.slope, places=9)
        unknown = koksma.integrate(lambda x: x[:, 0], "random", 64, trials=10)
        self.assertAlmostEqual(unknown.rmse[0], unknown.sd[0], places=15)
        self.assertTrue(math.isnan(unknown.integral))
        self.assertEqual(koksma.integrate(lambda x: x[:, 0], "hammersley", 16, integral=0.5).trials, 1)

    def test_sets_that_are_equal_by_chance(self):
        """mirror=1 gives two seeds of four the same points, or one of two: the others still count."""
        for pattern in ("halton:mirror=1", "hammersley:mirror=1", "hammersley:axes=1", "latin-hypercube"):
            for n in (21, [16, 64, 256]):
                ours = koksma.integrate(lambda x: x[:, 0] * x[:, 1] ** 2, pattern, n, trials=8, integral=1 / 6)
                sizes = [n] if isinstance(n, int) else n
                by_hand = [np.sqrt(np.mean([(np.mean(p[:, 0] * p[:, 1] ** 2) - 1 / 6) ** 2 for p in
                                            (koksma.generate(pattern, k, seed=t) for t in range(8))])) for k in sizes]
                self.assertEqual(ours.trials, 8)
                np.testing.assert_allclose(ours.rmse, by_hand, rtol=1e-9)
        self.assertEqual(koksma.integrate("genz-corner-peak", "hammersley:axes=1", 64, trials=16).trials, 16)
        for pattern in ("hammersley", "regular", "void-and-cluster"):
            one = all((koksma.generate(pattern, 16, seed=t) == koksma.generate(pattern, 16)).all() for t in range(8))
            self.assertEqual(koksma.integrate(lambda x: x[:, 0], pattern, 16, trials=8).trials, 1 if one else 8)

    def test_points(self):
        """One set: the mean of the program over a file, and of a callable."""
        points = koksma.generate(SCRAMBLED, 32, 3, seed=4)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "points.npy")
            koksma.write(path, points)
            said = rows("genz-gaussian", path)[0]
        for given in (points, points.tolist(), np.asfortranarray(points)):
            ours = koksma.integrate("genz-gaussian", given)
            self.assertEqual([said[k] for k in ("n", "dim", "trials", "rmse", "mean", "gain")],
                             [ours.sizes[0], ours.dim, ours.trials, ours.rmse[0], ours.mean[0], ours.gain[0]])
            self.assertTrue(math.isnan(ours.low[0]) and math.isnan(ours.sd[0]) and math.isnan(ours.slope))
        ours = koksma.integrate(lambda x: x[:, 2]**2, points, integral=1/3)
        self.assertAlmostEqual(ours.rmse[0], abs(np.mean(points[:, 2]**2) - 1/3), places=15)
        self.assertEqual(repr(ours), f"Integration('<lambda>', 'points', n=32: rmse {ours.rmse[0]:.3g})")
        one = koksma.integrate(lambda x: x[:, 0], "regular", 16)  # one set, an integral that nobody gave: a mean, no error
        self.assertEqual(repr(one), "Integration('<lambda>', 'regular', n=16: mean 0.5; its error takes integral=, or a pattern that depends on the seed)")
        for wrong, named in (((points, 32), "^n must be None"), ((points + 1,), "outside"), ((points[0],), "^points must be")):
            with self.assertRaisesRegex(koksma.ArgumentError, named):
                koksma.integrate("genz-gaussian", *wrong)
        with self.assertRaisesRegex(TypeError, "^n must be the number"):
            koksma.integrate("genz-gaussian", "random")

    def test_wrong_arguments(self):
        for wrong in (lambda: koksma.integrate("dsik", "random", 4), lambda: koksma.integrate("disk", "random", 4, dim=1),
                      lambda: koksma.integrate("disk", "random", []), lambda: koksma.integrate("disk", "random", 0),
                      lambda: koksma.integrate(lambda x: x, "random", 4),  lambda: koksma.integrate("disk", "random", 4, trials=0)):
            with self.assertRaises(koksma.Error):
                wrong()
        with self.assertRaises(ZeroDivisionError):
            koksma.integrate(lambda x: 1 // 0, "random", 4)
        huge = koksma.integrate(lambda x: np.full(len(x), 1e308), "random", 16, trials=2)
        np.testing.assert_allclose(huge.mean, 1e308)
        both = koksma.integrate(lambda x: np.where(x[:, 0] < 0.5, np.inf, -np.inf), "jittered", 16, trials=2)
        self.assertTrue(math.isnan(both.rmse[0]))
        self.assertEqual([m.name for m in koksma.integrands()][:2], ["x", "x2"])

    def test_values_that_are_no_real_numbers(self):
        """NumPy would drop the imaginary part, read texts as numbers and count masked values."""
        for wrong in (lambda x: x[:, 0] * 1j, lambda x: x[:, 0].astype(str), lambda x: np.ma.masked_less(x[:, 0], 0.6),
                      lambda x: [None] * len(x), lambda x: np.array([1j] * len(x), dtype=object), lambda x: x[:, 0].astype("datetime64[s]")):
            with self.assertRaisesRegex(TypeError, "^the values of the function <lambda> must be (real )?numbers, "):
                koksma.integrate(wrong, "sobol", 4)
        for right in (lambda x: x[:, 0] < 0.5, lambda x: [Fraction(1, 2)] * len(x), lambda x: x[:, 0].astype(np.float32)):
            self.assertAlmostEqual(koksma.integrate(right, "sobol", 256).mean[0], 0.5, places=2)
        for wrong in (1j, np.complex128(1j), np.complex128(0.5), np.array(1j), "0.5", True, None):
            for name in ("integral", "variance"):
                with self.assertRaisesRegex(TypeError, f"^{name} must be a number, not "):
                    koksma.integrate(lambda x: x[:, 0], "sobol", 4, **{name: wrong})
        for given in ({"integral": math.inf}, {"integral": -math.inf}, {"variance": math.inf}, {"variance": -1}, {"variance": -5e-324}):
            with self.assertRaisesRegex(koksma.ArgumentError, f"^{[*given][0]} must be a finite number"):
                koksma.integrate(lambda x: x[:, 0], "sobol", 4, **given)
        self.assertTrue(math.isnan(koksma.integrate(lambda x: x[:, 0], "jittered", 4, integral=math.nan, variance=0).integral))
        with self.assertRaisesRegex(TypeError, "^weights must be real numbers, not complex128"):
            koksma.optimise("l2-star", 4, 3, projections="pairs", weights=[1j, 1, 1], steps=1)


class Tolerance(unittest.TestCase):
    def test_same_numbers_as_the_program(self):
        output = subprocess.run([os.environ["KOKSMA"], "integrate", "genz-continuous", "-d", "3", "--tolerance", "1e-3", "--relative", "--seed",
                                 "5", "--json", "-q"], check=True, capture_output=True, text=True).stdout
        said = [json.loads(line) for line in output.splitlines()]
        ours = koksma.integrate("genz-continuous", 3, tolerance=1e-3, relative=True, seed=5)
        for row, step in zip(said, ours.path):
            self.assertEqual([row[k] for k in ("n", "points", "estimate", "low", "high", "error", "confidence", "estimator", "interval")],
                             [step.n, step.points, step.value, step.low, step.high, step.error, step.confidence, step.estimator, step.interval])
        self.assertEqual(len(said), len(ours.path) + 1)
        self.assertEqual((said[-1]["reached"], said[-1]["estimate"], said[-1]["rate"]), (True, float(ours), ours.rate))

    def test_domains(self):
        """The integral of x^2 over [-1, 2] x [0, 1/2] is 3/2; the mean of r^2 over the disk 1/2; of z over the hemisphere 1/2."""
        box = koksma.integrate(lambda x: x[:, 0] ** 2, tolerance=1e-6, bounds=[(-1, 2), (0, .5)])
        self.assertLessEqual(abs(float(box) - 1.5), 1e-6)
        disk = koksma.integrate(lambda x: (x ** 2).sum(axis=1), tolerance=1e-4, warp="concentric-disk")
        self.assertLessEqual(abs(float(disk) - .5), 1e-4)
        up = koksma.integrate(lambda x: x[:, 2] * 2 * x[:, 3], 3, tolerance=1e-4, warp="hemisphere")
        self.assertLessEqual(abs(float(up) - .5), 1e-4)

    def test_intervals(self):
        for interval in koksma.intervals():
            found = koksma.integrate(lambda x: x[:, 0] * x[:, 1], "sobol:scramble=owen", 1024, tolerance=0, interval=interval.name,
                                     value_range=(0, 1) if interval.bounded else None)
            self.assertEqual((len(found.path), found.points), (1, 15 * 1024))
            self.assertTrue(found.low <= .25 <= found.high, interval.name)
            self.assertEqual(found.path[0].interval == interval.name, interval.name != "auto")

    def test_limit(self):
        found = koksma.integrate(lambda x: x[:, 0] < x[:, 1] ** 2, "random", tolerance=1e-5, max_points=10**5)
        self.assertFalse(found.reached)
        self.assertIn("not reached", repr(found))
        self.assertGreater(found.needed, 1e6)

    def test_resume(self):
        """A search that its function or its limit ended continues to the same result."""
        calls = []

        def f(x):
            calls.append(len(x))
            if len(calls) == 6:
                raise KeyboardInterrupt
            return np.abs(x[:, 0] - .3) * x[:, 1]

        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "search.txt"
            with self.assertRaises(KeyboardInterrupt):
                koksma.integrate(f, 3, tolerance=1e-5, seed=2, resume=path)
            done = sum(calls[1:5])
            found = koksma.integrate(f, 3, tolerance=1e-5, seed=2, resume=path)
            self.assertEqual(found, koksma.integrate(f, 3, tolerance=1e-5, seed=2))
            self.assertEqual((found.parts, found.replicates, found.path[3].points), (True, 8, done))
            with self.assertRaisesRegex(koksma.ArgumentError, "first value"):
                koksma.integrate(f, 3, tolerance=1e-5, seed=2, resume=path, bounds=[(1, 2)] * 3)

    def test_errors_of_the_function_come_out(self):
        class Own(Exception):
            pass

        def bad(_x):
            raise Own("mine")

        with self.assertRaisesRegex(Own, "mine"):
            koksma.integrate(bad, 3, tolerance=1e-3)
        for wrong, text in ((dict(tolerance=-1), "tolerance"), (dict(tolerance=0), "with n"), (dict(tolerance=1, estimator="medan"), "median"),
                            (dict(tolerance=1, interval="betting"), "bounds"), (dict(tolerance=1, bounds=[(0, 1)]), "2 pairs"),
                            (dict(tolerance=1, trials=3), "replicates"), (dict(tolerance=1, replicates=1), "replicates"),
                            (dict(tolerance=1, pattern="sobol"), "one set"), (dict(tolerance=1, confidence=1), "confidence"),
                            (dict(tolerance=1, value_range=(0, .1)), "outside")):
            with self.assertRaisesRegex(koksma.ArgumentError, text):
                koksma.integrate(lambda x: x[:, 0], **wrong)
        with self.assertRaises(TypeError):
            koksma.integrate(lambda x: x[:, 0], "random", 4, estimator="mean")
        with self.assertRaisesRegex(koksma.ArgumentError, r"shape \(576, 2\) it returned"):
            koksma.integrate(lambda x: x, tolerance=1)


if __name__ == "__main__":
    unittest.main()

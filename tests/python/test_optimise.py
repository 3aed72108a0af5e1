#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""koksma.optimise against the program KOKSMA (in the environment)."""
import json
import os
import subprocess
import tempfile
import unittest

import numpy as np

import koksma


class Optimise(unittest.TestCase):
    def test_same_set_as_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "o.npy")
            row = json.loads(subprocess.run(
                [os.environ["KOKSMA"], "optimise", "l2-star", "-n", "8", "--steps", "2", "-s", "3", "-o", path, "--json"],
                check=True, capture_output=True, text=True).stdout)
            best = koksma.optimise("l2-star", 8, steps=2, seed=3)
            np.testing.assert_array_equal(best.points, np.load(path))
            self.assertEqual((best.value, best.steps, best.last_gain, best.method),
                             (row["value"], row["steps"], row["last_gain"], row["method"]))

    def test_progress_goes_on_and_stops(self):
        seen = []
        best = koksma.optimise("star", 6, progress=lambda o: seen.append(o.value) or o.steps < 2)
        self.assertEqual((best.steps, len(seen)), (2, 3))
        self.assertEqual(seen, sorted(seen, reverse=True))
        del seen[:]
        koksma.optimise("star", 6, steps=3, progress=lambda o: seen.append(o.value) or np.float64(o.value) < 0)
        self.assertEqual(len(seen), 1)
        again = koksma.optimise("star", start=best.points, steps=1, seed=1)
        self.assertNotEqual(again, best)  # which is no question of arrays
        with self.assertRaisesRegex(koksma.ArgumentError, "dim = 3, but the points of start have 2"):
            koksma.optimise("star", dim=3, start=best.points, steps=1)
        self.assertLessEqual(again.value, best.value)
        self.assertEqual(again.value, float(koksma.measure(again.points, "star")))

    def test_named_targets(self):
        for target in ("step", "gaussian", "latin-hypercube"):
            with self.subTest(target=target), tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "p.npy")
                subprocess.run([os.environ["KOKSMA"], "optimise", "--power", target, "-n", "14", "--steps", "1", "-o", path, "-q"],
                               check=True, capture_output=True)
                power = koksma.radial_power(target, 14)
                self.assertEqual(power.shape, (8,))
                np.testing.assert_array_equal(koksma.optimise(None, 14, power=target, steps=1).points, np.load(path))
                np.testing.assert_array_equal(koksma.optimise(None, 14, power=list(power), steps=1).points, np.load(path))
        rings = np.arange(1, 6)
        np.testing.assert_array_equal(koksma.radial_power("step", 16, 5), rings > np.sqrt(16 / np.pi))
        np.testing.assert_allclose(koksma.radial_power("gaussian", 16, 5), 1 - np.exp(-np.pi * rings**2 / 16), rtol=1e-14)
        mean = np.mean([koksma.spectrum(koksma.generate("jittered", 16, seed=seed), 5, exact=True).ring_power for seed in range(16)], axis=0)
        np.testing.assert_allclose(koksma.radial_power("jittered", 16, 5), mean, rtol=1e-9)
        for wrong in (("stepp", 16), ("step", 0), ("step", 16, 0), ("step", 16, 2.5)):
            with self.subTest(wrong=wrong), self.assertRaises((koksma.Error, TypeError)):
                koksma.radial_power(*wrong)
        for wrong in ([[1.0, 1.0]], [], [-1.0], "stepp"):
            with self.subTest(wrong=wrong), self.assertRaises(koksma.Error):
                koksma.optimise(None, 16, power=wrong, steps=1)

    def test_errors(self):
        with self.assertRaises(koksma.ArgumentError):
            koksma.optimise("l2-star", 8, projections=[(0,), (1,)], weights=[1], steps=1)
        with self.assertRaises(koksma.ArgumentError):
            koksma.optimise("l2-star", 8, projections=[(5,)], steps=1)
        for arguments in ({"keep": "all", "n": 4, "steps": 1}, {"steps": 1}, {"n": 4}, {"n": 0, "steps": 1}):
            with self.assertRaises(koksma.ArgumentError):
                koksma.optimise("star", **arguments)
        with self.assertRaises(ZeroDivisionError):
            koksma.optimise("star", 4, progress=lambda o: 1 / 0)


if __name__ == "__main__":
    unittest.main()

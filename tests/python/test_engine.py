#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The engine keeps what scipy tests of its own engines, for every pattern that serves any n; and without scipy it has
the same interface."""
import os
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

import koksma
from koksma import Engine, _engine

SEQUENCES = ["random", "sobol", "sobol:scramble=owen", "halton", "r-sequence"]
SETS = ["n-rooks", "latin-hypercube"]
WITHOUT_SCIPY = sys.modules.get("scipy", sys) is None  # the second run, which WithoutScipy starts


class OnUse(unittest.TestCase):
    """scipy takes most of a second to import: koksma imports it when Engine is used first."""

    def fresh(self, code):
        return subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout.split()

    def test_import_leaves_scipy_alone(self):
        loaded = "print([m for m in sys.modules if m.split('.')[0] == 'scipy'])"
        self.assertEqual(self.fresh(f"import sys, koksma; 'Engine' in dir(koksma); {loaded}"), ["[]"])
        self.assertEqual(self.fresh("import koksma; print('Engine' in dir(koksma), 'Engine' in koksma.__all__, hasattr(koksma, 'Engin'))"),
                         ["True", "True", "False"])

    def test_all_ways_to_it_are_one_class(self):
        code = ("import koksma; from koksma import *; from koksma import Engine as E; import koksma._engine as e, pickle; "
                "print(Engine is E is koksma.Engine is e.Engine is type(pickle.loads(pickle.dumps(E('sobol', 2, seed=1)))))")
        self.assertEqual(self.fresh(code), ["True"])

    @unittest.skipIf(WITHOUT_SCIPY, "of scipy's class")
    def test_it_is_one_of_scipys(self):
        try:
            from scipy.stats.qmc import QMCEngine
        except ImportError:
            self.skipTest("scipy is not installed")
        self.assertIsInstance(Engine("sobol", 2), QMCEngine)


class Engines(unittest.TestCase):

    def each(self, specs):
        for spec in specs:
            for seed in (12, np.random.default_rng(5), np.random.RandomState(5), None):
                with self.subTest(spec=spec, seed=seed):
                    yield spec, Engine(spec, 2, seed=seed)

    def test_sample(self):
        for spec in SEQUENCES + SETS:
            with self.subTest(spec=spec):
                engine = Engine(spec, 2, seed=12)
                sample = engine.random(8)
                self.assertEqual(sample.shape, (8, 2))
                self.assertTrue(((sample >= 0) & (sample < 1)).all())
                np.testing.assert_array_equal(sample, koksma.generate(spec, 8, 2, 12))

    def test_continuing(self):
        for _spec, engine in self.each(SEQUENCES):
            whole = engine.random(16)
            engine.reset()
            parts = np.concatenate([engine.random(8), engine.random(), engine.random(7)])
            np.testing.assert_array_equal(parts, whole)
            self.assertEqual(engine.num_generated, 16)

    def test_deterministic_sets_are_one_set(self):
        for spec in ("regular", "hammersley", "korobov"):
            with self.subTest(spec=spec):
                engine = Engine(spec, 2, seed=12)
                np.testing.assert_array_equal(engine.random(16), engine.random(16))
                np.testing.assert_array_equal(engine.random(16), Engine(spec, 2, seed=13).random(16))
                shifted = Engine(spec + ":shift=1", 2, seed=12)
                self.assertFalse((shifted.random(16) == shifted.random(16)).any())

    def test_optimization_by_any_measure(self):
        plain = Engine("n-rooks", 3, seed=5).random(6)
        measures = ("l2-centered", "l2-star", "star", "min-distance:torus=1", "l2-disk")
        for measure in measures[2:3] if WITHOUT_SCIPY else measures:
            dim = 2 if measure.startswith(("min", "l2-disk")) else 3
            with self.subTest(measure=measure):
                before = Engine("n-rooks", dim, seed=5).random(6)
                engine = Engine("n-rooks", dim, seed=5, optimization=measure)
                after = engine.random(6)
                np.testing.assert_array_equal(np.sort(after, axis=0), np.sort(before, axis=0))  # Latin is kept
                better = koksma.measure(after, measure).value - koksma.measure(before, measure).value
                self.assertTrue(better > 0 if measure.startswith("min") else better < 0)
                self.assertFalse(np.array_equal(np.sort(engine.random(6), axis=0), np.sort(after, axis=0)))
                np.testing.assert_array_equal(engine.reset().random(6, workers=2), after)
        np.testing.assert_array_equal(Engine("n-rooks", 3, seed=5, optimization=None).random(6), plain)
        for wrong in ("no-such", "edge-sampled", "l2-star:x=1"):
            with self.assertRaises(koksma.ArgumentError if wrong != "no-such" else koksma.Error):
                Engine("n-rooks", 2, optimization=wrong)

    def test_optimization_by_scipys_names(self):
        for name in ("random-cd", "lloyd"):
            try:
                from scipy.stats import qmc
            except ImportError:
                with self.assertRaises(ValueError):
                    Engine("n-rooks", 2, seed=1, optimization=name)
                continue
            np.testing.assert_array_equal(Engine("n-rooks", 2, seed=1, optimization=name).random(8).shape, (8, 2))
            ours, theirs = Engine("n-rooks", 2, seed=1, optimization=name), qmc.LatinHypercube(2, optimization=name)
            self.assertEqual(ours.optimization_method.func, theirs.optimization_method.func)

    def test_reset(self):
        for _spec, engine in self.each(SEQUENCES + SETS):
            first = engine.random(8)
            engine.reset()
            self.assertEqual(engine.num_generated, 0)
            np.testing.assert_array_equal(engine.random(8), first)

    def test_fast_forward(self):
        for spec, engine in self.each(SEQUENCES + SETS):
            engine.random(4)
            later = engine.random(4)
            engine.reset()
            np.testing.assert_array_equal(engine.fast_forward(4).random(4), later)
            if spec in SEQUENCES:
                engine.reset()
                whole = engine.random(8)
                engine.reset()
                for i in range(8):
                    if i % 2:
                        engine.fast_forward(1)
                    else:
                        np.testing.assert_array_equal(engine.random()[0], whole[i])

    def test_integers(self):
        engine = Engine("random", 2, seed=1)
        drawn = engine.integers(3, u_bounds=6, n=100)
        self.assertEqual(drawn.dtype, np.int64)
        self.assertEqual(set(drawn.ravel()), {3, 4, 5})
        self.assertEqual(set(engine.integers(2, n=100, endpoint=True).ravel()), {0, 1, 2})
        with self.assertRaises(ValueError):
            engine.integers(0.5)
        with self.assertRaises(ValueError):
            engine.integers([6, 2], u_bounds=[3, 5])

    def test_odd_shapes(self):
        self.assertEqual(Engine("random", 0).random(4).shape, (4, 0))
        self.assertEqual(Engine("random", 3).random(0).shape, (0, 3))
        self.assertEqual(Engine("random", 1, seed=1).random(5).shape, (5, 1))
        for bad in (-1, 1.5, "2"):
            with self.assertRaises((ValueError, TypeError)):
                Engine("random", bad)
        with self.assertRaises(koksma.ArgumentError):
            Engine("no-such")

    def test_distribution(self):
        for spec in ["sobol:scramble=owen", "halton:scramble=owen", "n-rooks", "random"]:
            for dim in (1, 2, 5):
                with self.subTest(spec=spec, dim=dim):
                    sample = Engine(spec, dim, seed=3).random(1024)
                    close = 0.05 if spec == "random" else 1e-2
                    np.testing.assert_allclose(sample.mean(axis=0), 0.5, atol=close)
                    np.testing.assert_allclose(np.percentile(sample, 25, axis=0), 0.25, atol=close)
                    np.testing.assert_allclose(np.percentile(sample, 75, axis=0), 0.75, atol=close)

    def test_n_may_be_any_whole_number(self):
        for n in (1, np.int64(3), np.uint8(5)):
            self.assertEqual(Engine("halton", 2).random(n).shape, (int(n), 2))
        for bad in (-1, 2.5, "3"):
            with self.assertRaises((ValueError, TypeError)):
                Engine("halton", 2).random(bad)

    def test_numbers_out_of_range(self):
        for spec in ("sobol", "n-rooks"):
            engine = Engine(spec, 2, seed=1)
            engine.random(8)
            for call, line in ((lambda: engine.fast_forward(-5), "n must be 0 to"),
                               (lambda: engine.random(-3), "n must be 0 to"),
                               (lambda: engine.random(3, workers=0), "workers must be a number of threads"),
                               (lambda: engine.random(3, workers=-2), "workers must be -1 to"),
                               (lambda: engine.random(0, workers=(1 << 32) + 1), "workers must be -1 to")):
                with self.subTest(line), self.assertRaisesRegex(koksma.ArgumentError, "^" + line):
                    call()
            for call in (engine.fast_forward, engine.random):
                with self.assertRaises(TypeError):
                    call(1.5)
            self.assertEqual(engine.num_generated, 8)
            self.assertEqual(engine.random(3, workers=-1).shape, (3, 2))
        with self.assertRaises(koksma.ArgumentError):
            Engine("random", 0).random(-3)

    def test_sequences_that_end(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "hundred.txt")
            points = koksma.generate("random", 100, seed=5)
            koksma.write(path, points)
            engine = Engine("file:" + path)
            np.testing.assert_array_equal(np.concatenate([engine.random(40), engine.random(60)]), points)
            with self.assertRaisesRegex(koksma.ArgumentError, "101"):
                engine.random()
            self.assertEqual(engine.num_generated, 100)
            np.testing.assert_array_equal(Engine("file:" + path).fast_forward(60).random(40), points[60:])
            engine = Engine("file:" + path)
            with mock.patch.object(_engine, "generate", side_effect=koksma.generate) as served:
                np.testing.assert_array_equal(np.concatenate([engine.random() for _ in range(100)]), points)
            self.assertLess(served.call_count, 30)
        engine = Engine("void-and-cluster", seed=1)
        np.testing.assert_array_equal(np.concatenate([engine.random(1500), engine.random(1500)]),
                                      koksma.generate("void-and-cluster", 3000, seed=1))

    def test_rng_is_seed(self):
        np.testing.assert_array_equal(Engine("random", rng=3).random(8), Engine("random", seed=3).random(8))
        np.testing.assert_array_equal(Engine("random", rng=np.random.default_rng(3)).random(8),
                                      Engine("random", seed=np.random.default_rng(3)).random(8))
        with self.assertRaises(TypeError):
            Engine("random", seed=3, rng=3)

    def test_quadrature_of_scipys(self):
        try:
            from scipy.integrate import qmc_quad
        except ImportError:
            self.skipTest("scipy is not installed, or older than 1.11")
        for spec in ("sobol:scramble=owen", "n-rooks", "random"):
            result = qmc_quad(lambda x: x[0] * x[1], [0, 0], [1, 1], n_points=1024, qrng=Engine(spec, 2, seed=3))
            self.assertGreater(result.standard_error, 0)  # the estimates are independent
            self.assertLess(abs(result.integral - 0.25), 6 * result.standard_error)

    def test_sobol_indices_of_scipys(self):
        """scipy draws the points of sobol_indices itself, by its own Sobol'; with points of ours it takes the function's values
        at A, B and A with a column of B. Exact indices of Ishigami's function: Homma & Saltelli 1996."""
        try:
            from scipy.stats import sobol_indices
        except ImportError:
            self.skipTest("scipy is not installed, or older than 1.11")

        def ishigami(x):
            return np.sin(x[0]) + 7 * np.sin(x[1])**2 + 0.1 * x[2]**4 * np.sin(x[0])

        for spec in ("sobol:scramble=owen", "halton:scramble=owen"):
            a, b = np.split(2 * np.pi * Engine(spec, 6, rng=1).random(4096).T - np.pi, 2)
            mixed = [np.where(np.arange(3)[:, None] == k, b, a) for k in range(3)]
            values = {"f_A": ishigami(a)[None], "f_B": ishigami(b)[None], "f_AB": np.stack([ishigami(m)[None] for m in mixed])}
            found = sobol_indices(func=values, n=4096)
            np.testing.assert_allclose(found.first_order, [0.3139, 0.4424, 0], atol=0.02)
            np.testing.assert_allclose(found.total_order, [0.5576, 0.4424, 0.2437], atol=0.02)

    def test_distributions_of_scipys(self):
        """What draws from an engine of the caller's: means, covariances and counts are those of the distributions."""
        try:
            from scipy.stats import norm, qmc
        except ImportError:
            self.skipTest("scipy is not installed")
        cov = np.array([[2, 0.5], [0.5, 1]])
        for spec in ("sobol:scramble=owen", "halton:scramble=owen", "n-rooks", "random"):
            for inverse in (True, False):  # by the inverse of the distribution, or Box and Muller's
                with self.subTest(spec=spec, inverse=inverse):
                    law = qmc.MultivariateNormalQMC(mean=[1, -2], cov=cov, engine=Engine(spec, 2, seed=5), inv_transform=inverse)
                    sample = law.random(4096)
                    self.assertLess(np.abs(sample.mean(axis=0) - [1, -2]).max(), 6 * np.sqrt(2 / 4096))
                    self.assertLess(np.abs(np.cov(sample.T) - cov).max(), 6 * 2 * np.sqrt(2 / 4096))
            chances = np.array([0.2, 0.3, 0.5])
            counts = qmc.MultinomialQMC(chances, n_trials=1000, engine=Engine(spec, 1, seed=5)).random(3)
            np.testing.assert_array_equal(counts.sum(axis=1), 1000)
            self.assertLess(np.abs(counts - 1000 * chances).max(), 6 * np.sqrt(250) if spec == "random" else 3)
        try:
            from scipy.stats.sampling import FastGeneratorInversion
        except ImportError:
            return  # scipy is older than 1.12
        sample = FastGeneratorInversion(norm()).qrvs(256, d=2, qmc_engine=Engine("sobol:scramble=owen", 2, seed=5))
        self.assertEqual(sample.shape, (256, 2))
        self.assertLess(np.abs(sample.std(axis=0) - 1).max(), 0.02)


class WithoutScipy(unittest.TestCase):
    def test_same_tests(self):
        if WITHOUT_SCIPY:
            self.skipTest("this is the run without scipy")
        code = f"import sys; sys.modules['scipy'] = None; sys.argv = [{__file__!r}]; exec(open({__file__!r}).read())"
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)


class ByScipysNames(unittest.TestCase):
    def test_seed_sequence(self):
        for name in ("seed", "rng"):
            one, other = (Engine("random", 2, **{name: np.random.SeedSequence(4)}) for _ in range(2))
            np.testing.assert_array_equal(one.random(8), other.random(8))
        same = Engine("random", 2, rng=np.random.default_rng(np.random.SeedSequence(4)))
        np.testing.assert_array_equal(same.random(8), one.reset().random(8))

    def test_what_default_rng_takes(self):
        for make in (lambda: np.random.PCG64(3), lambda: [1, 2, 3], lambda: np.array([7, 8]), lambda: (4,)):
            ours, numpys = Engine("random", 2, rng=make()), np.random.default_rng(make())
            np.testing.assert_array_equal(ours.random(4), Engine("random", 2, rng=numpys).random(4))
        for wrong in ("seven", 2.5, {}):
            with self.assertRaises((TypeError, ValueError)):
                Engine("random", 2, rng=wrong)

    def test_random_base2(self):
        engine = Engine("sobol", 2)
        np.testing.assert_array_equal(engine.random_base2(3), koksma.generate("sobol", 8))
        np.testing.assert_array_equal(engine.random_base2(3), koksma.generate("sobol", 16)[8:])
        with self.assertRaisesRegex(ValueError, "20 points, not a power of two"):
            engine.random_base2(2)
        self.assertEqual(engine.num_generated, 16)
        sets = Engine("n-rooks", 2, seed=1)
        self.assertEqual([sets.random_base2(3).shape, sets.random_base2(2).shape], [(8, 2), (4, 2)])
        for wrong in (-1, 29):
            self.assertRaises(koksma.ArgumentError, engine.random_base2, wrong)

    def test_repr(self):
        engine = Engine("sobol:scramble=owen", 3)
        engine.random(4)
        self.assertEqual(repr(engine), "Engine('sobol:scramble=owen', d=3, num_generated=4)")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])

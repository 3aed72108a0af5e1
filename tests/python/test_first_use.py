#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What users of NumPy, SciPy and pandas type first: values that are floats, their names of arguments and of measures, frames, short
texts of results, signatures, and answers to names that the package lacks."""
import copy
import inspect
import itertools
import math
import os
import pickle
import subprocess
import sys
import types
import typing
import unittest

import numpy as np

import koksma

POINTS = koksma.generate("random", 16, seed=3)


def of_scipy(x, method):
    """Discrepancies as scipy.stats.qmc.discrepancy defines them, by Hickernell (1998) and Zhou, Fang & Ning (2013)."""
    n, d = x.shape
    z, a, b = np.abs(x - 0.5), x[:, None, :], x[None, :, :]
    za, zb, apart = z[:, None, :], z[None, :, :], np.abs(a - b)
    if method == "CD":
        one, two = (1 + z / 2 - z**2 / 2).prod(1).sum(), (1 + za / 2 + zb / 2 - apart / 2).prod(2).sum()
        return (13 / 12)**d - 2 / n * one + two / n**2
    if method == "WD":
        return (1.5 - apart * (1 - apart)).prod(2).sum() / n**2 - (4 / 3)**d
    if method == "MD":
        one = (5 / 3 - z / 4 - z**2 / 4).prod(1).sum()
        return (19 / 12)**d - 2 / n * one + (15 / 8 - za / 4 - zb / 4 - 0.75 * apart + apart**2 / 2).prod(2).sum() / n**2
    return math.sqrt(3.0**-d - 2.0**(1 - d) / n * (1 - x**2).prod(1).sum() + (1 - np.maximum(a, b)).prod(2).sum() / n**2)


class Values(unittest.TestCase):
    def test_a_value_is_a_float(self):
        v, w = koksma.measure(POINTS), koksma.measure(POINTS, "l2-star")
        x, y = v.value, w.value
        self.assertIs(type(x), float)
        self.assertEqual((v, v < 0.9, v > w, v == x, hash(v)), (x, x < 0.9, x > y, True, hash(x)))
        self.assertEqual((f"{v:.3f}", f"{v}", "%.2g" % v, round(v, 3), str(v)), (f"{x:.3f}", f"{x}", "%.2g" % x, round(x, 3), str(x)))
        self.assertEqual((v + 1, 2 * v, v - w, -v, math.sqrt(v), v**2), (x + 1, 2 * x, x - y, -x, math.sqrt(x), x**2))
        self.assertEqual((min([v, w]), sorted([v, w])[1], sum([v, w])), (min(x, y), max(x, y), x + y))
        self.assertEqual(np.array([v, w]).dtype, np.float64)

    def test_lists_and_arrays_of_any_layout_are_the_same_points(self):
        points = koksma.generate("halton", 256)
        wide = np.random.default_rng(1).random((256, 5))
        wide[:, 1:3] = points
        for function in (koksma.identify, koksma.verify, koksma.measure):
            said = repr(function(points))
            for other in (points.tolist(), np.asfortranarray(points), wide[:, 1:3], points[::-1][::-1], points.astype(object)):
                self.assertEqual(repr(function(other)), said)

    def test_members_complete_and_are_read_only(self):
        v = koksma.measure(POINTS)
        self.assertLessEqual({"value", "square", "lower", "upper", "standard_error", "exact", "witness"}, set(dir(v)))
        with self.assertRaises(AttributeError):
            v.value = 1
        for again in (copy.deepcopy(v), copy.copy(v), pickle.loads(pickle.dumps(v))):
            self.assertEqual((again, again.exact, again.witness), (v, v.exact, v.witness))

    def test_a_witness_says_its_count_and_region(self):
        v = koksma.measure([[0.25, 0.5]])
        self.assertEqual(repr(v), "Value(0.875, 1 point in the closed box 0..0.25 x 0..0.5)")


class Vocabulary(unittest.TestCase):
    def test_a_wrong_argument_is_answered_by_the_right_one(self):
        for function, values, named, said in (
                (koksma.generate, ["sobol", 16], {"dims": 2}, "did you mean dim?"), (koksma.generate, ["sobol", 16], {"dimension": 2}, "did you mean dim?"),
                (koksma.generate, ["sobol"], {"n_samples": 16}, "did you mean n?"), (koksma.generate, ["sobol", 16], {"random_state": 1}, "did you mean seed?"),
                (koksma.generate, ["sobol", 16], {"scramble": True}, 'scramble is a part of the pattern: "NAME:scramble=owen"'),
                (koksma.generate, ["sobol", 16], {"treads": 1}, "did you mean threads?"), (koksma.measure, [POINTS], {"method": "CD"}, "did you mean measure?"),
                (koksma.rank, ["ball"], {"samples": 4}, "did you mean spp?"), (koksma.rank, ["ball"], {"timeout": 4}, "did you mean time_limit?"),
                (koksma.render, ["ball", "sobol"], {"resolution": (4, 4)}, "did you mean size?"), (koksma.Engine, ["sobol"], {"dims": 2}, "did you mean "),
                (koksma.has_ranges, ["sobol"], {"xyzzy": 2}, "it takes pattern")):
            with self.assertRaisesRegex(TypeError, "got an unexpected keyword argument '.*'; ") as caught:
                function(*values, **named)
            self.assertIn(said, str(caught.exception))
            self.assertIsNone(caught.exception.__cause__)

    def test_a_wrong_value_is_answered_by_its_remedy(self):
        points = koksma.generate("random", 16)
        for function, values, named, said in (
                (koksma.measure, [points - 0.5, "star"], {}, "x + 0.5"), (koksma.measure, [points * 512, "star"], {}, "divide by"),
                (koksma.verify, [points, "latin"], {}, "f.property"), (koksma.integrate, [lambda x: x[0] * x[1], "random", 16], {}, "x[:, 0]"),
                (koksma.integrate, [lambda x, y: x * y, "random", 16], {}, "one array"), (koksma.integrate, ["x*y", "random", 16], {}, "Python"),
                (koksma.integrate, ["disk", "random", 16], {"estimator": "mean"}, "estimator has an effect only with a tolerance"),
                (koksma.mask_quality, [np.arange(16.0).reshape(4, 4)], {}, "by 255"), (koksma.mask_quality, ["m.png"], {}, "read_mask(path)"),
                (koksma.generate, ["random", 16, 2, 3, 4], {}, "the order is generate(pattern, n, dim, seed)"),
                (koksma.generate, ["sobol,scramble=owen", 16], {}, "follow a colon"), (koksma.warp_points, [points, "disk"], {}, "concentric-disk"),
                (koksma.optimise, ["star", 8], {"method": "x"}, "chosen by the measure"), (koksma.rank, ["ball"], {"spp": [4, 16]}, "for each number"),
                (koksma.render, [{}], {}, "JSON"), (koksma.patterns, ["sobol"], {}, "lists all"), (koksma.plot_compare, [[points]], {}, "plot(a, b)"),
                (koksma.plot_compare, [["sobol", "random"]], {}, "*patterns"), (koksma.plot_compare, ["sobol", 64], {}, "n=256"),
                (koksma.plot, ["sobol", 64], {}, "generate(pattern, n)"), (koksma.plot, [points, "star"], {}, "witness='star'"),
                (koksma.plot, [points, "a.png"], {}, "save(path)"), (koksma.plot, [points[:, 0], points[:, 1]], {}, "np.column_stack((x, y))"),
                (koksma.plot, [points, 16], {}, "columns=16"), (koksma.generate, ["poisson-disk", 16], {"d": 0.1}, '"poisson-disk:d=0.1"'),
                (koksma.mask_quality, [np.linspace(-3, 3, 256).reshape(16, 16)], {}, "each equally often"),
                (koksma.render, ["ball"], {"integrator": "pathtracer"}, "did you mean 'path'?"),
                (koksma.measure, [points[:, 0]], {}, "x.reshape(-1, 2)"), (koksma.measure, [[points, points]], {}, "np.stack(sets)"),
                (koksma.measure, [points[:, 0] + 1j * points[:, 1]], {}, "z.imag"), (koksma.measure, [{"x": points[:, 0]}], {}, "column_stack(list"),
                (koksma.measure, [np.ma.masked_less(points, 0.5)], {}, "mask.any"), (koksma.measure, [points.astype(str)], {}, "astype(float)"),
                (koksma.measure, [points.view([("x", float), ("y", float)])], {}, "structured_to_unstructured"),
                (koksma.measure, [map(list, points)], {}, "np.array(list(points))"), (koksma.measure, [koksma.Engine("sobol")], {}, "engine.random(n)"),
                (koksma.measure, [points, points], {}, "np.stack(sets)"), (koksma.measure, [points, koksma.measures()[0]], {}, "its name"),
                (koksma.verify_sets, ["sobol"], {}, "range(100)"), (koksma.local_discrepancy, [[0.5, 0.5], points], {}, "(points, corner)"),
                (koksma.generate, ["sobol", 1e3], {}, "int(x)"), (koksma.generate, ["sobol", (16, 2)], {}, "generate(pattern, n, dim)"),
                (koksma.generate, [["sobol", "random"], 16], {}, "for each pattern"), (koksma.generate, ["random", 16], {"seed": [1, 2]}, "default_rng(1)"),
                (koksma.generate, ["sobol", 16], {"threads": -1}, "0 takes all"), (koksma.generate, ["sobol", 16], {"l_bounds": 0}, "qmc.scale"),
                (koksma.warp_points, ["polar-disk", points], {}, "warp_points(points, warp)"), (koksma.Engine, [2, "sobol"], {}, "Engine(pattern, d)"),
                (koksma.Engine, ["poisson-disk", 0.1], {}, "radius"), (koksma.integrate, [lambda x: x[:, 0], 0, 1], {}, "bounds=[(low, high)]"),
                (koksma.integrate, [lambda x: x[:, 0], ["sobol", "random"], 16], {}, "for each pattern"),
                (koksma.integrate, ["sobol", lambda x: x[:, 0], 16], {}, "(function, pattern, n)"),
                (koksma.integrate, [lambda x: x[:, 0], 1], {"tolerance": 0.1, "bounds": [(0, math.inf)]}, "x / (1 - x)"),
                (koksma.integrate, [lambda x: x[:, 0], 1], {"epsabs": 0.1}, "did you mean tolerance?"),
                (koksma.optimise, [points], {}, "start=points"), (koksma.convergence, ["sobol", ["star"]], {}, "for each measure"),
                (koksma.compare, [np.zeros((3, 8, 9)), np.zeros((8, 9, 3))], {}, "transpose(1, 2, 0)"),
                (koksma.write_image, ["i.png", np.zeros((8, 9, 4))], {}, "leaves out alpha"), (koksma.render, ["ball", 16], {}, "(scene, pattern, spp)"),
                (koksma.render, ["ball"], {"size": (24, 32, 3)}, "(shape[1], shape[0])"), (koksma.render, ["ball"], {"max_depth": 3}, "did you mean depth?"),
                (koksma.rank, ["ball"], {"reference": "r.exr"}, "read_image(path)"), (koksma.rank, [["sobol"], "ball"], {}, "it comes first"),
                (koksma.rank, ["ball", "sobol"], {}, "['name']"), (koksma.rank, ["ball"], {"target_error": 0.1}, "rank_to_error"),
                (koksma.rank, ["ball", ["random"], 1], {"size": (8, 6), "process": lambda x: None}, "process: an image must be"),
                (koksma.rank_to_error, ["ball", ["sobol"], 0.1], {}, "(scene, target_error, patterns)"), (koksma.mask, [(64, 64)], {}, "mask(filter, size)"),
                (koksma.mask, [], {"sigma": 1}, "gaussian:sigma=1"), (koksma.mask_quality, ["box:size=3", points], {}, "(mask, filter)"),
                (koksma.write_mask, [points, "m.png"], {}, "write_mask(path, mask)"), (koksma.datasheet, [["sobol", "random"]], {}, "beside="),
                (koksma.plot_convergence, [[1]], {}, "*results"), (koksma.trials, ["random", [16, 64]], {}, "convergence(pattern"),
                (koksma.verify, [np.stack([points, points])], {}, "points[0]"), (koksma.convergence, ["random"], {"n": [4, 8, 16]}, "did you mean sizes?"),
                (koksma.integrate, [lambda x: x[:, 0], 2], {"tolerance": 1e-9, "max_points": 100}, "are more than max_points, 100")):
            with self.assertRaises((TypeError, koksma.ArgumentError)) as caught:
                function(*values, **named)
            self.assertIn(said, str(caught.exception))
        with self.assertWarnsRegex(UserWarning, "one set, whatever the seed"):
            koksma.integrate("disk", "sobol", 16, seed=3)
        self.assertIn("not finite", repr(koksma.integrate(lambda x: x[:, 0] * np.nan, "random", 16)))
        self.assertIn("nothing to rank it against", repr(koksma.rank("ball", patterns=["random"], spp=1, size=(8, 6), max_trials=8)))

    def test_errors_of_a_users_function_stay(self):
        def helper(x, y):
            return x + y
        with self.assertRaisesRegex(TypeError, "argument: 'y'$"):
            koksma.integrate(lambda x: helper(x), "random", 4)

        def of_user(x):
            return dict(x).update(1, unexpected=int("1", bass=2))
        with self.assertRaises(TypeError) as caught:
            koksma.integrate(of_user, "sobol", 4, 2)
        self.assertNotIn("did you mean", str(caught.exception))

    def test_every_function_keeps_its_signature(self):
        for name in koksma.__all__:
            function = getattr(koksma, name)
            if isinstance(function, types.FunctionType):
                self.assertEqual(str(inspect.signature(function)), str(inspect.signature(function.__wrapped__)), name)
                self.assertTrue(function.__doc__, name)

    def test_scipys_names_give_scipys_values(self):
        # 0.008142039609053464 is the value in the documentation of scipy.stats.qmc.discrepancy.
        doc = (np.array([[1, 3], [2, 6], [3, 2], [4, 5], [5, 1], [6, 4]]) - 0.5) / 6
        self.assertAlmostEqual(koksma.measure(doc, "CD"), 0.008142039609053464, 15)
        stack = np.stack([koksma.generate("random", 16, 3, seed) for seed in range(3)])
        for method in ("CD", "WD", "MD", "L2-star"):
            stacked = koksma.measure(stack, method)
            for points, value in zip(stack, stacked):
                expected = of_scipy(points, method)
                self.assertAlmostEqual(koksma.measure(points, method), expected, 12)
                self.assertAlmostEqual(value, expected, 12)
                self.assertEqual(koksma.measure(points, [method])[method], koksma.measure(points, method))
                self.assertLessEqual(koksma.measure(points, method).lower, koksma.measure(points, method))

    def test_d_is_dim_and_rng_is_seed(self):
        same = np.testing.assert_array_equal
        same(koksma.generate("n-rooks", 8, d=3, rng=5), koksma.generate("n-rooks", 8, 3, 5))
        same(koksma.trials("jittered", 27, d=3, rng=5, trials=2).values, koksma.trials("jittered", 27, dim=3, seed=5, trials=2).values)
        same(koksma.convergence("sobol", sizes=[4, 8, 16], d=3).values, koksma.convergence("sobol", sizes=[4, 8, 16], dim=3).values)
        same(koksma.Engine("halton", dim=4).random(3), koksma.Engine("halton", 4).random(3))
        for both in ({"dim": 2, "d": 3}, {"seed": 1, "rng": 2}):
            with self.assertRaisesRegex(TypeError, "two names of one argument"):
                koksma.generate("random", 4, **both)

    def test_seeds_of_numpy(self):
        draw = lambda seed: koksma.generate("random", 8, seed=seed)  # noqa: E731
        kinds = (np.random.default_rng, np.random.RandomState, np.random.SeedSequence, np.random.PCG64)
        for kind in kinds:
            np.testing.assert_array_equal(draw(kind(7)), draw(kind(7)))
            self.assertFalse((draw(kind(7)) == draw(kind(8))).any())
        generator = np.random.default_rng(7)
        sets = [draw(generator), draw(generator), draw(None), draw(None), draw(0)]
        for a, b in itertools.combinations(sets, 2):
            self.assertFalse((a == b).any())
        self.assertNotEqual(*(koksma.trials("random", 4, trials=2, seed=None).seed for _ in range(2)))
        for bad, kind in ((1.5, TypeError), ("1", TypeError), (-1, koksma.ArgumentError), (1 << 64, koksma.ArgumentError)):
            with self.assertRaisesRegex(kind, "seed must be"):
                draw(bad)


def results():
    """A small result of each class that has a text or a frame."""
    pictures = [koksma.render("ball", "random", spp=1, size=(16, 12), seed=seed) for seed in (0, 1)]
    yield koksma.trials("random", 8, trials=4)
    yield koksma.convergence("sobol", sizes=[4, 8, 16])
    yield koksma.spectrum(POINTS, 8)
    yield koksma.pair_correlation(POINTS)
    yield koksma.compare(*pictures)
    yield koksma.integrate("exp", "random", [8, 16, 32], trials=4)
    yield koksma.integrate("exp", tolerance=0.1)
    yield koksma.rank("ball", ["random", "jittered"], 4, size=(16, 12), one_size=True)


class Results(unittest.TestCase):
    def setUp(self):
        if "pandas" not in sys.modules:
            try:
                import pandas  # noqa: F401
            except ModuleNotFoundError:  # its columns are all that is tested
                sys.modules["pandas"] = types.SimpleNamespace(DataFrame=lambda columns: columns)
                self.addCleanup(sys.modules.pop, "pandas")

    def test_frames_have_columns_of_one_length_and_texts_are_short(self):
        for result in results():
            frame = result.to_frame()
            self.assertEqual(len({len(frame[column]) for column in frame}), 1, type(result))
            self.assertGreater(len(list(frame)), 1)
            self.assertTrue(repr(result).startswith(type(result).__name__ + "("))
            self.assertLess(max(map(len, repr(result).split("\n"))), 200, repr(result))
            self.assertNotIn("array(", repr(result))
            if hasattr(result, "draw"):
                self.assertEqual(result.plot, result.draw)
        self.assertLess(len(repr(koksma.optimise("l2-star", 16, steps=2))), 200)

    def test_a_ranking_has_a_row_a_pattern_and_intervals_as_columns(self):
        ranking = koksma.rank("ball", ["random", "jittered"], 4, size=(16, 12), one_size=True)
        frame = ranking.to_frame()
        self.assertEqual(list(frame["pattern"]), [row.pattern for row in ranking.rows])
        self.assertEqual(list(frame["interval_high"]), [row.interval[1] for row in ranking.rows])


class Module(unittest.TestCase):
    def test_import_leaves_what_it_may_not_need(self):
        code = "import sys, koksma; print([m for m in ('scipy', 'pandas', 'matplotlib', 'koksma._engine', 'koksma._hints') if m in sys.modules])"
        environment = {**os.environ, "KOKSMA_LIBRARY_DIR": "/nowhere"}  # the libraries are loaded on use, too
        said = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True).stdout
        self.assertEqual(said.strip(), "[]")

    def test_version(self):
        self.assertEqual(koksma.__version__, koksma.version())
        self.assertIn("__version__", dir(koksma))

    def test_names_that_it_lacks(self):
        for name, remedy in (("optimize", "koksma.optimise"), ("discrepancy", "measure(points"),
                             ("CD", 'measure(points, "CD")'), ("L2_star", '"L2-star"'), ("Sobol", "scramble=owen"), ("n_rooks", 'generate("n-rooks"'),
                             ("l2_star", 'measure(points, "l2-star")'), ("list_patterns", "koksma.patterns"), ("generat", "koksma.generate"),
                             ("LatinHypercube", "latin-hypercube"), ("qqqq", "help(koksma)")):
            with self.assertRaises(AttributeError) as caught:
                getattr(koksma, name)
            self.assertIn(f"no attribute '{name}'", str(caught.exception))
            self.assertIn(remedy, str(caught.exception))
        self.assertFalse(hasattr(koksma, "_nothing"))

    def test_signatures_read_as_types(self):
        for name in koksma.__all__:
            item = getattr(koksma, name)
            if callable(item) and name != "Engine" and not name.endswith("Error"):
                self.assertNotRegex(str(inspect.signature(item)), r"(: |-> )'", name)
        self.assertIn("(pattern: str, n: Optional[SupportsIndex] = None", str(inspect.signature(koksma.generate)))
        self.assertIs(typing.get_type_hints(koksma.has_ranges)["return"], bool)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the program has, the package has: every table that `koksma list` prints, every option of `koksma render` that changes
pixels, differences of pairs; the same names, numbers and bits."""
import inspect
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np

import koksma

PROGRAM = os.environ["KOKSMA"]
CLAIMS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "include", "koksma", "claims.def")
TABLES = ("patterns", "measures", "modifiers", "integrands", "warps", "metrics", "filters", "integrators", "adaptive", "estimators", "intervals")


def program(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True).stdout


def listed(kind):
    return [json.loads(line) for line in program("list", kind, "--json").splitlines()]


def options_of(command):
    """The part of a command's help that lists options: from the first one on to the line after the last."""
    return re.search(r"^(?:  -|      --).*?(?=\n\n)", program(command, "--help"), re.M | re.S)[0]


class Tables(unittest.TestCase):
    def test_names(self):
        for kind in TABLES:
            with self.subTest(kind=kind):
                theirs, ours = listed(kind), getattr(koksma, kind)()
                self.assertTrue(ours)
                self.assertEqual([(m.name, m.title) for m in ours], [tuple(row.values())[:2] for row in theirs])
        self.assertEqual(koksma.scenes(), [next(iter(row.values())) for row in listed("scenes")])

    def test_claims(self):
        with open(CLAIMS, encoding="utf-8") as file:
            bits = {int(bit): name for bit, name in re.findall(r'^KOKSMA_CLAIM\(\w+, (\d+), "([a-z0-9-]+)"', file.read(), re.M)}
        every = {name for pattern in koksma.patterns() for name in pattern.claims}
        self.assertTrue(every <= set(bits.values()))
        for pattern, row in zip(koksma.patterns(), listed("patterns")):
            said = row["claims"] if isinstance(row["claims"], list) else re.findall(r"[a-z0-9-]{2,}", row["claims"])
            self.assertEqual(set(pattern.claims), set(said), pattern.name)

    def test_errors_name_functions(self):
        for call, function in ((lambda: koksma.generate("qqqqqqqq", 4), "patterns"), (lambda: koksma.measure([[.5, .5]], "qqqqqqqq"), "measures"),
                               (lambda: koksma.render("qqqqqqqq"), "scenes"), (lambda: koksma.render("ball", filter="qqqqqqqq"), "filters"),
                               (lambda: koksma.render("ball", integrator="qqqqqqqq"), "integrators"),
                               (lambda: koksma.render("ball", adaptive="qqqqqqqq"), "adaptive"),
                               (lambda: koksma.integrate("qqqqqqqq", "random", 4), "integrands"),
                               (lambda: koksma.compare(np.ones((2, 2)), np.ones((2, 2)), ["qqqqqqqq"]), "metrics")):
            with self.subTest(function=function), self.assertRaisesRegex(koksma.Error, rf"koksma\.{function}\(\) names them"):
                call()
            self.assertTrue(getattr(koksma, function)())

    def test_same_defaults(self):
        """What the help gives as a default is the default here, but for a time limit, without which optimise may not begin."""
        for command, function, renamed in (("generate", koksma.generate, {}), ("render", koksma.render, {}), ("rank", koksma.rank, {}),
                                           ("integrate", koksma.integrate, {})):
            text = re.sub(r"\n {8,}", " ", options_of(command))
            for option, default in re.findall(r"--([a-z-]+) [^\n]*\(default: ([a-z0-9-]+)\)", text):
                parameter = inspect.signature(function).parameters.get(renamed.get(option, option.replace("-", "_")))
                if option == "threads" or parameter is None or parameter.default is inspect.Parameter.empty or parameter.default is None or isinstance(
                        parameter.default, tuple):  # names of several, as of the patterns of rank
                    continue
                with self.subTest(command=command, option=option):
                    self.assertEqual(str(parameter.default), default)


class Rendering(unittest.TestCase):
    def test_same_bits_as_the_program(self):
        """Every option that changes pixels, one at a time."""
        size = ["--size", "24x18", "-n", "4", "-q"]
        for scene, options, ours in (
                ("mirror", ["--integrator", "path", "--depth", "0"], dict(integrator="path", depth=0)),
                ("mirror", ["--integrator", "path", "--depth", "3"], dict(integrator="path", depth=3)),
                ("ball", ["--filter", "mitchell", "--splat"], dict(filter="mitchell", splat=True)),
                ("ball", ["--adaptive", "contrast", "--budget", "9"], dict(adaptive="contrast", budget=9)),
                ("glossy", ["--adaptive", "hierarchical:levels=2"], dict(adaptive="hierarchical:levels=2"))):
            scene = scene if scene in koksma.scenes() else "ball"
            with self.subTest(options=options), tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "image.pfm")
                program("render", scene, *options, *size, "-o", path)
                image = koksma.render(scene, spp=4, size=(24, 18), **ours)
                np.testing.assert_array_equal(image, koksma.read_image(path))
                if "adaptive" in ours:
                    np.testing.assert_array_equal(image, koksma.render(scene, spp=4, size=(24, 18), layers=True, **ours).image)

    def test_replicates(self):
        with tempfile.TemporaryDirectory() as folder:
            image, error = (os.path.join(folder, name) for name in ("image.pfm", "error.pfm"))
            row = json.loads(program("render", "cornell", "-p", "random", "-n", "4", "--size", "16x12", "-s", "5", "--replicates", "6",
                                     "--error-map", error, "-o", image, "--json"))
            found = koksma.render_replicates("cornell", "random", 4, 6, size=(16, 12), seed=5)
            np.testing.assert_array_equal(found.image, koksma.read_image(image))
            np.testing.assert_array_equal(found.error, koksma.read_image(error))
            self.assertEqual([row[k] for k in ("replicates", "rays", "mean", "mean_low", "mean_high", "rmse", "rmse_low", "rmse_high")],
                             [found.replicates, found.rays, found.mean, *found.mean_interval, found.rmse, *found.rmse_interval])
        for wrong, error in ((dict(pattern="sobol"), "one set"), (dict(replicates=2), "replicates"), (dict(splat=2), "splat")):
            with self.assertRaisesRegex((koksma.ArgumentError, TypeError), error):
                koksma.render_replicates("cornell", **{"pattern": "random", **wrong})

    def test_rank_to_error(self):
        rows = [json.loads(line) for line in program("rank", "ball", "--target-error", "0.02", "--size", "16x12", "-p", "random,jittered",
                                                     "--time-limit", "0", "-q", "--json").splitlines()]
        found = koksma.rank_to_error("ball", 0.02, ["random", "jittered"], size=(16, 12), time_limit=None)
        self.assertEqual([[r[k] for k in ("pattern", "spp", "error", "low", "high", "needed", "rate", "state", "trials")] for r in rows],
                         [[t.pattern, t.spp, t.error, *t.interval, t.needed, t.rate, t.state, t.trials] for t in found])
        with self.assertRaisesRegex(koksma.ArgumentError, "target"):
            koksma.rank_to_error("ball", 0)

    def test_sky(self):
        """The bits of the program's --sky and --environment."""
        with tempfile.TemporaryDirectory() as folder:
            around, path = os.path.join(folder, "around.pfm"), os.path.join(folder, "image.pfm")
            koksma.write_image(around, np.linspace(0, 2, 96, dtype=np.float32).reshape(4, 8, 3))
            for options, ours in ((["--sky", "0.25"], dict(sky=0.25)), (["--environment", around], dict(environment=around)),
                                  (["--environment", around, "--sky", "3"], dict(environment=around, sky=3))):
                program("render", "ball", *options, "--size", "24x18", "-n", "4", "-q", "-o", path)
                image = koksma.render("ball", spp=4, size=(24, 18), **ours)
                np.testing.assert_array_equal(image, koksma.read_image(path))
                self.assertFalse(np.array_equal(image, koksma.render("ball", spp=4, size=(24, 18))))
        for arguments, kind, said in ((dict(sky=-1), koksma.ArgumentError, "-1"), (dict(environment="no.pfm"), koksma.MissingError, "no.pfm")):
            with self.assertRaisesRegex(kind, said):
                koksma.render("ball", spp=1, size=(8, 8), **arguments)

    def test_layers(self):
        image = koksma.render("ball", "jittered", 9, size=(24, 18))
        layers = koksma.render("ball", "jittered", 9, size=(24, 18), layers=True)
        np.testing.assert_array_equal(layers.image, image)
        self.assertTrue((layers.samples == 9).all() and layers.rays >= 9 * 24 * 18)
        for array, channels in ((layers.albedo, 3), (layers.normal, 3), (layers.depth, 1), (layers.variance, 1), (layers.samples, 1)):
            self.assertEqual(array.shape, (18, 24, channels))
        self.assertTrue((layers.depth >= 0).all() and layers.depth.max() > 0 and (np.linalg.norm(layers.normal, axis=2) < 1 + 1e-5).all())
        self.assertEqual((layers.rounds, layers.splits), (0, 0))

    def test_adaptive(self):
        """The budget holds; more samples are where the variance is."""
        layers = koksma.render("ball", spp=4, size=(48, 36), adaptive="contrast", budget=12, layers=True)
        self.assertTrue(4 < layers.samples.mean() <= 12 and layers.samples.min() >= 4 and layers.rounds > 0)
        more = layers.samples > 4
        self.assertGreater(layers.variance[more].mean(), layers.variance[~more].mean())

    def test_refusals(self):
        for arguments, said in ((dict(budget=3), "a method of adaptive sampling"), (dict(adaptive="contrast", budget=-1), "budget must be .*not -1$"),
                                (dict(adaptive="contrast", budget=float("nan")), "budget must be .*not nan$"), (dict(depth=65), "depth must be 0 to 64"),
                                (dict(adaptive="hierarchical", pattern="random"), "places its own samples"),
                                (dict(adaptive="contrast", splat=True), "splat")):
            with self.subTest(arguments=arguments), self.assertRaisesRegex(koksma.Error, said):
                koksma.render("ball", spp=4, size=(8, 8), **arguments)


class Axes(unittest.TestCase):
    """Curves on matplotlib's axes: the numbers of the results; without matplotlib, or with other axes, a sentence or those."""

    def results(self):
        sets = [koksma.generate("jittered", 64, seed=seed) for seed in range(4)]
        convergence, spectrum, pairs = koksma.convergence("sobol", "l2-star", [16, 64, 256]), koksma.spectrum(sets, 8), koksma.pair_correlation(sets)
        return ((convergence, convergence.sizes, convergence.mean), (spectrum, spectrum.frequency, spectrum.ring_power),
                (pairs, pairs.distance, pairs.density))

    def test_axes_given(self):
        for result, x, y in self.results():
            ax = unittest.mock.MagicMock()
            self.assertIs(result.draw(ax, color="red"), ax)
            drawn, style = ax.errorbar.call_args
            np.testing.assert_array_equal(drawn[0], x)
            np.testing.assert_array_equal(drawn[1], y)
            self.assertEqual(style["color"], "red")
            self.assertEqual(ax.loglog.called, isinstance(result, koksma.Convergence))


class Pairs(unittest.TestCase):
    def test_differences(self):
        """Those of the program's --paired, plain and through a warp."""
        for warp in (None, "concentric-disk"):
            measure = "edge" if warp else "star"
            lines = program("measure", "--paired", "--trials", "9", "pattern:random@16", "pattern:jittered@16", "-m", measure, "--json",
                            *(["--warp", warp] if warp else [])).splitlines()
            row = json.loads(lines[-1])
            random, jittered = (koksma.trials(p, 16, measure, trials=9, warp=warp) for p in ("random", "jittered"))
            difference = jittered - random
            self.assertIn("minus", row["source"])
            for ours, theirs in zip((difference.mean, *difference.interval), (row["value"], row["low"], row["high"])):
                self.assertAlmostEqual(ours, theirs, places=12)
            self.assertEqual(difference.pattern, "jittered - random")

    def test_refusals(self):
        one = koksma.trials("random", 16, trials=4)
        for other in (koksma.trials("random", 16, trials=5), koksma.trials("random", 16, trials=4, seed=1),
                      koksma.trials("random", 16, "l2-star", trials=4)):
            with self.assertRaisesRegex(koksma.ArgumentError, "the same measure, n, dim, first seed and number of sets"):
                one - other
        with self.assertRaises(TypeError):
            one - 1


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])

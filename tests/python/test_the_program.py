#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the package gives is what the program KOKSMA (in the environment) gives, in names, numbers and bits; and closed forms
and NumPy's sums of both."""
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

CLAIMS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "include", "koksma", "claims.def")
TABLES = ("patterns", "measures", "modifiers", "integrands", "warps", "metrics", "filters", "integrators", "adaptive", "estimators", "intervals")


def program(*arguments):
    done = subprocess.run([os.environ["KOKSMA"], *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def rows_of(*arguments):
    return [json.loads(line) for line in program(*arguments, "--json").splitlines()]


class InFolder(unittest.TestCase):
    def path(self, name):
        """Of a file in a folder of the test."""
        if not hasattr(self, "folder"):
            self.folder = tempfile.TemporaryDirectory()
            self.addCleanup(self.folder.cleanup)
        return os.path.join(self.folder.name, name)


def options_of(command):
    """The part of a command's help that lists options: from the first one on to the line after the last."""
    return re.search(r"^(?:  -|      --).*?(?=\n\n)", program(command, "--help"), re.M | re.S)[0]


class Tables(InFolder):
    def test_names(self):
        for kind in TABLES:
            with self.subTest(kind=kind):
                theirs, ours = rows_of("list", kind), getattr(koksma, kind)()
                self.assertTrue(ours)
                self.assertEqual([(m.name, m.title) for m in ours], [tuple(row.values())[:2] for row in theirs])
        self.assertEqual(koksma.scenes(), [next(iter(row.values())) for row in rows_of("list", "scenes")])

    def test_claims(self):
        with open(CLAIMS, encoding="utf-8") as file:
            bits = {int(bit): name for bit, name in re.findall(r'^KOKSMA_CLAIM\(\w+, (\d+), "([a-z0-9-]+)"', file.read(), re.M)}
        every = {name for pattern in koksma.patterns() for name in pattern.claims}
        self.assertTrue(every <= set(bits.values()))
        for pattern, row in zip(koksma.patterns(), rows_of("list", "patterns")):
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


class Rendering(InFolder):
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
            with self.subTest(options=options):
                path = self.path("image.pfm")
                program("render", scene, *options, *size, "-o", path)
                image = koksma.render(scene, spp=4, size=(24, 18), **ours)
                np.testing.assert_array_equal(image, koksma.read_image(path))
                if "adaptive" in ours:
                    np.testing.assert_array_equal(image, koksma.render(scene, spp=4, size=(24, 18), layers=True, **ours).image)

    def test_replicates(self):
        image, error = (self.path(name) for name in ("image.pfm", "error.pfm"))
        (row,) = rows_of("render", "cornell", "-p", "random", "-n", "4", "--size", "16x12", "-s", "5", "--replicates", "6",
                         "--error-map", error, "-o", image)
        found = koksma.render_replicates("cornell", "random", 4, 6, size=(16, 12), seed=5)
        np.testing.assert_array_equal(found.image, koksma.read_image(image))
        np.testing.assert_array_equal(found.error, koksma.read_image(error))
        self.assertEqual([row[k] for k in ("replicates", "rays", "mean", "mean_low", "mean_high", "rmse", "rmse_low", "rmse_high")],
                         [found.replicates, found.rays, found.mean, *found.mean_interval, found.rmse, *found.rmse_interval])
        for wrong, error in ((dict(pattern="sobol"), "one set"), (dict(replicates=2), "replicates"), (dict(splat=2), "splat")):
            with self.assertRaisesRegex((koksma.ArgumentError, TypeError), error):
                koksma.render_replicates("cornell", **{"pattern": "random", **wrong})

    def test_rank_to_error(self):
        rows = rows_of("rank", "ball", "--target-error", "0.02", "--size", "16x12", "-p", "random,jittered", "--time-limit", "0", "-q")
        found = koksma.rank_to_error("ball", 0.02, ["random", "jittered"], size=(16, 12), time_limit=None)
        self.assertEqual([[r[k] for k in ("pattern", "spp", "error", "low", "high", "needed", "rate", "state", "trials")] for r in rows],
                         [[t.pattern, t.spp, t.error, *t.interval, t.needed, t.rate, t.state, t.trials] for t in found])
        with self.assertRaisesRegex(koksma.ArgumentError, "target"):
            koksma.rank_to_error("ball", 0)

    def test_sky(self):
        """The bits of the program's --sky and --environment."""
        around, path = self.path("around.pfm"), self.path("image.pfm")
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


class Axes(InFolder):
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


class Pairs(InFolder):
    def test_differences(self):
        """Those of the program's --paired, plain and through a warp."""
        for warp in (None, "concentric-disk"):
            measure = "edge" if warp else "star"
            row = rows_of("measure", "--paired", "--trials", "9", "pattern:random@16", "pattern:jittered@16", "-m", measure,
                          *(["--warp", warp] if warp else []))[-1]
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


class Warps(InFolder):
    def test_same_bits_as_the_program(self):
        path = self.path("p.npy")
        for warp in koksma.warps():
            program("generate", "sobol:scramble=owen", "-n", "100", "-s", "3", "--warp", warp.name, "-o", path)
            ours = koksma.generate("sobol:scramble=owen", 100, seed=3, warp=warp.name)
            np.testing.assert_array_equal(ours, np.load(path), warp.name)
            np.testing.assert_array_equal(ours, koksma.warp_points(koksma.generate("sobol:scramble=owen", 100, seed=3), warp.name))

    def test_ranges_and_files(self):
        far = koksma.generate("sobol", 8, first=1 << 33, warp="polar-disk")
        np.testing.assert_array_equal(far, koksma.warp_points(koksma.generate("sobol", 8, first=1 << 33), "polar-disk"))
        path = self.path("p.npy")
        koksma.write(path, [[0.25, 0.5]])
        self.assertEqual(koksma.generate("file:" + path, warp="triangle").shape, (1, 2))

    def test_refusals(self):
        for call, said in ((lambda: koksma.generate("random", 4, warp="disc"), r"koksma\.warps\(\)"),
                           (lambda: koksma.generate("random", 4, 3, warp="triangle"), "2 dimensions, not 3"),
                           (lambda: koksma.generate("random", out=np.zeros((4, 2)), warp="triangle"), "warp excludes out"),
                           (lambda: koksma.warp_points([[0.5, 1.5]], "triangle"), r"outside \[0,1\]"),
                           (lambda: koksma.warp_points([0.5], "triangle"), r"shape \(n, dim\)")):
            with self.subTest(said=said), self.assertRaisesRegex(koksma.ArgumentError, said):
                call()

    def test_series(self):
        """Trials and convergence through a warp are the measures of the sets that generate makes."""
        ours = koksma.convergence("sobol", "edge", [16, 64], warp="concentric-disk")
        rows = rows_of("measure", "--prefixes", "16,64", "--warp", "concentric-disk", "-m", "edge", "pattern:sobol@64")
        self.assertEqual(list(ours.mean), [row["value"] for row in rows[:2]])
        self.assertTrue(np.isnan([ours.proven, ours.best]).all())
        sets = koksma.convergence("jittered", "edge", [16, 64], warp="concentric-disk", trials=2)
        for t in range(2):
            for i, n in enumerate((16, 64)):
                value = koksma.measure(koksma.generate("jittered", n, seed=t), "edge", warp="concentric-disk").value
                self.assertEqual(sets.values[t, i], value)


class Values(InFolder):
    def test_local_discrepancy(self):
        points = koksma.generate("random", 50, 3, seed=4)
        for corner in ([0.5, 0.25, 0.75], [1, 1, 1], points[7], (0, 0.3, 0.9)):
            inside = (points < np.array(corner)).all(axis=1).mean()
            self.assertAlmostEqual(koksma.local_discrepancy(points, corner), inside - np.prod(corner), 15)
        (row,) = rows_of("measure", "--at", "0.3,0.7", "pattern:jittered@16")
        self.assertIn(koksma.local_discrepancy(koksma.generate("jittered", 16), [0.3, 0.7]), row.values())
        for corner, said in (([0.5, 0.5], "corner must have 3 coordinates"), (0.5, "corner must have 3"), ([0, 0, 2], "outside|corner"),
                             ([0, 0, float("nan")], "outside|corner")):
            with self.subTest(corner=corner), self.assertRaisesRegex(koksma.ArgumentError, said):
                koksma.local_discrepancy(points, corner)

    def test_time_limit_of_trials(self):
        cut = koksma.trials("random", 100, "extreme", dim=3, trials=2, time_limit=1e-9)
        self.assertEqual(cut.exact, 0)
        self.assertEqual(koksma.trials("random", 8, "extreme", trials=2, time_limit=600).exact, 2)

    def test_pairs(self):
        every = koksma.optimise("l2-star", 8, 3, projections="pairs", steps=1)
        np.testing.assert_array_equal(every.points, koksma.optimise("l2-star", 8, 3, projections=[(0, 1), (0, 2), (1, 2)], steps=1).points)
        with self.assertRaisesRegex(koksma.ArgumentError, "projections must be .* not 'triples'"):
            koksma.optimise("l2-star", 8, 3, projections="triples", steps=1)

    def test_records(self):
        rows = rows_of("list", "records")
        self.assertEqual([(r.measure, r.n, r.dim, r.value, r.seed) for r in koksma.records()],
                         [(r["measure"], r["n"], r["dim"], r["value"], r["seed"]) for r in rows])
        for record in koksma.records()[::40]:
            points = koksma.generate(f"record:measure={record.measure}", record.n, record.dim)
            self.assertAlmostEqual(float(koksma.measure(points, record.measure)), record.value, 12)


class Scenes(InFolder):
    def test_check(self):
        for name in ("ball", "cornell", "many-lights"):
            rows = rows_of("scene", "check", name)
            found = koksma.check_scene(name)
            for kind in ("shapes", "meshes", "placements", "triangles", "materials", "lights"):
                self.assertEqual(getattr(found, kind), rows[0][kind])
            self.assertEqual(found.warnings, ())
        path = self.path("odd.pbrt")
        with open(path, "w", encoding="utf-8") as file:
            file.write('LookAt 0 0 -4 0 0 0 0 1 0\nCamera "perspective"\nWorldBegin\nLightSource "point"\n'
                       'Material "hair"\nShape "sphere"\n')
        found = koksma.check_scene(path)
        self.assertFalse(found)
        self.assertTrue(any("hair" in line for line in found.unknown))
        self.assertTrue(set(found.unknown) <= set(found.warnings))
        with koksma.refuse_unknown(), self.assertRaisesRegex(koksma.MalformedError, "hair"):
            koksma.check_scene(path)
        with self.assertRaises(koksma.Error):
            koksma.check_scene("no-such-scene")

    def test_lights(self):
        """The program's default is ours: a scene with more than 8 lights."""
        self.assertGreater(koksma.check_scene("many-lights").lights, 8)
        path = self.path("image.pfm")
        program("render", "many-lights", "--integrator", "path", "--size", "24x18", "-n", "2", "-q", "-o", path)
        image = koksma.render("many-lights", spp=2, size=(24, 18), integrator="path")
        np.testing.assert_array_equal(image, koksma.read_image(path))
        self.assertFalse(np.array_equal(image, koksma.render("many-lights", spp=2, size=(24, 18), integrator="path", lights="all")))

    def test_probes(self):
        layers = koksma.render("checker", spp=4, size=(24, 18), adaptive="hierarchical", probes=4, layers=True)
        row = rows_of("render", "checker", "-n", "4", "--size", "24x18", "--adaptive", "hierarchical", "--probe", "4", "-q",
                      "-o", self.path("i.pfm"))[0]
        self.assertGreater(layers.splits, 0)
        self.assertEqual((layers.splits, layers.needless / layers.splits), (row["splits"], row["needless"]))
        with self.assertRaisesRegex(koksma.ArgumentError, "probes 3"):
            koksma.render("ball", spp=1, size=(4, 4), probes=3)


class Masks(InFolder):
    def test_same_as_the_program(self):
        for space, options, ours in (("scalar", ["--levels", "8", "--open"], dict(levels=8, open=True)), ("sphere", ["-s", "3"], dict(seed=3))):
            path = self.path(space + ".npy")
            (row,) = rows_of("mask", "-o", path, "--size", "12x9", "--space", space, "--swaps", "30", "-f", "box:size=3", *options)
            mask = koksma.mask("box:size=3", (12, 9), space=space, swaps=30, **ours)
            np.testing.assert_array_equal(mask, np.load(path))
            np.testing.assert_array_equal(mask, koksma.mask(np.ones((3, 3)), (12, 9), space=space, swaps=30, **ours))
            np.testing.assert_array_equal(mask, koksma.read_mask(path, space))
            self.assertEqual(koksma.mask_quality(mask, "box:size=3", space=space).error, row["error"])

    def test_quality(self):
        mask = koksma.mask("binomial:size=3", (10, 8), swaps=20)
        weights = np.outer([1, 2, 1], [1, 2, 1]) / 16
        variances = []
        for t in (np.arange(5) + .5) / 5:
            inside = (mask < t).astype(float)
            variances.append(sum(weights[i, j] * np.roll(inside, (-i, -j), (0, 1)) for i in range(3) for j in range(3)).var())
        self.assertAlmostEqual(koksma.mask_quality(mask, "binomial:size=3", tests=5).error, np.sqrt(np.mean(variances)), 12)

    def test_files(self):
        mask = koksma.mask(size=(6, 5), space="vector2", swaps=2)
        self.assertEqual(mask.shape, (5, 6, 2))
        for name, bits in (("a.npy", 0), ("a.png", 16), ("a.png", 8)):
            path = self.path(name)
            koksma.write_mask(path, mask, bits=bits)
            np.testing.assert_allclose(koksma.read_mask(path), mask, atol=2.0**-bits if bits else 0)

    def test_start(self):
        start = koksma.mask(size=(8, 8), swaps=0, seed=1)
        better = koksma.mask("box:size=2", start=start, swaps=50)
        np.testing.assert_array_equal(np.sort(better, None), np.sort(start, None))
        self.assertLess(koksma.mask_quality(better, "box:size=2").error, koksma.mask_quality(start, "box:size=2").error)
        for wrong in (dict(size=(4, 8), start=start), dict(start=start, space="circle"), dict(filter=np.zeros((3, 3))), dict(size=(3, 8)),
                      dict(filter="gausian"), dict(space="ring"), dict(filter=[[1.0, np.nan]]), dict(start=start + 1)):
            with self.subTest(wrong=wrong), self.assertRaises(koksma.Error):
                koksma.mask(**{"filter": "box:size=2", **wrong})

    def test_correlation(self):
        """Of two masks at each offset, by the Fourier transform."""
        masks = [koksma.mask("box:size=3", (12, 10), swaps=20, seed=s) for s in range(2)]
        masks[1] = (np.roll(masks[0], (3, 5), (0, 1)) + masks[1]) / 2
        paths = [self.path(name) for name in ("a.npy", "b.npy")]
        for path, mask in zip(paths, masks):
            koksma.write_mask(path, mask)
        rows = rows_of("mask", "check", *paths, "--correlation", "5")
        a, b = (np.fft.fft2(mask.astype(float) - mask.mean(dtype=float)) for mask in masks)
        both = np.fft.ifft2(np.conj(a) * b).real / np.sqrt((abs(a)**2).sum() * (abs(b)**2).sum()) * a.size
        self.assertEqual(np.unravel_index(np.argmax(abs(both)), both.shape), (3, 5))
        np.testing.assert_allclose([row["correlation"] for row in rows], [both[row["dy"], row["dx"]] for row in rows], atol=1e-12)


class Optimise(InFolder):
    def test_same_set_as_the_program(self):
        path = self.path("o.npy")
        (row,) = rows_of("optimise", "l2-star", "-n", "8", "--steps", "2", "-s", "3", "-o", path)
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
            with self.subTest(target=target):
                path = self.path("p.npy")
                program("optimise", "--power", target, "-n", "14", "--steps", "1", "-o", path, "-q")
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
    unittest.main(argv=[sys.argv[0]])

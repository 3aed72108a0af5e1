#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The Python package against the program KOKSMA (in the environment) and against numpy."""
import builtins
import copy
import gc
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest
from unittest import mock

import numpy as np

import koksma
from koksma import _library, _points

PROGRAM = os.environ["KOKSMA"]


def program(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout


def unaligned(array):
    """The same numbers one byte off."""
    room = bytearray(array.nbytes + 1)
    result = np.frombuffer(room, dtype=array.dtype, offset=1, count=array.size).reshape(array.shape)
    result[:] = array
    return result


class Points(unittest.TestCase):
    def test_same_bits_as_the_program(self):
        for spec, n, dim, seed in [("n-rooks", 16, 2, 7), ("sobol", 64, 5, 0), ("poisson-disk:d=0.1", 20, 2, 3)]:
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "p.npy")
                program("generate", spec, "-n", str(n), "-d", str(dim), "-s", str(seed), "-o", path)
                ours = koksma.generate(spec, n, dim, seed)
                np.testing.assert_array_equal(ours, np.load(path))
                np.testing.assert_array_equal(ours, koksma.read(path))

    def test_out_is_filled_in_place(self):
        out = np.zeros((16, 2))
        self.assertIs(koksma.generate("jittered", seed=3, out=out), out)
        np.testing.assert_array_equal(out, koksma.generate("jittered", 16, seed=3))
        frozen = np.zeros((16, 2))
        frozen.flags.writeable = False
        for bad in (out[:, ::-1], np.zeros((16, 2), np.float32), np.zeros(16), np.zeros((0, 2)), unaligned(out), frozen,
                    np.zeros((16, 2), ">f8")):
            with self.assertRaises(koksma.ArgumentError):
                koksma.generate("random", out=bad)

    def test_dimensions(self):
        """2 of their own accord, the file's or out's; those that are asked for are there, or there is an error."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "p3.npy")
            rows = koksma.generate("random", 7, 3, seed=4)
            koksma.write(path, rows)
            for arguments, columns in (({}, 3), ({"dim": 1}, 1), ({"dim": 2}, 2), ({"dim": 3}, 3), ({"n": 7}, 2),
                                       ({"n": 5, "dim": 3}, 3)):
                with self.subTest(**arguments):
                    options = [x for key, value in arguments.items() for x in (f"-{key[0]}", str(value))]
                    copy = os.path.join(folder, "copy.npy")
                    program("generate", "file:" + path, *options, "-o", copy)
                    points = koksma.generate("file:" + path, **arguments)
                    np.testing.assert_array_equal(points, rows[:arguments.get("n"), :columns])
                    np.testing.assert_array_equal(points, np.load(copy))
            for arguments in ({"dim": 4}, {"n": 7, "dim": 4}):
                with self.assertRaisesRegex(koksma.ArgumentError, "3 dimensions, not 4"):
                    koksma.generate("file:" + path, **arguments)
        self.assertEqual(koksma.generate("random", 5).shape, (5, 2))
        self.assertEqual(koksma.generate("poisson-disk-maximal:d=0.3").shape[1], 2)
        self.assertEqual(koksma.generate("poisson-disk-maximal:d=0.3", dim=3).shape[1], 3)
        with self.assertRaisesRegex(koksma.ArgumentError, "no 7-dimensional form"):
            koksma.generate("poisson-disk-maximal:d=0.3", dim=7)
        out = np.zeros((5, 4))
        for arguments in ({}, {"n": 5}, {"dim": 4}, {"n": 5, "dim": 4}):
            np.testing.assert_array_equal(koksma.generate("random", seed=1, out=out, **arguments),
                                          koksma.generate("random", 5, 4, seed=1))
        for arguments in ({"n": 4}, {"dim": 2}, {"dim": 3}, {"n": 5, "dim": 2}, {"n": 4, "dim": 4}):
            out[:] = 7
            with self.assertRaisesRegex(koksma.ArgumentError, "out has the shape"):
                koksma.generate("random", out=out, **arguments)
            self.assertTrue((out == 7).all())

    def test_adopted_memory_lives_as_long_as_its_views(self):
        view = koksma.generate("poisson-disk-maximal:d=0.05", seed=1)[1:]
        copy = view.copy()
        gc.collect()
        koksma.generate("poisson-disk-maximal:d=0.05", seed=2)
        np.testing.assert_array_equal(view, copy)
        self.assertGreater(len(view), 100)

    def test_arrays_outlive_the_interpreter(self):
        code = ("import atexit, koksma\n"
                "class Last:\n"
                "    def __init__(self, array): self.array, self.sum = array, array.sum()\n"
                "    def __del__(self): print(self.array.sum() == self.sum)\n"
                "atexit.register(lambda: print(all(x.array.sum() == x.sum for x in kept)))\n"
                "kept = [Last(koksma.generate('poisson-disk-maximal:d=0.006')),\n"
                "        Last(koksma.render('ball', spp=1, size=(320, 240)))]\n")
        run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, 3 * "True\n", ""))

    def test_measure(self):
        points = koksma.generate("n-rooks", 32, seed=5)
        row = json.loads(program("measure", "pattern:n-rooks@32", "--seed", "5", "-m", "star", "--json"))
        value = koksma.measure(points, "star")
        self.assertEqual(float(value), row["value"])
        box = np.array(value.witness.hi)
        inside = (points <= box) if value.witness.closed else (points < box)
        self.assertEqual(inside.all(axis=1).sum(), value.witness.count)
        self.assertAlmostEqual(abs(value.witness.count / 32 - value.witness.volume), value.value, places=15)
        self.assertIsNone(koksma.measure(points, "l2-star").witness)
        fortran = np.asfortranarray(points)
        self.assertEqual(float(koksma.measure(fortran, "star")), float(value))
        self.assertEqual(float(koksma.measure(points.tolist(), "star")), float(value))

    def test_l2_star_against_warnock(self):
        x = koksma.generate("random", 50, 3, seed=2)
        n, d = x.shape
        pairs = np.prod(1 - np.maximum(x[:, None, :], x[None, :, :]), axis=2).sum() / n**2
        expected = 3.0**-d - np.prod((1 - x**2) / 2, axis=1).sum() * 2 / n + pairs
        self.assertAlmostEqual(koksma.measure(x, "l2-star").value**2, expected, places=14)

    def test_verify(self):
        found = {(f.property, f.subject): f for f in koksma.verify(koksma.generate("sobol", 64))}
        self.assertTrue(found["net-base-2", "0,1"].holds)
        self.assertTrue(found["progressive", found_subject(found, "progressive")].holds)
        names = ["distinct", "origin-unique", "origin-not-missing", "below-one-as-float"]
        self.assertEqual([found[name, "-"].holds for name in names], [True] * 4)
        bad = [f.property for f in koksma.verify([[0, 0], [0, 0], [1 - 1e-9, 0.5]]) if not f.holds]
        self.assertTrue({"distinct", "origin-unique", "below-one-as-float"} <= set(bad), bad)

    def test_tables(self):
        self.assertIn("n-rooks", [p.name for p in koksma.patterns()])
        self.assertIn("star", [m.name for m in koksma.measures()])
        self.assertEqual(koksma.canonical("poisson-disk:d=0.20"), koksma.canonical("poisson-disk:d=0.2"))
        self.assertIn(koksma.version(), program("version"))

    def test_files(self):
        points = koksma.generate("halton", 10, 3)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("p.txt", "p.csv", "p.npy"):
                koksma.write(os.path.join(folder, name), points, "ours")
                np.testing.assert_array_equal(koksma.read(os.path.join(folder, name)), points)
            path = pathlib.Path(folder, "comment.txt")
            with self.assertRaisesRegex(ValueError, "comment must not contain a zero character"):
                koksma.write(path, points, "cut\0off")
            self.assertFalse(path.exists())
            koksma.write(path, points, "Sobol’\n2")
            self.assertIn("# Sobol’\n# 2\n", path.read_text(encoding="utf-8"))


def found_subject(found, name):
    return next(subject for p, subject in found if p == name)


class Errors(unittest.TestCase):
    def test_exceptions_carry_the_librarys_line(self):
        with self.assertRaisesRegex(ValueError, "no pattern 'nope'"):
            koksma.generate("nope", 4)
        with self.assertRaisesRegex(ValueError, "no parameter 'x'"):
            koksma.generate("n-rooks:x=1", 4)
        with self.assertRaisesRegex(FileNotFoundError, "/no/such/file"):
            koksma.read("/no/such/file")
        with self.assertRaisesRegex(ValueError, r"outside|not in"):
            koksma.measure([[0.5, 1.5]])
        with self.assertRaises(koksma.ArgumentError):
            koksma.measure([0.5, 0.5])
        with self.assertRaises(koksma.ArgumentError):
            koksma.generate("random", 1 << 40)
        with self.assertRaises(koksma.ArgumentError):
            koksma.generate("random", 4, seed=-1)
        with self.assertRaises(koksma.ArgumentError):
            koksma.generate("random", -1)
        with self.assertRaises(koksma.ArgumentError):
            koksma.generate("random\0", 1)

    def test_malformed(self):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write("0.5 0.5\n0.5\n")
            file.flush()
            with self.assertRaisesRegex(koksma.MalformedError, "line 2"):
                koksma.read(file.name)

    def test_time_limit_gives_bounds(self):
        value = koksma.measure(koksma.generate("random", 500, 6), "star", time_limit=0.2)
        self.assertFalse(value.exact)
        self.assertLessEqual(value.lower, value.upper)


class ErrorsSpeakPython(unittest.TestCase):
    """Messages name the arguments of Python: no option of the program, no function of C, no file that is gone."""

    def test_transposed_points_are_named(self):
        with self.assertWarnsRegex(UserWarning, "^2 points in 16 dimensions; are rows and columns swapped"):
            koksma.measure(koksma.generate("sobol", 16).T, "star-lower")

    def test_wrong_calls(self):
        points = np.full((4, 2), .5)
        for call, said in (
                (lambda: koksma.generate("sobol"), r"^sobol: n, the number of points, is missing$"),
                (lambda: koksma.write_image("x.png", np.full((2, 2), 200, np.uint8)), "^pixels of linear light are floats, not uint8; read_image"),
                (lambda: koksma.generate("exec:./x", 4), r"^exec:./x: the pattern runs external code; 'with koksma.allow_exec\(\):' around the call allows that$"),
                (lambda: koksma.generate("jittered", 16, first=4), r"koksma\.has_ranges"),
                (lambda: koksma.render("ball", lights="q"), r"^lights must be one of all, one, .*, not 'q'$"),
                (lambda: koksma.render("ball", size=4), r"^size must be \(width, height\), not 4$"),
                (lambda: koksma.rank("ball", size=(1, 2, 3)), r"^size must be \(width, height\), not \(1, 2, 3\); of an array it is"),
                (lambda: koksma.rank("ball", "random"), r"^patterns must be a list of texts, not 'random'; a list of one is"),
                (lambda: koksma.datasheet("sobol", beside="random"), r"^beside must be a list of texts, not 'random'; a list of one is"),
                (lambda: koksma.datasheet("sobol", scenes="ball"), r"^scenes must be a list of texts, not 'ball'; a list of one is"),
                (lambda: koksma.datasheet("sobol", beside=["random"] * 9), r"^beside: 9 samplers"),
                (lambda: koksma.canonical("star", "q"), r"^kind must be one of pattern, measure, not 'q'$"),
                (lambda: koksma.write("", points), r"^the path of the file to write is empty$"),
                (lambda: koksma.read(""), r"^the path of the file to read is empty$"),
                (lambda: koksma.write_image("", np.ones((2, 2))), r"^the path is empty: the name of an image file must end in \.exr, "),
                (lambda: koksma.plot(points).save(""), r"^the path is empty: a picture's name ends in \.svg, \.pdf or \.png$"),
                (lambda: koksma.plot(points, size=-5), r"^size must be 16 to 32767"),
                (lambda: koksma.Study({"name": "x"}), r"^line 1 of json\.dumps\(plan, indent=1\): field 'title' is missing$")):
            with self.subTest(said=said), self.assertRaisesRegex(koksma.Error, said) as caught:
                call()
            self.assertNotRegex(str(caught.exception), r"--[a-z]|koksma_|koksma list|koksma-plan-")
        with self.assertRaisesRegex(TypeError, "pattern must be a str, not 16"):
            koksma.generate(16, "random")


class Datasheets(unittest.TestCase):
    def test_datasheet(self):
        seen = []
        sheet = koksma.datasheet("sobol", beside=["jittered"], scenes=[], quick=True, progress=seen.append)
        self.assertEqual(sheet.data["samplers"], ["sobol", "jittered"])
        star = float(koksma.measure(koksma.generate("sobol", 256), "star"))
        self.assertEqual(next(row["mean"] for row in sheet.table("values") if (row["measure"], row["sampler"], row["n"]) == ("star", "sobol", 256)), [star] * 3)
        self.assertIn("Datasheet of sobol", sheet.html)
        self.assertTrue(seen and max(seen) <= 1)
        with self.assertRaises(koksma.ArgumentError):
            sheet.save("sheet.pdf")
        with self.assertRaises(koksma.MissingError):
            koksma.datasheet("none_{n}_{seed}.npy")
        with self.assertRaises(koksma.ArgumentError):
            koksma.datasheet("sobol", beside=["random"] * 8)


class Rankings(unittest.TestCase):
    def test_rank(self):
        ranking = koksma.rank("checker", ["random", "n-rooks"], 4, size=(16, 12), time_limit=None)
        self.assertEqual((ranking.best, ranking.settled, ranking.complete, ranking.cut_short), ("n-rooks", True, True, False))
        adaptive = koksma.rank("checker", ["random"], 8, size=(8, 6), max_trials=8, one_size=True, adaptive="contrast")
        self.assertFalse(adaptive.rows[0].unbiased)
        with self.assertRaisesRegex(koksma.ArgumentError, "places its own samples"):
            koksma.rank("checker", ["random", "jittered"], 4, adaptive="selective")
        mixed = koksma.rank("checker", ["random", "sobol", "sobol:scramble=owen"], 4, size=(8, 6), max_trials=8, one_size=True)
        self.assertEqual({row.pattern: row.unbiased for row in mixed.rows}, {"random": True, "sobol": False, "sobol:scramble=owen": True})
        first, last = ranking.rows
        self.assertEqual([first.position, last.position, first.decision, last.decision], [1, 2, "best", "worse"])
        self.assertLess(last.interval[0], last.error)
        self.assertGreater(last.behind_interval[0], 0)
        self.assertEqual([check.size for check in ranking.checks], [(8, 6), (32, 24)])
        self.assertEqual({check.state for check in ranking.checks}, {"confirmed"})
        self.assertEqual({check.first.state for check in ranking.checks}, {"confirmed"})
        self.assertEqual({check.first.best for check in ranking.checks}, {None})
        ranking = koksma.rank("ball", ["regular", "half-jittered", "n-rooks", "jittered"], 4, size=(64, 48), time_limit=None)
        self.assertEqual((ranking.best, ranking.advised), ("half-jittered", "n-rooks"))
        half, twice = ranking.checks
        self.assertEqual([(check.state, check.best) for check in (half, twice)], [("confirmed", None)] * 2)
        self.assertEqual((half.first.state, half.first.best, half.first.coherent), ("overturned", "n-rooks", False))
        self.assertEqual((twice.first.state, twice.first.best, twice.first.coherent), ("overturned", "regular", True))
        self.assertTrue(0 < twice.first.behind_interval[0] < twice.first.behind < twice.first.behind_interval[1])
        self.assertIsNone(ranking.needed_trials)

    def test_a_short_time_is_no_error(self):
        ranking = koksma.rank("balls", ["n-rooks", "random"], 65536, size=(640, 480), time_limit=1e-3)
        self.assertEqual((ranking.best, ranking.cut_short), (None, True))
        self.assertEqual({row.state for row in ranking.rows}, {"too-slow"})
        self.assertTrue(ranking.needed_seconds is None or ranking.needed_seconds > 0)  # None: before the first ray


class OddArrays(unittest.TestCase):
    def test_kinds_of_numbers(self):
        exact = np.array([[0.25, 0.5], [0.75, 0.0], [0.5, 0.75]])
        expected = float(koksma.measure(exact, "star"))
        wide = np.zeros((6, 5))
        wide[::2, 1::3] = exact
        for same in (exact.astype(np.float32), exact.astype(np.float16), exact.astype(">f8"), exact.astype(object),
                     exact.astype(np.longdouble), np.asfortranarray(exact), exact[::-1][::-1], wide[::2, 1::3],
                     exact.tolist(), tuple(map(tuple, exact)), np.ma.array(exact), np.asmatrix(exact), unaligned(exact)):
            array = _points.as_points(same)
            self.assertTrue(type(array) is np.ndarray and array.flags.carray)
            self.assertEqual(float(koksma.measure(same, "star")), expected)
        self.assertEqual(float(koksma.measure(np.array([[0, 1], [1, 0]]), "star")), 1)
        frozen = np.broadcast_to(exact[0], (4, 2))
        self.assertGreater(float(koksma.measure(frozen, "star")), 0.5)

    def test_what_is_no_points(self):
        nan, inf = float("nan"), float("inf")
        for bad in ([[0.5, nan]], [[0.5, inf]], [[-0.1, 0.5]], [[0.5, 1.0000001]], [[0.5 + 1j, 0.5]], [["0.5", "0.5"]],
                    np.zeros((2, 2), "M8[s]"), np.ma.array([[0.5, 0.5]], mask=[[True, False]]), [], [[]], np.zeros((0, 2)),
                    [0.5, 0.5], np.zeros((2, 2, 2, 2)), [[0.1, 0.2], [0.3]], None):
            for function in (koksma.measure, koksma.verify):
                with self.subTest(bad=bad, function=function.__name__), self.assertRaises(ValueError):
                    function(bad)

    def test_what_is_no_number(self):
        for arguments in ({"n": 1.5}, {"n": "4"}, {"n": 4, "dim": 2.5}, {"n": 4, "seed": 1.5}, {"n": 4, "seed": "1"}):
            with self.subTest(arguments), self.assertRaises(TypeError):
                koksma.generate("random", **arguments)
        for limit in (0, -1, float("nan")):
            with self.assertRaises(koksma.ArgumentError):
                koksma.measure([[0.5, 0.5]], "star", time_limit=limit)
        with self.assertRaises(TypeError):
            koksma.render("ball", spp=1, size=(4.5, 4))
        np.testing.assert_array_equal(koksma.generate("random", np.int64(4), seed=np.uint64(1 << 63)),
                                      koksma.generate("random", 4, seed=1 << 63))

    def test_numbers_that_c_would_cut(self):
        points, wrap = koksma.generate("random", 64), 1 << 32
        for call, line in (
                (lambda: koksma.generate("random", wrap + 2), "n must be 1 to"),
                (lambda: koksma.generate("random", 0), "n must be 1 to"),
                (lambda: koksma.generate("random", 4, wrap + 2), "dim must be 1 to 4096"),
                (lambda: koksma.generate("poisson-disk-maximal:d=0.1", dim=wrap + 2), "dim must be 1 to 4096"),
                (lambda: koksma.generate("random", 1 << 20, 4096), "1048576 points in 4096 dimensions"),
                (lambda: koksma.generate("random", 4, seed=1 << 64), "seed must be 0 to"),
                (lambda: koksma.generate("random", 4, threads=wrap + 1), "threads must be 0 to"),
                (lambda: koksma.generate("random", 4, threads=-1), "threads must be 0 to"),
                (lambda: koksma.measure(points, threads=-wrap), "threads must be 0 to"),
                (lambda: koksma.verify(points, threads=wrap), "threads must be 0 to"),
                (lambda: koksma.spectrum(points, wrap + 16), "half must be 1 to 4096"),
                (lambda: koksma.spectrum(points, -1), "half must be 1 to 4096"),
                (lambda: koksma.spectrum(points, 16, threads=wrap), "threads must be 0 to"),
                (lambda: koksma.render("ball", size=(wrap + 8, 8)), "width must be 1 to 65536"),
                (lambda: koksma.render("ball", size=(8, -8)), "height must be 1 to 65536"),
                (lambda: koksma.render("ball", spp=wrap + 1), "spp must be 1 to 1048576"),
                (lambda: koksma.render("ball", seed=-1), "seed must be 0 to 18446744073709551615"),
                (lambda: koksma.render("ball", spp=1, size=(8, 8), threads=wrap), "threads must be 0 to")):
            with self.subTest(line), self.assertRaisesRegex(koksma.ArgumentError, "^" + line):
                call()
        for call in (lambda: koksma.spectrum(points, 16.0), lambda: koksma.generate("random", 4, threads=2.0),
                     lambda: koksma.render("ball", spp=1.0)):
            with self.assertRaises(TypeError):
                call()
        self.assertEqual(koksma.spectrum(points, np.uint8(4), threads=np.int8(1)).power.shape, (9, 9))

    def test_inputs_are_not_written_to(self):
        points = koksma.generate("random", 100)
        points.flags.writeable = False
        before = points.copy()
        koksma.measure(points, "star")
        koksma.verify(points)
        koksma.spectrum(points, 4)
        np.testing.assert_array_equal(points, before)

    def test_no_copies(self):
        points = koksma.generate("random", 100)
        self.assertTrue(np.shares_memory(points, _points.as_points(points)))
        self.assertEqual(_points.view(points).xs[7], points.ravel()[7])
        for array in (points, koksma.generate("poisson-disk-maximal:d=0.1"), koksma.render("ball", spp=1, size=(8, 6))):
            self.assertTrue(array.flags.c_contiguous and array.flags.writeable)


class Compare(unittest.TestCase):
    def test_numbers_are_the_programs(self):
        images = [koksma.render("checker-45", "regular", 4, size=(31, 24), seed=k) for k in range(3)]
        reference = koksma.render("checker-45", "jittered", 256, size=(31, 24))
        with tempfile.TemporaryDirectory() as folder:
            names = [f"{folder}/{k}.pfm" for k in range(3)] + [f"{folder}/reference.pfm"]
            for k, name in enumerate(names[:3]):
                subprocess.run([PROGRAM, "render", "checker-45", "-q", "-p", "regular", "-n", "4", "-s", str(k), "--size",
                                "31x24", "-o", name], check=True, stdout=subprocess.DEVNULL)
            subprocess.run([PROGRAM, "render", "checker-45", "-q", "-p", "jittered", "-n", "256", "--size", "31x24", "-o",
                            names[3]], check=True, stdout=subprocess.DEVNULL)
            for count in (1, 3):
                metrics = ["rmse", "relmse:epsilon=0.001", "hdr-flip"]
                row = json.loads(subprocess.run([PROGRAM, "compare", *names[:count], names[3], "--json", "-m",
                                                 ",".join(metrics)], check=True, capture_output=True).stdout.splitlines()[-1])
                self.assertEqual((row.pop("image"), row.pop("reference")), (names[0] if count == 1 else "mean", names[3]))
                ours = koksma.compare(iter(images[:count]), reference, metrics=metrics[1:], coherence=True)
                self.assertEqual(list(ours.metrics), metrics)
                for name, found in ours.metrics.items():
                    self.assertEqual((found.robust, found.top_share), (row.pop(f"{name}_robust"), row.pop(f"{name}_top_share")))
                    self.assertTrue(found.value == row.pop(name) if name != "rmse" else abs(found.value - ours.rmse) < 1e-15)
                self.assertEqual({key: getattr(ours, key) for key in row if row[key] is not None},
                                 {key: row[key] for key in row if row[key] is not None})
                self.assertEqual(ours.images, count)
        one = koksma.compare(images[0][:, :, 0], reference[:, :, 0].tolist())
        self.assertEqual(repr(one), repr(koksma.compare([images[0][:, :, 0]], reference[:, :, :1])))

    def test_bands_and_noise(self):
        random = np.random.default_rng(7)
        noise = random.standard_normal((50, 37))
        bands = 0.5 * np.cos(2 * np.pi * 5 * np.arange(37) / 37)
        self.assertFalse(koksma.compare(noise, 0 * noise).coherent)
        seen = koksma.compare(noise + bands, 0 * noise)
        self.assertTrue(seen.coherent and abs(seen.frequency_x - 5 / 37) < 1e-12 and seen.frequency_y == 0)
        # With metrics it is found only where it is asked for, and the other numbers are the same.
        for asked, looks in ((None, False), (True, True), (False, False)):
            other = koksma.compare(noise + bands, 0 * noise, metrics=["smape"], coherence=asked)
            self.assertEqual((other.mean, other.sd, other.max, other.rmse, other.coherent), (seen.mean, seen.sd, seen.max, seen.rmse, looks))
            self.assertTrue(other.coherence == seen.coherence if looks else np.isnan([other.coherence, other.noise_high, other.p]).all())
            self.assertEqual("bands" in other._repr_html_(), looks)
        self.assertTrue(np.isnan(koksma.compare(noise + bands, 0 * noise, coherence=False).coherence))
        none = koksma.compare(noise, noise)
        self.assertTrue(none.mean == 0 and np.isnan(none.coherence) and not none.coherent)

    def test_fireflies(self):
        image = np.full((40, 50), 1.25)
        image[3, 4] = image[10, 10] = 1000
        with self.assertWarnsRegex(RuntimeWarning, "0.1 % of the pixels carry 100 % .* without them rmse is 0.25$"):
            seen = koksma.compare(image, np.ones((40, 50)), metrics=["smape"])
        self.assertTrue(seen.metrics["rmse"].value > 20 and seen.metrics["smape"].top_share < 0.01)
        self.assertEqual(list(koksma.compare(image, image, metrics=["smape:epsilon=0.010"]).metrics), ["rmse", "smape:epsilon=0.010"])
        for wrong in ("smape", ["smap"], ["smape:epsilon=x"], [3]):
            with self.subTest(metrics=wrong), self.assertRaises((ValueError, TypeError)):
                koksma.compare(image, image, metrics=wrong)

    def test_what_is_no_image(self):
        image = np.zeros((4, 5))
        for images, reference in (([], image), (image, np.zeros((4, 6))), (np.zeros((4, 5, 2)), image), (image, [0.5]),
                                  (image + 1j, image), (np.full((4, 5), np.nan), image), (3, image)):
            with self.subTest(images=images), self.assertRaises((ValueError, TypeError)):
                koksma.compare(images, reference)


MEMBERS = [name for name, member in vars(koksma.Value).items() if isinstance(member, property)]


def members(value):
    """All of a Value, as text: some are NaN."""
    return repr([getattr(value, name) for name in MEMBERS])


class Again(unittest.TestCase):
    """Calls that were short before take a way of their own: they give and refuse the same."""

    def test_values_and_points(self):
        for n in (16, 64):
            points = koksma.generate("random", n, seed=3)
            for name in ("star", "l2-star", "extreme", "min-distance"):
                first = koksma.measure(points, name)
                for given in (points, np.asfortranarray(points), points.astype(">f8"), points[::-1][::-1], points.tolist()):
                    again = koksma.measure(given, name)
                    self.assertEqual(members(again), members(first))
                locked = points.copy()
                locked.flags.writeable = False
                self.assertEqual(members(koksma.measure(locked, name)), members(first))
                with self.assertRaises(ValueError):
                    koksma.measure(points + 1, name)
        for pattern in ("random", "sobol", "n-rooks"):
            for arguments in ({}, {"dim": 2}, {"seed": 3}, {"seed": np.uint64(3)}):
                first = koksma.generate(pattern, 16, **arguments)
                again = koksma.generate(pattern, 16, **arguments)
                np.testing.assert_array_equal(again, first)
                self.assertIsNot(again, first)
                out = np.zeros((16, 2))
                seed = {k: v for k, v in arguments.items() if k == "seed"}
                self.assertIs(koksma.generate(pattern, out=out, **seed), out)
                np.testing.assert_array_equal(out, first)
                out.flags.writeable = False
                with self.assertRaises(ValueError):
                    koksma.generate(pattern, out=out)
            for wrong in ({"n": 16.0}, {"n": 16, "dim": 2.0}, {"n": 16, "seed": 1.0}, {"n": "16"}):
                with self.assertRaises(TypeError):
                    koksma.generate(pattern, **wrong)


class Memory(unittest.TestCase):

    def test_memory_goes_with_the_last_view(self):
        freed, really = [], _library.core().koksma_points_fini
        with mock.patch.object(_library.core(), "koksma_points_fini", lambda p: freed.append(1) or really(p)):
            view = koksma.generate("poisson-disk-maximal:d=0.1")[1:].T
            self.assertIsInstance(view, np.ndarray)
            self.assertEqual(freed, [])
            del view
            gc.collect()
            self.assertEqual(freed, [1])


class Texts(unittest.TestCase):
    def test_no_builtin_name_is_replaced(self):
        names = {}
        exec("from koksma import *", names)
        self.assertEqual({name for name in set(names) & set(dir(builtins)) if not name.startswith("__")}, set())
        self.assertTrue(issubclass(koksma.SystemError, koksma.Error))


class Spectra(unittest.TestCase):
    def test_power_against_numpy(self):
        x = koksma.generate("jittered", 64, seed=3)
        k = np.arange(-5, 6)
        waves = np.exp(-2j * np.pi * (k[None, :, None] * x[:, 0] + k[:, None, None] * x[:, 1]))
        expected = abs(waves.sum(axis=2))**2 / len(x)
        for exact in (True, False):
            s = koksma.spectrum(x, 5, exact=exact)
            np.testing.assert_allclose(s.power, expected, atol=1e-7)
        self.assertEqual(s.frequency.tolist(), [1, 2, 3, 4, 5])
        self.assertTrue(np.isnan(s.standard_error).all())

    def test_several_sets(self):
        s = koksma.spectrum((koksma.generate("random", 100, seed=i) for i in range(50)), 16)
        self.assertEqual(s.sets, 50)
        self.assertLess(abs(s.ring_power.mean() - 1), 0.1)
        self.assertFalse(np.isnan(s.standard_error).any())
        x, y = koksma.generate("random", 32, seed=1), koksma.generate("random", 16, seed=2)
        one, mean = koksma.spectrum(x, 8).power, koksma.spectrum([x, y], 8).power
        for same in (x.tolist(), tuple(map(tuple, x)), list(x), [x], (x.tolist(),), x[None], np.asmatrix(x), iter([x])):
            np.testing.assert_array_equal(koksma.spectrum(same, 8).power, one)
        for same in ((x, y), [x.tolist(), y.tolist()], (points for points in (x, y))):
            np.testing.assert_array_equal(koksma.spectrum(same, 8).power, mean)
        for bad in (x[0], x[0].tolist(), [[0.1, 0.2], [0.3]], [[[]]], np.ma.array(x, mask=x > 0.5)):
            with self.subTest(bad=bad), self.assertRaises(ValueError):
                koksma.spectrum(bad, 8)
        with self.assertRaises(koksma.ArgumentError):
            koksma.spectrum([], 16)
        with self.assertRaises(koksma.ArgumentError):
            koksma.spectrum(np.zeros((4, 3)), 16)


class Rendering(unittest.TestCase):
    def test_same_bits_as_the_program(self):
        self.assertIn("ball", koksma.scenes())
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "ball.pfm")
            program("render", "ball", "-p", "multi-jittered", "-n", "4", "--size", "40x30", "-s", "9", "-q", "-o", path)
            image = koksma.render("ball", "multi-jittered", 4, size=(40, 30), seed=9)
            self.assertEqual(image.shape[:2], (30, 40))
            np.testing.assert_array_equal(image, koksma.read_image(path))
            np.testing.assert_array_equal(image, koksma.read_image(pathlib.Path(path)))

    def test_groups_of_uses(self):
        patterns = ["random", "pixel+time=scan-time", "light+lens=sobol"]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "balls.pfm")
            program("render", "balls", *(word for p in patterns for word in ("-p", p)), "-n", "16", "--size", "12x9", "-q",
                    "-o", path)
            image = koksma.render("balls", ";".join(patterns), 16, size=(12, 9))
            np.testing.assert_array_equal(image, koksma.read_image(path))
        separate = koksma.render("balls", "random;pixel=jittered;time=random", 16, size=(12, 9))
        self.assertTrue((image != separate).any())
        for pattern, said in (("pixel+tme=random", "no such use"), ("pixel+lens=scan-time", "have 4 dimensions together"),
                              ("pixel+time=random;time=random", "use time already has a pattern")):
            with self.assertRaisesRegex(koksma.Error, said):
                koksma.render("balls", pattern, 16, size=(12, 9))

    def test_a_path_is_a_file(self):
        scene = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes", "ball.json")
        expected = koksma.render("ball", spp=1, size=(8, 6))
        np.testing.assert_array_equal(koksma.render(pathlib.Path(scene), spp=1, size=(8, 6)), expected)
        with self.assertRaisesRegex(koksma.MissingError, "ball: can't be read"):
            koksma.render(pathlib.Path("ball"))


class Unknown(unittest.TestCase):
    def test_parts_of_scenes(self):
        """Of a scene of pbrt: refused in the block, in its thread, and only there."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "odd.pbrt")
            with open(path, "w", encoding="ascii") as file:
                file.write('Camera "perspective" Film "rgb" "integer xresolution" 4 "integer yresolution" 3 WorldBegin\n'
                           'LightSource "goniometric" "rgb I" [9 9 9]\nShape "sphere"\n')
            before = koksma.render(path, spp=1)
            with koksma.refuse_unknown():
                for call in (lambda: koksma.render(path), lambda: koksma.rank(path, ["random"]),
                             lambda: koksma.datasheet("random", scenes=[path], quick=True)):
                    with self.assertRaisesRegex(koksma.MalformedError, "odd.pbrt:2: light 'goniometric'.* refuse scenes"):
                        call()
                koksma.render("ball", spp=1, size=(4, 3))
            np.testing.assert_array_equal(before, koksma.render(path, spp=1))


class Code(unittest.TestCase):
    """exec: and plugin: run by the caller's word alone."""

    def test_sets(self):
        for pattern in ("n-rooks", "sobol:scramble=owen"):
            stack = koksma.generate(pattern, 16, 3, seed=5, sets=4)
            self.assertEqual(stack.shape, (4, 16, 3))
            for i in range(4):
                np.testing.assert_array_equal(stack[i], koksma.generate(pattern, 16, 3, seed=5 + i))
            room = np.zeros((4, 16, 3))
            self.assertIs(koksma.generate(pattern, seed=5, sets=4, out=room), room)
            np.testing.assert_array_equal(room, stack)
            for array in (stack, np.asfortranarray(stack), stack.astype(np.float32)):
                values = koksma.measure(array, "l2-star")
                self.assertEqual(values.tolist(), [koksma.measure(each, "l2-star").value for each in array])
            self.assertEqual(list(koksma.measure(stack, ["star", "l2-star"])), ["star", "l2-star"])
        for wrong in ({"sets": 0}, {"sets": 2, "first": 1}, {"sets": 2, "warp": "concentric-disk"}, {"sets": 3, "out": room}):
            self.assertRaises(koksma.ArgumentError, koksma.generate, "sobol", 16, 3, **wrong)
        self.assertRaises(koksma.ArgumentError, koksma.generate, "sobol", sets=2)
        self.assertRaises(koksma.ArgumentError, koksma.measure, np.zeros((0, 4, 2)), "star")
        self.assertRaises(koksma.ArgumentError, koksma.measure, stack, "star", warp="concentric-disk")

    def test_programs(self):
        sampler = "exec:" + os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "samplers", "stratified.py")
        with self.assertRaises(PermissionError) as refused:
            koksma.generate(sampler, 8)
        self.assertIsInstance(refused.exception, koksma.ForbiddenError)
        points = koksma.generate(sampler, 8, 3, seed=5, allow_exec=True)
        self.assertEqual(points.shape, (8, 3))
        self.assertEqual(sorted((8 * points[:, 0]).astype(int)), list(range(8)))
        with koksma.allow_exec(30):
            np.testing.assert_array_equal(koksma.generate(sampler, 8, 3, seed=5), points)
            threaded = threading.Thread(target=lambda: self.assertRaises(koksma.ForbiddenError, koksma.generate, sampler, 8))
            threaded.start()
            threaded.join()
        self.assertRaises(koksma.ForbiddenError, koksma.generate, sampler, 8)
        self.assertRaises(koksma.ArgumentError, lambda: koksma.allow_exec(0).__enter__())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])

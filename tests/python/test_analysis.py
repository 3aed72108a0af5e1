#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Trials, convergence, pair correlation, pictures and studies of the Python package, against the program KOKSMA (in the
environment) and against numpy; and the examples of all docstrings."""
import csv
import doctest
import importlib
import inspect
import io
import json
import math
import os
import pathlib
import pickle
import pkgutil
import re
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

import numpy as np

import koksma

PROGRAM = os.environ["KOKSMA"]
PLAN = {"name": "small", "title": "Small", "discrepancies": [
    {"id": "d", "patterns": ["random", "jittered", "sobol:scramble=owen"], "measures": ["star", "l2-star"], "n": [4, 16],
     "trials": 5, "quick": 2}]}


def rows(*arguments):
    done = subprocess.run([PROGRAM, *arguments, "--json"], check=True, capture_output=True, text=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


class Series(unittest.TestCase):
    def test_trials_are_the_programs(self):
        for pattern, measure, dim in [("jittered", "l2-star", 2), ("random", "star", 3), ("sobol:scramble=owen", "disk:r=0.2", 2)]:
            ours = koksma.trials(pattern, 64, measure, dim=dim, trials=12, seed=5)
            (theirs,) = rows("measure", f"pattern:{pattern}@64@{dim}", "-m", measure, "--trials", "12", "-s", "5")
            self.assertAlmostEqual(ours.mean, theirs["value"], delta=1e-14)
            self.assertAlmostEqual(ours.sd, theirs["sd"], delta=1e-12)
            self.assertAlmostEqual(ours.standard_error, theirs["standard_error"], delta=1e-12)
            self.assertEqual(float(ours), ours.mean)
            self.assertTrue(ours.interval[0] < ours.mean < ours.interval[1])

    def test_interval_is_students(self):
        values = koksma.trials("random", 8, trials=4).values
        half = 3.182446305284263 * values.std(ddof=1) / 2  # t of 3 degrees of freedom, from tables
        low, high = koksma.trials("random", 8, trials=4).interval
        self.assertAlmostEqual(high - low, 2 * half, delta=1e-9)

    def test_screen_errors_are_the_programs(self):
        ours = koksma.screen_errors("z-sampler", 2, 3, filter="box:size=4", trials=3, seed=7)
        theirs = rows("curve", "screen", "z-sampler@2@3", "--filter", "box:size=4", "--trials", "3", "--seed", "7")
        for a, b in zip(ours, theirs):
            self.assertEqual((a.coordinates, a.plain, a.plain_error, a.blurred, a.blurred_error), tuple(
                b[k] for k in ("coordinates", "plain", "plain_standard_error", "blurred", "blurred_standard_error")))
        self.assertEqual((len(ours), len(theirs)), (3, 3))
        with self.assertRaises(koksma.ArgumentError):
            koksma.screen_errors("random", 1, filter="box:size=40")

    def test_convergence_is_the_programs(self):
        sizes = [16, 64, 256]
        ours = koksma.convergence("sobol:scramble=owen", "l2-star", sizes, trials=6)
        theirs = rows("measure", "--prefixes", "16,64,256", "pattern:sobol:scramble=owen@256", "-m", "l2-star", "--trials", "6")
        np.testing.assert_allclose(ours.mean, [r["value"] for r in theirs[:3]], rtol=1e-13)
        slope = theirs[3]
        self.assertAlmostEqual(ours.slope, slope["value"], delta=1e-12)
        self.assertAlmostEqual(ours.slope_error, slope["standard_error"], delta=1e-12)
        line = np.polyfit(np.log(sizes), np.log(ours.mean), 1)[0]
        self.assertAlmostEqual(ours.slope, line, delta=1e-12)

    def test_one_set_has_residuals(self):
        """The slope of a deterministic pattern has the error of the residuals, however many trials; a shift makes it random."""
        sizes = [16, 64, 256]
        one, five = (koksma.convergence("sobol", "min-distance", sizes, trials=t) for t in (1, 5))
        x, y = np.log(sizes), np.log(one.mean)
        residuals = y - np.polyval(np.polyfit(x, y, 1), x)
        error = math.sqrt(residuals @ residuals / (len(x) - 2) / ((x - x.mean()) @ (x - x.mean())))
        self.assertAlmostEqual(one.slope_error, error, delta=1e-12)
        self.assertEqual((five.slope, five.slope_error), (one.slope, one.slope_error))
        shifted = koksma.convergence("sobol:shift=1", "min-distance", sizes, trials=5)  # the same distances for every shift
        self.assertLess(shifted.slope_error, 1e-12)

    def test_no_sequence_has_sets_of_each_size(self):
        ours = koksma.convergence("n-rooks", "star", [16, 64, 256], trials=3)
        for k, n in enumerate(ours.sizes):
            np.testing.assert_array_equal(ours.values[:, k], koksma.trials("n-rooks", int(n), trials=3).values)
        with self.assertRaisesRegex(koksma.ArgumentError, "no sequence"):
            koksma.convergence("n-rooks", "star", prefixes=True)

    def test_files_of_each_size_are_no_sequence(self):
        """file:NAME_{n}.npy has another file for each n; without {n} the first points of one file are the sets."""
        with tempfile.TemporaryDirectory() as folder:
            for n in (4, 8, 16):
                np.save(os.path.join(folder, f"f_{n}_0.npy"), koksma.generate("n-rooks", n, seed=n))
            for name, nested in (("f_{n}_{seed}.npy", False), ("f_16_{seed}.npy", True)):
                pattern = "file:" + os.path.join(folder, name)
                ours = koksma.convergence(pattern, "l2-star", [4, 8, 16])
                sets = [koksma.generate("n-rooks", 16 if nested else n, seed=16 if nested else n)[:n] for n in (4, 8, 16)]
                np.testing.assert_array_equal(ours.values[0], [koksma.measure(points, "l2-star").value for points in sets])
                done = subprocess.run([os.environ["KOKSMA"], "measure", "--prefixes", "4,8,16", f"pattern:{pattern}@16", "-m", "l2-star"],
                                      capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0 if nested else 2, done.stderr)
            engine = koksma.Engine("file:" + os.path.join(folder, "f_{n}_{seed}.npy"), seed=0)
            np.testing.assert_array_equal(engine.random(4), koksma.generate("n-rooks", 4, seed=4))

    def test_how_many_are_exact(self):
        sampled = koksma.trials("random", 16, "disk-sampled", trials=3)
        self.assertEqual((sampled.exact, sampled.are_exact.tolist()), (0, [False] * 3))
        exact = koksma.trials("random", 16, "star", trials=3)
        self.assertEqual((exact.exact, (exact - exact).exact), (3, 3))
        half = koksma.Trials(exact.pattern, exact.measure, 16, 2, 0, exact.values, np.array([True, False, True]))
        other = koksma.Trials(exact.pattern, exact.measure, 16, 2, 0, exact.values, np.array([False, True, True]))
        self.assertEqual((half.exact, (half - other).exact), (2, 1))

    def test_values_are_equal_to_themselves(self):
        points = koksma.generate("random", 16)
        for measure in koksma.measures():
            try:
                value, again = koksma.measure(points, measure.name), koksma.measure(points, measure.name)
            except koksma.Error:
                continue
            self.assertEqual(value, again)
            self.assertEqual(value, pickle.loads(pickle.dumps(again)))
            self.assertEqual(hash(value), hash(again))
        self.assertNotEqual(koksma.measure(points), koksma.measure(points, "extreme"))
        self.assertEqual(koksma.measure(points), koksma.measure(points).value)

    def test_rates(self):
        self.assertEqual(koksma.convergence("random", "star", [4, 16, 64]).proven, -0.5)
        self.assertEqual(koksma.convergence("jittered", "star", [4, 16, 64]).proven, -0.75)

    def test_many_measures(self):
        points = koksma.generate("hammersley", 32)
        every = koksma.measure(points, ["star", "l2-star", "extreme"])
        self.assertEqual(list(every), ["star", "l2-star", "extreme"])
        for name, value in every.items():
            one = koksma.measure(points, name)
            self.assertEqual((value.value, value.witness), (one.value, one.witness))

    def test_pair_correlation_by_the_definition(self):
        points, r_max, bins = koksma.generate("n-rooks", 40, seed=3), 0.4, 10
        gaps = np.abs(points[:, None] - points)
        distance = np.hypot(*np.minimum(gaps, 1 - gaps).transpose(2, 0, 1))[~np.eye(40, dtype=bool)]
        edges = np.linspace(0, r_max, bins + 1)
        expected = np.histogram(distance, edges)[0] / (40 * 39 * np.pi * np.diff(edges**2))
        np.testing.assert_allclose(koksma.pair_correlation(points, r_max, bins).density, expected, rtol=1e-12)
        both = koksma.pair_correlation([points, koksma.generate("random", 40)], r_max, bins)
        self.assertEqual(both.sets, 2)

    def test_wrong(self):
        for bad in (dict(trials=0), dict(seed=-1)):
            with self.assertRaises(ValueError):
                koksma.trials("random", 4, **bad)
        with self.assertRaisesRegex(ValueError, "did you mean 'star'"):
            koksma.trials("random", 4, "starr")


class Pictures(unittest.TestCase):
    def test_points(self):
        sets = [koksma.generate(p, 16) for p in ("n-rooks", "sobol")]
        picture = koksma.plot(*sets, witness="star", captions=["n-rooks", "sobol"])
        root = xml.etree.ElementTree.fromstring(picture.svg)
        self.assertTrue(root.tag.endswith("svg"))
        self.assertIn("<svg", picture._repr_svg_())
        self.assertEqual(picture.bytes("png")[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(picture.bytes("pdf")[:5], b"%PDF-")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.svg"
            picture.save(path)
            self.assertEqual(len(path.read_text().splitlines()), len(picture.svg.splitlines()))
            with self.assertRaises(ValueError):
                picture.save(path.with_suffix(".gif"))

    def test_moved_points_are_another_picture(self):
        points = koksma.generate("n-rooks", 16)
        before = koksma.plot(points).svg
        points[0] = 0.5
        self.assertNotEqual(before, koksma.plot(points).svg)

    def test_points_that_change_later_leave_a_picture_alone(self):
        points = koksma.generate("n-rooks", 16)
        picture = koksma.plot(points, witness="star")
        before = picture.svg
        points[:] = koksma.generate("n-rooks", 16, seed=1)
        self.assertEqual(before, picture.svg)

    def test_convergence(self):
        results = [koksma.convergence(p, "star", [4, 16, 64], trials=2) for p in ("random", "sobol")]
        svg = koksma.plot_convergence(*results).svg
        self.assertEqual([svg.count("<circle"), svg.count("<polygon")], [3 + 1, 3 + 1])  # each pattern has its mark
        for word in ("Convergence of star", "random: slope", "sobol: slope", ">16<", ">64<"):
            self.assertIn(word, svg)
        alone = koksma.plot_convergence(results[1], theme="light").svg
        colour = lambda text: re.findall(r'<g stroke="(#\w+)" fill="none" stroke-width="1.5"', text)[-1]
        self.assertEqual(colour(svg), colour(alone))  # sobol's, alone and beside another

    def test_compare(self):
        patterns = ["random", "sobol:scramble=owen"]
        picture = koksma.plot_compare(*patterns, n=64, sizes=[16, 64], trials=3, seed=5)
        # points, random's means and the legend's mark; sobol's, which are squares, and two bands of standard errors
        self.assertEqual([picture.svg.count("<circle"), picture.svg.count("<polygon")], [2 * 64 + 2 + 1, 2 + 1 + 2])
        self.assertEqual(picture.svg.count("<image"), 2)
        for word in ("random, n = 64", "sobol:scramble=owen, n = 64", "Radial mean", "Convergence of l2-star", "sobol:scramble=owen: slope"):
            self.assertIn(word, picture.svg)
        again = koksma.plot_compare(*patterns, n=64, sizes=[16, 64], trials=3, seed=5)
        self.assertEqual(picture.svg, again.svg)
        for call in (lambda: koksma.plot_compare(), lambda: koksma.plot_compare("jittered", n=17), lambda: koksma.plot_compare("nosuch")):
            with self.assertRaises(ValueError):
                call()

    def test_wrong(self):
        points = koksma.generate("random", 4)
        for call in (lambda: koksma.plot(), lambda: koksma.plot(points, witness="l2-star"),
                     lambda: koksma.plot(points, captions=["a", "b"]), lambda: koksma.plot_convergence(),
                     lambda: koksma.plot(np.zeros((3, 1))).svg):
            with self.assertRaises(ValueError):
                call()


class Studies(unittest.TestCase):
    def test_a_plan_from_a_dict(self):
        with tempfile.TemporaryDirectory() as folder:
            done = []
            with koksma.Study(PLAN, folder) as study:
                summary = study.run(threads=1, progress=done.append)
                self.assertTrue(summary.complete)
                self.assertEqual(summary.done_now, summary.jobs)
                self.assertTrue(study.report().exists())
                results = study.rows()
            self.assertTrue(all(0 <= f <= 1 for f in done))
            text = subprocess.run([PROGRAM, "study", "export", folder], check=True, capture_output=True, text=True).stdout
            theirs = list(csv.DictReader(io.StringIO(text)))
            self.assertEqual(len(results), len(theirs))
            self.assertEqual(len(results), 3 * 2 * 2 * 5)
            for mine, row in zip(results, theirs):
                self.assertEqual((mine["pattern"], mine["what"], int(mine["n"])), (row["pattern"], row["what"], int(row["n"])))
                self.assertEqual(float(mine["value"]), float(row["value"]))
            with koksma.Study(PLAN, folder) as again:
                self.assertEqual(again.run().done_now, 0)

    def test_the_rows_are_values_of_points(self):
        with tempfile.TemporaryDirectory() as folder, koksma.Study(PLAN, folder, quick=True) as study:
            study.run()
            for row in study.rows():
                points = koksma.generate(row["pattern"], int(row["n"]), seed=int(row["seed"]))
                self.assertEqual(koksma.measure(points, str(row["what"])).value, row["value"])

    def test_tables(self):
        with tempfile.TemporaryDirectory() as folder, koksma.Study("shirley1991", folder, trials=2) as study:
            self.assertIn("5.1", study.tables())
            table = study.table("5.1")
            self.assertTrue(all(row.verdict in ("waiting", "new") and math.isnan(row.mean) for row in table))
            self.assertEqual(table[0].published[0], float(table[0].published[0]))
            with self.assertRaises(ValueError):
                study.table("no such")

    def test_audit(self):
        with tempfile.TemporaryDirectory() as folder:
            with koksma.Study(PLAN, folder) as study:
                study.run()
            done = []
            found = koksma.audit(folder, rows=20, seed=3, threads=1, progress=done.append)
            (theirs,) = rows("study", "audit", folder, "--rows", "20", "--seed", "3")
            self.assertTrue(found)
            self.assertEqual((found.rows, found.drawn, found.agree, found.other_rows, found.differences), (60, 20, 20, 0, ()))
            self.assertEqual([found.rows, found.drawn, found.agree, found.bound, found.rows_missing],
                             [theirs[key] for key in ("rows", "drawn", "agree", "wrong_below", "rows_missing")])
            self.assertTrue(0.05 < found.bound < 1 - 0.05 ** (1 / 20) + 1e-12)  # of draws with replacement at most that
            self.assertTrue(done and all(0 <= f <= 1 for f in done))
            drawn = [koksma.audit(folder, rows=20) for _ in range(2)]
            self.assertEqual((found.seed, len({a.seed for a in drawn})), (3, 2))
            everything = koksma.audit(folder, rows=None)
            self.assertEqual((everything.drawn, everything.bound), (60, 0))

    def test_audit_of_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaises(koksma.MissingError):
                koksma.audit(folder)
            for wrong in ({"rows": 0}, {"rows": -1}, {"seed": -1}, {"threads": -1}):
                with self.assertRaises(koksma.ArgumentError):
                    koksma.audit(folder, **wrong)

    def test_wrong(self):
        for plan in ({"name": "x"}, "nosuch", {**PLAN, "colour": 1}):
            with self.assertRaises(koksma.Error):
                koksma.Study(plan)
        wrong = {"name": "x", "title": "x", "colour": 1}
        for plans, where in ((wrong, r"^line 4 of json.dumps\(plan, indent=1\): "), ([PLAN, wrong], r"^line 4 of json.dumps\(plan\[1\], "),
                             ([json.dumps(wrong)], r"^plan '\(text\)': line 1: "), ([PLAN, json.dumps(wrong)], r"^plan '\(text 2\)': ")):
            with self.assertRaisesRegex(koksma.MalformedError, where):
                koksma.Study(plans)
        study = koksma.Study(PLAN)
        study.close()
        study.close()
        with self.assertRaisesRegex(koksma.ArgumentError, "closed"):
            study.run()
        self.assertIn("shirley1991", koksma.plans())

    def test_paths(self):
        """Relative paths of a dict start at the present directory, and its rows have the pattern's text as it is."""
        before = os.getcwd()
        plan = {"name": "p", "title": "P", "discrepancies": [{"patterns": ["file:p.txt"], "measures": ["star"], "n": [4], "trials": 1}]}
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                np.savetxt("p.txt", koksma.generate("sobol", 4))
                with koksma.Study(plan, "s") as study:
                    self.assertEqual(study.run().done_now, 1)
                    self.assertEqual(study.rows()["pattern"].tolist(), ["file:p.txt"])
                with koksma.Study((), "s") as study:  # the text is in the folder
                    self.assertEqual(study.run().done_before, 1)
                    study.report()
                self.assertEqual(sorted(os.listdir()), ["p.txt", "s"])
                pathlib.Path("p.txt").write_text("0.5 x\n")
                with self.assertRaisesRegex(koksma.MalformedError, "p.txt"):
                    koksma.Study((), "s")
            finally:
                os.chdir(before)


class Docstrings(unittest.TestCase):
    def test_examples(self):
        before, names = os.getcwd(), [m.name for m in pkgutil.iter_modules(koksma.__path__) if m.name not in ("_program", "mitsuba")]  # which needs Mitsuba
        with tempfile.TemporaryDirectory() as folder:  # some write files
            os.chdir(folder)
            try:
                for module in (koksma, *(importlib.import_module(f"koksma.{name}") for name in names)):
                    self.assertEqual(doctest.testmod(module).failed, 0, module.__name__)
            finally:
                os.chdir(before)

    def test_readme(self):
        """The lines of README, as they stand there."""
        with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "README.md"), encoding="utf-8") as file:
            code, = re.findall(r"^```python\n(.*?)^```", file.read(), re.M | re.S)
        space = {}
        exec(compile(code, "README.md", "exec"), space)
        self.assertEqual(space["points"].shape, (16, 2))
        self.assertGreater(space["value"].value, 0)
        self.assertLessEqual(abs(float(space["integral"]) - 2**-5), 1e-5)
        self.assertEqual(space["image"].ndim, 3)
        self.assertEqual(space["engine"].random(4).shape, (4, 2))

    def test_functions(self):
        """Every public function says what it takes, under its names, and has an example that is run."""
        for name in koksma.__all__:
            function = getattr(koksma, name)
            if not inspect.isfunction(function):
                continue
            text = inspect.getdoc(function)
            with self.subTest(name=name):
                examples = doctest.DocTestParser().get_examples(text)
                self.assertIn("Examples\n--------\n", text)
                run = [e for e in examples if not e.options.get(doctest.SKIP) and f"{name}(" in e.source]
                self.assertTrue(run or name == "allow_exec", "no example calls it")  # which takes a program
                takes = [p for p in inspect.signature(function).parameters]
                part = text.partition("Parameters\n----------\n")[2].partition("\n\n")[0]
                said = {word.strip(" *") for line in part.splitlines() if not line.startswith(" ") for word in line.partition(" :")[0].split(",")}
                self.assertEqual(set(takes), said)


if __name__ == "__main__":
    unittest.main()

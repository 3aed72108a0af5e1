#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Warps, searches for scenes, checks of scenes, images in files and records: against the program KOKSMA (in the environment), closed
forms and NumPy."""
import json
import os
import subprocess
import tempfile
import unittest

import numpy as np

import koksma


def program(*arguments, code=0):
    done = subprocess.run([os.environ["KOKSMA"], *arguments], capture_output=True, text=True)
    assert done.returncode == code, done.stderr
    return done.stdout


class Warps(unittest.TestCase):
    def test_same_bits_as_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "p.npy")
            for warp in koksma.warps():
                program("generate", "sobol:scramble=owen", "-n", "100", "-s", "3", "--warp", warp.name, "-o", path)
                ours = koksma.generate("sobol:scramble=owen", 100, seed=3, warp=warp.name)
                np.testing.assert_array_equal(ours, np.load(path), warp.name)
                np.testing.assert_array_equal(ours, koksma.warp_points(koksma.generate("sobol:scramble=owen", 100, seed=3), warp.name))

    def test_ranges_and_files(self):
        far = koksma.generate("sobol", 8, first=1 << 33, warp="polar-disk")
        np.testing.assert_array_equal(far, koksma.warp_points(koksma.generate("sobol", 8, first=1 << 33), "polar-disk"))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "p.npy")
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
        rows = [json.loads(line) for line in program("measure", "--prefixes", "16,64", "--warp", "concentric-disk", "-m", "edge",
                                                     "pattern:sobol@64", "--json").splitlines()]
        self.assertEqual(list(ours.mean), [row["value"] for row in rows[:2]])
        self.assertTrue(np.isnan([ours.proven, ours.best]).all())
        sets = koksma.convergence("jittered", "edge", [16, 64], warp="concentric-disk", trials=2)
        for t in range(2):
            for i, n in enumerate((16, 64)):
                value = koksma.measure(koksma.generate("jittered", n, seed=t), "edge", warp="concentric-disk").value
                self.assertEqual(sets.values[t, i], value)


class Values(unittest.TestCase):
    def test_local_discrepancy(self):
        points = koksma.generate("random", 50, 3, seed=4)
        for corner in ([0.5, 0.25, 0.75], [1, 1, 1], points[7], (0, 0.3, 0.9)):
            inside = (points < np.array(corner)).all(axis=1).mean()
            self.assertAlmostEqual(koksma.local_discrepancy(points, corner), inside - np.prod(corner), 15)
        row = json.loads(program("measure", "--at", "0.3,0.7", "pattern:jittered@16", "--json"))
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
        rows = [json.loads(line) for line in program("list", "records", "--json").splitlines()]
        self.assertEqual([(r.measure, r.n, r.dim, r.value, r.seed) for r in koksma.records()],
                         [(r["measure"], r["n"], r["dim"], r["value"], r["seed"]) for r in rows])
        for record in koksma.records()[::40]:
            points = koksma.generate(f"record:measure={record.measure}", record.n, record.dim)
            self.assertAlmostEqual(float(koksma.measure(points, record.measure)), record.value, 12)


class Scenes(unittest.TestCase):
    def test_check(self):
        for name in ("ball", "cornell", "many-lights"):
            rows = [json.loads(line) for line in program("scene", "check", name, "--json").splitlines()]
            found = koksma.check_scene(name)
            for kind in ("shapes", "meshes", "placements", "triangles", "materials", "lights"):
                self.assertEqual(getattr(found, kind), rows[0][kind])
            self.assertEqual(found.warnings, ())
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "odd.pbrt")
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
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "image.pfm")
            program("render", "many-lights", "--integrator", "path", "--size", "24x18", "-n", "2", "-q", "-o", path)
            image = koksma.render("many-lights", spp=2, size=(24, 18), integrator="path")
            np.testing.assert_array_equal(image, koksma.read_image(path))
            self.assertFalse(np.array_equal(image, koksma.render("many-lights", spp=2, size=(24, 18), integrator="path", lights="all")))

    def test_probes(self):
        layers = koksma.render("checker", spp=4, size=(24, 18), adaptive="hierarchical", probes=4, layers=True)
        with tempfile.TemporaryDirectory() as folder:
            row = json.loads(program("render", "checker", "-n", "4", "--size", "24x18", "--adaptive", "hierarchical", "--probe", "4",
                                     "-q", "--json", "-o", os.path.join(folder, "i.pfm")).splitlines()[0])
        self.assertGreater(layers.splits, 0)
        self.assertEqual((layers.splits, layers.needless / layers.splits), (row["splits"], row["needless"]))
        with self.assertRaisesRegex(koksma.ArgumentError, "probes 3"):
            koksma.render("ball", spp=1, size=(4, 4), probes=3)


if __name__ == "__main__":
    unittest.main()

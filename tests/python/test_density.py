# SPDX-License-Identifier: Apache-2.0
"""Points with a density and on models from Python: the program's bits, shapes, refusals."""
import os
import subprocess
import tempfile
import unittest

import numpy as np

import koksma


class Density(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.map = np.ones((8, 8), np.float32)
        self.map[:, 4:] = 3

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def program(self, *arguments):
        out = self.path("out.npy")
        subprocess.run([os.environ["KOKSMA"], "generate", *arguments, "-q", "-o", out], check=True)
        return np.load(out)

    def test_the_programs_bits(self):
        file, model = self.path("map.pfm"), self.path("model.off")
        koksma.write_image(file, self.map)
        with open(model, "w", encoding="ascii") as f:
            f.write("OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 2 3\n")
        for pattern in ("random", "sample-elimination", "progressive-elimination"):
            ours = koksma.generate(pattern, 200, seed=3, density=self.map)
            np.testing.assert_array_equal(ours, koksma.generate(pattern, 200, seed=3, density=file, threads=2))
            np.testing.assert_array_equal(ours, self.program(pattern, "-n", "200", "-s", "3", "--density", file))
            self.assertTrue(120 < (ours[:, 0] > 0.5).sum() < 180)
            ours = koksma.generate(pattern, 200, 7, seed=3, on=model)
            np.testing.assert_array_equal(ours, self.program(pattern, "-n", "200", "-d", "7", "-s", "3", "--on", model))
            np.testing.assert_array_equal(ours[:, :3], koksma.generate(pattern, 200, seed=3, on=model))
            np.testing.assert_array_equal(ours[:, 3:6], np.where(ours[:, 6:] == 0, [0, 0, 1], [1, 0, 0]))

    def test_rectangles(self):
        for pattern in ("random", "sample-elimination"):
            ours = koksma.generate(pattern, 50, seed=3, domain=(8, 2.5))
            np.testing.assert_array_equal(ours, self.program(pattern, "-n", "50", "-s", "3", "--domain", "8:2.5"))
            self.assertTrue(((ours >= 0) & (ours < [8, 2.5])).all() and (ours.max(0) > [6, 1.5]).all())
        wide = koksma.generate("sample-elimination", 50, density=self.map[:4])  # a picture of 2 : 1
        np.testing.assert_array_equal(wide * [2, 1], koksma.generate("sample-elimination", 50, density=self.map[:4], domain=(2, 1)))

    def test_refusals(self):
        koksma.write_image(self.path("dark.pfm"), 0 * self.map)
        for error, said, arguments in (
                (koksma.ArgumentError, "number of points is missing", {"n": None, "density": self.map}),
                (koksma.ArgumentError, "number of points is missing", {"n": None, "domain": (2, 1)}),
                (koksma.ArgumentError, "exclude first and out", {"on": "x.obj", "density": self.map}),
                (koksma.ArgumentError, "exclude first and out", {"on": "x.obj", "domain": (2, 1)}),
                (koksma.ArgumentError, "exclude first and out", {"first": 1, "domain": (2, 1)}),
                (koksma.ArgumentError, "warp excludes", {"warp": "triangle", "domain": (2, 1)}),
                (koksma.ArgumentError, "width, height", {"domain": (2, 1, 1)}),
                (koksma.ArgumentError, "width and height are above 0", {"domain": (0, 1)}),
                (koksma.ArgumentError, "width and height are above 0", {"domain": (float("nan"), 1)}),
                (koksma.MissingError, "none.obj", {"on": self.path("none.obj")}),
                (koksma.MissingError, "none.pfm", {"density": self.path("none.pfm")}),
                (koksma.ArgumentError, "2 dimensions", {"dim": 3, "density": self.map}),
                (koksma.MalformedError, "^the density is 0 everywhere", {"density": 0 * self.map}),
                (koksma.MalformedError, "dark.pfm: the density is 0 everywhere", {"density": self.path("dark.pfm")})):
            with self.assertRaisesRegex(error, said):
                koksma.generate("random", **{"n": 5, **arguments})
        with self.assertRaisesRegex(koksma.UnsupportedError, "can't make points with a density"):
            koksma.generate("sobol", 5, density=self.map)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Masks of the package are the program's, and their quality is that of NumPy's sums."""
import json
import os
import subprocess
import tempfile
import unittest

import numpy as np

import koksma

PROGRAM = os.environ["KOKSMA"]


def program(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True).stdout


class Masks(unittest.TestCase):
    def test_same_as_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            for space, options, ours in (("scalar", ["--levels", "8", "--open"], dict(levels=8, open=True)), ("sphere", ["-s", "3"], dict(seed=3))):
                path = os.path.join(folder, space + ".npy")
                row = json.loads(program("mask", "-o", path, "--size", "12x9", "--space", space, "--swaps", "30", "-f", "box:size=3", "--json", *options))
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
        with tempfile.TemporaryDirectory() as folder:
            mask = koksma.mask(size=(6, 5), space="vector2", swaps=2)
            self.assertEqual(mask.shape, (5, 6, 2))
            for name, bits in (("a.npy", 0), ("a.png", 16), ("a.png", 8)):
                path = os.path.join(folder, name)
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
        with tempfile.TemporaryDirectory() as folder:
            masks = [koksma.mask("box:size=3", (12, 10), swaps=20, seed=s) for s in range(2)]
            masks[1] = (np.roll(masks[0], (3, 5), (0, 1)) + masks[1]) / 2
            paths = [os.path.join(folder, name) for name in ("a.npy", "b.npy")]
            for path, mask in zip(paths, masks):
                koksma.write_mask(path, mask)
            rows = [json.loads(line) for line in program("mask", "check", *paths, "--correlation", "5", "--json").splitlines()]
        a, b = (np.fft.fft2(mask.astype(float) - mask.mean(dtype=float)) for mask in masks)
        both = np.fft.ifft2(np.conj(a) * b).real / np.sqrt((abs(a)**2).sum() * (abs(b)**2).sum()) * a.size
        self.assertEqual(np.unravel_index(np.argmax(abs(both)), both.shape), (3, 5))
        np.testing.assert_allclose([row["correlation"] for row in rows], [both[row["dy"], row["dx"]] for row in rows], atol=1e-12)


if __name__ == "__main__":
    unittest.main()

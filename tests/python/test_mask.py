#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Masks of the package are the program's, and their quality is that of NumPy's sums."""
import json
import os
import re
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

    def test_page(self):
        """The tables of the page are NumPy's: correlations of two masks, and a ramp that Bayer's matrix dithers, filtered."""
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, name) for name in ("a.npy", "b.npy", "page.html")]
            masks = [koksma.mask("box:size=3", (12, 10), swaps=20, seed=s) for s in range(2)]
            masks[1] = (np.roll(masks[0], (3, 5), (0, 1)) + masks[1]) / 2
            for path, mask in zip(paths, masks):
                koksma.write_mask(path, mask)
            program("mask", "check", *paths[:2], "-o", paths[2], "-f", "binomial:size=3")
            with open(paths[2], encoding="utf-8") as file:
                data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', file.read(), re.S).group(1))
        tables = {}

        def walk(node):
            if isinstance(node, dict) and node.get("kind") == "table":
                tables[node["name"]] = node["rows"]
            for inner in node.values() if isinstance(node, dict) else node if isinstance(node, list) else ():
                walk(inner)
        walk(data)
        number = lambda cell: cell["value"] if isinstance(cell, dict) else cell
        a, b = (np.fft.fft2(mask.astype(float) - mask.mean(dtype=float)) for mask in masks)
        both = np.fft.ifft2(np.conj(a) * b).real / np.sqrt((abs(a)**2).sum() * (abs(b)**2).sum()) * a.size
        at = np.unravel_index(np.argmax(abs(both)), both.shape)
        self.assertEqual(at, (3, 5))
        np.testing.assert_allclose([number(c) for c in tables["pairs"][0][2:]], [both[0, 0], both[at], at[1], at[0]], atol=1e-12)
        bayer = np.zeros((1, 1))
        for _ in range(4):
            bayer = np.block([[4 * bayer, 4 * bayer + 2], [4 * bayer + 3, 4 * bayer + 1]])
        ramp = np.tile((np.arange(240) + .5) / 240, (48, 1))
        rows, columns = np.indices(ramp.shape)
        filtered = np.pad((ramp > (bayer[rows % 16, columns % 16] + .5) / 256) - ramp, 1, "edge")
        filtered = sum(w * v * filtered[i:i + 48, j:j + 240] for i, w in enumerate((.25, .5, .25)) for j, v in enumerate((.25, .5, .25)))
        error = next(number(row[2]) for row in tables["dithering"] if list(row[:2]) == ["ramp", "Bayer"])
        self.assertAlmostEqual(error, np.sqrt(np.mean(filtered**2)), 6)


if __name__ == "__main__":
    unittest.main()

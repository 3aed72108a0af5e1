#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What notebooks show of results, and the notebooks of examples/notebooks, run from the first cell to the last. Exit code 77
after the first part where nbconvert, ipykernel or IPython are not installed (`pip install nbconvert ipykernel`)."""
import os
import sys
import unittest
import xml.etree.ElementTree as ET

import numpy as np

import koksma
from koksma import _display, _frame

NOTEBOOKS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "notebooks")
try:
    import nbformat
    from IPython.core.interactiveshell import InteractiveShell
    from nbconvert.preprocessors import ExecutePreprocessor
except ModuleNotFoundError:
    nbformat = None


def cells(page):
    """The texts of an HTML table's cells, row by row."""
    return [[cell.text or "" for cell in row] for row in ET.fromstring(page).iter("tr")]


class Display(unittest.TestCase):
    def test_tables(self):
        value = koksma.measure([[0.5, 0.5]], "star")
        rows = dict(cells(value._repr_html_()))
        self.assertEqual(rows["value"], "0.75")
        self.assertEqual(float(rows["its volume"]), value.witness.volume)
        ranking = koksma.rank("checker", ["n-rooks", "random"], 4, size=(16, 12), one_size=True, max_trials=8, time_limit=None)
        head, *lines = repr(ranking).splitlines()
        self.assertRegex(head, r"^Ranking\(16 x 12 pixels, mae, (use [a-z-]+(, within [0-9.]+ % of the best( but for few pixels)?)?|undecided);")
        self.assertRegex(lines.pop(), r"^4 samples of .* random")
        self.assertEqual([line.split()[:3] for line in lines], [[str(r.position), r.pattern, f"{r.error:.5g}"] for r in ranking.rows])
        rows = cells(ranking._repr_html_())
        self.assertEqual([row[1] for row in rows[1:]], [row.pattern for row in ranking.rows])
        self.assertEqual(rows[0][2], "error (mae)")
        image = koksma.render("checker", "n-rooks", 4, size=(16, 12))
        rows = cells(koksma.compare(image, 0 * image, metrics=["smape"])._repr_html_())
        self.assertEqual([row[0] for row in rows[1:]], ["mean absolute error", "largest", "rmse", "smape"])
        found = koksma.integrate("exp", "random", [16, 64, 256])
        self.assertEqual([row[0] for row in cells(found._repr_html_())[1:]], ["16", "64", "256"])
        self.assertEqual(cells(_frame.table(["<b>"], [["a & b", float("nan")]])), [["<b>"], ["a & b", ""]])

    def test_curves(self):
        sets = [koksma.generate("n-rooks", 64, 2, seed) for seed in range(3)]
        for shown in (koksma.spectrum(sets, half=16), koksma.pair_correlation(sets),
                      koksma.convergence("n-rooks", sizes=(16, 64, 256), trials=2), koksma.plot(sets[0])):
            self.assertTrue(ET.fromstring(shown._repr_svg_()).tag.endswith("svg"), type(shown))

    def test_what_arrays_look_like(self):
        points, image = koksma.generate("n-rooks", 16), koksma.render("checker", "n-rooks", 4, size=(16, 12))
        self.assertTrue(_display.looks_like_points(points) and _display.looks_like_an_image(image))
        for other in (image, points * 2, points.T, points[:, 0], np.ones((3, 3), int), points.astype(np.float32), [[0.5, 0.5]]):
            self.assertFalse(_display.looks_like_points(other))
        for other in (points, image[:, :, 0], image * np.float32(np.nan), image.astype(float), None):
            self.assertFalse(_display.looks_like_an_image(other))
        self.assertEqual(_display.png(image)[:8], b"\x89PNG\r\n\x1a\n")

    @unittest.skipUnless(nbformat, "IPython is not installed")
    def test_the_extension(self):
        shell = InteractiveShell.instance()
        points, other = koksma.generate("n-rooks", 16), np.arange(6)
        before = shell.display_formatter.format(points)[0]
        koksma.load_ipython_extension(shell)
        self.assertEqual(shell.display_formatter.format(points)[0]["image/svg+xml"], koksma.plot(points).svg)
        self.assertEqual(set(shell.display_formatter.format(other)[0]), {"text/plain"})
        koksma.unload_ipython_extension(shell)
        self.assertEqual(shell.display_formatter.format(points)[0], before)


@unittest.skipUnless(nbformat, "nbconvert is not installed")
class Notebooks(unittest.TestCase):
    def test_they_run(self):
        names = sorted(name for name in os.listdir(NOTEBOOKS) if name.endswith(".ipynb"))
        self.assertGreaterEqual(len(names), 2)
        for name in names:
            with self.subTest(name=name), open(os.path.join(NOTEBOOKS, name), encoding="utf-8") as file:
                book = nbformat.read(file, as_version=4)
                self.assertFalse(any(cell.get("outputs") for cell in book.cells), "a notebook is kept without its outputs")
                ExecutePreprocessor(timeout=None, kernel_name="python3").preprocess(book, {"metadata": {"path": NOTEBOOKS}})
                kinds = {kind for cell in book.cells for out in cell.get("outputs", []) for kind in out.get("data", {})}
                self.assertLessEqual({"image/svg+xml" if "own" in name else "image/png", "text/html"}, kinds)


if __name__ == "__main__":
    result = unittest.main(argv=[sys.argv[0]], exit=False).result
    sys.exit(1 if not result.wasSuccessful() else 0 if nbformat else 77)

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""koksma.rank with another renderer: errors that follow from the noise that it adds, exceptions, sizes."""
import json
import math
import os
import sys
import tempfile
import unittest

import numpy as np

import koksma

DEVIATIONS = {"fine": .1, "coarse": .2}


def renderer(asked):
    """A ramp and normal noise of a known deviation."""
    if asked.pattern == "square" and math.isqrt(asked.spp) ** 2 != asked.spp:
        raise ValueError(f"square: spp {asked.spp} is no square number")
    width, height = asked.size or (40, 30)
    noise = np.random.default_rng([asked.seed, asked.spp, *asked.pattern.encode()])
    return .5 + np.linspace(0, .3, width) + DEVIATIONS[asked.pattern] / asked.spp ** .5 * noise.normal(size=(height, width))


class Renderers(unittest.TestCase):
    def test_errors(self):
        """The mean absolute value of normal noise of deviation s is s sqrt(2 / pi)."""
        asked = []
        ranking = koksma.rank("any text", ["coarse", "fine"], 4, renderer=lambda a: asked.append(a) or renderer(a))
        self.assertEqual((ranking.best, ranking.advised, ranking.size), ("fine", "fine", (40, 30)))
        for row in ranking.rows:
            low, high = row.interval
            self.assertTrue(low <= DEVIATIONS[row.pattern] / 2 * math.sqrt(2 / math.pi) <= high, row)
        self.assertEqual({a.scene for a in asked}, {"any text"})
        self.assertEqual({a.spp for a in asked}, {1, 4, 16}, "a first picture, the trials, the reference")
        self.assertTrue(all(0 <= a.seed < 1 << 31 for a in asked))
        self.assertEqual(len({(a.pattern, a.spp, a.seed) for a in asked}), len(asked), "a seed came twice")
        self.assertEqual([check.state for check in ranking.checks], ["unchecked"] * 2, "a size that nobody set")

    def test_sizes(self):
        ranking = koksma.rank("any", ["coarse", "fine"], 4, renderer=renderer, size=(48, 32), reference="fine")
        self.assertEqual([(c.size, c.state) for c in ranking.checks], [((24, 16), "confirmed"), ((96, 64), "confirmed")])

    def test_exceptions(self):
        def raises(asked):
            if asked.pattern == "fine" and asked.spp == 4:
                raise KeyError("mine")
            return renderer(asked)
        with self.assertRaisesRegex(KeyError, "mine"):
            koksma.rank("any", ["coarse", "fine"], 4, renderer=raises)

    def test_refusals(self):
        with self.assertRaisesRegex(ValueError, "the same picture for every seed"):
            koksma.rank("any", ["fine"], 4, renderer=lambda asked: np.ones((4, 4)))
        with self.assertRaisesRegex(ValueError, "^renderer: fine: an image must be an array"):
            koksma.rank("any", ["fine", "coarse"], 4, renderer=lambda asked: None)
        with self.assertRaisesRegex(ValueError, "a pattern as reference has an effect only with renderer"):
            koksma.rank("ball", ["random"], 4, reference="random")
        with self.assertRaisesRegex(ValueError, "instead of 8 x 8"):
            koksma.rank("any", ["fine"], 4, renderer=lambda asked: np.ones((4, 4)), size=(8, 8))

    def test_a_finished_reference(self):
        """Against an exact reference the error of a pattern is the mean of the images' errors: here of a constant."""
        scene = {"camera": {"eye": [0, 2, 6], "target": [0, 1, 0], "fov_deg": 40}, "background": 0.4,
                 "materials": [{"name": "m", "kind": "lambert", "albedo": 0.5}],
                 "shapes": [{"kind": "sphere", "centre": [0, 1, 50], "radius": 1, "material": "m"}]}
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "flat.json")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(scene, file)
            ranking = koksma.rank(path, ["random"], 4, reference=np.full((6, 8), .25), max_trials=8)
        self.assertEqual((ranking.size, math.isnan(ranking.reference_error)), ((8, 6), True))
        self.assertAlmostEqual(ranking.rows[0].error, .15, 6)

    def test_processed(self):
        """The images of the patterns are processed and the reference is not: a copy changes nothing, a constant makes its error."""
        more = {"size": (8, 6), "max_trials": 8, "one_size": True}
        plain = koksma.rank("ball", ["random"], 4, **more).rows[0].error
        self.assertEqual(koksma.rank("ball", ["random"], 4, process=lambda image: image, **more).rows[0].error, plain)
        ranking = koksma.rank("ball", ["random"], 4, process=lambda image: 0 * image + 2, reference=np.ones((6, 8)), max_trials=8)
        self.assertAlmostEqual(ranking.rows[0].error, 1, 6)
        noisy = koksma.rank("any", ["fine"], 4, renderer=renderer, process=lambda image: image + 1, max_trials=8).rows[0].error
        self.assertAlmostEqual(noisy, 1, 1)
        with self.assertRaisesRegex(ZeroDivisionError, "division"):
            koksma.rank("ball", ["random"], 4, process=lambda image: 1 / 0, **more)
        with self.assertRaisesRegex(ValueError, "4 x 4 pixels instead of 8 x 6"):
            koksma.rank("ball", ["random"], 4, process=lambda image: np.ones((4, 4)), **more)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Mistakes that still give a number: each has one warning, at the caller's line, and what is right has none."""
import unittest
import warnings

import numpy as np

import koksma

SMALL = dict(size=(32, 24), seed=1)
IMAGE = koksma.render("cornell", spp=4, **SMALL)
REFERENCE = koksma.render("cornell", "sobol:scramble=owen", 256, **SMALL)
RANKING = dict(patterns=["jittered", "random"], spp=4, max_trials=8, one_size=True)


class Doubts(unittest.TestCase):
    def told(self, call):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            call()
        self.assertEqual({w.filename for w in told} - {__file__}, set())
        return [str(w.message) for w in told]

    def check(self, doubtful, right):
        for said, call in doubtful:
            with self.subTest(said=said):
                told = self.told(call)
                self.assertEqual(len(told), 1, told)
                self.assertIn(said, told[0])
        for i, call in enumerate(right):
            with self.subTest(right=i):
                self.assertEqual(self.told(call), [])

    def test_images(self):
        compare = koksma.compare
        self.check([("its mean is 2", lambda: compare(IMAGE * 255, REFERENCE)), ("its mean is ", lambda: compare(IMAGE * 683, REFERENCE)),
                    ("its mean is 0.00", lambda: compare(IMAGE / 255, REFERENCE)), ("its mean is 3.", lambda: compare(IMAGE * np.pi, REFERENCE)),
                    ("image 1: its mean", lambda: compare([IMAGE, IMAGE * 255], REFERENCE)), ("same image", lambda: compare(IMAGE, IMAGE)),
                    ("are the two swapped?", lambda: compare(REFERENCE, IMAGE)), ("has colours", lambda: compare(IMAGE @ [0.2126, 0.7152, 0.0722], REFERENCE)),
                    ("another scene", lambda: compare(IMAGE[::-1], REFERENCE))],
                   [lambda: compare(IMAGE, REFERENCE), lambda: compare([IMAGE, IMAGE * 0.9], REFERENCE), lambda: compare(IMAGE * 1.1, REFERENCE)])

    def test_references_and_processes(self):
        ball = koksma.render("ball", "sobol:scramble=owen", 256, **SMALL)

        def rank(reference=None, process=None):
            size = SMALL["size"] if reference is None else None
            return lambda: koksma.rank("ball", reference=reference, process=process, size=size, **RANKING)

        self.check([("the light of the reference", rank(ball * 255)), ("another scene", rank(ball[:, ::-1])),
                    ("more noise than a picture of 4", rank(koksma.render("ball", "random", 1, **SMALL))),
                    ("a processed picture of ball has 25", rank(process=lambda x: x * 255)),
                    ("the light of the reference", lambda: koksma.rank_to_error("ball", 0.1, ["random"], reference=ball * 255, time_limit=1))],
                   [rank(ball), rank(process=lambda x: (x + np.roll(x, 1, 0)) / 2), rank(),
                    lambda: koksma.rank_to_error("ball", 0.1, ["random"], reference=ball)])


if __name__ == "__main__":
    unittest.main()

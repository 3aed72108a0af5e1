#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Mistakes that still give a number: each has one warning, at the caller's line, and what is right has none."""
import math
import tempfile
import unittest
import warnings

import numpy as np

import koksma

SMALL = dict(size=(32, 24), seed=1)
IMAGE = koksma.render("cornell", spp=4, **SMALL)
REFERENCE = koksma.render("cornell", "sobol:scramble=owen", 256, **SMALL)
RANKING = dict(patterns=["jittered", "random"], spp=4, max_trials=8, one_size=True)


class Frame:
    """What of a pandas.DataFrame is asked for."""

    def __init__(self, array, columns):
        self._array, self.columns = array, columns

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self._array, dtype)


class Tensor(Frame):
    """What a torch.Tensor with a gradient does."""
    ndim = 2

    def __init__(self):
        pass

    def __array__(self, dtype=None, copy=None):
        raise RuntimeError("Can't call numpy() on Tensor that requires grad. Use tensor.detach().numpy() instead.")

    def __repr__(self):
        return "tensor([0.1], requires_grad=True)"


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
                    ("are the two swapped?", lambda: compare(*[koksma.render("ball", spp=spp, **SMALL) for spp in (256, 4)])), ("has colours", lambda: compare(IMAGE @ [0.2126, 0.7152, 0.0722], REFERENCE)),
                    ("in reverse", lambda: compare(IMAGE[..., ::-1], REFERENCE)), ("another scene", lambda: compare(IMAGE[::-1], REFERENCE)),
                    ("was it interrupted", lambda: compare(IMAGE * (np.arange(24) < 12)[:, None, None], REFERENCE))],
                   [lambda: compare(REFERENCE ** (1 / 2.2), IMAGE),  # its gamma is no noise: the two are not swapped
                    lambda: compare(2 * IMAGE * (np.random.default_rng(1).random((24, 32, 1)) < 0.5), REFERENCE),
                    lambda: compare(IMAGE, REFERENCE), lambda: compare([IMAGE, IMAGE * 0.9], REFERENCE), lambda: compare(IMAGE * 1.1, REFERENCE)])

    def test_references_and_processes(self):
        ball = koksma.render("ball", "sobol:scramble=owen", 256, **SMALL)

        def rank(reference=None, process=None):
            size = SMALL["size"] if reference is None else None
            return lambda: koksma.rank("ball", reference=reference, process=process, size=size, **RANKING)

        self.check([("the light of the reference", rank(ball * 255)), ("another scene", rank(ball[:, ::-1])),
                    ("the reference has noise", rank(koksma.render("ball", "random", 1, **SMALL))),
                    ("was it interrupted", rank(ball * (np.arange(24) < 12)[:, None, None])),
                    ("a processed picture of ball has 25", rank(process=lambda x: x * 255)),
                    ("the light of the reference", lambda: koksma.rank_to_error("ball", 0.1, ["random"], reference=ball * 255, time_limit=1))],
                   [rank(ball), rank(process=lambda x: (x + np.roll(x, 1, 0)) / 2), rank(),
                    lambda: koksma.rank_to_error("ball", 0.1, ["random"], reference=ball)])

    def test_integrals(self):
        def product(x):
            return x[:, 0] * x[:, 1]

        def with_integral(integral, pattern, n=(64, 256, 1024), function=product):
            return lambda: koksma.integrate(function, pattern, list(n), integral=integral)

        patterns = ("random", "sobol:scramble=owen", "sobol")
        self.check([*((f"integral {wrong}", with_integral(wrong, p)) for p in patterns for wrong in (0.3, 4)),
                    ("confidence 0.05", lambda: koksma.integrate(product, 2, tolerance=0.01, confidence=0.05)),
                    ("tolerance 1e-12 is not reached", lambda: koksma.integrate(product, 2, tolerance=1e-12, max_points=4096)),
                    ("all 73728 values are 0", lambda: koksma.integrate(lambda x: 0 * x[:, 0], 2, tolerance=0.01)),
                    ("the integral may be infinite", lambda: koksma.integrate(lambda x: x[:, 0] ** -2, 1, tolerance=0, n=8192, replicates=8))],
                   [*(with_integral(0.25, p) for p in patterns), with_integral(0.3, "sobol", (100, 101, 102)), with_integral(math.nan, "random"),
                    *(with_integral(1e-4, p, function=lambda x: 1.0 * (x.max(axis=1) < 0.01)) for p in patterns),
                    lambda: koksma.integrate(product, 2, tolerance=0.01, confidence=0.5)])

    def test_mistakes_in_integrals(self):
        def in_three(x):
            return x[:, 0] * x[:, 2]

        for call, said in ((lambda: koksma.integrate(in_three, tolerance=0.01), "its points have 2 dimensions"),
                           (lambda: koksma.integrate(in_three, "sobol", 4), "its points have 2 dimensions"),
                           (lambda: koksma.integrate(in_three, 3, tolerance=0.01, bounds=[[0, 0], [1, 1], [1, 2]]), r"list\(zip\(lower, upper\)\)"),
                           (lambda: float(koksma.integrate(in_three, "sobol", [4, 8], 3)), r"\.mean\[-1\] is the last")):
            with self.assertRaisesRegex(koksma.ArgumentError, said):
                call()
        self.assertEqual(float(koksma.integrate(in_three, "sobol", 4, dim=3)), koksma.integrate(in_three, "sobol", 4, dim=3).mean[0])

    def test_masks(self):
        noise, picture = koksma.mask(size=(32, 32), swaps=10), koksma.render("cornell", spp=4, size=(32, 32))
        with tempfile.TemporaryDirectory() as folder:
            mask_path, picture_path = folder + "/m.png", folder + "/p.png"
            koksma.write_mask(mask_path, noise)
            koksma.write_image(picture_path, picture)
            self.check([("read_mask has its numbers", lambda: koksma.read_image(mask_path)),
                        ("read_image reads pictures", lambda: koksma.read_mask(picture_path)),
                        ("neighbours are alike", lambda: koksma.mask_quality(np.clip(picture[..., 0], 0, 1))),
                        ("all numbers are 0.5", lambda: koksma.mask_quality(np.full((8, 8), 0.5)))],
                       [lambda: koksma.read_image(picture_path), lambda: koksma.read_mask(mask_path), lambda: koksma.mask_quality(noise),
                        lambda: koksma.mask_quality(np.arange(1024).reshape(32, 32) / 1024)])

    def test_points(self):
        points = koksma.generate("sobol:scramble=owen", 64, 2)
        weights, index = np.full((64, 1), 1 / 64), np.arange(64.0)[:, None]
        self.check([(said, lambda f=f, p=np.hstack(p): f(p)) for f in (koksma.measure, koksma.verify, koksma.identify) for said, p in (
                        ("column 3 is 0.015625 in all rows", (points, weights)), ("column 3 sums to 1", (points[:48], points[:48, :1] / points[:48, 0].sum())))]
                   + [("the first column counts the rows", lambda: koksma.identify(np.hstack((index, points)))),
                      *(("rows and columns swapped", lambda f=f: f(points.T)) for f in (koksma.verify, koksma.plot, koksma.identify)),
                      ("column 'seed' is taken as a coordinate", lambda: koksma.measure(Frame(points, ["x", "seed"]), "l2-star"))],
                   [lambda p=p: koksma.measure(p) for p in (points, Frame(points, ["u", "v"]), koksma.generate("regular", 64), koksma.generate("korobov", 55), [[0.5, 0.5]], koksma.generate("hammersley", 64))]
                   + [lambda: koksma.verify(points.repeat(2, 0))])

    def test_index(self):
        with self.assertRaisesRegex(koksma.ArgumentError, r"points\[:, 1:\] has the others"):
            koksma.measure(np.column_stack((np.arange(8), koksma.generate("sobol", 8))))

    def test_tensors(self):
        for call in (lambda: koksma.measure(Tensor()), lambda: koksma.integrate(lambda x: Tensor(), "sobol", 4), lambda: koksma.compare(Tensor(), REFERENCE)):
            with self.assertRaisesRegex((TypeError, koksma.ArgumentError), r"; x\.detach\(\)\.cpu\(\)\.numpy\(\) is an array$"):
                call()


if __name__ == "__main__":
    unittest.main()

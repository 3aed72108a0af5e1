#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The homogeneous medium of `koksma render`, judged by the equation of radiative transfer alone,

    dL/ds = -(a + b) L + b (integral over directions w' of p(w, w') L(w')),

with absorption a, scattering b and the phase function p of Henyey & Greenstein:

  - half-spaces of isotropic scatterers under parallel light and under an even sky, by the H functions of Chandrasekhar (Radiative
    Transfer, 1960): all orders of scattering
  - a room with a ball, by a path tracer of 40 lines that shares nothing with ours: collisions are drawn one by one

tests/render/test_medium.c has single scattering, the phase function and furnaces. Pixels of a picture estimate one number, or a
block of them does; no mean may be 5 standard errors off."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from numpy.polynomial.legendre import leggauss

import koksma

PROGRAM = os.environ["KOKSMA"]
MATTE = [{"name": "m", "kind": "lambert", "albedo": .5}]
AWAY = {"kind": "sphere", "centre": [0, 900, 900], "radius": 1, "material": "m"}


def phase(cosine, g):
    return (1 - g * g) / (4 * np.pi * (1 + g * g - 2 * g * cosine) ** 1.5)


def quadrature(low, high, n):
    x, w = leggauss(n)
    return low + (x + 1) / 2 * (high - low), w * (high - low) / 2


def chandrasekhar(albedo, n=200):
    """H of isotropic scattering: H(m) = 1 / (sqrt(1 - albedo) + albedo / 2 (integral of x H(x) / (m + x) from 0 to 1))."""
    x, w = quadrature(0, 1, n)
    h = np.ones(n)
    for _ in range(500):
        h = (h + 1 / (np.sqrt(1 - albedo) + albedo / 2 * (w * x * h / (x[:, None] + x)).sum(1))) / 2
    return lambda m: 1 / (np.sqrt(1 - albedo) + albedo / 2 * (w * x * h / (m + x)).sum())


def narrow(eye, target, up=(0, 1, 0)):
    """All pixels see the same but for some millionths."""
    return {"eye": list(eye), "target": list(target), "up": list(up), "fov_deg": .02}


class Medium(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def render(self, scene, spp, depth, size=(16, 12), seed=1):
        with open(self.path("scene.json"), "w", encoding="utf-8") as file:
            json.dump(scene, file)
        subprocess.run([PROGRAM, "render", self.path("scene.json"), "-p", "random", "-n", str(spp), "--size", f"{size[0]}x{size[1]}", "-s", str(seed),
                        "--depth", str(depth), "--integrator", "path", "-q", "-o", self.path("o.pfm")], check=True, stdout=subprocess.DEVNULL)
        image = koksma.read_image(self.path("o.pfm")).astype(float)
        return np.broadcast_to(image, image.shape[:2] + (3,)).reshape(-1, 3)

    def agree(self, pixels, wanted, floor=1e-4):
        wanted = np.broadcast_to(wanted, 3)
        error = pixels.std(0, ddof=1) / np.sqrt(len(pixels))
        self.assertTrue((error < .01 * wanted).all(), f"errors {error} of {wanted} are too large to see anything")
        self.assertTrue((np.abs(pixels.mean(0) - wanted) < 5 * error + floor * wanted).all(), f"{pixels.mean(0)} +- {error}, not {wanted}")

    def test_half_spaces(self):
        for albedo, out, into in ((.3, 1, 1), (.8, .5, .9), (.8, .3, .3)):
            h = chandrasekhar(albedo)
            sine, slant = np.sqrt(1 - out ** 2), np.sqrt(1 - into ** 2)
            scene = {"camera": narrow((10 * sine, 10 * out, 0), (0, 0, 0), (0, 0, 1)), "materials": MATTE, "shapes": [AWAY],
                     "medium": {"sigma_a": 1 - albedo, "sigma_s": albedo, "low": [-9e4, -80, -9e4], "high": [9e4, 0, 9e4]}}
            for light, wanted in (({"kind": "directional", "direction": [slant * .6, -into, slant * .8], "irradiance": np.pi},
                                   albedo / 4 * into / (out + into) * h(out) * h(into)),
                                  ({"kind": "environment", "radiance": 1}, 1 - h(out) * np.sqrt(1 - albedo))):
                with self.subTest(albedo=albedo, out=out, light=light["kind"]):
                    self.agree(self.render({**scene, "lights": [light]}, 600, 64), wanted)

    # A matte ball (0, 1, 0) of radius 1 on a matte floor y = 0, in a box of haze, under a point light above it.
    BOX, LIGHT, INTENSITY, ALBEDO = np.array([[-3, 0, -3], [3, 4, 3]], float), np.array([1.5, 4.8, 1]), 20, .6
    A, B, G = .05, .35, .4

    @staticmethod
    def hits(o, d):
        """The distance to the ball or the floor, and the normal."""
        t, n = np.full(len(o), np.inf), np.zeros_like(o)
        down = (d[:, 1] < -1e-9) & (o[:, 1] > 1e-7)
        t[down], n[down] = -o[down, 1] / d[down, 1], (0, 1, 0)
        e = o - (0, 1, 0)
        half, rest = (e * d).sum(1), (e * e).sum(1) - 1
        root = half ** 2 - rest
        for sign in (1, -1):
            s = -half + sign * np.sqrt(np.maximum(root, 0))
            met = (root > 0) & (s > 1e-6) & (s < t)
            t[met], n[met] = s[met], e[met] + s[met, None] * d[met]
        return t, n

    @classmethod
    def inside(cls, o, d, end):
        """Where the ray up to `end` enters the box, and its length inside."""
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (cls.BOX[:, None] - o) / np.where(d == 0, 1e-30, d)
        first, last = np.maximum(t.min(0).max(1), 0), np.minimum(t.max(0).min(1), end)
        return first, np.maximum(last - first, 0)

    @classmethod
    def lit(cls, p):
        """The direction of the light and its irradiance through the haze, 0 in shadow."""
        to = cls.LIGHT - p
        r = np.linalg.norm(to, axis=1)
        w = to / r[:, None]
        clear = cls.hits(p, w)[0] > r - 1e-6
        return w, clear * cls.INTENSITY / r ** 2 * np.exp(-(cls.A + cls.B) * cls.inside(p, w, r)[1])

    @classmethod
    def trace(cls, o, d, rng, vertices=40):
        light, weight, alive = np.zeros(len(o)), np.ones(len(o)), np.arange(len(o))
        for _ in range(vertices):
            t, n = cls.hits(o, d)
            first, length = cls.inside(o, d, t)
            s = rng.exponential(1 / (cls.A + cls.B), len(o))
            haze = s < length
            keep = haze | np.isfinite(t)
            o, d, n, t, haze, alive = (x[keep] for x in (o, d, n, np.where(haze, first + s, t), haze, alive))
            o = o + t[:, None] * d
            w, irradiance = cls.lit(o)
            weight[alive] *= np.where(haze, cls.B / (cls.A + cls.B), cls.ALBEDO)
            light[alive] += weight[alive] * irradiance * np.where(haze, phase((w * d).sum(1), cls.G), np.maximum((w * n).sum(1), 0) / np.pi)
            u = rng.random((2, len(o)))
            turned = (1 + cls.G ** 2 - ((1 - cls.G ** 2) / (1 - cls.G + 2 * cls.G * u[0])) ** 2) / (2 * cls.G)
            axis, cosine = np.where(haze[:, None], d, n), np.where(haze, turned, np.sqrt(u[0]))
            side = np.cross(axis, np.where(np.abs(axis[:, :1]) < .5, (1., 0, 0), (0, 1., 0)))
            side /= np.linalg.norm(side, axis=1)[:, None]
            sine = np.sqrt(1 - cosine ** 2)[:, None]
            d = cosine[:, None] * axis + sine * (np.cos(2 * np.pi * u[1])[:, None] * side + np.sin(2 * np.pi * u[1])[:, None] * np.cross(axis, side))
        return light

    def test_path_tracer(self):
        """By blocks of 8 x 8 pixels, eight pictures of each."""
        scene = {"camera": {"eye": [0, 1.5, 7], "target": [0, 1.2, 0], "fov_deg": 30}, "materials": [{"name": "m", "kind": "lambert", "albedo": self.ALBEDO}],
                 "shapes": [{"kind": "plane", "centre": [0, 0, 0], "normal": [0, 1, 0], "material": "m"},
                            {"kind": "sphere", "centre": [0, 1, 0], "radius": 1, "material": "m"}],
                 "medium": {"sigma_a": self.A, "sigma_s": self.B, "g": self.G, "low": self.BOX[0].tolist(), "high": self.BOX[1].tolist()},
                 "lights": [{"kind": "point", "centre": self.LIGHT.tolist(), "intensity": self.INTENSITY}]}
        forward = np.array([0, -.3, -7]) / np.hypot(.3, 7)
        right = np.array([1., 0, 0])
        up = np.cross(right, forward)
        y, x = np.mgrid[0:24, 0:24].reshape(2, -1)
        ours, theirs = [], []
        for k in range(8):
            rng = np.random.default_rng(k)
            picture = 0
            for _ in range(24):
                u, v = (x + rng.random(576)) / 12 - 1, 1 - (y + rng.random(576)) / 12
                d = forward + np.tan(np.radians(15)) * (u[:, None] * right + v[:, None] * up)
                d /= np.linalg.norm(d, axis=1)[:, None]
                picture = picture + self.trace(np.broadcast_to((0, 1.5, 7.), d.shape), d, rng) / 24
            theirs.append(picture.reshape(3, 8, 3, 8).mean((1, 3)))
            ours.append(self.render(scene, 192, 38, (24, 24), seed=k)[:, 0].reshape(3, 8, 3, 8).mean((1, 3)))
        ours, theirs = np.array(ours), np.array(theirs)
        error = np.sqrt((ours.var(0, ddof=1) + theirs.var(0, ddof=1)) / 8)
        self.assertLess((error / theirs.mean(0)).max(), .05)
        self.assertLess((np.abs(ours.mean(0) - theirs.mean(0)) / error).max(), 5.5, f"{ours.mean(0)}\n{theirs.mean(0)}\n{error}")
        whole = ours.mean((1, 2)) - theirs.mean((1, 2))
        self.assertLess(abs(whole.mean()), 5 * whole.std(ddof=1) / np.sqrt(8))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])

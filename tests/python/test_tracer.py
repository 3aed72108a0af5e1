#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""scenes/cornell.json by an independent path tracer, by blocks and channels: at rest, cut after 0 and 5 bounces, and with both
boxes turning, moving and changing size while the shutter is open. The tracer samples the light by area at every vertex and
follows cosine-distributed directions; boxes are slabs in a frame that it turns itself, so it shares neither geometry nor
sampling with the renderer. No block's mean may be 5.5 standard errors off, and the whole picture's 5."""
import copy
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import koksma

PROGRAM = os.environ["KOKSMA"]
SCENE = json.loads((pathlib.Path(__file__).parents[2] / "scenes/cornell.json").read_text(encoding="utf-8"))
SIDE, BLOCK, PICTURES = 24, 8, 8
TURNS = ({"half": [1.2, .8, .15], "to": {"rotate_deg": [0, 110, 0], "centre": [1.7, 1, 1.9], "scale": .8}},
         {"half": [.1, 1.6, 1.2], "to": {"rotate_deg": [0, -80, 0], "centre": [3.9, 1.4, 3.3], "scale": .7}})


def turned(v, angle):
    """v rotated about y, from z to x."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * v[:, 0] + s * v[:, 2], v[:, 1], c * v[:, 2] - s * v[:, 0]], 1)


class Tracer:
    def __init__(self, scene):
        albedo = {m["name"]: np.array(m["albedo"], float) for m in scene["materials"]}
        self.walls = [(np.array(s["centre"], float), np.array(s["normal"], float), s["half"], albedo[s["material"]]) for s in scene["shapes"] if s["kind"] == "rectangle"]
        self.boxes = [s for s in scene["shapes"] if s["kind"] == "box"]
        self.box_albedo = [albedo[s["material"]] for s in self.boxes]
        light = scene["lights"][0]
        self.light, self.half, self.radiance = np.array(light["centre"], float), light["half"], np.array(light["radiance"], float)
        self.camera = scene["camera"]

    @staticmethod
    def flat(o, d, centre, normal, half):
        """The distance to a rectangle that is square to an axis, or infinity. Its half sides go along y or z, and the other."""
        k = int(np.argmax(np.abs(normal)))
        sides = {0: {2: half[0], 1: half[1]}, 1: {0: half[0], 2: half[1]}, 2: {0: half[0], 1: half[1]}}[k]
        t = (centre[k] - o[:, k]) / np.where(d[:, k] == 0, 1e-30, d[:, k])
        p = o + t[:, None] * d
        inside = (t > 1e-6) & np.all([np.abs(p[:, j] - centre[j]) <= h for j, h in sides.items()], 0)
        return np.where(inside, t, np.inf)

    def hits(self, o, d, time):
        """Distance, normal, albedo, and where the light is met."""
        best, n, albedo = np.full(len(o), np.inf), np.zeros_like(o), np.zeros_like(o)
        for centre, normal, half, a in self.walls:
            t = self.flat(o, d, centre, normal, half)
            met = t < best
            best[met], n[met], albedo[met] = t[met], normal, a
        for s, a in zip(self.boxes, self.box_albedo):
            to = s.get("to", {})
            angle = np.radians(s["angle_deg"] + time * to.get("rotate_deg", [0, 0, 0])[1])
            centre = np.array(s["centre"]) + time[:, None] * (np.array(to.get("centre", s["centre"])) - s["centre"])
            half = np.array(s["half"]) * (1 + time[:, None] * (to.get("scale", 1) - 1))
            e, f = turned(o - centre, -angle), turned(d, -angle)
            f = np.where(f == 0, 1e-30, f)
            low, high = np.minimum((-half - e) / f, (half - e) / f), np.maximum((-half - e) / f, (half - e) / f)
            axis = low.argmax(1)
            t = low.max(1)
            met = (t < high.min(1)) & (t > 1e-6) & (t < best)  # nothing starts inside
            out = np.zeros_like(o)
            out[np.arange(len(o)), axis] = -np.sign(f[np.arange(len(o)), axis])
            best[met], n[met], albedo[met] = t[met], turned(out, angle)[met], a
        t = self.flat(o, d, self.light, np.array([0., -1, 0]), self.half)
        lit = t < best
        n[lit & (d[:, 1] > 0)] = 0
        return np.where(lit, t, best), n, albedo, lit

    def picture(self, rng, spp, bounces):
        total = np.zeros((SIDE * SIDE, 3))
        y, x = np.mgrid[0:SIDE, 0:SIDE].reshape(2, -1)
        scale = np.tan(np.radians(self.camera["fov_deg"]) / 2)
        for _ in range(spp):
            u, v = ((x + rng.random(x.size)) / SIDE * 2 - 1) * scale, (1 - (y + rng.random(x.size)) / SIDE * 2) * scale
            # the camera looks along z; its right is -x
            d = np.stack([-u, v, np.ones_like(u)], 1)
            d /= np.linalg.norm(d, axis=1)[:, None]
            o, time = np.broadcast_to(np.array(self.camera["eye"], float), d.shape), rng.random(len(d))
            weight, alive = np.ones_like(d), np.arange(len(d))
            for bounce in range(bounces + 1):
                t, n, albedo, lit = self.hits(o, d, time)
                if bounce == 0:
                    total[alive[lit & (d[:, 1] > 0)]] += self.radiance
                keep = np.isfinite(t) & ~lit
                o, d, n, albedo, time, alive, weight = (q[keep] for q in (o + np.where(np.isfinite(t), t, 0)[:, None] * d, d, n, albedo, time, alive, weight))
                weight = weight * albedo
                q = self.light + (2 * rng.random((len(o), 3)) - 1) * (self.half[0], 0, self.half[1])
                to = q - o
                r = np.linalg.norm(to, axis=1)
                w = to / r[:, None]
                cosines = np.maximum((w * n).sum(1), 0) * np.maximum(w[:, 1], 0)
                reached = np.abs(self.hits(o, w, time)[0] - r) < 1e-5
                np.add.at(total, alive, weight * self.radiance * (reached * cosines / r ** 2 * 4 * self.half[0] * self.half[1] / np.pi)[:, None])
                a, b = rng.random((2, len(o)))
                side = np.cross(n, np.where(np.abs(n[:, :1]) < .5, (1., 0, 0), (0, 1., 0)))
                side /= np.linalg.norm(side, axis=1)[:, None]
                d = np.sqrt(1 - a)[:, None] * n + np.sqrt(a)[:, None] * (np.cos(2 * np.pi * b)[:, None] * side + np.sin(2 * np.pi * b)[:, None] * np.cross(n, side))
        return (total / spp).reshape(SIDE // BLOCK, BLOCK, SIDE // BLOCK, BLOCK, 3).mean((1, 3))


class Agreement(unittest.TestCase):
    def ours(self, scene, seed, bounces):
        with tempfile.TemporaryDirectory() as folder:
            path, out = os.path.join(folder, "scene.json"), os.path.join(folder, "out.pfm")
            pathlib.Path(path).write_text(json.dumps(scene), encoding="utf-8")
            subprocess.run([PROGRAM, "render", path, "--integrator", "path", "--depth", str(bounces), "-p", "random", "-n", "64", "-s", str(seed),
                            "--size", f"{SIDE}x{SIDE}", "-q", "-o", out], check=True, stdout=subprocess.DEVNULL)
            return koksma.read_image(out).astype(float).reshape(SIDE // BLOCK, BLOCK, SIDE // BLOCK, BLOCK, 3).mean((1, 3))

    def test_blocks(self):
        moving = copy.deepcopy(SCENE)
        for box, turn in zip([s for s in moving["shapes"] if s["kind"] == "box"], TURNS):
            box.update(turn)
        for name, scene, bounces in (("at rest, direct", SCENE, 0), ("at rest", SCENE, 5), ("turning", moving, 3)):
            with self.subTest(name):
                tracer = Tracer(scene)
                theirs = np.array([tracer.picture(np.random.default_rng(k), 24, bounces) for k in range(PICTURES)])
                ours = np.array([self.ours(scene, k, bounces) for k in range(PICTURES)])
                error = np.sqrt((ours.var(0, ddof=1) + theirs.var(0, ddof=1)) / PICTURES) + 1e-7
                off = ours.mean(0) - theirs.mean(0)
                self.assertLess(np.median(error / theirs.mean(0)), .03, "too noisy to see anything")
                self.assertLess((np.abs(off) / error).max(), 5.5, f"ours {ours.mean(0)}\ntheirs {theirs.mean(0)}\nerrors {error}")
                whole = ours.mean((1, 2)) - theirs.mean((1, 2))
                self.assertLess((np.abs(whole.mean(0)) / (whole.std(0, ddof=1) / np.sqrt(PICTURES))).max(), 5, f"{ours.mean((0, 1, 2))} {theirs.mean((0, 1, 2))}")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])

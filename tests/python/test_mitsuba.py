#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Koksma's samplers in Mitsuba 3: the bits of <koksma/sampler.h>, pictures without bias, variance that falls as in our
own renderer, rankings. Exit code 77: Mitsuba is not installed (scripts/try_mitsuba installs it and runs this).
KOKSMA_MITSUBA_VARIANT: another variant than scalar_rgb, such as llvm_ad_rgb."""
import os
import subprocess
import sys
import tempfile
import unittest

try:
    import mitsuba as mi
except ModuleNotFoundError:
    print("skipped: Mitsuba is not installed")
    sys.exit(77)

import drjit as dr
import numpy as np

VARIANT = os.environ.get("KOKSMA_MITSUBA_VARIANT", "scalar_rgb")
mi.set_variant(VARIANT)

import koksma  # noqa: E402
import koksma.mitsuba as km  # noqa: E402

JIT = dr.is_jit_v(mi.Float)
SIDE = 32 if JIT else 4


def cornell(pattern, spp, side=SIDE, **more):
    """Mitsuba's Cornell box with a sampler and a box filter."""
    scene = mi.cornell_box()
    scene["sensor"]["film"].update(width=side, height=side, rfilter={"type": "box"})
    own = pattern in km.OWN
    scene["sensor"]["sampler"] = {"type": pattern if own else "koksma", "sample_count": spp, **more}
    if not own:
        scene["sensor"]["sampler"]["pattern"] = pattern
    return scene


def checker(pattern, spp):
    """A diffuse plane with a checkerboard under a white sky."""
    scene = cornell(pattern, spp)
    for name in [name for name in scene if name not in ("type", "sensor", "integrator")]:
        del scene[name]
    scene["integrator"] = {"type": "direct"}
    scene["light"] = {"type": "constant", "radiance": 1.0}
    scene["plane"] = {"type": "rectangle", "bsdf": {"type": "diffuse", "reflectance": {
        "type": "checkerboard", "to_uv": mi.ScalarTransform4f().scale(6)}}}
    return scene


class Signature(mi.SamplingIntegrator):
    """A pixel's value is a mean over its samples of (x, y, x y): equal for two pixels only if they draw equal points."""

    def sample(self, scene, sampler, ray, medium=None, active=True):
        p = sampler.next_2d(active)
        return mi.Color3f(p.x, p.y, p.x * p.y), mi.Bool(True), []


mi.register_integrator("signature", Signature)


def signatures(width, height, **integrator):
    """A scene whose picture shows which points each pixel draws."""
    return {"type": "scene", "integrator": {"type": "signature", **integrator}, "sensor": {"type": "perspective", "film": {
        "type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}}}}


def shared_between(pictures):
    """The largest number of pixels of one picture whose points another has, too."""
    sets = [set(map(tuple, np.round(picture.reshape(-1, 3).astype(float), 6))) for picture in pictures]
    return max(len(a & b) for i, a in enumerate(sets) for b in sets[:i])


# films that are no multiple of a block, or smaller than one: width, height, samples, the integrator's properties
FILMS = ((35, 33, 1, {}), (33, 5, 2, {}), (5, 7, 4, {}), (10, 12, 2, {"block_size": 8}), (16, 16, 1, {}))


class Seeds(unittest.TestCase):
    """Pictures of different seeds are independent: none of their pixels has the samples of one in another picture."""

    def test_plug_in(self):
        for width, height, spp, integrator in FILMS:
            for pattern, sets in ((km.OWEN_SOBOL, 1), ("n-rooks", 32)):
                with self.subTest(film=(width, height), pattern=pattern):
                    scene = signatures(width, height, **integrator)
                    scene["sensor"]["sampler"] = {"type": "koksma", "pattern": pattern, "sample_count": spp, "sets": sets}
                    scene = mi.load_dict(scene)
                    pictures = [np.array(mi.render(scene, spp=spp, seed=seed)) for seed in range(8)]
                    self.assertEqual(shared_between(pictures), 0)
                    if pattern == km.OWEN_SOBOL:  # nor has one of the same picture
                        self.assertEqual(len(np.unique(pictures[0].reshape(-1, 3), axis=0)), width * height)
                    again = np.array(scene.integrator().render(scene, scene.sensors()[0], 3, spp))
                    np.testing.assert_array_equal(again, pictures[3])

    def test_rankings(self):
        """Likewise of Mitsuba's own samplers in rankings, whose seeds meet in scalar variants when they are handed on."""
        for width, height, spp, integrator in FILMS:
            for pattern in ("independent", "n-rooks"):
                with self.subTest(film=(width, height), pattern=pattern):
                    renderer = km.Renderer(signatures(width, height, **integrator))
                    self.assertEqual(shared_between([renderer(koksma.Asked("", pattern, spp, None, s)) for s in range(8)]), 0)


class Samplers(unittest.TestCase):
    def setUp(self):
        km.register()

    def test_bits(self):
        """koksma_sobol_2d equals sobol:scramble=hash-owen,shuffle=1 with the domain's key as the seed."""
        for key in (0, 1, 0x123456789ABCDEF0, (1 << 64) - 1):
            words = key & 0xFFFFFFFF, key >> 32
            if JIT:
                x, y = km._sobol_2d(tuple(mi.UInt32(w) for w in words), dr.arange(mi.UInt32, 256))
                got = np.stack([np.array(x), np.array(y)], 1)
            else:
                got = np.array([km._sobol_2d(words, i) for i in range(256)])
            np.testing.assert_array_equal(got / 2.0 ** 32, koksma.generate(km.OWEN_SOBOL, 256, 2, key))

    def test_sets_are_koksma_s(self):
        """The points that one pixel's use draws are a set of the pattern, whole: one in each cell for jittered."""
        sampler = mi.load_dict({"type": "koksma", "pattern": "jittered", "sample_count": 16})
        cells = set()
        if JIT:
            sampler.seed(3, 16 * 8)
            sampler.next_2d()
            p = np.array(sampler.next_2d()).T
            for pixel in range(8):
                cells = {tuple(c) for c in np.floor(p[16 * pixel:16 * pixel + 16] * 4).astype(int)}
                self.assertEqual(len(cells), 16)
        else:
            sampler.seed(3)
            for _ in range(16):
                sampler.next_2d()
                cells.add(tuple(np.floor(np.array(sampler.next_2d()) * 4).astype(int)))
                sampler.advance()
            self.assertEqual(len(cells), 16)

    def test_no_bias(self):
        """Means of the Cornell box, whose paths take a symbolic loop, agree with Mitsuba's independent sampler."""
        spp, runs = (256, 8) if JIT else (16, 4)
        means = {}
        for pattern in ("independent", km.OWEN_SOBOL, "jittered", "n-rooks"):
            scene = mi.load_dict(cornell(pattern, spp))
            values = [float(np.array(mi.render(scene, spp=spp, seed=seed)).mean()) for seed in range(runs)]
            means[pattern] = np.mean(values), np.std(values, ddof=1) / np.sqrt(runs)
        mean, error = means.pop("independent")
        for pattern, (other, other_error) in means.items():
            with self.subTest(pattern=pattern):
                self.assertLess(abs(other - mean), 5 * np.hypot(error, other_error))

    def test_less_error_than_independent(self):
        """On a slowly varying integrand jittered samples have much less variance than random ones."""
        errors = {}
        for pattern in ("random", "jittered", km.OWEN_SOBOL):
            scene = mi.load_dict(checker(pattern, 16))
            pictures = np.array([np.array(mi.render(scene, spp=16, seed=seed)) for seed in range(12)])
            errors[pattern] = pictures.std(0, ddof=1).mean()
        self.assertLess(errors["jittered"], .8 * errors["random"])
        self.assertLess(errors[km.OWEN_SOBOL], .8 * errors["random"])

    def test_equal_seeds(self):
        scene = mi.load_dict(cornell("jittered", 4))
        a, b, c = (np.array(mi.render(scene, spp=4, seed=seed)) for seed in (5, 5, 6))
        np.testing.assert_array_equal(a, b)
        self.assertTrue((a != c).any())

    def test_refusals(self):
        for wrong, reason in (({"pattern": "nothing"}, "nothing"), ({"sets": 0}, "sets must be 1 to")):
            with self.assertRaisesRegex(Exception, reason):
                mi.load_dict({"type": "koksma", "sample_count": 4, **wrong})

    @unittest.skipUnless(JIT, "scalar variants have no passes")
    def test_passes_are_refused(self):
        scene = cornell("jittered", 16)
        scene["integrator"]["samples_per_pass"] = 4
        with self.assertRaises(RuntimeError) as caught:
            mi.render(mi.load_dict(scene), spp=16)
        self.assertIn("samples_per_pass is not supported", str(caught.exception.__cause__.__cause__ or caught.exception.__cause__))


class Rankings(unittest.TestCase):
    def test_rank(self):
        names = ["independent", "jittered", "random"]
        ranking = km.rank(checker("independent", 16), names, 16, size=(8, 8), time_limit=None, max_trials=8)
        by = {row.pattern: row for row in ranking.rows}
        self.assertEqual(ranking.size, (8, 8))
        self.assertLess(by["jittered"].error, by["random"].error)

    def test_left_out(self):
        """A pattern that cannot make so many samples is named with the reason, and the others are ranked."""
        ranking = km.rank(checker("independent", 5), ["independent", "regular"], 5, size=(4, 4), time_limit=None, max_trials=8)
        self.assertEqual([row.state for row in ranking.rows], ["ranked", "refused"])
        self.assertIn("5", ranking.rows[1].reason)

    def test_a_sampler_is_replaced_however_it_is_written(self):
        """Files as people write them: the ranking's sampler takes the place of the file's, of which there may be none."""
        lines = '<integer name="sample_count" value="9"/>'
        plain = f'<sampler type="multijitter">{lines}</sampler>'
        film = '<film type="hdrfilm"><integer name="width" value="7"/><integer name="height" value="5"/></film>'
        view = '<transform name="to_world"><lookat origin="0, 0, 5" target="0, 0, 0" up="0, 1, 0"/></transform>'
        sensor = '<sensor type="perspective">{0}</sensor>'
        styles = {
            "without a name": sensor.format(view + plain + film),
            "with a name": sensor.format(view + plain.replace("type", 'name="sampler" type') + film),
            "with another name": sensor.format(view + plain.replace("type", 'name="my_sampler" type') + film),
            "with an id": sensor.format(view + film + plain.replace("type", 'id="sampler" type')),
            "in one tag": sensor.format(view + '<sampler type="independent"/>' + film),
            "none": sensor.format(view + film),
            "before everything, in single quotes": sensor.format(f"<sampler type='ldsampler' >\n{lines}<!-- 9 --></sampler>\n" + film + view),
            "defaults": '<default name="spp" value="9"/><default name="kind" value="stratified"/>' + sensor.format(
                view + '<sampler type="$kind"><integer name="sample_count" value="$spp"/></sampler>' + film),
            "referred to": plain.replace("type", 'id="s" type') + sensor.format(view + '<ref id="s"/>' + film),
            "referred to by a name": plain.replace("type", 'id="s" type') + sensor.format(view + '<ref name="sampler" id="s"/>' + film),
            "two sensors": 2 * sensor.format(view + plain + film),
            "in an included file": '<include filename="camera.xml"/>',
            "an older version": sensor.format(view.replace("to_world", "toWorld") + plain.replace("sample_count", "sampleCount") + film),
        }
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "camera.xml"), "w", encoding="utf-8") as file:
                file.write(f'<scene version="3.0.0">{sensor.format(view + plain + film)}</scene>')
            for style, text in styles.items():
                path = os.path.join(folder, "scene.xml")
                version = "0.6.0" if style == "an older version" else "3.0.0"
                with open(path, "w", encoding="utf-8") as file:
                    file.write(f'<?xml version="1.0"?>\n<scene version="{version}"><integrator type="direct"/>{text}'
                               '<shape type="sphere"/><emitter type="constant"/></scene>')
                for pattern, kind in (("jittered", "KoksmaSampler"), ("independent", "IndependentSampler")):
                    with self.subTest(style=style, pattern=pattern):
                        scene = km.Renderer(path).load(pattern, 4, (6, 4))
                        for camera in scene.sensors():
                            self.assertEqual((camera.sampler().sample_count(), tuple(camera.film().size())), (4, (6, 4)))
                            self.assertIn(kind, str(camera.sampler()))

    def test_xml_and_command(self):
        with tempfile.TemporaryDirectory() as folder:
            scene, out = os.path.join(folder, "scene.xml"), os.path.join(folder, "out.exr")
            config = mi.parser.ParserConfig(mi.variant())
            mi.parser.write_file(mi.parser.parse_dict(config, checker("independent", 4)), scene)
            subprocess.run([sys.executable, "-m", "koksma.mitsuba", scene, "jittered", "4", "1", "6", "5", out], check=True,
                           env={**os.environ, "KOKSMA_MITSUBA_VARIANT": VARIANT})
            picture = koksma.read_image(out)
            self.assertEqual(picture.shape, (5, 6, 3))
            np.testing.assert_allclose(picture, km.Renderer(scene)(koksma.Asked(scene, "jittered", 4, (6, 5), 1)), rtol=1e-3)
            for wrong, said in (((scene, "independant"), r"^koksma\.mitsuba: no sampler 'independant': Mitsuba has independent, stratified"),
                                ((scene, "sobl"), r"^koksma\.mitsuba: no pattern 'sobl'; did you mean 'sobol'"),
                                (("no.xml", "jittered"), r"^koksma\.mitsuba: .*no\.xml")):
                done = subprocess.run([sys.executable, "-m", "koksma.mitsuba", *wrong, "4", "1", "6", "5", out], capture_output=True, text=True,
                                      env={**os.environ, "KOKSMA_MITSUBA_VARIANT": VARIANT})
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, said)
                self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])

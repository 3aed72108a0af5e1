#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Scenes that Mitsuba 3 renders and that `koksma render` reads, by blocks: Mitsuba's own Cornell box; ours, written for
Mitsuba from its JSON file; and scenes of glass, rough metal, rough glass, textures, environments and lights that reflect.
Every block's means of independent pictures must agree within their standard errors, and so must the whole picture's.
Exit code 77: Mitsuba is not installed. KOKSMA_MITSUBA_PICTURES: pictures of each renderer (8 when left out)."""
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

try:
    import mitsuba as mi
except ModuleNotFoundError:
    print("skipped: Mitsuba is not installed")
    sys.exit(77)

import numpy as np

import koksma

mi.set_variant("scalar_rgb")
PROGRAM = os.environ["KOKSMA"]
PICTURES = int(os.environ.get("KOKSMA_MITSUBA_PICTURES", "8"))
SIDE, BLOCK = 32, 8
SCENES = pathlib.Path(__file__).parents[2] / "scenes"


def scene(inside, depth=64, eye="0, 1, 6", target="0, 1, 0", fov=39):
    return f"""<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="{depth}"/></integrator>
<sensor type="perspective"><float name="fov" value="{fov}"/><transform name="to_world"><lookat origin="{eye}" target="{target}"
 up="0, 1, 0"/></transform><film type="hdrfilm"><integer name="width" value="{SIDE}"/><integer name="height" value="{SIDE}"/>
<rfilter type="box"/></film></sensor>{inside}</scene>"""


def rgb(name, value):
    return f'<rgb name="{name}" value="{value}"/>'


def diffuse(value):
    return f'<bsdf type="twosided"><bsdf type="diffuse">{rgb("reflectance", value)}</bsdf></bsdf>'


def rectangle(inside, *operations):
    return f'<shape type="rectangle"><transform name="to_world">{"".join(operations)}</transform>{inside}</shape>'


def turn(axis, angle):
    return f'<rotate {axis}="1" angle="{angle}"/>'


def move(x=0, y=0, z=0):
    return f'<translate x="{x}" y="{y}" z="{z}"/>'


def ball(bsdf):
    return f'<shape type="sphere"><float name="radius" value="0.6"/><point name="center" x="0" y="0.7" z="0"/>{bsdf}</shape>'


def emitter(value):
    return f'<emitter type="area">{rgb("radiance", value)}</emitter>'


ROOM = "".join([rectangle(diffuse("0.7, 0.6, 0.5"), turn("x", -90)),
                rectangle(diffuse("0.6, 0.7, 0.7"), move(y=1, z=-1)),
                rectangle(diffuse("0.6, 0.1, 0.1"), turn("y", 90), move(x=-1, y=1)),
                rectangle(diffuse("0.1, 0.5, 0.1"), turn("y", -90), move(x=1, y=1))])
PANEL = rectangle(emitter("5, 4, 3"), turn("x", 90), move(y=2.5))
WHITE = '<string name="material" value="none"/>'
GGX = '<string name="distribution" value="ggx"/>'


class Agreement(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def ours(self, path, spp, seed, depth):
        out = self.path("ours.pfm")
        subprocess.run([PROGRAM, "render", path, "--integrator", "path", *([] if depth is None else ["--depth", str(depth)]), "--spp", str(spp), "--seed",
                        str(seed), "--size", f"{SIDE}x{SIDE}", "-p", "random", "-q", "-o", out, "--unknown", "refuse"], check=True, stdout=subprocess.DEVNULL)
        return koksma.read_image(out)

    def agree(self, theirs, path, spp=256, depth=62, floor=1e-4):
        """Welch's statistic of every block and channel, and of the whole picture."""
        def blocks(image):
            image = np.asarray(image, dtype=float)[:, :, :3]
            image = np.broadcast_to(image, image.shape[:2] + (3,))
            return image.reshape(SIDE // BLOCK, BLOCK, SIDE // BLOCK, BLOCK, 3).mean((1, 3))
        a = np.array([blocks(mi.render(theirs, spp=spp, seed=s)) for s in range(PICTURES)])
        b = np.array([blocks(self.ours(path, spp, s, depth)) for s in range(PICTURES)])
        for x, y, limit in ((a, b, 6.5), (a.mean((1, 2)), b.mean((1, 2)), 5)):
            error = np.sqrt((x.var(0, ddof=1) + y.var(0, ddof=1)) / PICTURES) + floor * np.abs(x.mean(0)) + 1e-7
            z = (y.mean(0) - x.mean(0)) / error
            self.assertLess(np.abs(z).max(), limit, f"theirs {x.mean(0)}\nours {y.mean(0)}\nerrors {error}")
        mean, error = a.mean(), a.mean((1, 2, 3)).std(ddof=1) / np.sqrt(PICTURES)
        self.assertLess(error, .01 * mean)  # the comparison has the power to see differences of a few percent

    def of_text(self, text, **more):
        path = self.path("scene.xml")
        pathlib.Path(path).write_text(text, encoding="utf-8")
        self.agree(mi.load_file(path), path, **more)

    def test_serialized_meshes(self):
        """Two meshes of one file in both versions: a rectangle with normals and texture coordinates, under a checkerboard, and a
        bare octahedron. It is flat: of smooth normals we lose what they reflect below the surface."""
        corners = [(-1, 0, 0), (1, 0, 0), (1, 2, 0), (-1, 2, 0)]
        texels = [(0, 0), (2, 0), (2, 1), (0, 1)]
        tips = [(1, 0, 0), (-1, 0, 0), (0, 1.5, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
        sides = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]

        def stream(version, flags, arrays, triangles):
            single = flags & 0x1000
            data = struct.pack("<I", flags) + (b"mesh\0" if version == 4 else b"")
            data += struct.pack("<QQ", len(arrays[0]), len(triangles))
            data += b"".join(struct.pack("<f" if single else "<d", x) for array in arrays for row in array for x in row)
            data += b"".join(struct.pack("<3I", *triangle) for triangle in triangles)
            return struct.pack("<HH", 0x041C, version) + zlib.compress(data)
        for version in (3, 4):
            first = stream(version, 0x1003, [corners, [(0, 0, 1)] * 4, texels], [(0, 1, 2), (0, 2, 3)])
            second = stream(version, 0x2000, [tips], sides)
            ends = struct.pack("<2I" if version == 3 else "<2Q", 0, len(first)) + struct.pack("<I", 2)
            pathlib.Path(self.path("two.serialized")).write_bytes(first + second + ends)
            named = '<string name="filename" value="two.serialized"/>'
            checks = f'<texture type="checkerboard" name="reflectance">{rgb("color0", "0.7, 0.3, 0.2")}{rgb("color1", 0.2)}</texture>'
            self.of_text(scene(
                f'<shape type="serialized">{named}<transform name="to_world">{move(z=-1)}</transform>'
                f'<bsdf type="twosided"><bsdf type="diffuse">{checks}</bsdf></bsdf></shape>'
                f'<shape type="serialized">{named}<integer name="shape_index" value="1"/>'
                f'<boolean name="face_normals" value="true"/><transform name="to_world">'
                f'<scale value="0.5"/>{move(y=.8)}</transform>{diffuse("0.5, 0.6, 0.7")}</shape>'
                f'<emitter type="constant">{rgb("radiance", 0.6)}</emitter>', depth=3), depth=1)

    def test_meshes_without_normals(self):
        """A bowl of 6 x 8 patches, open to the sides that see it, is smooth in every format; as OBJ also in groups."""
        rings, spokes = 6, 8
        places = [(np.cos(2 * np.pi * j / spokes) * i / rings, .6 * (i / rings) ** 2, np.sin(2 * np.pi * j / spokes) * i / rings)
                  for i in range(1, rings + 1) for j in range(spokes)] + [(0, 0, 0)]
        last, at = len(places) - 1, lambda i, j: i * spokes + j % spokes
        faces = [(last, at(0, j + 1), at(0, j)) for j in range(spokes)]
        for i, j in ((i, j) for i in range(rings - 1) for j in range(spokes)):
            faces += [(at(i, j), at(i, j + 1), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i + 1, j))]
        obj = "".join(f"v {x} {y} {z}\n" for x, y, z in places)
        groups = "".join(f"g {k // 20}\nf " + " ".join(str(c + 1) for c in face) + "\n" for k, face in enumerate(faces))
        pathlib.Path(self.path("bowl.obj")).write_text(obj + groups, encoding="utf-8")
        header = f"ply\nformat ascii 1.0\nelement vertex {last + 1}\nproperty float x\nproperty float y\nproperty float z\n"
        pathlib.Path(self.path("bowl.ply")).write_text(
            header + f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
            + "".join(f"{x} {y} {z}\n" for x, y, z in places) + "".join("3 %d %d %d\n" % face for face in faces), encoding="utf-8")
        light = f'<emitter type="directional"><vector name="direction" x="-0.3" y="-1" z="-0.2"/>{rgb("irradiance", 3)}</emitter>'
        for kind in ("obj", "ply"):
            with self.subTest(format=kind):
                self.of_text(scene(f'<shape type="{kind}"><string name="filename" value="bowl.{kind}"/>{diffuse("0.8")}</shape>' + light,
                                   depth=2, eye="0, 5, 2", target="0, .3, 0", fov=18), depth=None)

    def test_what_the_camera_sees(self):
        """Lights that it does not see, planes that clip, and direct light alone; the file says how long paths are."""
        light = rectangle(emitter("9, 8, 7"), '<scale value="0.4"/>', move(y=1, z=2)) + '<emitter type="constant"/>'
        block = f'<shape type="cube"><transform name="to_world"><scale value="0.4"/>{turn("y", 30)}{move(y=.7)}</transform>{diffuse("0.5")}</shape>'
        inside = ROOM + light + block  # behind a hidden light Mitsuba 3.9.1 shades spheres as if all their normals were the camera's
        hide = '<boolean name="hide_emitters" value="true"/></integrator>'
        for name, text in (("hidden", scene(inside).replace("</integrator>", hide)),
                           ("direct", scene(inside).replace('"path"><integer name="max_depth" value="64"/>', '"direct">')),
                           ("near", scene(inside).replace("<film", '<float name="near_clip" value="5.7"/><film')),
                           ("far", scene(inside).replace("<film", '<float name="far_clip" value="6"/><film')),
                           ("short", scene(inside, depth=3))):
            with self.subTest(name=name):
                self.of_text(text, depth=None)

    def test_checkerboards(self):
        """Texture coordinates of a cube's six sides and of a rectangle, there mapped by a matrix: the phase of their squares."""
        checks = (f'<bsdf type="twosided"><bsdf type="diffuse"><texture type="checkerboard" name="reflectance">'
                  f'{rgb("color0", "0.8, 0.4, 0.1")}{rgb("color1", 0.1)}<transform name="to_uv"><scale x="1.5" y="1.5"/></transform>'
                  '</texture></bsdf></bsdf>')
        floor = checks.replace('<scale x="1.5" y="1.5"/>', f'{move(x=.2, y=.1)}<scale x="2.5" y="1.5"/>{turn("z", 20)}')
        for angle in (35, 215):
            self.of_text(scene(
                f'<shape type="cube"><transform name="to_world"><scale value="0.6"/>{turn("y", angle)}{turn("x", angle)}{move(y=1)}'
                f'</transform>{checks}</shape>' + rectangle(floor, '<scale value="1.5"/>', move(y=1, z=-1.5))
                + f'<emitter type="constant">{rgb("radiance", 0.6)}</emitter>', depth=2), depth=0)

    def test_mitsubas_cornell_box(self):
        """Its light has a white surface, which reflects 1 % of the picture."""
        given = mi.cornell_box()
        given["sensor"]["film"].update(width=SIDE, height=SIDE, rfilter={"type": "box"})
        path = self.path("cornell.xml")
        config = mi.parser.ParserConfig(mi.variant())
        mi.parser.write_file(mi.parser.parse_dict(config, given), path)
        self.agree(mi.load_dict(given), path, depth=6)  # its max_depth is 8

    def test_our_cornell_box(self):
        """scenes/cornell.json, written for Mitsuba, cut after 1, 2 and 6 bounces and hardly ever."""
        given = json.loads((SCENES / "cornell.json").read_text(encoding="utf-8"))
        T = mi.ScalarTransform4f
        theirs = {"type": "scene"}
        for m in given["materials"]:
            theirs[m["name"]] = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": m["albedo"]}}}

        def placed(s):  # a rectangle of v = up made square to the normal, u = v x normal
            n = np.array(s["normal"], float)
            up = np.array([0, 0, -1.0] if abs(n[1]) > .9 else [0, 1.0, 0])
            u = np.cross(up, n)
            matrix = np.eye(4)
            matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3] = u * s["half"][0], up * s["half"][1], n, s["centre"]
            return {"type": "rectangle", "to_world": T(matrix)}
        for i, s in enumerate(given["shapes"]):
            shape = placed(s) if s["kind"] == "rectangle" else {"type": "cube", "to_world":
                T().translate(s["centre"]).rotate([0, 1, 0], s["angle_deg"]).scale(s["half"])}
            theirs[f"shape{i}"] = {**shape, "bsdf": {"type": "ref", "id": s["material"]}}
        light, camera = given["lights"][0], given["camera"]
        theirs["light"] = {**placed(light), "emitter": {"type": "area", "radiance": {"type": "rgb", "value": light["radiance"]}}}
        theirs["sensor"] = {"type": "perspective", "fov": camera["fov_deg"], "to_world": T().look_at(camera["eye"], camera["target"], [0, 1, 0]),
                            "film": {"type": "hdrfilm", "width": SIDE, "height": SIDE, "rfilter": {"type": "box"}}}
        for depth in (0, 1, 6, 62):
            with self.subTest(depth=depth):
                self.agree(mi.load_dict({**theirs, "integrator": {"type": "path", "max_depth": depth + 2}}), str(SCENES / "cornell.json"), depth=depth)

    def test_materials(self):
        """A ball of each material that has an exact counterpart, in a room under a square light."""
        for name, bsdf in (
                ("diffuse", diffuse("0.5, 0.6, 0.7")),
                ("conductor", f'<bsdf type="conductor">{WHITE}</bsdf>'),
                ("roughconductor", f'<bsdf type="roughconductor">{WHITE}{GGX}<float name="alpha" value="0.3"/></bsdf>'),
                ("roughdielectric", f'<bsdf type="roughdielectric">{GGX}<float name="alpha" value="0.3"/><float name="int_ior" value="1.5"/>'
                                    '<float name="ext_ior" value="1"/></bsdf>'),
                ("dielectric", '<bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>')):
            with self.subTest(material=name):
                self.of_text(scene(ROOM + PANEL + ball(bsdf)))

    def test_metals(self):
        """By name, which has constants in RGB, and by numbers and samples; smooth, and as facets."""
        gold = '<string name="material" value="Au"/>'
        odd = rgb("eta", "2.9, 0.4, 1.4") + rgb("k", "3.1, 2.4, 0.6") + rgb("specular_reflectance", "0.9, 1, 0.8")
        samples = "".join(f'<spectrum name="{name}" value="400:{a}, 550:{b}, 700:{c}"/>' for name, a, b, c in (("eta", 1.7, .5, .2), ("k", 1.9, 2.4, 4)))
        for name, bsdf in (("smooth gold", f'<bsdf type="conductor">{gold}</bsdf>'), ("smooth", f'<bsdf type="conductor">{odd}</bsdf>'),
                           ("samples", f'<bsdf type="conductor">{samples}</bsdf>'),
                           ("copper", f'<bsdf type="roughconductor">{GGX}<string name="material" value="Cu"/><float name="alpha" value="0.1"/></bsdf>'),
                           ("rough", f'<bsdf type="roughconductor">{GGX}{odd}<float name="alpha" value="0.4"/></bsdf>')):
            with self.subTest(metal=name):
                self.of_text(scene(ROOM + PANEL + ball(bsdf)), floor=5e-3 if name == "samples" else 1e-4)  # the observer is a fit here

    def test_lights(self):
        for name, light in (
                ("a square that reflects", rectangle(diffuse("0.9") + emitter("5, 4, 3"), turn("x", 90), move(y=2.2))),
                ("sphere", '<shape type="sphere"><float name="radius" value="0.2"/><point name="center" x="0" y="1.7" z="0.5"/>' + emitter("9, 8, 7") + "</shape>"),
                ("disk", f'<shape type="disk"><transform name="to_world"><scale value="0.5"/>{turn("x", 90)}{move(y=2.2)}</transform>{emitter("5, 4, 3")}</shape>'),
                ("cube", f'<shape type="cube"><transform name="to_world"><scale value="0.2"/>{move(y=1.6)}</transform>{emitter("5, 4, 3")}</shape>'),
                ("constant", f'<emitter type="constant">{rgb("radiance", "1, 0.8, 0.6")}</emitter>'),
                ("point", f'<emitter type="point"><point name="position" x="0.3" y="1.8" z="1"/>{rgb("intensity", "2, 2, 1")}</emitter>'),
                ("spot", f'<emitter type="spot"><transform name="to_world"><lookat origin="0.5, 2, 1.5" target="0, 0.4, 0" up="0, 0, 1"/></transform>'
                         f'{rgb("intensity", "4, 4, 3")}<float name="cutoff_angle" value="35"/><float name="beam_width" value="8"/></emitter>'),
                ("directional", f'<emitter type="directional"><vector name="direction" x="-0.5" y="-1" z="-0.7"/>{rgb("irradiance", "2, 2, 1")}</emitter>')):
            with self.subTest(light=name):
                self.of_text(scene(ROOM + light + ball(diffuse("0.5"))))

    def test_environment(self):
        """A smooth image of the sky of 24 rows, with a bright side, turned about y. Mitsuba interpolates between pixels, and its
        first row is at the pole, not half a pixel below it: without that, means differ by 1 %."""
        y, x = np.mgrid[0:24, 0:48]
        up, around = np.cos((y + .5) / 24 * np.pi), (x + .5) / 48 * 2 * np.pi
        image = np.stack([1 + up, 1 + .5 * up + .8 * np.sin(around) * np.sqrt(1 - up ** 2), 1 + .5 * np.cos(around) * np.sqrt(1 - up ** 2)], 2)
        mi.util.write_bitmap(self.path("sky.exr"), image.astype(np.float32), write_async=False)
        for angle in (0, 90):
            with self.subTest(angle=angle):
                sky = (f'<emitter type="envmap"><string name="filename" value="sky.exr"/><float name="scale" value="0.7"/><transform '
                       f'name="to_world">{turn("y", angle)}</transform></emitter>')
                ground = rectangle(diffuse("0.7, 0.6, 0.5"), '<scale value="3"/>', turn("x", -90))
                self.of_text(scene(sky + ground + ball(f'<bsdf type="conductor">{WHITE}</bsdf>')))

    def test_spectra(self):
        """Reflectances and an emission as sampled spectra; the colour-matching functions are a fit here, hence 2 %."""
        def spectrum(name, value):
            return f'<spectrum name="{name}" value="{value}"/>'
        ground = rectangle(f'<bsdf type="twosided"><bsdf type="diffuse">{spectrum("reflectance", "400:0.7, 480:0.2, 550:0.4, 640:0.8, 700:0.6")}</bsdf></bsdf>',
                           '<scale value="3"/>', turn("x", -90))
        for emission in ("400:0, 500:8, 600:15.6, 700:18.4", "6"):
            with self.subTest(emission=emission):
                panel = rectangle(f'<emitter type="area">{spectrum("radiance", emission)}</emitter>', turn("x", 90), move(y=2.5))
                self.of_text(scene(ground + panel + ball(diffuse("0.5, 0.6, 0.7"))), floor=2e-2)

    def test_texture(self):
        """An image on a floor, seen from above, whose four corners differ."""
        y, x = np.mgrid[0:64, 0:64] / 64
        mi.util.write_bitmap(self.path("floor.exr"), np.stack([.1 + .8 * x, .1 + .8 * y, .5 + .4 * (x > .5) * (y > .5)], 2).astype(np.float32), write_async=False)
        for name, mapping in (("plain", ""), ("turned", f'<transform name="to_uv"><scale x="2.5" y="1.5"/>{turn("z", 20)}</transform>'),
                              ("moved", f'<transform name="to_uv">{move(x=.25, y=.4)}<scale x="2.5" y="1.5"/></transform>'),
                              ("a matrix of 9", '<transform name="to_uv"><matrix value="2 0.5 0.25 0 1.5 0.4 0.1 0.2 1"/></transform>'),
                              ("mirrored", '<transform name="to_uv"><scale value="2.5"/></transform><string name="wrap_mode" value="mirror"/>'),
                              ("clamped", '<transform name="to_uv"><scale value="2.5"/></transform><string name="wrap_mode" value="clamp"/>'
                                          '<string name="filter_type" value="nearest"/>')):
            texture = ('<bsdf type="diffuse"><texture type="bitmap" name="reflectance"><string name="filename" value="floor.exr"/>'
                       f'<boolean name="raw" value="true"/>{mapping}</texture></bsdf>')
            with self.subTest(mapping=name):
                self.of_text(scene(rectangle(texture, '<scale value="1.5"/>', turn("x", -90)) + '<emitter type="constant"/>' +
                                   ball(diffuse("0.5")), eye="0.5, 5, 2", target="0, 0, 0"))

    def test_medium(self):
        """A box of haze around a ball on a floor, before a light in it, one outside and a sky, as our JSON and as Mitsuba's cube
        without a surface. After one bounce, three and hardly ever; the sky's box is grey and scatters back."""
        for name, depth, absorbed, scattered, g, light in (
                ("single", 0, (.05, .1, .2), (.6, .5, .4), .6, "point"), ("some", 2, (.05, .1, .2), (.6, .5, .4), .6, "point"),
                ("all", 40, (0, .1, .2), (.9, .7, .5), .3, "sphere"), ("sky", 40, (.1,) * 3, (.7,) * 3, -.4, "environment")):
            lights = {"point": ({"kind": "point", "centre": [.4, 2.6, 1], "intensity": [5, 4, 3]},
                                f'<emitter type="point"><point name="position" x="0.4" y="2.6" z="1"/>{rgb("intensity", "5, 4, 3")}</emitter>'),
                      "sphere": ({"kind": "sphere", "centre": [.4, 1.5, .4], "radius": .2, "radiance": [5, 4, 3], "visible": True},
                                 f'<shape type="sphere"><float name="radius" value="0.2"/><point name="center" x="0.4" y="1.5" z="0.4"/>{emitter("5, 4, 3")}</shape>'),
                      "environment": ({"kind": "environment", "radiance": [1, .8, .6]}, f'<emitter type="constant">{rgb("radiance", "1, 0.8, 0.6")}</emitter>')}[light]
            ours = {"camera": {"eye": [0, 1, 6], "target": [0, 1, 0], "fov_deg": 39}, "image": {"width": SIDE, "height": SIDE},
                    "medium": {"sigma_a": absorbed, "sigma_s": scattered, "g": g, "low": [-1.5, -.3, -1.2], "high": [1.5, 2.1, 1.2]},
                    "materials": [{"name": "m", "kind": "lambert", "albedo": .6}],
                    "shapes": [{"kind": "sphere", "centre": [0, .7, 0], "radius": .6, "material": "m"},
                               {"kind": "rectangle", "centre": [0, 0, 0], "normal": [0, 1, 0], "half": [3, 3], "material": "m"}], "lights": [lights[0]]}
            haze = [f"{a + b}" for a, b in zip(absorbed, scattered)], [f"{b / (a + b)}" for a, b in zip(absorbed, scattered)]
            cube = (f'<shape type="cube"><transform name="to_world"><scale x="1.5" y="1.2" z="1.2"/>{move(y=.9)}</transform><bsdf type="null"/>'
                    f'<medium name="interior" type="homogeneous">{rgb("sigma_t", ", ".join(haze[0]))}{rgb("albedo", ", ".join(haze[1]))}'
                    f'<phase type="hg"><float name="g" value="{g}"/></phase></medium></shape>')
            floor = rectangle(diffuse("0.6"), '<scale value="3"/>', turn("x", -90))
            text = scene(cube + floor + ball(diffuse("0.6")) + lights[1], depth=depth + 2).replace('"path"', '"volpath"')
            path = self.path("haze.json")
            pathlib.Path(path).write_text(json.dumps(ours), encoding="utf-8")
            with self.subTest(light=name):
                self.agree(mi.load_string(text), path, depth=depth)
            with self.subTest(light=name, scene="Mitsuba's, read by us"):
                self.of_text(text, depth=depth)

    def test_media_in_shapes(self):
        """A ball of haze, within which is a wall, and a turned cube, under a sky and a lamp outside."""
        haze = (f'<bsdf type="null"/><medium name="interior" type="homogeneous">{rgb("sigma_t", "0.6, 0.8, 1")}{rgb("albedo", "0.9, 0.7, 0.5")}<float name="scale" value="1.5"/>'
                '<phase type="hg"><float name="g" value="0.4"/></phase></medium>')
        light = f'<emitter type="constant">{rgb("radiance", 0.3)}</emitter>' + PANEL
        for name, shape in (("ball", f'<shape type="sphere"><point name="center" x="0.1" y="0.9" z="0.2"/><float name="radius" value="0.8"/>'
                                     f'<transform name="to_world"><scale value="1.2"/></transform>{haze}</shape>'),
                            ("cube", f'<shape type="cube"><transform name="to_world"><scale x="0.5" y="0.7" z="0.6"/>{turn("y", 35)}{turn("x", 20)}'
                                     f'{move(y=1)}</transform>{haze}</shape>')):
            with self.subTest(shape=name):
                self.of_text(scene(ROOM + light + shape, depth=12).replace('"path"', '"volpath"'), depth=None)

    def test_medium_of_the_sensor(self):
        """A cube of haze around the sensor, which names it, and most of a room. The light is outside: near a light in haze samples
        have no finite variance."""
        haze = (f'<medium type="homogeneous" id="haze">{rgb("sigma_t", "0.3, 0.4, 0.5")}{rgb("albedo", "0.9, 0.7, 0.5")}'
                '<float name="scale" value="0.5"/></medium>')
        cube = (f'<shape type="cube"><transform name="to_world"><scale x="4" y="4" z="7"/>{move(y=-2)}</transform><bsdf type="null"/>'
                '<ref name="interior" id="haze"/></shape>')
        light = f'<emitter type="point"><point name="position" x="0.4" y="3.4" z="1"/>{rgb("intensity", "9, 8, 7")}</emitter>'
        text = scene(ROOM + light + ball(diffuse("0.6")) + cube, depth=6).replace('"path"', '"volpath"')
        self.of_text(text.replace("<sensor", haze + "<sensor").replace("<film", '<ref id="haze"/><film'), depth=4)


if __name__ == "__main__":
    unittest.main()

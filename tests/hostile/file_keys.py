#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_keys.py PROGRAM FAULTS: no file that a scene names may change without another hash of the scene.

The rows of a study are kept under the hash of their scene: if two scenes had one hash, a row would mix both. For each way
in which a file of a scene names another (CASES), one pixel, byte or number of the named file is changed, then all of it. Both
must give another hash; the picture of the second must differ too, which shows that the scene uses the file. A way that
file_inputs.py knows, a kind of file (src/engine/core/file_kinds.def) and a kind of mesh (src/files/meshes/mesh_read.c) without a case
are failures.
"""
import base64
import gzip
import json
import os
import re
import struct
import sys
import tempfile
import zlib

import file_inputs
import file_pictures
import files
from file_serialized import serialized

SIDE = 8
NO_SCENES = {"POINTS", "PARAMETERS", "IMAGE", "PLAN"}  # the kinds of files that scenes do not name
HERE = "Scale -1 1 1 LookAt 0 0 4 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 40\n" \
       "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 12\nWorldBegin\n"
LAMP = 'LightSource "point" "point3 from" [1 1 3] "rgb I" [9 9 9]\n'
QUAD = 'Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 -1 0 1 -1 0 1 1 0 -1 1 0]' \
       ' "point2 uv" [0 0 1 0 1 1 0 1]\n'
OPEN = '<scene version="3.0.0"><sensor type="perspective"><float name="fov" value="40"/><transform name="to_world"><lookat ' \
       'origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/></transform><film type="hdrfilm"><integer name="width" value="16"/>' \
       '<integer name="height" value="12"/></film></sensor>'
POINT = '<emitter type="point"><point name="position" x="1" y="1" z="3"/><rgb name="intensity" value="9"/></emitter>'


# ---- Files that are named ------------------------------------------------------------------------------------------


def png(levels, channels=3):
    """The levels of SIDE x SIDE pixels, row by row."""
    row = SIDE * channels
    lines = b"".join(b"\0" + bytes(levels[i:i + row]) for i in range(0, len(levels), row))
    return file_pictures.png(SIDE, SIDE, zlib.compress(lines), 8, {3: 2, 4: 6}[channels])


def pfm(levels):
    return f"PF\n{SIDE} {SIDE}\n-1\n".encode() + struct.pack(f"<{len(levels)}f", *(level / 100 for level in levels))


def versions(write, **how):
    """An image, the same with one pixel of another level, and one of other pixels."""
    n = SIDE * SIDE * how.get("channels", 3)
    first = [100 + i * 37 % 50 for i in range(n)]
    return write(first, **how), write(first[:n // 2] + [first[n // 2] + 1] + first[n // 2 + 1:], **how), \
        write([i * 53 % 90 for i in range(n)], **how)


def picture(**how):
    return versions(png, **how)


def corners(size):
    """Of a rectangle: the camera of a model would show squares of any size alike."""
    return [(-size, -1, 0), (size, -1, 0), (size, 1, 0), (-size, 1, 0)]


def obj(size, head="", foot=""):
    return (head + "".join(f"v {x} {y} {z}\n" for x, y, z in corners(size)) + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n" + foot
            + "f 1/1 2/2 3/3 4/4\n").encode()


def ply(size):
    return ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
            + "".join(f"{x} {y} {z}\n" for x, y, z in corners(size)) + "4 0 1 2 3\n").encode()


def packed_mesh(size):
    return serialized([struct.pack("<I", 0x1000) + b"m\0" + struct.pack("<QQ", 4, 2)
                       + b"".join(struct.pack("<3f", *corner) for corner in corners(size))
                       + struct.pack("<6I", 0, 1, 2, 0, 2, 3)])


def gz(data):
    return gzip.compress(data, mtime=0)


def buffer(size):
    return (b"".join(struct.pack("<3f", *corner) for corner in corners(size)) + struct.pack("<6H", 0, 1, 2, 0, 2, 3)
            + struct.pack("<8f", 0, 1, 1, 1, 1, 0, 0, 0))


def gltf(uri="b.bin", material=None, image=None):
    """A square; without a name its buffer is the one of a .glb."""
    made = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1, "material": 0}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-9, -9, 0], "max": [9, 9, 0]},
                          {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                          {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"}],
            "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                            {"buffer": 0, "byteOffset": 60, "byteLength": 32}],
            "buffers": [dict({"byteLength": 92}, **({"uri": uri} if uri else {}))],
            "materials": [material or {"pbrMetallicRoughness": {"metallicFactor": 0}}]}
    if image:
        made["images"], made["textures"] = [image], [{"source": 0}]
    return json.dumps(made).encode()


def glb(size):
    text = gltf(None)
    text += b" " * (-len(text) % 4)
    data = buffer(size)
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(data), b"BIN\0") + data)


def sizes(write, *rest):
    """A mesh, and the same a little and much larger."""
    return tuple(write(size, *rest) for size in (0.5, 0.5078125, 1))


def texts(text, *values):
    return tuple((text % value).encode() for value in values)


# ---- The ways --------------------------------------------------------------------------------------------------------


def scene(**how):
    return json.dumps(file_inputs.scene(**how)).encode()


def mesh_scene(name):
    return scene(shape={"kind": "mesh", "file": name, "material": "m"},
                 light={"kind": "point", "centre": [1, 1, 3], "intensity": 9})


def textured(what):
    return {what: {"index": 0}}


def pbrt(text, name="s.pbrt"):
    return name, (HERE + text).encode()


def mitsuba(text, name="s.xml"):
    return name, (OPEN + text + "</scene>").encode()


def bitmap(name):
    return f'<texture name="reflectance" type="bitmap"><string name="filename" value="{name}"/></texture>'


MESHES = {".obj": sizes(obj), ".ply": sizes(ply), ".ply.gz": sizes(lambda size: gz(ply(size))),
          ".glb": sizes(glb), ".serialized": sizes(packed_mesh),
          ".gltf": tuple(gltf("data:;base64," + base64.b64encode(buffer(size)).decode()) for size in (0.5, 0.5078125, 1))}
SQUARE = {"b.bin": buffer(1)}
SKY = 'LightSource "infinite" "string filename" "t.png"\n'
MAP = 'Texture "t" "spectrum" "imagemap" "string filename" "t.png"\n'
SHOWN = 'Material "diffuse" "texture reflectance" "t"\n' + QUAD
DULL = texts('Material "diffuse" "rgb reflectance" [%s .5 .5]\n', .5, .51, .1)


def in_gltf(material, image=None):
    return "s.gltf", gltf(material=material, image=image or {"uri": "t.png"})


def cases():
    """(kind, way, scene's (name, bytes), named file, its three versions, other files). The way may be one of file_inputs.py's."""
    yield "TEXTURE", "albedo", ("s.json", scene(albedo={"image": "t.png"})), "t.png", picture(), {}
    yield ("TEXTURE", "environment", ("s.json", scene(light={"kind": "environment", "image": "t.pfm"})), "t.pfm",
           versions(pfm), {})
    for ending, made in MESHES.items():
        yield "MESH", "mesh", ("s.json", mesh_scene("m" + ending)), "m" + ending, made, {}
        yield "MESH", "model", None, "s" + ending, made, {}
    yield "BUFFER", "buffer of a mesh", ("s.json", mesh_scene("m.gltf")), "b.bin", sizes(buffer), {"m.gltf": gltf()}
    yield ("MATERIALS", "mtllib", ("s.obj", obj(1, "mtllib m.mtl\n", "usemtl m\n")), "m.mtl",
           texts("newmtl m\nKd %s .5 .5\n", .5, .51, .1), {})
    for what, rest in (("map_Kd", ""), ("map_Ke", "Ke 1 1 1\n")):
        yield ("TEXTURE", what, ("s.obj", obj(1, "mtllib m.mtl\n", "usemtl m\n")), "t.png", picture(),
               {"m.mtl": f"newmtl m\nKd .5 .5 .5\n{rest}{what} t.png\n".encode()})
    yield "BUFFER", "buffer", ("s.gltf", gltf()), "b.bin", sizes(buffer), {}
    base = textured("baseColorTexture")
    for what, material, how in (
            ("glTF image", {"pbrMetallicRoughness": dict(base, metallicFactor=0)}, {}),
            ("glTF metal", {"pbrMetallicRoughness": textured("metallicRoughnessTexture")}, {}),
            ("glTF normals", textured("normalTexture"), {}),
            ("glTF emission", dict(textured("emissiveTexture"), emissiveFactor=[1, 1, 1]), {}),
            ("glTF alpha", {"alphaMode": "BLEND", "pbrMetallicRoughness": base}, {"channels": 4})):
        yield "TEXTURE", what, in_gltf(material), "t.png", picture(**how), SQUARE
    yield "SCENE", "pbrt scene", None, "s.pbrt", tuple(pbrt(LAMP + QUAD.join((d.decode(), "")))[1] for d in DULL), {}
    for ending, write in (("", bytes), (".gz", gz)):
        for word in ("Include", "Import"):
            yield ("SCENE", "pbrt include", pbrt(f'{LAMP}{word} "i.pbrt{ending}"\n' + QUAD * (word == "Include")),
                   "i.pbrt" + ending, tuple(write(d + QUAD.encode() * (word == "Import")) for d in DULL), {})
        yield ("TEXTURE", "texture in an include", pbrt(f'{LAMP}Include "i.pbrt{ending}"\n'), "t.png", picture(),
               {"i.pbrt" + ending: write((MAP + SHOWN).encode())})
        yield ("TEXTURE", "sky in an include", pbrt(f'Include "i.pbrt{ending}"\n' + QUAD), "t.png", picture(),
               {"i.pbrt" + ending: write(SKY.encode())})
        yield ("MESH", "pbrt mesh", pbrt(f'{LAMP}Shape "plymesh" "string filename" "m.ply{ending}"\n'), "m.ply" + ending,
               MESHES[".ply" + ending], {})
    yield "TEXTURE", "pbrt texture", pbrt(LAMP + MAP + SHOWN), "t.png", picture(), {}
    yield ("TEXTURE", "coated", pbrt(LAMP + MAP + SHOWN.replace("diffuse", "coateddiffuse")), "t.png", picture(), {})
    yield ("TEXTURE", "named material", pbrt(LAMP + MAP + 'MakeNamedMaterial "n" "string type" "diffuse" "texture reflectance" "t"\n'
                                             'NamedMaterial "n"\n' + QUAD), "t.png", picture(), {})
    yield ("TEXTURE", "texture of a texture", pbrt(LAMP + MAP.replace('"t"', '"u"', 1) + 'Texture "t" "spectrum" "scale" '
                                                   '"texture tex" "u" "float scale" 1\n' + SHOWN), "t.png", picture(), {})
    yield "TEXTURE", "pbrt sky", pbrt(SKY + QUAD), "t.png", picture(), {}
    diffuse = '<bsdf type="diffuse">%s</bsdf>'
    reds = texts(diffuse % '<rgb name="reflectance" value="%s, .5, .5"/>', .5, .51, .1)
    rectangle = '<shape type="rectangle">%s</shape>'
    yield ("SCENE", "Mitsuba scene", None, "s.xml", tuple(mitsuba(POINT + rectangle % red.decode())[1] for red in reds), {})
    yield ("SCENE", "Mitsuba include", mitsuba(POINT + '<include filename="i.xml"/>'), "i.xml",
           tuple(f'<scene version="3.0.0">{rectangle % red.decode()}</scene>'.encode() for red in reds), {})
    for kind in ("obj", "ply", "serialized"):
        yield ("MESH", "Mitsuba mesh", mitsuba(f'{POINT}<shape type="{kind}"><string name="filename" value="m.{kind}"/></shape>'),
               "m." + kind, MESHES["." + kind], {})
    yield "TEXTURE", "Mitsuba texture", mitsuba(POINT + rectangle % (diffuse % bitmap("t.png"))), "t.png", picture(), {}
    yield ("TEXTURE", "texture in an include", mitsuba(POINT + '<include filename="i.xml"/>'), "t.png", picture(),
           {"i.xml": f'<scene version="3.0.0">{rectangle % (diffuse % bitmap("t.png"))}</scene>'.encode()})
    yield ("TEXTURE", "Mitsuba sky", mitsuba('<emitter type="envmap"><string name="filename" value="t.pfm"/></emitter>'),
           "t.pfm", versions(pfm), {})


# ---- Checks ----------------------------------------------------------------------------------------------------------


class Bench:
    """Renders scenes, each in a folder of its own."""

    def __init__(self, program, checks):
        self.program, self.checks = program, checks

    def render(self, what, name, contents):
        """The hash of the scene and the picture without texts, or None."""
        with tempfile.TemporaryDirectory() as folder:
            for path, data in contents.items():
                with open(os.path.join(folder, path), "wb") as stream:
                    stream.write(data)
            done = files.run(self.program, "render", "./" + name, "-n", "1", "--size", "16x12", "-q", "-o", "o.png", cwd=folder)
            if not self.checks.check(done and done.code == 0, f"{what}: {done and done.err}"):
                return None
            with open(os.path.join(folder, "o.png"), "rb") as stream:
                data = stream.read()
        found = re.search(rb" hash=([0-9a-f]{16}) ", data)
        if not self.checks.check(found, f"{what}: the picture has no hash"):
            return None
        return found[1], data[data.index(b"IDAT"):]

    def case(self, what, top, named, made, others):
        name, contents = top[0] if top else named, dict([top] if top else [], **others)
        seen = [self.render(what, name, dict(contents, **{named: data})) for data in made]
        if all(seen):
            self.checks.check(len({one[0] for one in seen}) == 3, f"{what}: {named} changes, the hash does not")
            self.checks.check(seen[0][1] != seen[2][1], f"{what}: the picture does not show {named}")


def check_ways(checks, bench):
    with tempfile.TemporaryDirectory() as folder:
        known = {(kind, way) for kind, _, way, _ in file_inputs.named_by_files(folder) if "of a plan" not in way}
    seen, endings = set(), set()
    for kind, way, top, named, made, others in cases():
        seen.add((kind, way))
        endings.add(named[named.index("."):] if kind == "MESH" else "")
        bench.case(f"{way} in {top[0] if top else named}", top, named, made, others)
    checks.check(known <= seen, f"no case for {known - seen}")
    checks.check({kind for kind, _ in seen} == set(file_inputs.limits()) - NO_SCENES, "a kind of file without a case")
    with open(os.path.join(file_inputs.SOURCE, "src/files/meshes/mesh_read.c"), encoding="utf-8") as stream:
        readers = set(re.findall(r'\{"(\.[a-z.]+)", koksma__', stream.read()))
    checks.check(readers and readers <= endings, f"no case for meshes {readers - endings}")


def main():
    checks = files.Checks()
    bench = Bench(sys.argv[1], checks)
    check_ways(checks, bench)
    checks.end()


if __name__ == "__main__":
    main()

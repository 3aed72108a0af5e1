#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_work.py PROGRAM FAULTS: small scenes of pbrt and Mitsuba, and small models, that ask for much work or memory.

References let a few kilobytes ask for any amount: instances of instances of nothing, trees of textures, lights with many
properties that many shapes name, names that stand for long texts, texts that are included again and again. Such a scene must
be refused by one line that names the file, within the memory and the processor time of an ordinary run. Large honest scenes
take time and memory in proportion to their length: many names, shapes, elements and triangles, and many meshes of one
compressed file. What is repeated, a material or a mesh under other
names of its file, counts once. So do the files that a model names, a list of indices that many primitives of a
glTF file share, and an image that many materials emit; a damaged one counts each time.
"""
import gzip
import json
import os
import re
import shutil
import string
import struct
import sys
import tempfile
import zlib

import file_pictures
import files
from file_serialized import serialized

PROCESSOR = 600 if files.SANITIZED else 60  # seconds; without a limit the scenes below take from minutes to years
LARGE = 4 if files.SANITIZED else 1  # what large scenes are divided by
# without the texts that AddressSanitizer keeps after they are freed
SANITIZER = {"ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":quarantine_size_mb=8"}
STEPS = "more than 67108864 steps"
HELD = "more than 384 MiB of memory"
SENSOR = ('<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="{width}"/>'
          '<integer name="height" value="4"/></film></sensor><emitter type="constant"/>')
PBRT = 'LookAt 0 0 5 0 0 0 0 1 0\nCamera "perspective"\nWorldBegin\nLightSource "infinite"\n'


def mitsuba(*parts, width=8):
    return '<scene version="3.0.0">' + SENSOR.format(width=width) + "".join(parts) + "</scene>"


def groups(levels, fan, inner):
    """Groups of which each has `fan` instances of the one before."""
    return (f'<shape type="shapegroup" id="g0">{inner}</shape>'
            + "".join(f'<shape type="shapegroup" id="g{level}">' + f'<shape type="instance"><ref id="g{level - 1}"/></shape>' * fan
                      + "</shape>" for level in range(1, levels + 1))
            + f'<shape type="instance"><ref id="g{levels}"/></shape>')


def checkers(levels):
    """Checkerboards of which each has the next one for both colours."""
    return "".join(f'<texture type="checkerboard" id="c{i}"><ref name="color0" id="c{i + 1}"/><ref name="color1" id="c{i + 1}"/>'
                   "</texture>" for i in range(levels)) + f'<texture type="checkerboard" id="c{levels}"/>'


class Bench(files.Bench):
    def refused(self, what, name, text, *words, place=None, most=files.OTHER):
        """place: the file that the message names, if that is another; most: MiB that the run may take."""
        self.put(name, text)
        done = self.run("scene", "check", name)
        self.checks.refused(what, done, 3, f"{place or name}:", *words, most=most)
        if done:
            self.checks.check(done.err.count(f"{place or name}:".encode()) == 1, f"{what}: the place is given twice: {done.err}")

    def counts(self, what, name, text, **expected):
        """Numbers of what the scene has; warnings are allowed."""
        self.put(name, text)
        done = self.run("scene", "check", name, "--json")
        if not self.checks.check(done is not None and done.code in (0, 1), f"{what}: {done and (done.code, done.err[-300:])}"):
            return
        self.checks.check(done.mib < files.OTHER, f"{what}: took {done.mib:.0f} MiB")
        found = json.loads(done.out.splitlines()[0])
        for key, value in expected.items():
            self.checks.check(found[key] == value, f"{what}: {found[key]} {key}, not {value}")


def instances(bench):
    nothing = ("", '<shape type="hair"/>', '<shape type="sphere"><bsdf type="null"/></shape>')
    for inner in nothing[:1] if files.SANITIZED else nothing:
        bench.refused(f"14 levels of 10 instances of '{inner}'", "s.xml", mitsuba(groups(14, 10, inner)), STEPS)
    null = '<shape type="sphere"><ref id="n"/></shape>'
    bench.refused("20,000 instances of 20,000 shapes that are not there", "s.xml",
                  mitsuba('<bsdf type="null" id="n"/><shape type="shapegroup" id="g">' + null * 20000 + "</shape>"
                          + '<shape type="instance"><ref id="g"/></shape>' * 20000), STEPS)
    bench.refused("8,000 objects of 8,000 shapes that are not there", "s.pbrt",
                  PBRT + 'ObjectBegin "o"\nMaterial "interface"\n' + 'Shape "sphere"\n' * 8000 + "ObjectEnd\n"
                  + 'ObjectInstance "o"\n' * 8000, STEPS)
    long = '<scale value="' + " " * 60000 + '1"/>'
    bench.refused("100,000 instances whose matrix is a long text", "s.xml",
                  mitsuba('<shape type="shapegroup" id="a"><shape type="instance"><transform name="to_world">' + long
                          + '</transform><ref id="b"/></shape></shape><shape type="shapegroup" id="b"/>'
                          + '<shape type="instance"><ref id="a"/></shape>' * 100000), STEPS)
    cubes = mitsuba(groups(4, 10, '<shape type="cube"/>'))
    bench.counts("4 levels of 10 instances of a cube", "s.xml", cubes, placements=10000, meshes=1, materials=1)


def trees(bench):
    conductor = ('<shape type="rectangle"><bsdf type="conductor"><ref name="specular_reflectance" id="c0"/>'
                 '<ref name="eta" id="c0"/><ref name="k" id="c0"/></bsdf></shape>')
    bench.refused("1,000 times 3 trees of checkerboards", "s.xml", mitsuba(checkers(16), conductor * 1000), STEPS)
    bench.counts("3 trees of 256 checkerboards", "s.xml", mitsuba(checkers(8), conductor), shapes=1)
    if files.SANITIZED:
        return
    light = '<emitter type="area" id="e">' + '<float name="x" value="1"/>' * 50000 + "</emitter>"
    bench.refused("50,000 shapes with one light of 50,000 properties", "s.xml",
                  mitsuba(light, '<shape type="sphere"><bsdf type="diffuse"/>' + '<ref id="e"/>' * 50000 + "</shape>"), STEPS)
    coat = '<bsdf type="twosided" id="t">' + '<float name="x" value="1"/>' * 50000 + '<bsdf type="diffuse"/></bsdf>'
    bench.refused("50,000 BSDFs around one with 50,000 properties", "s.xml",
                  mitsuba(coat, '<shape type="cube">' + '<bsdf type="twosided"><ref id="t"/></bsdf>' * 50000 + "</shape>"), STEPS)


def spectra(bench):
    """Each takes as long as the sum of its values at some hundred wavelengths."""
    leaf = '<texture type="checkerboard" id="c{}"><spectrum name="color0" value="{}"/><spectrum name="color1" value="{}"/></texture>'
    shape = '<shape type="sphere"><bsdf type="diffuse"><ref name="reflectance" id="c0"/></bsdf></shape>'
    for value in ("360:.1 830:.2", "360:.1, 595:.3, 830:.2")[:1 if files.SANITIZED else 2]:
        tree = checkers(14).replace('<texture type="checkerboard" id="c14"/>', leaf.format(14, value, value))
        bench.refused(f"100 trees of spectra {value}", "s.xml", mitsuba(tree, shape * 100), STEPS)
        bench.counts(f"a tree of spectra {value}", "s.xml", mitsuba(tree, shape), placements=1)
    if files.SANITIZED:
        return
    bench.put("part", 'Material"diffuse""spectrum reflectance"[360 1 830 1]\n' * 2000)
    bench.put("parts", 'Include "part"\n' * 500)
    bench.refused("a million spectra", "s.pbrt", PBRT + 'Include "parts"\n', STEPS, place="part")
    bench.put("parts", 'Include "part"\n' * 200)
    bench.counts("400,000 spectra", "s.pbrt", PBRT + 'Include "parts"\n', lights=1)


def texts(bench):
    """What a few characters describe takes hundreds of bytes. A text may be included until it has 256 MiB."""
    bench.put("p.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    shape = 'Shape "plymesh" "string filename" "p.ply"\n'
    bench.counts("100,000 shapes in an object", "s.pbrt",
                 PBRT + 'ObjectBegin "o"\n' + shape * (100000 // LARGE) + "ObjectEnd\n", meshes=1)
    side = 708 // (2 if files.SANITIZED else 1)
    faces = " ".join(f"{i} {i + 1} {i + side} {i + 1} {i + side} {i + side + 1}"
                     for i in range(side * (side - 1)) if i % side < side - 1)
    places = " ".join(f"{i % side} {i // side} 0" for i in range(side * side))
    bench.counts("a million triangles", "s.pbrt",
                 PBRT + f'Shape "trianglemesh" "integer indices" [{faces}] "point3 P" [{places}]\n',
                 triangles=2 * (side - 1) ** 2)
    elements = "".join(f'<float name="n{i}" value="{i}"/>' for i in range(1000000 // LARGE))
    bench.counts("a million elements", "s.xml", mitsuba(elements), lights=1)
    if files.SANITIZED:
        return
    triangle = 'Shape"trianglemesh""point3 P"[0 0 0 1 0 0 0 1 0]\n'
    for what, one in (("shapes in an object", 'Shape"disk"\n'), ("triangles in an object", triangle),
                      ("coordinate systems", 'CoordinateSystem""\n'), ("objects", 'ObjectBegin""ObjectEnd\n'),
                      ("materials", 'MakeNamedMaterial"""string type""diffuse"\n')):
        bench.put("part", one * (60000 // len(one)))
        bench.put("parts", 'Include "part"\n' * 60)
        around = ('ObjectBegin"a"\n', "ObjectEnd\n") if "in an object" in what else ("", "")
        bench.refused(what, "s.pbrt", PBRT + around[0] + 'Include "parts"\n' * 60 + around[1], HELD, place="part", most=1024)
    bench.refused("a mesh of six million triangles to subdivide", "s.pbrt",
                  PBRT + 'Shape "loopsubdiv" "integer levels" 0 "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" ['
                  + "0 1 2 " * 6000000 + "]\n", HELD, most=1024)
    attributes = "<a " + " ".join(f'{letter}=""' for letter in string.ascii_letters) + "/>"
    bench.put("part", "<scene>" + attributes * (60000 // len(attributes)) + "</scene>")
    bench.put("parts", "<scene>" + '<include filename="part"/>' * 60 + "</scene>")
    bench.refused("attributes", "s.xml", mitsuba('<include filename="parts"/>' * 60), HELD, place="part", most=1024)
    many = "".join(f'a{i}="" ' for i in range(600000))
    bench.put("part", f'<scene><shape type="sphere" {many}/></scene>')
    bench.refused("many attributes within as many", "s.xml", mitsuba(f'<x {many}><include filename="part"/></x>'),
                  "the names and attributes up to here take more than 128 MiB", place="part", most=1024)


def references(bench):
    """Many <ref>s to one long element, of which nothing is made."""
    n = 10000
    parts = '<float name="x" value="1"/>' * n
    bench.refused("10,000 <ref>s to a phase function of 10,000 properties", "s.xml",
                  f'<scene version="3.0.0"><phase type="hg" id="p">{parts}</phase><sensor type="perspective">'
                  '<medium type="homogeneous">' + '<ref id="p"/>' * n + "</medium></sensor></scene>", STEPS)
    bench.refused("10,000 <ref>s of an instance to a group of 10,000 properties", "s.xml",
                  mitsuba(f'<shape type="shapegroup" id="g">{parts}</shape>', '<shape type="instance">' + '<ref id="g"/>' * n + "</shape>"),
                  STEPS)
    n = 40000
    alias = "<alias " + " ".join(f'a{i}=""' for i in range(n)) + ' as="q" id="r"/><x id="r"/>'
    bench.refused("40,000 <ref>s to an alias of 40,000 attributes", "s.xml", mitsuba(alias, '<ref id="q"/>' * n), STEPS)


def names(bench):
    text = '<default name="a" value="' + "x" * 65000 + '"/>'
    bench.refused("20,000 values of 65,000 characters", "s.xml", mitsuba(text, '<x a="$a"/>' * 20000), "384 MiB")
    bench.counts("1,000 values of 65,000 characters", "s.xml", mitsuba(text, '<x a="$a"/>' * 1000), lights=1)
    many = "".join(f'<default name="n{i}" value="{i}"/>' for i in range(200000 // LARGE))
    used = "".join(f'<x a="$n{i}"/>' for i in range(200000 // LARGE))
    bench.counts("many names, each used", "s.xml", mitsuba(many, used), lights=1)
    # the first value counts
    bench.put("s.xml", '<scene version="3.0.0"><default name="w" value="5"/>' + many + '<default name="w" value="7"/>'
              + SENSOR.format(width="$w") + "</scene>")
    done = bench.run("render", "s.xml", "-n", "1", "-q", "-o", "s.pfm")
    if bench.checks.check(done and done.code == 0, f"a name with two values: {done and done.err}"):
        with open(os.path.join(bench.folder, "s.pfm"), "rb") as stream:
            bench.checks.check(stream.read(12).split()[1:3] == [b"5", b"4"], "a name with two values has not the first")


def materials(bench):
    """1,100 shapes: what is equal counts once, and 1,024 that differ are the most."""
    n = 1100
    triangle = '"integer indices" [0 1 2] "point3 P" [0 0 0 1 0 0 0 1 0]'
    bench.put("p.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    bench.counts("shapes without a BSDF", "s.xml", mitsuba('<shape type="sphere"/>' * n), shapes=n, materials=1)
    checker = '<bsdf type="diffuse" id="m"><texture type="checkerboard" name="reflectance"/></bsdf>'
    mesh = '<shape type="obj"><string name="filename" value="p.obj"/><ref id="m"/></shape>'
    bench.counts("meshes without texture coordinates", "s.xml", mitsuba(checker, mesh * n), placements=n, meshes=2, materials=1)
    bench.counts("meshes of pbrt without texture coordinates", "s.pbrt",
                 PBRT + 'Texture "t" "spectrum" "checkerboard" "rgb tex1" [.2 .2 .2] Material "diffuse" "texture reflectance" "t"\n'
                 + f'Shape "trianglemesh" {triangle}\n' * n, placements=n, materials=2)  # and the one before any Material
    bench.counts("equal BSDFs", "s.xml", mitsuba('<shape type="sphere"><bsdf type="plastic"/></shape>' * n), shapes=n, materials=1)
    bench.counts("equal materials", "s.pbrt", PBRT + 'Material "conductor" Shape "sphere"\n' * n, shapes=n, materials=2)
    spheres = [f'Material "diffuse" "float reflectance" {(i + 1) / 2048} Shape "sphere"\n' for i in range(n)]
    bench.counts("1,023 materials and the first", "s.pbrt", PBRT + "".join(spheres[:1023]), shapes=1023, materials=1024)
    bench.refused("1,024 materials and the first", "s.pbrt", PBRT + "".join(spheres[:1025]), "more than 1024 different materials")


def packed(n):
    """A .serialized file of n triangles."""
    return serialized([struct.pack("<I", 0x1000) + b"\0" + struct.pack("<QQ", 3, 1)
                       + struct.pack("<9f", 0, 0, i / 1024, 1, 0, 0, 0, 1, 0) + struct.pack("<3I", 0, 1, 2) for i in range(n)])


def meshes(bench):
    n = 30000 // LARGE
    for name in ("a.serialized", "b.serialized"):
        bench.put(name, packed(n))
    shape = '<shape type="serialized"><string name="filename" value="{}"/><integer name="shape_index" value="{}"/></shape>'
    both = [shape.format("ab"[i % 2] + ".serialized", i // 2) for i in range(2 * n)]
    bench.counts("all meshes of two files in turn", "s.xml", mitsuba(*both), meshes=2 * n, triangles=2 * n)
    bench.put("p.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    os.symlink("p.ply", os.path.join(bench.folder, "q.ply"))
    ways = "".join(f'Shape "plymesh" "string filename" "{"./" * i}p.ply"\n' for i in range(100)) + 'Shape "plymesh" "string filename" "q.ply"\n'
    bench.counts("a mesh under many names", "s.pbrt", PBRT + ways, meshes=1, placements=101)


def material_files(bench):
    bench.put("q", "# a long comment\n" * 65536)
    lines = "".join("mtllib" + " q ./q" * (600 + i) + "\n" for i in range(64))
    bench.counts("a material file of 1 MiB that 64 lines name 80,000 times", "s.obj",
                 lines + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", triangles=1)


def gltf(buffers, accessors, hidden):
    """A triangle in the first buffer; the primitives `hidden` are of a mesh that no node shows."""
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}, {"primitives": hidden}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}] + accessors,
        "bufferViews": [{"buffer": i, "byteLength": MIB} for i in range(len(buffers))],
        "buffers": [{"uri": name, "byteLength": MIB} for name in buffers]})


MIB = 1 << 20
POINTS = {"attributes": {"POSITION": 0}, "mode": 0}
BYTES = {"bufferView": 0, "byteOffset": 36, "componentType": 5121, "type": "SCALAR", "count": MIB - 36}


def buffers(bench):
    bench.put("b.bin", struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + bytes(MIB - 36))
    bench.counts("4,000 buffers of one file", "s.gltf", gltf(["./" * (i % 9) + "b.bin" for i in range(4000)], [], [POINTS]),
                 triangles=1)


def indices(bench):
    """Of all accessors that have the same bytes, each is read; one that primitives share is read once."""
    each = [dict(POINTS, indices=1 + i) for i in range(100000)]
    bench.put("s.gltf", gltf(["b.bin"], [BYTES] * 100000, each))
    bench.checks.refused("100,000 accessors of the same indices", bench.run("scene", "check", "s.gltf"), 3,
                         "'s.gltf': line 1: meshes[1].primitives[1024]: ", "1024 MiB of indices")
    bench.counts("100,000 primitives with one accessor of indices", "s.gltf", gltf(["b.bin"], [BYTES], each[:1] * 100000),
                 triangles=1)
    parts = [dict(BYTES, byteOffset=36 + i, count=8) for i in range(0, 800000, 8)]
    bench.counts("100,000 primitives with the same vertices", "s.gltf", gltf(["b.bin"], parts, each), triangles=1)


def png(side, last=b"\0"):
    """A black PNG of 1 bit a pixel. last: the filter of its last row; there is none of number 7."""
    row = bytes(side // 8)
    return file_pictures.png(side, side, zlib.compress((b"\0" + row) * (side - 1) + last + row, 9), 1, 0)


SIDE = 8192 // LARGE


def glows(bench):
    """Emission textures are looked through once."""
    bench.put("black.png", png(SIDE))
    bench.put("glow.mtl", "".join(f"newmtl m{i}\nKe 1 1 1\nmap_Ke black.png\n" for i in range(1000)))
    bench.counts("1,000 materials with one black emission texture", "glow.obj",
                 "mtllib glow.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 3/1\n", triangles=1)


def damaged(bench):
    """Of an image that fails in its last row, with more bytes behind it each time."""
    bad, n = png(SIDE, b"\7"), 400
    bench.put("b.bin", struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + bytes(24) + bad + bytes(n))
    each = range(n)
    vertices = {"POSITION": 0, "TEXCOORD_0": 1}
    bench.put("s.gltf", json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": vertices, "material": i} for i in each]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}} for i in each],
        "textures": [{"source": i} for i in each], "images": [{"bufferView": 2 + i, "mimeType": "image/png"} for i in each],
        "accessors": [{"bufferView": i, "componentType": 5126, "type": kind, "count": 3} for i, kind in enumerate(("VEC3", "VEC2"))],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}]
                       + [{"buffer": 0, "byteOffset": 60, "byteLength": len(bad) + i} for i in each],
        "buffers": [{"uri": "b.bin", "byteLength": 60 + len(bad) + n}]}))
    bench.checks.refused("400 places of one damaged image", bench.run("scene", "check", "s.gltf"), 3, "s.gltf", "images[",
                         "more than 2048 MiB")


def packed_ply(n):
    """n triangles of which one has an area, and three times as many vertices: 48 bytes each once unpacked."""
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {3 * n}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {n}\nproperty list uchar int vertex_indices\nend_header\n")
    vertices = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0) + bytes(36 * (n - 1))
    return gzip.compress(head.encode() + vertices + (b"\3" + struct.pack("<3i", 0, 1, 2)) * n)


def packed_meshes(bench):
    """Shapes of one file share its mesh; many files may not take all memory."""
    n, files_n = 1000000, 40

    def scene(names):
        return json.dumps({
            "camera": {"eye": [0, 0, 4], "target": [0, 0, 0], "fov_deg": 40}, "lights": [{"kind": "environment", "radiance": 1}],
            "materials": [{"name": "m", "kind": "lambert", "albedo": 0.5}],
            "shapes": [{"kind": "mesh", "file": name, "material": "m"} for name in names]})
    bench.put("0.ply.gz", packed_ply(n))
    bench.counts("1,000 shapes of one packed file", "s.json", scene(["./" * (i % 9) + "0.ply.gz" for i in range(1000)]),
                 meshes=1, placements=1000)
    if files.SANITIZED:
        return
    for i in range(1, files_n):
        shutil.copy(os.path.join(bench.folder, "0.ply.gz"), os.path.join(bench.folder, f"{i}.ply.gz"))
    names = [f"{i}.ply.gz" for i in range(files_n)]
    bench.counts("4 packed files", "s.json", scene(names[:4]), meshes=4)
    each = "".join(f'Shape "plymesh" "string filename" "{name}"\n' for name in names)
    for name, text in (("s.json", scene(names)), ("s.pbrt", PBRT + each)):
        bench.put(name, text)
        done = bench.run("scene", "check", name)
        words = (name, "12.ply.gz: ", "more than 1024 MiB and more than 64 times their files: use fewer or smaller ones")
        bench.checks.check(done and done.code == 3 and all(word in done.err.decode() for word in words) and done.mib < 1400,
                           f"40 packed files: {done and (done.code, done.err[-300:], done.mib)}")


def environments(bench):
    """A packed image of the largest size as an environment, whose pixels are computed anew."""
    bench.put("sky.png", png(SIDE))
    bench.put("s.pbrt", 'Camera "perspective"\nWorldBegin\nLightSource "infinite" "string filename" "sky.png"\nShape "sphere"\n')
    bench.put("s.xml", '<scene version="3.0.0"><sensor type="perspective"/><emitter type="envmap"><string name="filename" '
              'value="sky.png"/></emitter><shape type="sphere"/></scene>')
    for name in ("s.pbrt", "s.xml"):
        done = files.run(bench.program, "scene", "check", name, cwd=bench.folder, env=SANITIZER, processor=PROCESSOR // 2)
        bench.checks.check(done and done.code in (0, 1) and done.mib < 1200, f"{name}: {done and (done.code, done.err, done.mib)}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(os.path.abspath(sys.argv[1]), folder, env=SANITIZER, processor=PROCESSOR)
        bench.put("a.serialized", packed(1))
        bench.put("s.xml", mitsuba('<shape type="serialized"><string name="filename" value="a.serialized"/></shape>'))
        done = bench.run("scene", "check", "s.xml")
        if re.search(b"no zlib|no expat|no Embree", done.err):
            print("skipped: " + done.err.decode().strip())
            return
        for part in (instances, trees, spectra, texts, references, names, materials, meshes, material_files,
                     buffers, indices, damaged, glows, packed_meshes, environments):
            part(bench)
        bench.checks.end()


if __name__ == "__main__":
    main()

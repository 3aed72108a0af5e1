#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_serialized.py PROGRAM FAULTS: compressed meshes, whole and hostile.

Mitsuba's .serialized files are written here by struct and zlib, as the documentation of its plug-in "serialized" defines them,
in both versions and precisions, with every combination of normals, texture coordinates and colours. What Koksma reads
of them must be what it reads of the same mesh as PLY, in a .ply.gz too: equal pictures
of Mitsuba scenes. Then come files that are cut, damaged or claim what they cannot hold: exit code 3, one line that names the
file, and no memory beyond docs/files.md. With sanitizers each flag is in fewer files, fewer bytes are damaged, and no file is of a GiB.
"""
import gzip
import itertools
import os
import re
import struct
import sys
import tempfile
import zlib

import files

NORMALS, UVS, COLOURS, FACES, SINGLE, DOUBLE = 1, 2, 8, 16, 0x1000, 0x2000

# A roof of four triangles; all numbers are exact in single precision.
PLACES = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0.25, 0, 0.75)]
SLANTED = [(-0.5, -0.5, 0.75), (0.5, -0.5, 0.75), (0.5, 0.5, 0.75), (-0.5, 0.5, 0.75), (0, 0, 1)]
TEXELS = [(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0.75)]
TRIANGLES = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]


def moved(places, by):
    return [(x + by, y, z) for x, y, z in places]


def mesh(flags, version=4, places=PLACES, name="roof", counts=None, tail=b""):
    """What one mesh's stream holds, before it is compressed."""
    number = "<d" if flags & DOUBLE else "<f"
    arrays = [places] + [array for flag, array in ((NORMALS, SLANTED), (UVS, TEXELS), (COLOURS, PLACES)) if flags & flag]
    return (struct.pack("<I", flags) + (name.encode() + b"\0" if version == 4 else b"")
            + struct.pack("<QQ", *(counts or (len(places), len(TRIANGLES))))
            + b"".join(struct.pack(number, x) for array in arrays for row in array for x in row)
            + b"".join(struct.pack("<3I", *triangle) for triangle in TRIANGLES) + tail)


def serialized(bodies, version=4, offsets=None, count=None):
    """A file of these streams; offsets and count: what its dictionary claims."""
    data, at = b"", []
    for body in bodies:
        at.append(len(data))
        data += struct.pack("<HH", 0x041C, version) + zlib.compress(body)
    at = at if offsets is None else offsets
    return (data + b"".join(struct.pack("<I" if version == 3 else "<Q", offset) for offset in at)
            + struct.pack("<I", len(at) if count is None else count))


def ply(flags, meshes):
    """The same as text."""
    columns = "x y z" + (" nx ny nz" if flags & NORMALS else "") + (" u v" if flags & UVS else "")
    rows = [place + (SLANTED[i] if flags & NORMALS else ()) + (TEXELS[i] if flags & UVS else ())
            for places in meshes for i, place in enumerate(places)]
    faces = [[5 * k + i for i in triangle] for k in range(len(meshes)) for triangle in TRIANGLES]
    return ("ply\nformat ascii 1.0\n" + f"element vertex {len(rows)}\n"
            + "".join(f"property float {column}\n" for column in columns.split())
            + f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
            + "".join(" ".join(map(str, row)) + "\n" for row in rows)
            + "".join("3 " + " ".join(map(str, face)) + "\n" for face in faces)).encode()


SCENE = """<scene version="3.0.0"><sensor type="perspective"><float name="fov" value="40"/><transform name="to_world">
<lookat origin="1, -2, 5" target="0, 0, 0" up="0, 0, 1"/></transform><film type="hdrfilm"><integer name="width" value="24"/>
<integer name="height" value="16"/></film></sensor><emitter type="point"><point name="position" x="1" y="-3" z="4"/>
<rgb name="intensity" value="20"/></emitter><shape type="{kind}"><string name="filename" value="{name}"/>{more}
<bsdf type="diffuse"><texture type="checkerboard" name="reflectance"/></bsdf></shape></scene>"""


class Bench(files.Bench):
    def picture(self, kind, name, more=""):
        self.put("s.xml", SCENE.format(kind=kind, name=name, more=more))
        done = self.run("render", "s.xml", "-n", "1", "-q", "-o", "s.pfm")
        self.checks.check(done and done.code == 0, f"picture of {name}: {done and done.err}")
        with open(os.path.join(self.folder, "s.pfm"), "rb") as stream:
            return stream.read()

    def refused(self, what, data, *words, name="bad.serialized"):
        self.put(name, data)
        done = self.run("scene", "check", name)
        self.checks.refused(what, done, 3, name, *words)
        self.checks.check(done and done.mib < files.OTHER, f"{what}: {done and done.mib:.0f} MiB")


def wholes(bench):
    every = itertools.product((3, 4), (SINGLE, DOUBLE), *[(0, flag) for flag in (NORMALS, UVS, COLOURS)])
    for version, precision, *parts in itertools.islice(every, None, None, 5 if files.SANITIZED else 1):
        flags = precision | sum(parts)
        bench.put("a.serialized", serialized([mesh(flags, version)], version))
        bench.put("a.ply", ply(flags, [PLACES]))
        bench.checks.check(bench.picture("serialized", "a.serialized") == bench.picture("ply", "a.ply"), f"version {version}, flags {flags:#x}")
    flags = SINGLE | NORMALS | UVS
    for version in (3, 4):
        three = [mesh(flags, version, moved(PLACES, by), f"roof {by}") for by in (0, 4, -0.5)]
        bench.put("three.serialized", serialized(three, version))
        for index, by in enumerate((0, 4, -0.5)):
            bench.put("one.ply", ply(flags, [moved(PLACES, by)]))
            for more in ("", '<boolean name="face_normals" value="true"/>'):
                numbered = bench.picture("serialized", "three.serialized", f'<integer name="shape_index" value="{index}"/>' + more)
                bench.checks.check(numbered == bench.picture("ply", "one.ply", more), f"version {version}: picture of mesh {index}{more}")
    bench.put("bare.serialized", serialized([mesh(SINGLE | UVS | FACES)]))  # Mitsuba 3 ignores the flag, and smooths
    bench.put("one.ply", ply(UVS, [PLACES]))
    bench.checks.check(bench.picture("serialized", "bare.serialized") == bench.picture("ply", "one.ply"), "a mesh without normals")
    flat = bench.picture("serialized", "bare.serialized", '<boolean name="face_normals" value="true"/>')
    bench.checks.check(flat != bench.picture("serialized", "bare.serialized"), "a mesh without normals is not smoothed")
    done = bench.run("scene", "check", bench.put("c.serialized", serialized([mesh(SINGLE | COLOURS)])))
    bench.checks.check(done.code == 1 and b"vertex colours" in done.err, f"colours that are not read: {done.err}")


def gzipped(bench):
    text = ply(SINGLE | NORMALS | UVS, [PLACES])
    bench.put("a.ply", text)
    plain = bench.picture("ply", "a.ply")
    half = len(text) // 2
    for what, data in (("one stream", gzip.compress(text)), ("two streams", gzip.compress(text[:half]) + gzip.compress(text[half:]))):
        bench.put("a.ply.gz", data)
        bench.checks.check(bench.picture("ply", "a.ply.gz") == plain, f".ply.gz: {what}")
    packed = gzip.compress(text)
    bench.refused("a plain file as .ply.gz", text, "1F 8B", name="b.ply.gz")
    bench.refused("a cut .ply.gz", packed[:-12], "cut short", name="b.ply.gz")
    bench.refused("a damaged .ply.gz", packed[:40] + bytes(8) + packed[48:], "damaged", name="b.ply.gz")
    bench.refused("an empty .ply.gz", gzip.compress(b""), "empty", name="b.ply.gz")
    bench.refused("an .obj in a .ply.gz", gzip.compress(b"v 0 0 0\n"), "line 1", name="b.ply.gz")
    if files.SANITIZED:
        return
    # 1 GiB + 1 of zeros is the least that is too long; its 1 MiB of gzip costs the memory of what a model may have
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    data = b"".join(packer.compress(bytes(1 << 20)) for _ in range(1024)) + packer.compress(b"\0") + packer.flush()
    bench.put("b.ply.gz", data)
    done = bench.run("scene", "check", "b.ply.gz")
    bench.checks.check(done and done.code == 3 and f"b.ply.gz: it decompresses to more than {1 << 30} bytes".encode() in done.err,
                       f"a .ply.gz that stands for too much: {done and done.err}")
    # while a block grows by half, the old one may still be there
    bench.checks.check(done and done.mib < 2 * 1024 + files.OTHER, f"a .ply.gz that stands for too much: {done and done.mib:.0f} MiB")


def included(bench):
    """A text that a scene of pbrt includes, packed by gzip."""
    head = 'Camera "perspective" "float fov" 60 Film "rgb" "integer xresolution" 24 "integer yresolution" 16 WorldBegin\n'
    body = 'LightSource "infinite" Translate 0 0 3 Material "diffuse" Shape "sphere"\n'
    pictures = []
    for name, data in (("body.pbrt", body.encode()), ("body.pbrt.gz", gzip.compress(body.encode()))):
        bench.put(name, data)
        bench.put("s.pbrt", head + f'Include "{name}"\n')
        done = bench.run("render", "s.pbrt", "-n", "4", "-q", "-o", "s.pfm")
        bench.checks.check(done and done.code == 0, f"{name}: {done and done.err}")
        with open(os.path.join(bench.folder, "s.pfm"), "rb") as stream:
            pictures.append(stream.read())
    bench.checks.check(pictures[0] == pictures[1], "a packed text gives another picture")
    for what, data, words in (("cut", gzip.compress(body.encode())[:-9], "cut short"), ("no gzip", body.encode(), "damaged"),
                              ("binary", gzip.compress(bytes(600)), "zero byte"),
                              ("long", gzip.compress(b" " * ((64 << 20) + 1)), f"more than {64 << 20} bytes")):
        bench.put("body.pbrt.gz", data)
        bench.checks.refused(f"a packed text, {what}", bench.run("scene", "check", "s.pbrt"), 3, "s.pbrt:2: ", "body.pbrt.gz", words)
    # many names, of which the first is looked up a million times
    names = "".join(f'ObjectBegin "{i}" ObjectEnd CoordinateSystem "{i}"\n' for i in range(200000))
    bench.put("s.pbrt", head + names + 'ObjectInstance "0" CoordSysTransform "0"\n' * 1000000 + body)
    done = bench.run("scene", "check", "s.pbrt")
    bench.checks.check(done and done.code in (0, 1), f"many names: {done and done.err}")
    bench.put("s.pbrt", head + "".join(f'Texture "{i}" "spectrum" "constant"\n' for i in range(65537)) + body)
    done = bench.run("scene", "check", "s.pbrt")
    bench.checks.check(done and done.code == 3 and b"s.pbrt:65538: more than 65536 textures" in done.err, f"many textures: {done and done.err}")
    # small files cannot make a long text: 64 MiB of blanks are 64 KiB of gzip
    bench.put("long.pbrt.gz", gzip.compress(b" " * (64 << 20)))
    bench.put("long.pbrt", b" " * (60 << 20))
    for name, line in (("long.pbrt.gz", 9), ("long.pbrt", 10)):
        bench.put("s.pbrt", head + f'Include "{name}"\n' * 4 + body)
        done = bench.run("scene", "check", "s.pbrt")
        bench.checks.check(done and done.code in (0, 1), f"four times {name}: {done and done.err}")
        bench.put("s.pbrt", head + f'Include "{name}"\n' * 4096 + body)
        done = bench.run("scene", "check", "s.pbrt")
        said = f"s.pbrt:{line}: reading the scene up to here takes more than".encode()  # AddressSanitizer keeps texts that were freed
        bench.checks.check(done and done.code == 3 and said in done.err, f"4,096 times {name}: {done and done.err}")


def hostiles(bench):
    good, flags = mesh(SINGLE), SINGLE
    whole = serialized([good])
    bench.refused("empty", b"", "1C 04")
    bench.refused("another format", b"\x1c\x05" + whole[2:], "1C 04")
    bench.refused("text", b"v 0 0 0\nv 1 0 0\n", "1C 04")
    bench.refused("only the mark", whole[:2], "1C 04")
    bench.refused("no dictionary", whole[:6], "its last four bytes")
    for version in (0, 2, 5):
        bench.refused(f"version {version}", whole[:2] + struct.pack("<H", version) + whole[4:], f"version {version}")
    bench.refused("no mesh", serialized([good], offsets=[]), "0 meshes")
    for count in (2, 1000, 0xFFFFFFFF):
        bench.refused(f"{count} meshes claimed", serialized([good], count=count), "bad.serialized")
    for offsets in ([1], [5], [len(whole)], [2**63], [2**64 - 1], [2**64 - 4], [0, 0], [20, 0], [0, 3]):
        bench.refused(f"meshes at {offsets}", serialized([good], offsets=offsets), "bad.serialized")
    bench.refused("a cut stream", whole[:40] + whole[-12:], "bad.serialized")
    bench.refused("a damaged stream", whole[:20] + bytes(20) + whole[40:], "compressed data is damaged")
    bench.refused("too little in the stream", serialized([good[:-4]]), "less than its header claims")
    bench.refused("no precision", serialized([mesh(NORMALS)]), "neither single nor double")
    bench.refused("both precisions", serialized([mesh(SINGLE | DOUBLE)]), "or both")
    bench.refused("an endless name", serialized([struct.pack("<I", flags) + b"n" * 100000]), "name of more than")
    bench.refused("no triangles", serialized([mesh(SINGLE, counts=(5, 0))]), "no triangles")
    for counts in ((2**26 + 1, 4), (5, 2**26 + 1), (2**64 - 1, 4), (5, 2**63)):
        bench.refused(f"{counts} claimed", serialized([mesh(flags, counts=counts)]), "a mesh has at most")
    for counts in ((2**26, 4), (5, 2**26), (10000, 10000)):
        bench.refused(f"{counts} claimed", serialized([mesh(flags, counts=counts)]), "compressed bytes can hold")
    bench.refused("an index beyond", serialized([good[:-4] + struct.pack("<I", 5)]), "a vertex that does not exist")
    bench.refused("an infinite vertex", serialized([good[:25] + struct.pack("<f", float("inf")) + good[29:]]), "inf")
    # many meshes, of which each claims the most that its stream could hold: together more than a model may have
    body = struct.pack("<I", SINGLE) + b"\0" + struct.pack("<QQ", 1 << 25, 1) + bytes(12 << 20)
    bench.refused("zeros", serialized([body] * 4), "bad.serialized")
    for index, words in ((1, "no mesh 1"), (-1, "shape_index"), (1e10, "shape_index")):
        bench.put("good.serialized", whole)
        bench.put("s.xml", SCENE.format(kind="serialized", name="good.serialized", more=f'<float name="shape_index" value="{index}"/>'))
        bench.checks.refused(f"shape_index {index}", bench.run("scene", "check", "s.xml"), 3, words)
    for at in range(0, len(whole), 15 if files.SANITIZED else 3):  # each third byte changed
        bench.put("bad.serialized", whole[:at] + bytes([whole[at] ^ 0x55]) + whole[at + 1:])
        done = bench.run("scene", "check", "bad.serialized")
        bench.checks.check(done and done.code in (0, 1, 3) and (done.code < 3 or b"bad.serialized" in done.err), f"byte {at}: {done and done.err}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(os.path.abspath(sys.argv[1]), folder)
        done = bench.run("scene", "check", bench.put("probe.serialized", serialized([mesh(SINGLE)])))
        if re.search(b"no zlib|no Embree", done.err):
            print("skipped: " + done.err.decode().strip())
            return
        wholes(bench)
        gzipped(bench)
        included(bench)
        hostiles(bench)
        bench.checks.end()


if __name__ == "__main__":
    main()

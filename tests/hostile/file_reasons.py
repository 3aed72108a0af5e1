#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_reasons.py PROGRAM FAULTS: exit codes and messages for files that are damaged, of another kind, or oddly named.

EXR files are written here by the format's own page (https://openexr.com/en/latest/OpenEXRFileLayout.html): good ones,
those of kinds that are not read, and good ones with each byte of their pixels damaged. File names with newlines, escape
sequences, and bytes that are no UTF-8 stand in each place of the command line, in scenes and in plans. The exit code is 3
for what is wrong with a file, 4 for what is wrong with the system, and the message is one line of UTF-8. With sanitizers each
place has one of the names in turn, and fewer bytes are damaged.
"""
import json
import os
import struct
import subprocess
import sys
import tempfile
import zlib

import files

WIDTH, HEIGHT = 8, 6
NONE, RLE, ZIPS, ZIP, PIZ, PXR24 = 0, 1, 2, 3, 4, 5


# ---- EXR ------------------------------------------------------------------------------------------------------

def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def header(channels="BGR", compression=NONE, sampling=1, deep=False, parts=False, window=(0, 0, WIDTH - 1, HEIGHT - 1)):
    lists = b"".join(name.encode() + b"\0" + struct.pack("<iiii", 2, 0, sampling, sampling) for name in channels) + b"\0"
    flags = 2 | (0x800 if deep else 0) | (0x1000 if parts else 0)
    out = struct.pack("<ii", 20000630, flags)
    out += attribute("channels", "chlist", lists) + attribute("compression", "compression", bytes([compression]))
    out += attribute("dataWindow", "box2i", struct.pack("<iiii", *window))
    out += attribute("displayWindow", "box2i", struct.pack("<iiii", *window))
    out += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    out += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
    out += attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    if deep:
        out += attribute("type", "string", b"deepscanline") + attribute("version", "int", struct.pack("<i", 1))
        out += attribute("chunkCount", "int", struct.pack("<i", HEIGHT)) + attribute("name", "string", b"d")
        out += attribute("maxSamplesPerPixel", "int", struct.pack("<i", 1))
    return out + b"\0"


def shuffled(data):
    """What OpenEXR does to bytes before it compresses them."""
    halves = data[0::2] + data[1::2]
    return bytes([halves[0]]) + bytes((b - a + 128) & 255 for a, b in zip(halves, halves[1:]))


def run_lengths(data):
    out, i = b"", 0
    while i < len(data):
        n = 1
        while n < 127 and i + n < len(data) and data[i + n] == data[i]:
            n += 1
        out += struct.pack("b", n - 1) + data[i:i + 1]
        i += n
    return out


def exr(compression=NONE, channels="BGR", **how):
    """(file, offset of the first chunk)."""
    start = header(channels, compression, **how)
    lines = {ZIP: 16, PXR24: 16, PIZ: 32}.get(compression, 1)
    chunks, offsets = [], []
    at = len(start) + 8 * -(-HEIGHT // lines)
    for y in range(0, HEIGHT, lines):
        n = min(lines, HEIGHT - y)
        data = struct.pack(f"<{WIDTH * n * len(channels)}f", *[(i * 7 % 13) / 13 for i in range(WIDTH * n * len(channels))])
        if compression in (ZIPS, ZIP):
            data = zlib.compress(shuffled(data))
        elif compression == RLE:
            data = run_lengths(shuffled(data))
        elif compression != NONE:
            data = b"\xa5" * 40  # no such stream
        chunks.append(struct.pack("<ii", y, len(data)) + data)
        offsets.append(at)
        at += len(chunks[-1])
    return start + struct.pack(f"<{len(offsets)}Q", *offsets) + b"".join(chunks), offsets[0]


def put(folder, name, data):
    with open(os.path.join(folder, name), "wb") as stream:
        stream.write(data)
    return name


def check_exr(checks, program, folder):
    good = put(folder, "good.exr", exr()[0])
    for name, made in (("none", exr()[0]), ("zip", exr(ZIP)[0]), ("zips", exr(ZIPS)[0]), ("one", exr(channels="Y")[0])):
        done = files.run(program, "compare", put(folder, f"{name}.exr", made), good, cwd=folder)
        checks.check(done and done.code in (0, 2) and (done.code == 0 or name == "one"), f"{name}: {done and done.err}")
    for name, made, why in (("deep", exr(deep=True)[0], "deep"), ("subsampled", exr(sampling=2)[0], "subsampled"),
                            ("b44", exr(6)[0], "B44"), ("no-colour", exr(channels="PQ")[0], "no channels")):
        checks.refused(name, files.run(program, "compare", put(folder, f"{name}.exr", made), good, cwd=folder), 3,
                       f"{name}.exr", why)
    tried, often = 0, 8 if files.SANITIZED else 1
    for name, compression in (("rle", RLE), ("zips", ZIPS), ("zip", ZIP), ("piz", PIZ), ("pxr24", PXR24)):
        made, at = exr(compression)
        damaged = [made[:i] + bytes([made[i] ^ bits]) + made[i + 1:] for i in range(at, len(made), 11 * often) for bits in (1, 255)]
        damaged += [made[:i] for i in range(at, len(made), 41 * often)]
        for i, data in enumerate([made] * (compression in (PIZ, PXR24)) + damaged):
            done = files.run(program, "compare", put(folder, f"{name}.exr", data), good, cwd=folder)
            if done is None or done.code or compression in (PIZ, PXR24):
                checks.refused(f"{name}, damaged in way {i}", done, 3, f"{name}.exr")
            tried += 1
    checks.check(tried > 100 / often, f"{tried} damaged files only")


# ---- Two files --------------------------------------------------------------------------------------------------

def check_two(checks, program, folder):
    for name, size in (("a.pfm", "8x6"), ("b.pfm", "6x8"), ("c.png", "8x6")):
        files.run(program, "render", "ball", "-n", "1", "--size", size, "-q", "-o", name, cwd=folder)
    for words in (["a.pfm", "b.pfm"], ["a.pfm", "c.png", "b.pfm"], ["c.png", "b.pfm", "a.pfm"]):
        wrong = words[0] if words[-1] == "b.pfm" else "b.pfm"
        checks.refused(f"compare {words}", files.run(program, "compare", *words, cwd=folder), 2, wrong, words[-1])


# ---- Names ------------------------------------------------------------------------------------------------------

NAMES = [b"new\nline", b"esc\x1b[31mape", b"bad\xff\xfebytes", b"over\xc0\xaflong", b"c1\xc2\x9b31m", b"tab\tbell\x07",
         b"half\xe2\x82", "gr\u00fcn \u20ac".encode(), b"%s%n%x", b"'\";&|$(x)", b"\xed\xa0\x80surrogate", b"x" * 250]


def check_names(checks, program, folder):
    """Each place of the command line that takes a file's name, with files that are not there, and malformed ones."""
    places = [["measure", b"@.txt"], ["measure", b"pattern:file:@.txt@3"], ["verify", b"@.npy"], ["plot", b"@.csv", "-o", "p.svg"],
              ["curve", "rings", b"@.txt"], ["generate", b"file:@.txt", "-n", "3"], ["compare", b"@.png", b"@.exr"],
              ["scene", "check", b"./@.json"], ["scene", "check", b"./@.obj"], ["scene", "check", b"./@.gltf"],
              ["render", b"./@.json", "-o", "o.png"], ["study", "run", b"./@.json", "-o", "out"],
              ["study", "estimate", b"./@.json"], ["study", "export", b"@"], ["study", "report", b"@"],
              ["study", "images", b"@_{spp}.exr", "--reference", b"@.exr"], ["rank", b"./@.json"],
              ["generate", "random", "-n", "3", "-o", b"no/@/@.txt"], ["render", "ball", "-n", "1", "-o", b"@"],
              [b"@"], ["generate", b"@", "-n", "3"], ["list", b"@"], ["render", "ball", b"--@"],
              ["generate", "random", "-n", b"@"], ["render", b"@", "-o", "o.png"], ["study", "run", b"@", "-o", "out"],
              ["help", b"@"], ["plot", "pattern:random@4", "-o", b"@"], ["measure", "pattern:random@4", "-m", b"@"]]
    for place, name in files.each(places, NAMES):
        for malformed in (False, True):
            words = [word.replace(b"@", name) if isinstance(word, bytes) else word.encode() for word in place]
            made = [w.split(b"file:")[-1].split(b"@")[0] for w in words if malformed and w.endswith(
                (b".txt", b".npy", b".csv", b".png", b".json", b".obj", b".gltf", b"@3")) and not w.startswith(b"no/")]
            if malformed and not made:
                continue
            for word in made:
                put(folder.encode(), word, b"\x01 nothing \xff that anybody reads\n")
            done = files.run(program, *words, cwd=folder)
            what = f"{words}{' malformed' if malformed else ''}"
            if checks.check(done is not None, f"{what}: did not end") and done.code:
                checks.check(files.is_utf8(done.err) and done.err.endswith(b"\n"), f"{what}: {done.err!r}")
                lines = done.err.decode("utf-8", "replace")[:-1]
                checks.check(lines and all(c == " " or c.isprintable() for c in lines), f"{what}: {done.err!r}")
                checks.check(done.code in (2, 3, 4), f"{what}: exit code {done.code}")
            for word in made:
                os.remove(os.path.join(folder.encode(), word))


def check_names_within(checks, program, folder):
    """Names that a scene or plan holds: JSON's texts are UTF-8, and may hold any character."""
    for name in ("new\nline.png", "esc\x1b[31mape.png", "c1\u009b31m.png", "gr\u00fcn.png"):
        made = {"camera": {"eye": [0, 0, 5], "target": [0, 0, 0], "fov_deg": 40},
                "materials": [{"name": name, "kind": "lambert", "albedo": {"image": name}}], "shapes": [], "lights": []}
        put(folder, "s.json", json.dumps(made).encode())
        done = files.run(program, "scene", "check", "s.json", cwd=folder)
        checks.refused(f"a scene that names {name!r}", done, 3, "s.json")
        checks.check(all(c.isprintable() for c in done.err.decode()[:-1]), f"{name!r}: {done.err!r}")


def main():
    program = os.path.abspath(sys.argv[1])
    checks = files.Checks()
    has_exr = subprocess.run([program, "render", "ball", "-n", "1", "--size", "4x4", "-q", "-o", "/dev/null/x.exr"],
                             capture_output=True, check=False).returncode == 4
    for case in (check_exr, check_two, check_names, check_names_within):
        if case is check_exr and not has_exr:
            continue
        with tempfile.TemporaryDirectory() as folder:
            case(checks, program, folder)
    checks.end()


if __name__ == "__main__":
    main()

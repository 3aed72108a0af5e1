#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""metadata.py KOKSMA: what a file says of its numbers counts. The files are written here, from their formats' definitions:
EXR (openexr.com, "OpenEXR File Layout"), PFM (pauldebevec.com/Research/HDR/PFM), NPY (numpy.lib.format), sets of UTK
(lines "#" between them), Git LFS pointers (the specification of git-lfs)."""
import json
import os
import random
import struct
import subprocess
import sys
import tempfile

KOKSMA = os.path.abspath(sys.argv[1])
failures = []


def run(*arguments):
    return subprocess.run([KOKSMA, *arguments], capture_output=True, text=True, check=False, timeout=60)


def check(what, true, said=""):
    if not true:
        failures.append(f"{what}: {said}")


def put(name, content):
    with open(name, "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())


# ---- Points ----------------------------------------------------------------------------------------------------

def star(name):
    said = run("measure", name, "-m", "star", "--json")
    return json.loads(said.stdout.splitlines()[0])["value"] if not said.returncode else said.stderr


def text_of(points):
    return "".join(" ".join(f"{x:.17g}" for x in p) + "\n" for p in points)


def npy(descr, code, rows, numbers):
    header = f"{{'descr': '{descr}', 'fortran_order': False, 'shape': ({rows}, {len(numbers) // rows}), }}"
    header += " " * (63 - (10 + len(header)) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + struct.pack(code, *numbers)


def arrays():
    """Unsigned integers of b bits are fractions of 2^b, float16 are themselves, signed integers, too."""
    rng = random.Random(1)
    n = 16
    for bits, code in ((8, "B"), (16, "H"), (32, "I"), (64, "Q")):
        numbers = [rng.randrange(2**bits) for _ in range(2 * n)]
        put("t.txt", text_of([[x / 2**bits for x in numbers[2 * i:2 * i + 2]] for i in range(n)]))
        for order in "<>" if bits > 8 else "|":
            put("a.npy", npy(f"{order}u{bits // 8}", f"{order if bits > 8 else '<'}{2 * n}{code}", n, numbers))
            check(f"{order}u{bits // 8}", star("a.npy") == star("t.txt"), star("a.npy"))
    halves = [struct.unpack("<e", struct.pack("<e", rng.random()))[0] for _ in range(2 * n - 3)] + [0.0, 1.0, 2.0**-24]
    put("t.txt", text_of([halves[2 * i:2 * i + 2] for i in range(n)]))
    for order in "<>":
        put("a.npy", npy(f"{order}f2", f"{order}{2 * n}e", n, halves))
        check(f"{order}f2", star("a.npy") == star("t.txt"), star("a.npy"))
    put("t.txt", "0 1\n1 0\n")
    for bits, code in ((8, "b"), (16, "h"), (32, "i"), (64, "q")):
        put("a.npy", npy(f"{'|' if bits == 8 else '<'}i{bits // 8}", f"<4{code}", 2, [0, 1, 1, 0]))
        check(f"i{bits // 8}", star("a.npy") == star("t.txt"), star("a.npy"))
        for wrong in (2, -1, -2**(bits - 1), 2**(bits - 1) - 1):
            put("a.npy", npy(f"{'|' if bits == 8 else '<'}i{bits // 8}", f"<4{code}", 2, [0, 1, wrong, 0]))
            said = run("measure", "a.npy", "-m", "star")
            check(f"i{bits // 8} of {wrong}", said.returncode == 3 and "outside [0,1]" in said.stderr, said.stderr)
    for bad in (float("inf"), float("nan"), -0.5, 1.5):
        put("a.npy", npy("<f2", "<4e", 2, [0, 1, bad, 0]))
        check(f"f2 of {bad}", run("measure", "a.npy", "-m", "star").returncode == 3)
    for descr in ("|b1", "<c8", "<f1", "|u2", "<u1", "<u3", "<M8", "|S4"):
        put("a.npy", npy(descr, "<8I", 2, [0] * 8))
        said = run("measure", "a.npy", "-m", "star")
        check(descr, said.returncode == 3 and "float16, float32, float64 or an integer" in said.stderr, said.stderr)


def sets():
    """A line "#" ends a set; one set with such a line at its end, or before it, is one set; two are refused with the line."""
    a, b = "0.1 0.2\n0.3 0.4\n", "0.5 0.6\n0.7 0.8\n"
    put("one.txt", a)
    for name, text in (("end", a + "#\n"), ("end and blanks", a + " # \n\n#\n"), ("start", "#\n" + a), ("comments", "# x\n" + a + "# y\n"),
                       ("carriage return", a.replace("\n", "\r\n") + "#\r\n")):
        put("s.txt", text)
        check(f"one set, {name}", star("s.txt") == star("one.txt"), star("s.txt"))
    put("s.txt", a.replace("\n", " # c\n") + "# between\n" + b)
    check("comments in a set", isinstance(star("s.txt"), float), star("s.txt"))
    for name, text in (("two sets", a + "#\n" + b), ("three", a + "#\n" + b + "#\n" + a), ("blanks", a + " #\t\n" + b), ("CR LF", a + "#\r\n" + b)):
        put("s.txt", text)
        said = run("measure", "s.txt", "-m", "star")
        check(name, said.returncode == 3 and "line 3: the line '#' ends a set of 2 points" in said.stderr, said.stderr)


# ---- Images ----------------------------------------------------------------------------------------------------

def exr(width, height, pixels, attributes=(), compression=0):
    """Scan lines of floats without compression: magic, version, attributes, a table of offsets, a chunk for each line."""
    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    channels = b"".join(c + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    head = struct.pack("<ii", 20000630, 2) + attribute("channels", "chlist", channels)
    head += attribute("compression", "compression", bytes([compression])) + attribute("dataWindow", "box2i", window)
    head += attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", b"\0")
    head += attribute("pixelAspectRatio", "float", struct.pack("<f", 1)) + attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    for name, kind, value in attributes:
        head += attribute(name, kind, value)
    head += b"\0"
    size, start = 8 + 12 * width, len(head) + 8 * height
    table = b"".join(struct.pack("<Q", start + y * size) for y in range(height))
    lines = b""
    for y in range(height):
        row = pixels[y * width:(y + 1) * width]
        lines += struct.pack("<ii", y, 12 * width) + b"".join(struct.pack(f"<{width}f", *[p[c] for p in row]) for c in (2, 1, 0))
    return head + table + lines


def times(matrix, v):
    return [sum(a * b for a, b in zip(row, v)) for row in matrix]


# IEC 61966-2-1, and SMPTE ST 2065-1: the XYZ of ACES's red, green and blue
FROM_XYZ = ((3.2406255, -1.5372080, -0.4986286), (-0.9689307, 1.8757561, 0.0415175), (0.0557101, -0.2040211, 1.0569959))
ACES = ((0.9525523959, 0, 0.0000936786), (0.3439664498, 0.7281660966, -0.0721325464), (0, 0, 1.0088251844))
CHROMATICITIES = {"XYZ": ((1, 0, 0, 1, 0, 0, 1 / 3, 1 / 3), ((1, 0, 0), (0, 1, 0), (0, 0, 1))),
                  "ACES": ((0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767), ACES)}


def chromaticities(xy):
    return ("chromaticities", "chromaticities", struct.pack("<8f", *xy))


def mae(a, b):
    said = run("compare", a, b, "--json")
    return json.loads(said.stdout.splitlines()[0])["mean"] if not said.returncode else float("nan")


def colours():
    rng = random.Random(2)
    pixels = [[rng.random() for _ in range(3)] for _ in range(24)]
    for name, (xy, matrix) in CHROMATICITIES.items():
        put("a.exr", exr(6, 4, pixels, [chromaticities(xy)]))
        put("b.exr", exr(6, 4, [times(FROM_XYZ, times(matrix, p)) for p in pixels]))
        put("c.exr", exr(6, 4, pixels))
        check(f"{name} is converted", mae("a.exr", "b.exr") < 3e-4, mae("a.exr", "b.exr"))
        check(f"{name} is not Rec. 709", mae("c.exr", "b.exr") > 0.01, mae("c.exr", "b.exr"))
    put("a.exr", exr(6, 4, pixels, [chromaticities((0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290))]))
    check("Rec. 709 stays", mae("a.exr", "c.exr") == 0, mae("a.exr", "c.exr"))
    put("a.exr", exr(6, 4, pixels, [chromaticities((0.3, 0.3) * 4)]))
    said = run("compare", "a.exr", "c.exr")
    check("no colour space", said.returncode == 3 and "chromaticities" in said.stderr, said.stderr)
    for number, name in ((10, "HTJ2K256"), (11, "HTJ2K32"), (12, "number 12"), (200, "number 200")):
        put("a.exr", exr(6, 4, pixels, compression=number))
        said = run("compare", "a.exr", "c.exr")
        check(f"compression {number}", said.returncode == 3 and name in said.stderr, said.stderr)


def scales():
    pixels = struct.pack("<4f", 0.1, 0.2, 0.3, 0.4)
    put("one.pfm", b"Pf\n2 2\n-1.0\n" + pixels)
    scene = {"camera": {"eye": [0, 1, 5], "target": [0, 0, 0], "fov_deg": 40}, "materials": [
        {"name": "m", "kind": "lambert", "albedo": {"image": "a.pfm"}}], "shapes": [
            {"kind": "rectangle", "centre": [0, 0, 0], "normal": [0, 0, 1], "half": [1, 1], "material": "m"}]}
    put("a.json", json.dumps(scene))
    put("a.pbrt", 'LookAt 0 1 5  0 0 0  0 1 0 Camera "perspective" WorldBegin LightSource "infinite" "string filename" "a.pfm"\n'
                  'Shape "sphere"\n')
    for scale, warns in (("-1", False), ("-1.0", False), ("-2", True), ("-0.5", True), ("-1e3", True)):
        put("a.pfm", f"Pf\n2 2\n{scale}\n".encode() + pixels)
        for what, line in (("compare", ("compare", "a.pfm", "one.pfm")),
                           ("texture", ("scene", "check", "./a.json")), ("environment", ("scene", "check", "a.pbrt"))):
            said = run(*line)
            check(f"{what}, scale {scale}", said.returncode in (0, 1) and ("scale" in said.stderr) == warns, said.stderr)


# ---- Pointers --------------------------------------------------------------------------------------------------

def pointers():
    """A Git LFS pointer is named as such by every reader of files."""
    pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:" + "4d7a" * 16 + "\nsize 12345\n"
    put("one.pfm", b"Pf\n1 1\n-1.0\n\x00\x00\x00\x3f")
    lines = [(name, ("scene", "check", "./" + name)) for name in ("a.obj", "a.ply", "a.gltf", "a.glb", "a.json", "a.pbrt")]
    lines += [(name, ("measure", name, "-m", "star")) for name in ("a.txt", "a.npy", "a.csv")]
    lines += [(name, ("compare", name, "one.pfm")) for name in ("a.exr", "a.png", "a.pfm", "a.jpg")]
    lines += [("a.vec", ("generate", "lattice-file:a.vec", "-n", "4")), ("a.mat", ("generate", "net-file:a.mat", "-n", "4")),
              ("a.pts", ("generate", "file:a.pts")), ("plan.json", ("study", "run", "plan.json", "-o", "study"))]
    for name, line in lines:
        put(name, pointer)
        said = run(*line)
        check(f"pointer {name}", said.returncode == 3 and "Git LFS pointer" in said.stderr and name in said.stderr,
              f"{said.returncode}: {said.stderr}")
    put("b.pbrt", 'LookAt 0 1 5  0 0 0  0 1 0 Camera "perspective" WorldBegin Shape "plymesh" "string filename" "a.ply"\n')
    said = run("scene", "check", "b.pbrt")
    check("a pointer that a scene names", said.returncode == 3 and "Git LFS pointer" in said.stderr, said.stderr)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for test in (arrays, sets, colours, scales, pointers):
        test()
for failure in failures:
    print(failure)
sys.exit(bool(failures))

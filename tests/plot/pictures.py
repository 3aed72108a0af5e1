#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""pictures.py PROGRAM PALETTE: what is in the pictures that the examples of `koksma plot --help` make, as they stand and
as SVG at the default width, 400 wide and dark: titles and names, as many marks as there are points, all inside the
picture, texts over no other text and over no data, contrasts, and the same bytes again; PNG with clear edges.

Widths of texts are those of Helvetica (Adobe's font metrics) and a quarter more, as other sans-serif fonts are wider.
"""
import itertools
import json
import os
import re
import shlex
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
import zlib

PROGRAM, PALETTE = (os.path.abspath(path) for path in sys.argv[1:3])
HELVETICA = [int(w) for w in (
    "278 278 355 556 556 889 667 191 333 333 389 584 278 333 278 278 556 556 556 556 556 556 556 556 556 556 278 278 584 584 584 "
    "556 1015 667 667 722 722 667 611 778 722 278 500 667 556 833 722 778 667 778 722 667 611 722 667 944 667 667 611 278 278 "
    "278 469 556 333 556 556 500 556 556 278 556 556 222 222 500 222 833 556 556 556 556 333 500 278 556 500 722 500 500 500 "
    "334 260 334 584").split()]
WIDER = 1.25
MAX_DIM = 8  # KOKSMA_PLOT_MAX_DIM
failed = 0


def check(good, *what):
    global failed
    if not good:
        failed += 1
        print(*what)


def koksma(*arguments):
    return subprocess.run([PROGRAM, *arguments], check=True, capture_output=True, text=True).stdout


def examples():
    """The command lines at the end of the help, as lists of arguments."""
    text = koksma("plot", "--help").split("\nexamples:\n")[1]
    return [shlex.split(line)[1:] for line in text.splitlines() if line.strip()]


# ---- A picture as boxes of texts, shapes and frames


class Box:
    def __init__(self, x0, y0, x1, y1, what=""):
        self.x0, self.y0, self.x1, self.y1, self.what = x0, y0, x1, y1, what

    def inside(self, other, slack=0.0):
        return self.x0 >= other.x0 - slack and self.y0 >= other.y0 - slack and self.x1 <= other.x1 + slack and self.y1 <= other.y1 + slack

    def meets(self, other):
        return self.x0 < other.x1 and other.x0 < self.x1 and self.y0 < other.y1 and other.y0 < self.y1


def text_box(element, style):
    size, text = float(style["font-size"]), element.text
    width = WIDER * size / 1000 * sum(HELVETICA[ord(c) - 32] if 32 <= ord(c) < 127 else 700 for c in text)
    x, y = float(element.get("x")), float(element.get("y"))
    # the anchor stands where it is; the spare width goes to the sides that a wider font would take
    left = x - {"start": 0, "middle": 0.5, "end": 1}[style.get("text-anchor", "start")] * width
    return Box(left, y - 0.72 * size, left + width, y + 0.2 * size, text)


class Picture:
    def __init__(self, data):
        root = xml.etree.ElementTree.fromstring(data)
        tag = "{http://www.w3.org/2000/svg}"
        self.title = root.findtext(f"{tag}title")
        self.view = Box(*map(float, root.get("viewBox").split()))
        self.size = float(root.get("width")), float(root.get("height"))
        self.texts, self.circles, self.frames, self.shapes, self.fills, self.images = [], [], [], [], [], 0
        for element in root:
            style = element.attrib if element.tag == f"{tag}g" else {}
            for part in list(element) if element.tag == f"{tag}g" else [element]:
                kind = part.tag.replace(tag, "")
                if kind == "text":
                    self.texts.append(text_box(part, style))
                    self.fills.append(style["fill"])
                elif kind == "circle":
                    x, y, r = (float(part.get(k)) for k in ("cx", "cy", "r"))
                    if style.get("stroke") is None:
                        self.circles.append(Box(x - r, y - r, x + r, y + r, "circle"))
                    else:
                        self.frames.append(Box(x - r, y - r, x + r, y + r, "disk"))
                elif kind in ("rect", "image"):
                    x, y, w, h = (float(part.get(k)) for k in ("x", "y", "width", "height"))
                    box = Box(x, y, x + w, y + h, kind)
                    self.shapes.append(box)
                    if kind == "image":
                        self.images += 1
                    elif style.get("stroke") and style.get("stroke-width") == "1":
                        self.frames.append(box)
                    if len(self.shapes) == 1:
                        self.paper = style["fill"]
                elif kind in ("polyline", "polygon"):
                    xs, ys = zip(*(map(float, pair.split(",")) for pair in part.get("points").split()))
                    box = Box(min(xs), min(ys), max(xs), max(ys), kind)
                    small = kind == "polygon" and max(box.x1 - box.x0, box.y1 - box.y0) < 9  # a mark that is not a disk
                    (self.circles if small and style.get("stroke") is None else self.shapes).append(box)
        self.words = "".join(box.what for box in self.texts).replace(" ", "")


def luminance(colour):
    levels = [int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    return sum(w * (s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055)**2.4) for w, s in zip((0.2126, 0.7152, 0.0722), levels))


def contrast(a, b):
    low, high = sorted((luminance(a), luminance(b)))
    return (high + 0.05) / (low + 0.05)


# ---- What a picture is to hold


def option(arguments, name, fallback=None):
    return arguments[arguments.index(name) + 1] if name in arguments else fallback


def operands(arguments):
    return [a for a in arguments if a.startswith("pattern:")]


def parts(source):
    """The pattern, n and dimension of pattern:SPEC@N[@DIM]."""
    spec, n, *dim = source[len("pattern:"):].split("@")
    return spec, int(n), int(dim[0]) if dim else 2


def sizes(n):
    return [4**k for k in range(2, 16) if 4**k <= n]


def isolated(source, column):
    """Finite values without finite neighbours in the rows of the curve."""
    rows = [json.loads(line)[column] is not None for line in koksma("curve", "rings", source, "--json").splitlines()]
    return sum(row and not any(rows[max(i - 1, 0):i] + rows[i + 1:i + 2]) for i, row in enumerate(rows))


def expected(arguments):
    """Circles, frames, images and headings of a picture."""
    kind = "compare" if "--compare" in arguments else option(arguments, "--curve", "points")
    sources = [parts(source) for source in operands(arguments)]
    pairs = [min(dim, MAX_DIM) * (min(dim, MAX_DIM) - 1) // 2 for _, _, dim in sources]
    of_points = sum(n * k for (_, n, _), k in zip(sources, pairs))
    of_sizes = sum(len(sizes(n)) + 1 for _, n, _ in sources)  # and one in the legend
    n = len(sources)
    alone = sum(isolated(s, "anisotropy_db") for s in operands(arguments)) if kind == "anisotropy" else 0
    return {
        "points": (of_points, sum(pairs), 0, ""),
        "power": (0, n, n, "Power spectrum" if n == 1 else "Power spectra"),
        "rings": (0, 1, 0, "Radial mean of the power spectrum"),
        "anisotropy": (alone, 1, 0, "Anisotropy of the power spectrum"),
        "pairs": (0, 1, 0, "Pair correlation"),
        "convergence": (of_sizes, 1, 0, "Convergence of " + option(arguments, "-m", "l2-star")),
        "compare": (of_points + of_sizes, 2 * n + 2, n, "Points, power spectra and convergence"),
        "filter": (0, 1, 0, "Pixel filters"),
        "filter-response": (0, 1, 0, "Frequency responses of pixel filters"),
    }[kind]


def look(name, arguments, data):
    """Checks an SVG file that these arguments made."""
    text = data.decode()
    picture = Picture(data)
    circles, frames, images, heading = expected(arguments)
    heading = option(arguments, "--title", heading)
    check(not re.search(r'nan|inf"|\bid="', text), name, "has no number, or an id")
    check(picture.title and heading in picture.title, name, "is titled", picture.title)
    check(heading.replace(" ", "") in picture.words, name, "does not show its heading")
    for source in operands(arguments):
        spec, n, dim = parts(source)
        check(spec in picture.words, name, "does not name", spec)
        if "convergence" not in arguments:
            check(f"{spec},n={n}" + (f",d={dim}" if dim > 2 else "") in picture.words, name, "does not say how many points")
    check(len(picture.circles) == circles, name, "has", len(picture.circles), "marks and not", circles)
    check(len(picture.frames) == frames, name, "has", len(picture.frames), "frames and not", frames)
    check(picture.images == images, name, "has", picture.images, "images and not", images)
    for box in picture.texts + picture.shapes + picture.circles + picture.frames:
        check(box.inside(picture.view), name, f"'{box.what}' leaves the picture:", vars(box), vars(picture.view))
    for a, b in itertools.combinations(picture.texts, 2):
        check(not a.meets(b), name, f"'{a.what}' and '{b.what}' overlap")
    for words, frame in itertools.product(picture.texts, picture.frames):
        check(not words.meets(frame), name, f"'{words.what}' is over data")
    for mark in picture.circles:
        swatch = any(s.what == "polyline" and s.x1 - s.x0 == 22 and mark.inside(s, 4) for s in picture.shapes)
        check(swatch or any(mark.inside(frame, 5) for frame in picture.frames), name, "a mark is in no frame")
    check(all(contrast(fill, picture.paper) >= 7 for fill in picture.fills), name, "has texts that are faint")
    check((luminance(picture.paper) < 0.1) == ("dark" in arguments), name, "is of the other theme")
    size = option(arguments, "--size")
    if size:
        check([str(int(s)) for s in picture.size][:size.count("x") + 1] == size.split("x"), name, "is", picture.size)


def png_rows(data):
    """The rows of an 8-bit RGB or RGBA PNG file, as bytes, and the bytes of a pixel."""
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    channels, at, packed = {2: 3, 6: 4}[kind], 8, b""
    while at < len(data):
        length, = struct.unpack(">I", data[at:at + 4])
        packed += data[at + 8:at + 8 + length] if data[at + 4:at + 8] == b"IDAT" else b""
        at += 12 + length
    raw, rows, before = zlib.decompress(packed), [], bytes(width * channels)
    for y in range(height):
        start = y * (width * channels + 1)
        kind, row = raw[start], bytearray(raw[start + 1:start + 1 + width * channels])
        for i in range(len(row)):
            a, b = row[i - channels] if i >= channels else 0, before[i]
            c = before[i - channels] if i >= channels else 0
            paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            row[i] = row[i] + (0, a, b, (a + b) // 2, paeth)[kind] & 255
        rows.append(bytes(row))
        before = row
    assert depth == 8
    return rows, channels


def look_at_edges(name, data):
    """Nothing but paper in the outermost pixels: what is drawn by the fonts of this machine is cut nowhere."""
    rows, channels = png_rows(data)
    paper = rows[0][:channels]
    edge = [rows[0], rows[-1], b"".join(row[:channels] for row in rows), b"".join(row[-channels:] for row in rows)]
    check(all(side == paper * (len(side) // channels) for side in edge), name, "is cut at an edge")


def make(arguments, path):
    koksma(*arguments[:arguments.index("-o") + 1], path, *arguments[arguments.index("-o") + 2:])
    with open(path, "rb") as file:
        return file.read()


# ---- The palette


def colours_apart():
    """Colours that are told apart with any vision: simulated by Machado, Oliveira and Fernandes 2009 (severity 1), the
    least distance in CIELAB. Distances from 10 on are seen at a glance."""
    machado = {
        "normal": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
        "protan": ((.152286, 1.052583, -.204868), (.114503, .786281, .099216), (-.003882, -.048116, 1.051998)),
        "deutan": ((.367322, .860646, -.227968), (.280085, .672501, .047413), (-.011820, .042940, .968881)),
        "tritan": ((1.255528, -.076749, -.178779), (-.078411, .930809, .147602), (.004733, .691367, .303900))}
    xyz = ((.4124, .3576, .1805), (.2126, .7152, .0722), (.0193, .1192, .9505))

    def times(matrix, v):
        return [sum(m * x for m, x in zip(row, v)) for row in matrix]

    def lab(colour, vision):
        linear = [s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055)**2.4 for s in (colour >> k & 255 for k in (16, 8, 0))
                  for s in (s / 255,)]
        seen = [min(max(v, 0), 1) for v in times(machado[vision], linear)]
        f = [t**(1 / 3) if t > 0.008856 else 7.787 * t + 16 / 116 for t in (v / w for v, w in zip(times(xyz, seen), (.9505, 1, 1.089)))]
        return 116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])

    with open(PALETTE, encoding="utf-8") as file:
        palette = [[int(c, 16) for c in pair] for pair in re.findall(r"^COLOUR\((0x\w+), (0x\w+)", file.read(), re.M)]
    check(len(palette) >= 8, "the palette has", len(palette), "colours")
    for theme, vision in itertools.product((0, 1), machado):
        for a, b in itertools.combinations([pair[theme] for pair in palette], 2):
            distance = sum((u - v)**2 for u, v in zip(lab(a, vision), lab(b, vision)))**0.5
            check(distance >= 10, f"#{a:06x} and #{b:06x} are {distance:.1f} apart for {vision} vision")


def main():
    colours_apart()
    made = examples()
    check(len(made) >= 8, "the help has", len(made), "examples")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for arguments in made:
            name = shlex.join(arguments)
            own = make(arguments, option(arguments, "-o"))
            ending = option(arguments, "-o").rsplit(".", 1)[1]
            check(own.startswith({"svg": b"<?xml", "pdf": b"%PDF-", "png": b"\x89PNG"}[ending]), name, "is no", ending)
            for more in ([], ["--size", "400"], ["--theme", "dark"], ["--size", "720x500"]):
                if more and more[0] in arguments or "--compare" in arguments and "720x500" in more:
                    continue  # the second: its texts alone are as high
                data = make(arguments + more, "a.svg")
                look(shlex.join(arguments + more), arguments + more, data)
                check(data == make(arguments + more, "b.svg"), name, "has other bytes the second time")
            look_at_edges(name, make(arguments, "a.png"))
        os.chdir("/")
    print(f"{len(made)} examples, {failed} problems")
    return failed > 0


sys.exit(main())

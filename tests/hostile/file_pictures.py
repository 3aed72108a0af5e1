#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_pictures.py PROGRAM FAULTS: what a picture that a scene names may cost.

docs/files.md states it: the bytes of the file, 12 a pixel of at most 2^26 pixels, and what the reader takes beside.
Pictures of that size that pack into a few hundred KiB, of one pixel more, files whose first bytes are right up to the
limit, EXR tiles of many channels, and JPEGs that claim more than they hold must keep to it.
"""
import json
import os
import struct
import sys
import tempfile
import zlib

import files
from file_inputs import scene

MOST = 1 << 26  # pixels: src/files/image/image.h
LIMIT = 1 << 30  # bytes of a texture's file: src/engine/core/file_kinds.def


def packed(size, byte=0):
    packer = zlib.compressobj(1)
    piece = bytes([byte]) * (1 << 20)
    return b"".join(packer.compress(piece[:min(len(piece), size - at)]) for at in range(0, size, len(piece))) + packer.flush()


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width, height, data=None, bits=16, colours=2):
    """Of three colours, or another type of them."""
    head = struct.pack(">IIBBBBB", width, height, bits, colours, 0, 0, 0)
    data = packed(height * (1 + 6 * width)) if data is None else data
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(value)) + value


def exr(width, height, tile, channels, compression=3):
    """Tiled, floats; zeros in ZIP (3), which its predictor makes bytes of 128. In DWAB (9) no pixels: only its head is right."""
    names = sorted(["R", "G", "B"] + [f"x{i:05}" for i in range(channels - 3)])
    entries = b"".join(name.encode() + b"\0" + struct.pack("<IBxxxII", 2, 0, 1, 1) for name in names) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    head = (b"\x76\x2f\x31\x01\x02\x02\0\0" + attribute("channels", "chlist", entries) + attribute("compression", "compression", bytes([compression]))
            + attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
            + attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
            + attribute("screenWindowCenter", "v2f", bytes(8)) + attribute("screenWindowWidth", "float", struct.pack("<f", 1))
            + attribute("tiles", "tiledesc", struct.pack("<IIB", tile, tile, 0)) + b"\0")
    tiles = [(x, y) for y in range((height + tile - 1) // tile) for x in range((width + tile - 1) // tile)]
    data = packed(4 * channels * min(tile, width) * min(tile, height), 128)
    offsets, body = b"", b""
    for x, y in tiles:
        offsets += struct.pack("<Q", len(head) + 8 * len(tiles) + len(body))
        body += struct.pack("<5i", x, y, 0, 0, len(data)) + data
    return head + offsets + body


def jpeg(side, scans, filling=0):
    """Grey, progressive; tables with the one code 0, so that a block takes one bit of a scan; `filling` bytes in the head."""
    def segment(mark, data):
        return bytes([0xFF, mark]) + struct.pack(">H", 2 + len(data)) + data

    head = b"\xff\xd8" + segment(0xDB, bytes(1) + bytes([1] * 64)) + segment(0xE1, bytes(65000)) * (filling // 65000)
    head += segment(0xC2, struct.pack(">BHHB", 8, side, side, 1) + b"\1\x11\0")
    head += b"".join(segment(0xC4, bytes([kind, 1] + [0] * 16)) for kind in (0, 0x10))
    return head + b"".join(segment(0xDA, bytes([1, 1, 0, *which])) + data for *which, data in scans) + b"\xff\xd9"


def check_many(checks, program, folder, data):
    """A picture of 256 MiB by many materials takes them once; many equal pictures are refused at 2 GiB."""
    for n, what in ((1, "one JPEG in 60 materials"), (60, "60 JPEGs")):
        made = scene()
        made["materials"] = [{"name": f"m{i}", "kind": "lambert", "albedo": {"image": f"{i % n}.jpg"}} for i in range(60)]
        made["shapes"] = [dict(made["shapes"][0], material=f"m{i}") for i in range(60)]
        for i in range(n):
            with open(os.path.join(folder, f"{i}.jpg"), "wb") as stream:
                stream.write(data)
        with open(os.path.join(folder, "many.json"), "w", encoding="ascii") as stream:
            json.dump(made, stream)
        done = files.run(program, "scene", "check", "many.json", cwd=folder)
        words = "" if n == 1 else "more than 2048 MiB"
        checks.check(done and done.code == (3 if n > 1 else 0) and words in done.err.decode(),
                     f"{what}: exit code {done and done.code}, {done and done.err}")
        most_mib = (MOST * 6 >> 20) + (2048 if n > 1 else 0)
        checks.check(done and done.mib < most_mib + files.OTHER, f"{what}: {done and done.mib:.0f} MiB for {most_mib}")
        print(f"{what}: {done.mib:.0f} MiB, exit code {done.code}")


def main():
    program = os.path.abspath(sys.argv[1])
    checks = files.Checks()
    with tempfile.TemporaryDirectory() as folder:
        def check(what, name, data, length, most_mib, *words):
            """Of `length` bytes; read, or refused with the words, for at most so many MiB."""
            with open(os.path.join(folder, name), "wb") as stream:
                stream.write(data)
                stream.truncate(max(length, len(data)))
            with open(os.path.join(folder, "s.json"), "w", encoding="ascii") as stream:
                json.dump(scene(albedo={"image": name}), stream)
            done = files.run(program, "scene", "check", "s.json", cwd=folder)
            if words:
                checks.check(done and done.code == 3 and all(word in done.err.decode() for word in words),
                             f"{what}: exit code {done and done.code}, {done and done.err}")
            else:
                checks.check(done and done.code == 0, f"{what}: exit code {done and done.code}, {done and done.err}")
            checks.check(done and done.mib < most_mib + files.OTHER, f"{what}: {done and done.mib:.0f} MiB for {most_mib}")
            print(f"{what}: {done.mib:.0f} MiB, exit code {done.code}")
            os.remove(os.path.join(folder, name))

        side = 8192
        check("PNG of 2^26 pixels", "a.png", png(side, side), 0, MOST * 18 >> 20)
        check("PNG of more", "b.png", png(side + 1, side, bytes(1 << 16)), 0, 0, "b.png", f"at most {MOST}")
        check("PNG and zeros", "c.png", png(4, 4), LIMIT, LIMIT >> 20)
        check("PNG's head and zeros", "d.png", png(4, 4)[:33], LIMIT, LIMIT >> 20, "d.png")
        check("PFM of more", "e.pfm", b"Pf\n%d %d\n-1\n" % (side + 1, side), LIMIT, LIMIT >> 20, "e.pfm", f"at most {MOST}")
        check("EXR's mark and zeros", "f.exr", b"\x76\x2f\x31\x01\x02\0\0\0", LIMIT, LIMIT >> 20, "f.exr")
        check("EXR of 2^26 pixels", "g.exr", exr(side, side, 1024, 3), 0, MOST * 12 >> 20)
        check("EXR of more", "h.exr", exr(2 * side, side, side, 3)[:4096], 1 << 20, 0, "h.exr")
        check("EXR with tiles of 40 channels", "i.exr", exr(256, 256, 256, 40), 0, 16)
        check("EXR with tiles of 400 channels", "j.exr", exr(1024, 1024, 1024, 400), 0, 0, "j.exr", "256 MiB")
        check("DWAB with tiles of 400 channels", "k.exr", exr(1024, 1024, 1024, 400, 9), 0, 0, "k.exr", "256 MiB")
        check("EXR of 100,000 channels", "r.exr", exr(16, 16, 16, 100000), 0, 64, "r.exr", "more than 4096")
        many = exr(16, 16, 16, 3)
        at = many.index(b"compression\0")
        many = many[:at] + b"".join(attribute(f"x{i}", "string", b"y") for i in range(100000)) + many[at:]
        check("EXR of 100,000 attributes", "s.exr", many, 0, 64, "s.exr", "more than 4096")
        bits = bytes(side * side // 64 // 8)
        whole = [(0, 0, 0, bits), (1, 63, 0, bits)]
        check("JPEG of 2^26 pixels", "l.jpg", jpeg(side, whole), 0, MOST * 6 >> 20)
        check("JPEG of more", "m.jpg", jpeg(side + 8, whole), 0, 0, "m.jpg", f"at most {MOST}")
        check("JPEG of few bytes", "n.jpg", jpeg(side, [(0, 0, 0, b"\0")]), 0, 0, "n.jpg", "cut short")
        check("JPEG of few bytes and zeros", "o.jpg", jpeg(side, [(0, 0, 0, b"\0")]), LIMIT, LIMIT >> 20, "o.jpg", "premature end")
        check("JPEG with a long head", "p.jpg", jpeg(side, [(0, 0, 0, b"\0")], 1 << 20), 0, 1, "p.jpg", "premature end")
        check_many(checks, program, folder, jpeg(side, whole))
        check("JPEG of 20,000 scans", "q.jpg", jpeg(side, whole[:1] + 20000 * [(1, 63, 0x10, b"\0")]), 0, MOST * 6 >> 20, "q.jpg")
    checks.end()


if __name__ == "__main__":
    main()

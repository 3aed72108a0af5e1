#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_reasons.py PROGRAM FAULTS: exit codes and messages for files that are damaged, of another kind, or oddly named.

File names with newlines, escape sequences, and bytes that are no UTF-8 stand in each place of the command line, in scenes and
in plans. The exit code is 3 for what is wrong with a file, 4 for what is wrong with the system, and the message is one line
of UTF-8. With sanitizers each place has one of the names in turn.
"""
import json
import os
import sys
import tempfile

import files

def put(folder, name, data):
    with open(os.path.join(folder, name), "wb") as stream:
        stream.write(data)
    return name


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
    for case in (check_two, check_names, check_names_within):
        with tempfile.TemporaryDirectory() as folder:
            case(checks, program, folder)
    checks.end()


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_plans.py PROGRAM FAULTS: small plans that ask for much work before a study starts.

A plan's check tries its patterns and measures with its numbers of points, and a few kilobytes name any number of pairs: many
sizes with many points, many patterns with many sizes, many coordinates, many reads of one file, one scene in many blocks. Each of these plans ends
with an unknown field, which is reported after all trials: the limit of processor time is what they are tested against. Lists
whose jobs are more than the limits are refused before any is made; a family of many files is listed once, not for each size.
"""
import itertools
import json
import os
import sys
import tempfile

import files
from file_pictures import png

PROCESSOR = 300 if files.SANITIZED else 30  # seconds; without a limit the plans below take minutes to hours


MEASURES = ["star", "extreme", "l2-star", "l2-extreme", "l2-centered", "l2-mixture", "l2-symmetric", "l2-wraparound", "min-distance"]
UNKNOWN = {"questions": [{"id": "q", "zz": 1}]}


def run(folder, members):
    with open(os.path.join(folder, "p.json"), "w", encoding="ascii") as stream:
        json.dump({"name": "p", "title": "p", **members}, stream)
    return files.run(os.path.abspath(sys.argv[1]), "study", "run", "./p.json", "-q", "-o", "out", cwd=folder, processor=PROCESSOR)


def check(checks, folder, what, members, reason="questions[0].zz: unknown field", code=3):
    """The plan with these members is refused for the reason."""
    checks.refused(what, run(folder, members), code, reason)


def put_scene(folder):
    with open(os.path.join(folder, "s.json"), "w", encoding="ascii") as stream:
        stream.write('{"camera": {"eye": [0, 1, 0], "target": [0, 1, -1], "fov_deg": 20}, "background": 0.5, "ambient": 1, '
                     '"materials": [], "shapes": []}')


def other_names():
    """4,096 names of s.json."""
    return ["./" + "".join(parts) + "s.json" for parts in itertools.product(("/", "./"), repeat=12)]


def check_options(checks, folder):
    """Blocks of 1,008 combinations of options and 64 patterns."""
    options = {"filter": ["box", "tent", "hermite", "gaussian", "mitchell", "b-spline", "blackman-harris"],
               "integrator": ["utah", "whitted", "distribution", "path", "path-balance", "path-light", "path-bsdf", "direct",
                              "ambient-occlusion"], "lights": ["all", "one"], "pairing": ["shuffled", "native"],
               "scope": ["pixel", "image"], "splat": ["no", "yes"]}
    block = {"scenes": ["ball"], "patterns": ["random"] + [f"korobov:a={a}" for a in range(1, 64)], "spp": [1], "trials": 1,
             "options": options, "references": [{"name": "r", "pattern": "random", "spp": 1}]}
    check(checks, folder, "combinations of options", {"images": 2000 * [block]},
          "images[65]: with it the blocks have more than 65536 combinations of options")


def check_scenes(checks, folder):
    """A scene of 48 MiB in 100 blocks and 25 figures."""
    with open(os.path.join(folder, "black.png"), "wb") as stream:
        stream.write(png(2048, 2048))
    with open(os.path.join(folder, "s.pbrt"), "w", encoding="ascii") as stream:
        stream.write('Camera "perspective"\nWorldBegin\nTexture "t" "spectrum" "imagemap" "string filename" "black.png"\n'
                     'Material "diffuse" "texture reflectance" "t"\nShape "sphere"\n')
    block = {"scenes": ["./s.pbrt"], "patterns": ["random"], "spp": [1], "trials": 1,
             "references": [{"name": "r", "pattern": "random", "spp": 1}]}
    figures = [{"id": f"f{i}", "title": "f", "scene": "./s.pbrt", "pattern": "random", "n": 1} for i in range(25)]
    check(checks, folder, "one scene in many blocks", {"images": 100 * [block], "figures": figures, **UNKNOWN})


def sets(patterns, n, measures=1):
    return {"patterns": [f"korobov:a={a}" for a in range(1, patterns + 1)], "measures": MEASURES[:measures], "n": list(range(1, n + 1)), "trials": 1}


def images(scenes, references):
    """A block of one scene under many names, with many references."""
    return {"scenes": other_names()[:scenes], "patterns": ["random"], "spp": [1], "trials": 1, "size": [2, 2],
            "references": [{"name": f"r{i}", "pattern": "random", "spp": 1} for i in range(references)]}


def check_limits(checks, folder):
    put_scene(folder)
    tasks = "plan 'p': more than 262144 combinations of patterns, sizes, warps, scenes and options"
    series = "plan 'p': more than 2097152 combinations of these with measures, references and metrics"
    for what, members, reason in (
            ("one block of tasks", {"discrepancies": [sets(4096, 4096)]}, tasks),
            ("many blocks of tasks", {"discrepancies": 1025 * [sets(16, 16)]}, tasks),
            ("tasks of both kinds", {"discrepancies": [sets(512, 512)], "images": [images(1, 1)]}, tasks),
            ("measures", {"discrepancies": [sets(512, 512, 9)]}, series),
            ("scenes and references", {"images": [images(1024, 4096)]}, series),
            ("references", {"images": [images(1024, 1024)]}, "plan 'p': more than 65536 images for reference"),
            ("references beside sets of points", {"discrepancies": [sets(1, 1)], "images": [images(1024, 1024)]},
             "plan 'p': more than 65536 images for reference")):
        check(checks, folder, what, members, reason, 2)


def check_family(checks, folder):
    """10,000 files and 4,000 sizes, all but one of which are left out by the first trial."""
    family = os.path.join(folder, "family")
    os.mkdir(family)
    for i in range(10000):
        with open(os.path.join(family, f"s_{i}.txt"), "w", encoding="ascii") as stream:
            stream.write("0.25 0.5\n0.5 0.25\n")
    block = {"patterns": ["file:family/s_{seed}.txt"], "measures": ["star"], "n": list(range(1, 4001)), "trials": 1, "skip": True}
    done = run(folder, {"discrepancies": [block]})
    most = (3 if files.SANITIZED else 1) * files.OTHER  # sanitizers keep what was freed
    checks.check(done and done.code == 0 and done.mib < most, f"a family and many sizes: {done and (done.code, done.err, done.mib)}")


def main():
    checks = files.Checks()
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "points.txt"), "w", encoding="ascii") as stream:
            stream.write("0.25 0.5\n" * 60000)
        korobov = [f"korobov:a={a}" for a in range(1, 4097)]
        read = [f"file:{'./' * i}points.txt" for i in range(40)]
        for what, patterns, measures, n, more in (
                ("many points", ["random"], ["min-distance"], range(1040000, 1044096), {}),
                ("many points, left out", ["random"], ["min-distance"], range(1040000, 1044096), {"skip": True}),
                ("many coordinates", ["random"], ["l2-star", "l2-centered", "diaphony", "l2-mixture"], range(1, 512), {"dim": 4096}),
                ("many pairs", korobov, ["star"], range(60001, 64097), {}),
                ("many reads", read, ["star"], range(1, 1001), {"skip": True})):
            block = {"patterns": patterns, "measures": measures, "n": list(n), "trials": 1, **more}
            check(checks, folder, what, {"discrepancies": [block], **UNKNOWN})
        block = {"patterns": korobov, "measures": ["star"], "n": list(range(1, 4097)), "trials": 1, "skip": True}
        check(checks, folder, "many pairs in many blocks", {"discrepancies": 40 * [block]},
              "discrepancies[1]: with it the blocks have more than 33554432 pairs")
        check_scenes(checks, folder)
        check_options(checks, folder)
        check_limits(checks, folder)
        check_family(checks, folder)
    checks.end()


if __name__ == "__main__":
    main()

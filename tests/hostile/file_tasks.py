#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_tasks.py PROGRAM FAULTS: small plans that make much before their first job.

Lists of a few kilobytes have millions of pairs: patterns and sizes, scenes and references. Those above the limits are refused
before anything is made of them; and a family of many files is listed once, not for each size.
"""
import itertools
import json
import os
import sys
import tempfile

import files

PROCESSOR = 300 if files.SANITIZED else 30  # seconds; without the limits, and with a list for each size, they take minutes
SCENE = {"camera": {"eye": [0, 1, 0], "target": [0, 1, -1], "fov_deg": 20}, "background": 0.5, "ambient": 1, "materials": [],
         "shapes": []}
KOROBOV = [f"korobov:a={a}" for a in range(1, 4097)]
MEASURES = ["star", "extreme", "l2-star", "l2-extreme", "l2-centered", "l2-mixture", "l2-symmetric", "l2-wraparound", "min-distance"]


def sets(patterns, n, measures=1):
    return {"patterns": KOROBOV[:patterns], "measures": MEASURES[:measures], "n": list(range(1, n + 1)), "trials": 1}


def images(scenes, references):
    """A block of one scene under many names, with many references."""
    names = ["./" + "".join(parts) + "s.json" for parts in itertools.product(["/", "./"], repeat=12)]
    return {"scenes": names[:scenes], "patterns": ["random"], "spp": [1], "trials": 1, "size": [2, 2],
            "references": [{"name": f"r{i}", "pattern": "random", "spp": 1} for i in range(references)]}


def run(folder, **members):
    """Runs the plan with these members."""
    with open(os.path.join(folder, "p.json"), "w", encoding="ascii") as stream:
        json.dump({"name": "p", "title": "p", **members}, stream)
    return files.run(os.path.abspath(sys.argv[1]), "study", "run", "./p.json", "-q", "-o", "out", cwd=folder, processor=PROCESSOR)


def check_limits(checks, folder):
    with open(os.path.join(folder, "s.json"), "w", encoding="ascii") as stream:
        json.dump(SCENE, stream)
    tasks = "plan 'p': more than 262144 combinations of patterns, sizes, warps, scenes and options"
    series = "plan 'p': more than 2097152 combinations of these with measures, references and metrics"
    for what, members, reason in (
            ("one block of tasks", {"discrepancies": [sets(4096, 4096)]}, tasks),
            ("many blocks of tasks", {"discrepancies": 1025 * [sets(16, 16)]}, tasks),
            ("tasks of both kinds", {"discrepancies": [sets(512, 512)], "images": [images(1, 1)]}, tasks),
            ("measures", {"discrepancies": [sets(512, 512, 9)]}, series),
            ("scenes and references", {"images": [images(4096, 4096)]}, series),
            ("references", {"images": [images(1024, 1024)]}, "plan 'p': more than 65536 images for reference"),
            ("references beside sets of points", {"discrepancies": [sets(1, 1)], "images": [images(1024, 1024)]},
             "plan 'p': more than 65536 images for reference")):
        checks.refused(what, run(folder, **members), 2, reason)


def check_family(checks, folder):
    """10,000 files and 4,000 sizes, all but one of which are left out by the first trial."""
    family = os.path.join(folder, "family")
    os.mkdir(family)
    for i in range(10000):
        with open(os.path.join(family, f"s_{i}.txt"), "w", encoding="ascii") as stream:
            stream.write("0.25 0.5\n0.5 0.25\n")
    block = {"patterns": ["file:family/s_{seed}.txt"], "measures": ["star"], "n": list(range(1, 4001)), "trials": 1, "skip": True}
    done = run(folder, discrepancies=[block])
    most = (3 if files.SANITIZED else 1) * files.OTHER  # sanitizers keep what was freed
    checks.check(done and done.code == 0 and done.mib < most, f"a family and many sizes: {done and (done.code, done.err, done.mib)}")


def main():
    checks = files.Checks()
    with tempfile.TemporaryDirectory() as folder:
        check_limits(checks, folder)
        check_family(checks, folder)
    checks.end()


if __name__ == "__main__":
    main()

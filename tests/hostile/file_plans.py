#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_plans.py PROGRAM FAULTS: small plans that ask for much work before a study starts.

A plan's check tries its patterns and measures with its numbers of points, and a few kilobytes name any number of pairs: many
sizes with many points, many patterns with many sizes, many coordinates, many reads of one file. Each of these plans ends with
an unknown field, which is reported after all trials: the limit of processor time is what they are tested against.
"""
import json
import os
import sys
import tempfile

import files

PROCESSOR = 300 if files.SANITIZED else 30  # seconds; without a limit the plans below take minutes to hours


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
            with open(os.path.join(folder, "p.json"), "w", encoding="ascii") as stream:
                json.dump({"name": "p", "title": "p", "discrepancies": [block], "questions": [{"id": "q", "zz": 1}]}, stream)
            done = files.run(os.path.abspath(sys.argv[1]), "study", "run", "./p.json", "-q", "-o", "out", cwd=folder,
                             processor=PROCESSOR)
            checks.refused(what, done, 3, "questions[0].zz: unknown field")
    checks.end()


if __name__ == "__main__":
    main()

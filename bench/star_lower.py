#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How often star-lower reaches star: KOKSMA [-m MEASURE]. Counts the sets whose exact star discrepancy a measure
reaches, by dimension, and lists the others with their gaps (docs/findings/records.md). Two to three minutes, most
of them for the exact values."""
import json
import resource
import subprocess
import sys

PATTERNS = ("random", "n-rooks", "jittered", "regular", "sobol", "sobol:scramble=owen", "halton", "faure", "hammersley",
            "r-sequence", "lattice-rank1", "korobov")
CELLS = ("regular", "jittered")  # take m^d points in more than two dimensions
EASY = {2: (64, 100, 144, 256, 400, 512), 3: (64, 125, 216, 256, 512, 1000, 2000), 4: (64, 81, 144, 256, 512, 1000),
        5: (64, 100, 144, 243, 300, 512)}
HARD = {6: (64, 128, 200), 7: (50, 89, 128), 8: (50, 64)}


def sources():
    for dim, sizes in {**EASY, **HARD}.items():
        for n in sizes:
            for pattern in PATTERNS:
                if pattern not in CELLS or round(n ** (1 / dim)) ** dim == n:
                    yield dim, "pattern:%s@%d@%d" % (pattern, n, dim)


def seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def values(program, measure, names):
    rows = []
    for i in range(0, len(names), 32):
        command = [program, "measure", "--json", "-m", measure, "-s", "1", *names[i:i + 32]]
        run = subprocess.run(command, capture_output=True, text=True, check=True)
        rows += [json.loads(line)["value"] for line in run.stdout.splitlines()]
    return rows


def main():
    program = sys.argv[1]
    measure = sys.argv[sys.argv.index("-m") + 1] if "-m" in sys.argv else "star-lower"
    total, reached, missed = 0, 0, []
    for dim in (*EASY, *HARD):
        names = [name for d, name in sources() if d == dim]
        start = seconds()
        exact = values(program, "star", names)
        between = seconds()
        found = values(program, measure, names)
        end = seconds()
        gaps = [(1 - f / e, name) for f, e, name in zip(found, exact, names)]
        good = sum(gap <= 1e-12 for gap, _ in gaps)
        print("d = %d: %3d of %3d; star %.1f s, %s %.1f s" % (dim, good, len(names), between - start, measure,
                                                            end - between), flush=True)
        total, reached = total + len(names), reached + good
        missed += [g for g in gaps if g[0] > 1e-12]
    print("%s: %d of %d sets" % (measure, reached, total))
    for gap, name in sorted(missed, reverse=True):
        print("  %.2f %% below: %s" % (100 * gap, name))


main()

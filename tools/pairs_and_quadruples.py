#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the tables of docs/findings/pairs-and-quadruples.md: pairs_and_quadruples.py KOKSMA [evenness|integrals|images]

Evenness: D* and t of the coordinates 2k, 2k + 1 (24 pairs) and 4k .. 4k + 3 (12 quadruples) of 48 dimensions, mean and worst,
as `koksma measure` gives them. Integrals: RMS errors of `koksma integrate` in two and four coordinates, Owen-scrambled. Images:
root mean square errors against a reference, mean of SEEDS renders with its standard error.
"""
import json
import os
import subprocess
import sys
import tempfile

PATTERNS = "sobol", "sz", "cascaded-sobol"
SIZES = [2 ** m for m in range(4, 13)]
MOST_STAR_4D = 1024  # more take hours
DIM, SEEDS = 48, 6
SCENES, SPP = ("ball", "balls", "glossy"), (4, 16, 64)
program = sys.argv[1]


def run(*words):
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


def values(lines, key="value"):
    return [json.loads(line)[key] for line in lines.splitlines()]


def summary(numbers):
    return f"{sum(numbers) / len(numbers):.4g}, {max(numbers):.4g}"


def evenness(folder):
    for group in 2, 4:
        print(f"\n| n | {' | '.join(f'`{p}` t: mean, worst; D*' for p in PATTERNS)} |\n|---|{'---|' * len(PATTERNS)}")
        for n in SIZES:
            cells = []
            for pattern in PATTERNS:
                rows = [line.split() for line in run("generate", pattern, "-d", str(DIM), "-n", str(n), "-q").splitlines() if line[:1] != "#"]
                files = []
                for k in range(0, DIM, group):
                    files.append(os.path.join(folder, f"{k}.txt"))
                    with open(files[-1], "w", encoding="ascii") as out:
                        out.writelines(" ".join(row[k:k + group]) + "\n" for row in rows)
                cell = summary(values(run("measure", *files, "-m", "t-value", "--json", "-q")))
                if group == 2 or n <= MOST_STAR_4D:
                    cell += "; " + summary(values(run("measure", *files, "-m", "star", "--json", "-q")))
                cells.append(cell)
            print(f"| {n} | {' | '.join(cells)} |", flush=True)


def integrals(_):
    for dim, functions in (2, "disk,triangle,quarter-gaussian,bilinear"), (4, "genz-gaussian,genz-corner-peak,genz-continuous,bernoulli"):
        for n in 64, 256, 1024, 4096:
            for pattern in PATTERNS:
                text = run("integrate", functions, "-p", pattern + ":owen=1", "-n", str(n), "-d", str(dim), "-t", "100", "--json", "-q")
                cells = [f"{r['rmse']:.3g}" for r in map(json.loads, text.splitlines())]
                print(f"| {dim} | {n} | `{pattern}` | {' | '.join(cells)} |", flush=True)


def images(folder):
    size = ("--size", "48x36", "--pairing", "native")
    for scene in SCENES:
        reference = os.path.join(folder, "reference.pfm")
        run("render", scene, "-p", "sobol:scramble=owen", "-n", "1024", "--size", "48x36", "-s", "99", "-o", reference, "-q")
        for spp in SPP:
            cells = []
            for pattern in PATTERNS:
                files = [os.path.join(folder, f"{seed}.pfm") for seed in range(SEEDS)]
                for seed, file in enumerate(files):
                    run("render", scene, "-p", pattern + ":owen=1", "-n", str(spp), *size, "-s", str(seed), "-o", file, "-q")
                errors = values(run("compare", *files, reference, "--json", "-q"), "rmse")
                mean = sum(errors) / SEEDS
                deviation = (sum((e - mean) ** 2 for e in errors) / (SEEDS - 1) / SEEDS) ** .5
                cells.append(f"{mean:.4f} ± {deviation:.4f}")
            print(f"| `{scene}` | {spp} | {' | '.join(cells)} |", flush=True)


with tempfile.TemporaryDirectory() as work:
    for table in sys.argv[2:] or ("evenness", "integrals", "images"):
        {"evenness": evenness, "integrals": integrals, "images": images}[table](work)

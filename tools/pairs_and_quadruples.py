#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the tables of docs/findings/pairs-and-quadruples.md:

    pairs_and_quadruples.py KOKSMA evenness [N...]
    pairs_and_quadruples.py KOKSMA scrambled|ternary|all-pairs|integrals
    pairs_and_quadruples.py KOKSMA images STUDY
    pairs_and_quadruples.py KOKSMA authors FILE

Evenness: D* and t of the coordinates 2k, 2k + 1 (24 pairs) and 4k .. 4k + 3 (12 quadruples) of 48 dimensions, mean and worst,
as `koksma measure` gives them, at the N given or at all; D* of equal sets is computed once. Quadruples of 4,096 points take
25 minutes of one core, all else 7. Scrambled: D* of SETS Owen scramblings, the mean over groups with its standard error over sets,
and the worst. Ternary: the same, plain and scrambled, at powers of 3, and t in base 3 of `ternary-quads`. All pairs: t of all 1,128 pairs of 48 dimensions, by ranks of matrices. Integrals: RMS errors of `koksma integrate`
in two and four coordinates, Owen-scrambled. Images: root mean square errors of the study's images, those of Joe & Kuo's
numbers and the differences of the others from them with 95 % intervals; the last row has the geometric means. Authors: 44
dimensions of `ternary-quads` beside those of Ostromoukhov et al. 2024, made from their file of initial numbers,
initIrreducibleGF3.dat (github.com/liris-origami/Quad-Optimized-LDS).
"""
import csv
import io
import json
import math
import os
import subprocess
import sys
import tempfile

PATTERNS = "sobol", "sobol:numbers=groups", "sz", "cascaded-sobol"
SIZES = [2 ** m for m in range(4, 13)]
DIM, SETS = 48, 10
BASE = "sobol:scramble=owen"
program = sys.argv[1]


def run(*words):
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


def values(lines, key="value"):
    return [json.loads(line)[key] for line in lines.splitlines()]


def mean_and_error(numbers):
    mean = sum(numbers) / len(numbers)
    return f"{mean:.4g} ± {(sum((x - mean) ** 2 for x in numbers) / (len(numbers) - 1) / len(numbers)) ** .5:.1g}"


def summary(numbers):
    return f"{sum(numbers) / len(numbers):.4g}, {max(numbers):.4g}"


def groups(folder, pattern, n, group, *options, dim=DIM):
    """Writes the coordinates of each group of one set to a file of its own and returns the files."""
    text = run("generate", pattern, "-d", str(dim), "-n", str(n), "-q", *options)
    rows = [line.split() for line in text.splitlines() if line[:1] != "#"]
    files = []
    for k in range(0, dim, group):
        files.append(os.path.join(folder, f"{k}.txt"))
        with open(files[-1], "w", encoding="ascii") as out:
            out.writelines(" ".join(row[k:k + group]) + "\n" for row in rows)
    return files


def measured(files, measure):
    return values(run("measure", *files, "-m", measure, "--json", "-q"))


def stars_of_sets(files, known):
    """D* of the points in each file. Sets that differ by the order of the points alone are measured once, as all groups of sz:
    `known` holds the values of all sets so far."""
    stars = []
    for file in files:
        with open(file, encoding="ascii") as points:
            key = "".join(sorted(points))
        if key not in known:
            known[key] = measured([file], "star")[0]
        stars.append(known[key])
    return stars


def heading(text):
    print(f"\n| n | {' | '.join(f'`{p}`{text}' for p in PATTERNS)} |\n|---|{'---|' * len(PATTERNS)}")


def evenness(folder):
    for group in 2, 4:
        heading(" t: mean, worst; D*")
        for n in [int(word) for word in sys.argv[3:]] or SIZES:
            cells, known = [], {}
            for pattern in PATTERNS:
                files = groups(folder, pattern, n, group)
                cells.append(f"{summary(measured(files, 't-value'))}; {summary(stars_of_sets(files, known))}")
            print(f"| {n} | {' | '.join(cells)} |", flush=True)


def scrambled(folder):
    for group, sizes in (2, (16, 64, 256, 1024, 4096)), (4, (16, 64, 256)):
        heading("")
        for n in sizes:
            cells = []
            for pattern in PATTERNS:
                spec = pattern + ("," if ":" in pattern else ":") + "owen=1"
                sets = [measured(groups(folder, spec, n, group, "-s", str(seed)), "star") for seed in range(SETS)]
                means = [sum(stars) / len(stars) for stars in sets]
                cells.append(f"{mean_and_error(means)}; {max(map(max, sets)):.4g}")
            print(f"| {n} | {' | '.join(cells)} |", flush=True)


def ternary(folder):
    patterns = "sobol", "sobol:numbers=groups", "ternary-quads"
    for group, sizes in (2, (27, 81, 243, 729, 2187)), (4, (27, 81, 243, 729)):
        print(f"\n| n | `ternary-quads` t in base 3: mean, worst | {' | '.join(f'`{p}` D*; scrambled' for p in patterns)} |\n"
              f"|---|---|{'---|' * len(patterns)}")
        for n in sizes:
            cells = [summary(measured(groups(folder, patterns[-1], n, group), "t-value:base=3"))]
            for pattern in patterns:
                scramble = "scramble=owen" if pattern == patterns[-1] else "owen=1"
                spec = pattern + ("," if ":" in pattern else ":") + scramble
                sets = [measured(groups(folder, spec, n, group, "-s", str(seed)), "star") for seed in range(SETS)]
                cells.append(f"{summary(measured(groups(folder, pattern, n, group), 'star'))}; "
                             f"{mean_and_error([sum(stars) / len(stars) for stars in sets])}")
            print(f"| {n} | {' | '.join(cells)} |", flush=True)


def authors_columns(degree, polynomial, numbers, count):
    """Columns of a generator matrix in base 3: column c has c + 1 digits, the first row's the highest. Each is, digit by digit,
    the sum of the column `degree` before and of the last ones, shifted down and times -a_j of the primitive polynomial."""
    def digits(x, length):
        return [x // 3 ** i % 3 for i in range(length)]

    a, columns = digits(polynomial, degree + 1), list(numbers)
    for c in range(degree, count):
        terms = [columns[c - degree]] + [3 ** j * sum(d * -a[degree - j] % 3 * 3 ** i for i, d in enumerate(digits(columns[c - j], c)))
                                         for j in range(1, degree + 1)]
        columns.append(sum(sum(digits(term, c + 1)[i] for term in terms) % 3 * 3 ** i for i in range(c + 1)))
    return [x * 3 ** (count - 1 - c) for c, x in enumerate(columns)]


def authors(folder):
    digits, dims, net = 7, 44, os.path.join(folder, "net.txt")
    with open(sys.argv[3], encoding="ascii") as file:
        lines = [[int(word) for word in line.split()] for line in file if line.strip() and line[0] != "d"][:dims]
    with open(net, "w", encoding="ascii") as file:
        file.write(f"# dnet\n3\n{dims}\n{digits}\n{digits}\n")
        for _, degree, polynomial, *numbers in lines:
            file.write(" ".join(map(str, authors_columns(degree, polynomial, numbers, digits))) + "\n")
    print("\n| group | n | theirs, t in base 3; D* | `ternary-quads`, t in base 3; D* |\n|---|---|---|---|")
    for group, most in (2, 2187), (4, 729):
        for n in 27, 81, 243, 729, 2187:
            cells = []
            for pattern in "net-file:" + net, "ternary-quads":
                files = groups(folder, pattern, n, group, dim=dims)
                cells.append(summary(measured(files, "t-value:base=3")) + ("; " + summary(measured(files, "star")) if n <= most else ""))
            print(f"| {group} | {n} | {' | '.join(cells)} |", flush=True)


def t_of_pair(a, b, m):
    """t of the first 2^m points: a and b hold the rows of the generator matrices, bit c the digit of column c."""
    mask, least, upper = (1 << m) - 1, m, []
    for k in range(m + 1):
        basis, count = list(upper), k
        while count < m:
            rest = b[count - k] & mask
            for v in basis:
                rest = min(rest, rest ^ v)
            if not rest:
                least = min(least, count)
                break
            basis.append(rest)
            count += 1
        if k < m:
            rest = a[k] & mask
            for v in upper:
                rest = min(rest, rest ^ v)
            if not rest:
                return m - min(least, k)
            upper.append(rest)
    return m - least


def all_pairs(_):
    most = 12
    heading(" t: mean, worst")
    cells = {m: [] for m in range(4, most + 1)}
    for pattern in PATTERNS:
        for m in cells:
            text = run("generate", pattern, "-d", str(DIM), "-n", str(2 ** m), "-q")
            points = [line.split() for line in text.splitlines() if line[:1] != "#"]
            columns = [[int(float(points[2 ** c][k]) * 2 ** m) for c in range(m)] for k in range(DIM)]
            rows = [[sum((column[c] >> (m - 1 - r) & 1) << c for c in range(m)) for r in range(m)] for column in columns]
            cells[m].append(summary([t_of_pair(rows[i], rows[j], m) for j in range(DIM) for i in range(j)]))
    for m, some in cells.items():
        print(f"| {2 ** m} | {' | '.join(some)} |", flush=True)


def integrals(_):
    for dim, functions in (2, "disk,triangle,quarter-gaussian,bilinear"), (4, "genz-gaussian,genz-corner-peak,genz-continuous,bernoulli"):
        for n in 64, 256, 1024, 4096:
            for pattern in PATTERNS:
                text = run("integrate", functions, "-p", pattern + ("," if ":" in pattern else ":") + "owen=1", "-n", str(n), "-d", str(dim), "-t", "100", "--json", "-q")
                cells = [f"{r['rmse']:.3g}" for r in map(json.loads, text.splitlines())]
                print(f"| {dim} | {n} | `{pattern}` | {' | '.join(cells)} |", flush=True)


def images(_):
    """From the rows that `koksma study run ./docs/findings/pairs-and-quadruples.json -o STUDY` made."""
    errors, logs = {}, {}
    for row in csv.DictReader(io.StringIO(run("study", "export", sys.argv[3], "-q"))):
        if row["kind"] == "image":
            column = row["pattern"] if "pairing=native" in row["options"] else "padded"
            errors.setdefault((row["scene"], int(row["n"])), {}).setdefault(column, []).append(float(row["rmse"]))
    columns = [BASE, BASE + ",numbers=groups", "sz:owen=1", "cascaded-sobol:owen=1", "padded"]  # the order of the page
    print(f"| scene | samples | {' | '.join(columns)} |\n|---|---|{'---|' * len(columns)}")
    for (scene, spp), of in sorted(errors.items()):
        base, cells = relative(of[BASE]), []
        for column in columns:
            mean, variance = relative(of[column])
            logs.setdefault(column, []).append((math.log(mean / base[0]), variance + base[1]))
            cells.append(f"{mean:.5f}" if column == BASE else percent(*logs[column][-1]))
        print(f"| `{scene}` | {spp} | {' | '.join(cells)} |")
    means = ["" if c == BASE else percent(*(sum(part) / len(logs[c]) ** (1 + i) for i, part in enumerate(zip(*logs[c]))))
             for c in columns]
    print(f"| all |  | {' | '.join(means)} |")


def relative(numbers):
    """The mean, and the variance of its logarithm."""
    mean = sum(numbers) / len(numbers)
    return mean, sum((x / mean - 1) ** 2 for x in numbers) / (len(numbers) - 1) / len(numbers)


def percent(log, variance):
    return f"{100 * math.expm1(log):+.1f} % ± {100 * 1.96 * variance ** .5:.1f}"


with tempfile.TemporaryDirectory() as work:
    {"evenness": evenness, "scrambled": scrambled, "ternary": ternary, "all-pairs": all_pairs, "integrals": integrals, "images": images, "authors": authors}[sys.argv[2]](work)

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""answers.py PROGRAM: the sentences above tables of means, from the rows of the store: a pattern is said to be the best where
the intervals of its differences from all others exclude 0, at 95 % together (Bonferroni: Student's t at 1 - 0.025 / k of half
intervals that add in squares); else who is not told apart is named. Quantiles come from the density, by Simpson's rule and bisection."""
import csv
import io
import json
import math
import re
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path

from schema import blocks, complain, finish, words

KOKSMA = Path(sys.argv[1]).resolve()
PATTERNS = ["random", "jittered", "n-rooks", "halton", "multi-jittered", "hammersley"]
PLANS = [(["star", "min-distance", "l2-star"], [16, 64], 3), (["star", "l2-periodic"], [9], 20), (["l2-star"], [256], 100), (["star"], [16], 1)]
checked = 0
kinds = set()


@cache
def student(p, degrees, steps=2000):
    """x with P(T <= x) = p, p > 0.5."""
    scale = math.exp(math.lgamma((degrees + 1) / 2) - math.lgamma(degrees / 2)) / math.sqrt(degrees * math.pi)
    density = lambda x: scale * (1 + x * x / degrees) ** (-(degrees + 1) / 2)
    low, high = 0.0, 1000.0
    while high - low > 1e-9 * high:
        x = (low + high) / 2
        # x = tan(u) spreads the steps over long tails.
        h = math.atan(x) / steps
        inside = sum((1 if i in (0, steps) else 4 if i % 2 else 2) * density(math.tan(i * h)) / math.cos(i * h) ** 2 for i in range(steps + 1)) * h / 3
        low, high = (x, high) if inside < p - 0.5 else (low, x)
    return low


def expected(values, larger):
    """The patterns by their means, and those that are not told apart from the first."""
    mean = {p: sum(v) / len(v) for p, v in values.items()}
    order = sorted(values, key=lambda p: -mean[p] if larger else mean[p])
    first, rest = order[0], order[1:]
    alpha = 0.025 / len(rest)

    def half(p):
        v = values[p]
        if p in ("halton", "hammersley"):
            return 0.0
        if len(v) < 2:
            return math.nan
        sd = math.sqrt(sum((x - mean[p]) ** 2 for x in v) / (len(v) - 1))
        return student(0.975, len(v) - 1) * sd / math.sqrt(len(v))

    def of_difference(p):
        h, n = math.hypot(half(first), half(p)), max(len(values[first]), len(values[p]))
        return h * student(1 - alpha, n - 1) / student(0.975, n - 1) if n > 1 else (h if h == 0 else math.nan)

    tied = [p for p in rest if not abs(mean[first] - mean[p]) > of_difference(p)]
    return order, tied


def check(answer, text, values, larger):
    order, tied = expected(values, larger)
    name = f"{text[:60]}..."
    if answer != ("undecided" if tied else "decided"):
        complain(f"{name}: {answer}, and not told apart are {tied}")
    elif tied:
        named = [order[0]] + tied[:3]
        if f"between {len(tied) + 1} of {len(values)} patterns" not in text or any(f" {p} " not in text.replace(",", " ") for p in named):
            complain(f"{name}: not told apart are {[order[0]] + tied}: {text}")
    elif f": {order[0]} has the {'largest' if larger else 'least'} mean" not in text or f"{order[1]} follows" not in text:
        complain(f"{name}: the first are {order[:2]}: {text}")
    kinds.add(answer)


for measures, sizes, trials in PLANS:
    with tempfile.TemporaryDirectory() as folder:
        plan = {"name": "a", "title": "a", "discrepancies": [{"patterns": PATTERNS, "measures": measures, "n": sizes, "trials": trials}]}
        Path(folder, "a.json").write_text(json.dumps(plan | {"discrepancies": [plan["discrepancies"][0] | {"skip": True}]}))
        subprocess.run([KOKSMA, "study", "run", "./a.json", "-o", "out", "-q"], cwd=folder, check=True)
        rows = list(csv.DictReader(io.StringIO(subprocess.run([KOKSMA, "study", "export", "out"], cwd=folder, check=True, capture_output=True, text=True).stdout)))
        report = json.loads(Path(folder, "out/report.json").read_text())
    for block in blocks(report["content"]):
        text = words(block.get("text", []))
        found = re.match(r"(\S+), N = (\d+): ", text)
        if "answer" in block and found:
            values = {p: [float(r["value"]) for r in rows if (r["pattern"], r["what"], r["n"]) == (p, found[1], found[2])] for p in PATTERNS}
            check(block["answer"], text, {p: v for p, v in values.items() if v}, found[1] == "min-distance")
            checked += 1
if checked != sum(len(measures) for measures, _, _ in PLANS):
    complain(f"{checked} answers were checked")
if len(kinds) < 2:
    complain(f"only {kinds} were met")
finish(f" in {checked} answers")

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""coverage_page.py ROWS.jsonl [COVERAGE_TABLE]: the tables of docs/findings/coverage.md, in Markdown, from the rows of coverage_table.

With the path of the program coverage_table it first makes the rows that ROWS.jsonl lacks (half an hour of one core; interrupted, it continues).

Of estimators: the RMSE of the mean divided by that of another, so that more is better. Of intervals: the least coverage over
the integrands of a kind, dimensions and sizes, and all cells whose coverage is below LOW; 1,000 runs of an interval of 95 %
have a standard error of 0.7 %, 200 runs of 1.5 %.
"""
import json
import os
import statistics
import subprocess
import sys

LOW = 0.90
RUNS = {16: 1000, 64: 1000, 512: 1000, 4096: 1000, 65536: 100}


def complete(path, program):
    """Appends the rows of all cells (pattern, n, dimension) that the file lacks; a cell comes whole or not at all."""
    done = set()
    if os.path.exists(path):
        with open(path, encoding="utf-8") as rows:
            done = {(r["pattern"], r["n"], r["dim"], r["runs"]) for r in map(json.loads, rows)}
    for n, runs in RUNS.items():
        for pattern in ("sobol:scramble=lms,digital-shift=1", "sobol:scramble=owen"):
            for dim in (1, 2, 4, 8, 16, 32):
                if (pattern, n, dim, runs) not in done:
                    made = subprocess.run([program, pattern, str(n), str(dim), str(runs), "15"], check=True, stdout=subprocess.PIPE, text=True).stdout
                    with open(path, "a", encoding="utf-8") as rows:
                        rows.write(made)
                    print(f"{pattern} n = {n}, d = {dim}: {runs} runs", file=sys.stderr)


if len(sys.argv) > 2:
    complete(*sys.argv[1:3])
with open(sys.argv[1], encoding="utf-8") as file:
    ALL = [json.loads(line) for line in file]
ROWS = [r for r in ALL if r["kind"] != "other"]
DIMS = sorted({r["dim"] for r in ROWS})
MOST = max(r["n"] for r in ROWS)
INTERVALS = ("auto", "quantile", "student", "bootstrap", "empirical-bernstein", "betting")
PATTERNS = list(dict.fromkeys(r["pattern"] for r in ROWS))


def table(head, rows):
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def ratio(row):
    value = row["mean"] / row["median"]
    return f"{value:.2f}" if value < 10 else f"{value:,.0f}"


print(f"RMSE of the mean divided by that of the median, `{PATTERNS[0]}`, n = {MOST:,}:\n")
cells = {(r["integrand"], r["dim"]): r for r in ROWS if r["pattern"] == PATTERNS[0] and r["n"] == MOST}
names = dict.fromkeys((r["kind"], r["integrand"]) for r in ROWS)
table(["kind", "integrand"] + [f"d = {d}" for d in DIMS],
      [[kind, f"`{name}`"] + [ratio(cells[name, d]) if (name, d) in cells else "" for d in DIMS] for kind, name in names])

print("RMSE of the mean divided by that of others over all integrands of a kind: medians, from the least to the most:\n")
table(["pattern", "kind"] + [e for e in ("median", "median-of-means", "auto")],
      [[f"`{p}`", kind] + ["{:.2f} ({:.2f} to {:,.2f})".format(statistics.median(v), min(v), max(v)) for e in
                           ("median", "median-of-means", "auto_rmse") for v in
                           ([r["mean"] / r[e] for r in ROWS if r["pattern"] == p and r["kind"] == kind],)]
       for p in PATTERNS for kind in ("smooth", "kink", "jump")])

print("Least and mean coverage of intervals of 95 %, and the median of their width beside Student's:\n")
table(["pattern", "kind", *INTERVALS],
      [[f"`{p}`", kind] + [f"{min(r[i] for r in of):.3f}, {statistics.mean(r[i] for r in of):.3f}; "
                           f"{statistics.median(r[i + '_width'] / r['student_width'] for r in of):.2g}" for i in INTERVALS for of in
                           ([r for r in ROWS if r["pattern"] == p and r["kind"] == kind and r[i] is not None],)]
       for p in PATTERNS for kind in ("smooth", "kink", "jump")])

for i in INTERVALS:
    bad = sorted((r for r in ROWS if r[i] is not None and r[i] < LOW), key=lambda r: r[i])
    print(f"{i}: {len(bad)} of {len(ROWS)} cells below {LOW}; the lowest: " + "; ".join(
        f"`{r['integrand']}` d = {r['dim']}, n = {r['n']}, {r['pattern']}: {r[i]:.3f}" for r in bad[:5]))

print("\nCoverage of proved intervals, over all integrands with bounds, and its standard error if it were 95 %:\n")
table(["pattern", "n", "runs", "empirical-bernstein", "betting"],
      [[f"`{p}`", str(n), f"{runs:,} ({(0.95 * 0.05 / runs) ** 0.5:.4f})"] + [f"{min(v):.4f} to {max(v):.4f} ({len(v)})" for i in
        ("empirical-bernstein", "betting") for v in ([r[i] for r in ALL if (r["pattern"], r["n"], r["runs"]) == (p, n, runs) and r[i] is not None],)]
       for p, n, runs in dict.fromkeys((r["pattern"], r["n"], r["runs"]) for r in ALL)])

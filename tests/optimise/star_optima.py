#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""star_optima.py PROVER PROGRAM: tools/prove_star.c proves the least star discrepancies of 1 to 11 points (with sanitizers 8) in the plane, and
tests/optimise/check_star.py accepts the proofs: nothing is below the sets of `koksma list records` less 1e-9. A proof in which any
line is altered, of each kind, is refused.
"""
import json
import math
import os
import subprocess
import sys

from check_star import Wrong, check

PROVER, PROGRAM = sys.argv[1:]
MARGIN = 1e-9
failures = []


def prove(n, value):
    return subprocess.run([PROVER, str(n), f"{value:.12f}"], capture_output=True, text=True)


def expect_wrong(what, lines):
    try:
        check(lines)
    except Wrong:
        return
    failures.append(f"accepted: {what}")


def alterations(lines):
    """(name, lines): each kind of node as another kind, with other numbers, missing and twice; the head; the ends."""
    head = lines[0].split()
    yield "head: more points", [f"{head[0]} {int(head[1]) + 1} {head[2]}"] + lines[1:]
    yield "head: fewer points", [f"{head[0]} {int(head[1]) - 1} {head[2]}"] + lines[1:]
    yield "head: a larger value", [f"{head[0]} {head[1]} {float(head[2]) + 1e-6:.12f}"] + lines[1:]
    yield "head: no value", [" ".join(head[:2])] + lines[1:]
    yield "no nodes", lines[:1]
    yield "the last node is missing", lines[:-1]
    yield "a node too many", lines + [lines[-1]]
    for kind in "bmc":
        places = [at for at, line in enumerate(lines) if line[0] == kind]
        for at in {places[0], places[len(places) // 2], places[-1]}:
            for other in "bmcx":
                if other != kind:
                    yield f"{kind} {at} as {other}", lines[:at] + [other + lines[at][1:]] + lines[at + 1:]
            yield f"{kind} {at} as the first cut", lines[:at] + ["c 1 1 1 1"] + lines[at + 1:]
            yield f"{kind} {at} is missing", lines[:at] + lines[at + 1:]
            yield f"{kind} {at} with a number too many", lines[:at] + [lines[at] + " 1"] + lines[at + 1:]
            if kind == "c":
                yield f"c {at} without its first group", lines[:at] + ["c " + " ".join(lines[at].split()[5:])] + lines[at + 1:]
                if exchanged(lines[at]) != lines[at]:
                    yield f"c {at} with the bounds exchanged", lines[:at] + [exchanged(lines[at])] + lines[at + 1:]


def exchanged(line):
    numbers = line.split()[1:]
    return "c " + " ".join(" ".join(numbers[g + k] for k in (2, 3, 0, 1)) for g in range(0, len(numbers), 4))


listed = subprocess.run([PROGRAM, "list", "records", "--json"], check=True, capture_output=True, text=True).stdout
values = {row["n"]: row["value"] for row in map(json.loads, listed.splitlines()) if row["measure"] == "star" and row["dim"] == 2}
values[1] = (math.sqrt(5) - 1) / 2  # one point, White 1976
altered = 0
for n in range(1, 9 if os.environ.get("KOKSMA_SANITIZED") == "1" else 12):
    proof = prove(n, values[n] - MARGIN)
    lines = proof.stdout.splitlines()
    proved, below = check(lines)
    if proof.returncode or proved != n or abs(float(below) + MARGIN - values[n]) > 1e-11:
        failures.append(f"n = {n}: {proof.stderr}")
    if prove(n, values[n] + 1e-6).returncode != 1:
        failures.append(f"n = {n}: more than the least value is proved")
    if 4 <= n <= 7:
        for what, other in alterations(lines):
            altered += 1
            expect_wrong(f"n = {n}, {what}", other)
print("\n".join(failures + [f"{altered} altered proofs, {len(failures)} failures"]))
sys.exit(bool(failures) or altered < 100)

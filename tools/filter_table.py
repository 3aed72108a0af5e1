#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""filter_table.py KOKSMA LIBRARY_DIR DIR: the tables of docs/findings/filters.md, as Markdown.

Runs docs/findings/filters.json into DIR (again: only what is missing) and reads errors and coherences from the exported
rows. Responses and leakage are the library's (koksma_filter_response, koksma_filter_leakage); the sidelobe is the largest
response beyond one cycle a pixel, searched in steps of 1/256 up to 16 cycles."""
import csv
import ctypes
import math
import os
import statistics
import subprocess
import sys

STUDENT_975 = {1: 12.706, 3: 3.182, 7: 2.365, 15: 2.131}  # by degrees of freedom
FILTERS = ["box", "tent", "hermite", "gaussian", "mitchell", "b-spline", "blackman-harris"]
PATTERNS = ["random", "jittered", "n-rooks", "sobol:scramble=owen"]
COHERENT_P = 0.005


def load(folder):
    ctypes.CDLL(os.path.join(folder, "libkoksma.so"), mode=ctypes.RTLD_GLOBAL)
    lab = ctypes.CDLL(os.path.join(folder, "libkoksma-lab.so"))
    lab.koksma_filter_find.restype = ctypes.c_void_p
    lab.koksma_filter_find.argtypes = [ctypes.c_char_p]
    lab.koksma_filter_response.restype = lab.koksma_filter_leakage.restype = ctypes.c_double
    lab.koksma_filter_response.argtypes = [ctypes.c_void_p, ctypes.c_double]
    lab.koksma_filter_leakage.argtypes = [ctypes.c_void_p]
    return lab


def print_responses(lab):
    print("| filter | response at 1/2 | leakage | largest beyond 1 cycle |\n|---|---|---|---|")
    for name in FILTERS:
        of = lab.koksma_filter_find(name.encode())
        lobe = max(abs(lab.koksma_filter_response(of, i / 256)) for i in range(256, 16 * 256))
        print(f"| `{name}` | {lab.koksma_filter_response(of, 0.5):.3f} | {100 * lab.koksma_filter_leakage(of):.1f} % "
              f"| {20 * math.log10(lobe):.1f} dB |")


def option(name, splat):
    return ";".join(sorted(t for t in ("" if name == "box" else f"filter={name}", "splat=yes" if splat else "") if t))


def print_rows(rows, scene, kind, title, cell):
    heads = [f"{how}, {p.split(':')[0]}" for how in ("drawn", "splatted") for p in PATTERNS]
    print(f"\n| {scene}, {title} | {' | '.join(heads)} |\n|---|{'---|' * len(heads)}")
    for name in FILTERS:
        cells = []
        for splat in (False, True):
            for pattern in PATTERNS:
                some = [r for r in rows if r["scene"] == scene and r["pattern"] == pattern and r["kind"] == kind
                        and sorted(filter(None, r["options"].split(";"))) ==
                        sorted(filter(None, option(name, splat).split(";")))]
                cells.append(cell(some))
        print(f"| `{name}` | {' | '.join(cells)} |")


def error(rows):
    values = [1e4 * float(r["value"]) for r in rows]
    half = STUDENT_975[len(values) - 1] * statistics.stdev(values) / math.sqrt(len(values))
    return f"{statistics.mean(values):.1f} ± {half:.1f}"


def coherence(rows):
    coherent = sum(float(r["p"]) < COHERENT_P for r in rows)
    text = f"{statistics.mean(float(r['value']) for r in rows):.1f}"
    return f"**{text}**, {coherent} of {len(rows)}" if 2 * coherent > len(rows) else f"{text}, {coherent}"


def main():
    koksma, library, folder = sys.argv[1:]
    plan = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../docs/findings/filters.json")
    print_responses(load(library))
    subprocess.run([koksma, "study", "run", plan, "-o", folder, "-q"], check=True)
    exported = subprocess.run([koksma, "study", "export", folder], check=True, capture_output=True, text=True).stdout
    rows = list(csv.DictReader(exported.splitlines()))
    for kind, title, cell in (("image", "error", error), ("coherence", "coherence", coherence)):
        for scene in ("checker", "ball"):
            print_rows(rows, scene, kind, title, cell)


if __name__ == "__main__":
    main()

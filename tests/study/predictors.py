#!/usr/bin/env python3
"""predictors.py KOKSMA: the answer to which measure predicts the error reproduces from the exported rows. numpy
computes Spearman's correlations by scene and group again, by their definition."""
import csv, io, json, os, subprocess, sys, tempfile

import numpy as np

PATTERNS = ["random", "n-rooks", "jittered", "regular", "zaremba:shift=1", "multi-jittered", "sobol:scramble=owen",
            "halton:scramble=owen"]
MEASURES = ["star", "l2-edge", "l2-centered", "relative-radius"]
GROUPS = {"edges": ["checker", "checker-45"], "lens": ["all"]}


def plan():
    reference = [{"name": "c", "pattern": "jittered", "spp": 64, "replicates": 2}]
    image = {"id": "i", "size": [8, 6], "patterns": PATTERNS, "spp": [4, 16], "trials": 4, "references": reference}
    return {"name": "p", "title": "p",
            "discrepancies": [{"id": "d", "patterns": PATTERNS, "measures": MEASURES, "n": [4, 16], "trials": 6}],
            "images": [dict(image, scenes=["checker", "checker-45"]), dict(image, scenes=["ball", "all"])],
            "questions": [{"id": "q", "kind": "correlation", "title": "Q", "discrepancies": "d", "images": "i",
                           "groups": [{"title": t, "scenes": s} for t, s in GROUPS.items()]}]}


def unit_ranks(values):
    values = np.asarray(values)
    equal = np.abs(values[:, None] - values) <= 1e-12 * np.maximum(np.abs(values[:, None]), np.abs(values))
    ranks = ((values < values[:, None]) & ~equal).sum(1) + (equal.sum(1) - 1) / 2
    ranks -= ranks.mean()
    length = np.sqrt(ranks @ ranks)
    return ranks / length if length else ranks


def means(rows):
    """{(what, pattern, n): mean} of points, {(scene, pattern, n): mean} of images."""
    values = {}
    for row in rows:
        key = row["what"] if row["kind"] == "discrepancy" else row["scene"]
        values.setdefault((row["kind"], key, row["pattern"], int(row["n"])), []).append(float(row["value"]))
    return {key: np.mean(v) for key, v in values.items()}


def cases_of(rows):
    """{(scene, n): (ranks of measures, ranks of the error)}; patterns in the plan's order."""
    mean = means(rows)
    points = {n: np.array([unit_ranks([mean["discrepancy", m, p, n] for p in PATTERNS]) for m in MEASURES])
              for n in (4, 16)}
    return {(s, n): (points[n], unit_ranks([mean["image", s, p, n] for p in PATTERNS]))
            for s in ("checker", "checker-45", "ball", "all") for n in (4, 16)}


def close(what, value, expected):
    if not abs(float(value) - expected) < 1e-9:
        sys.exit(f"{what}: the report has {value}, the rows give {expected}")


def tables_of(blocks):
    """The tables of a report by their names: rows of values by the names of their columns."""
    for block in blocks:
        if block["kind"] == "section":
            yield from tables_of(block["content"])
        elif block["kind"] == "table":
            names = [column["name"] for column in block["columns"]]
            yield block["name"], [dict(zip(names, [c[0] if isinstance(c, list) else c for c in row])) for row in block["rows"]]


def main(koksma):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "p.json")
        with open(path, "w") as f:
            json.dump(plan(), f)
        subprocess.run([koksma, "study", "run", path, "-o", folder + "/out", "-q"], check=True)
        rows = list(csv.DictReader(io.StringIO(subprocess.run([koksma, "study", "export", folder + "/out"], check=True,
                                                              capture_output=True, text=True).stdout)))
        report = json.load(open(folder + "/out/report.json"))
    files = dict(tables_of(report["content"]))
    cases = cases_of(rows)

    def rho(measure, keep):
        turned = -1 if measure == "relative-radius" else 1
        m = MEASURES.index(measure)
        return turned * np.mean([z[m] @ y for key, (z, y) in cases.items() if keep(*key)])

    checked = 0
    tables = {"correlation-scene-q": ("scene", lambda name: lambda s, n: s == name),
              "correlation-group-q": ("group", lambda name: lambda s, n: s in GROUPS[name.split(" (")[0]])}
    for file, (head, keep) in tables.items():
        for row in files[file]:
            own = {m: rho(m, keep(row[head])) for m in MEASURES}
            for m in MEASURES:
                close(f"{file}, {row[head]}, {m}", row[m], own[m])
                checked += 1
            close(f"{file}, {row[head]}, best", own[row["best"]], max(own.values()))
    for row in files["correlation-q"]:
        without = [rho(row["measure"], lambda s, n, left=left: s != left) for left in ("checker", "checker-45", "ball", "all")]
        close("all cases", row["mean Spearman"], rho(row["measure"], lambda s, n: True))
        close("lowest", row["lowest without a scene"], min(without + [rho(row["measure"], lambda s, n: True)]))
        close("highest", row["highest without a scene"], max(without + [rho(row["measure"], lambda s, n: True)]))
    if checked != 4 * (4 + 2):
        sys.exit(f"{checked} numbers were compared")


main(*sys.argv[1:])

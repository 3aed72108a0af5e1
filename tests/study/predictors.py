#!/usr/bin/env python3
"""predictors.py KOKSMA: the answer to which measure predicts the error reproduces from the exported rows. numpy
computes again, by the definitions, Spearman's correlations by scene, group and number of samples, and the rank
regression with one scene left out; both are compared with the tables of the report."""
import csv, io, itertools, json, os, subprocess, sys, tempfile

import numpy as np

PATTERNS = ["random", "n-rooks", "jittered", "regular", "zaremba:shift=1", "multi-jittered", "sobol:scramble=owen",
            "halton:scramble=owen"]
MEASURES = ["star", "l2-edge", "l2-centered", "relative-radius"]
GROUPS = {"edges": ["checker", "checker-45"], "lens": ["all"]}
PENALTIES = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1, 3, 10]


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


def held_out(cases, scene):
    """Spearman in the scene of the single measure, the pair and the ridge regression that the others choose."""
    scenes = sorted({s for s, _ in cases})

    def sums(some):
        gram, right = 0, 0
        for s in some:
            of = [c for (t, _), c in cases.items() if t == s]
            gram = gram + sum(z @ z.T for z, _ in of) / len(of)
            right = right + sum(z @ y for z, y in of) / len(of)
        return gram, right

    def error(weights, s):
        gram, right = sums([s])
        return weights @ gram @ weights - 2 * weights @ right

    def ridge(some, penalty):
        gram, right = sums(some)
        return np.linalg.solve(gram + penalty * len(some) * np.eye(len(right)), right)

    others = [s for s in scenes if s != scene]
    gram, right = sums(others)
    single = max(range(len(right)), key=lambda j: right[j] ** 2 / gram[j, j])
    pairs = {p: np.linalg.solve(gram[np.ix_(p, p)], right[list(p)]) for p in itertools.combinations(range(len(right)), 2)}
    pair = max(pairs, key=lambda p: pairs[p] @ right[list(p)])
    penalty = min(PENALTIES, key=lambda l: sum(error(ridge([t for t in others if t != s], l), s) for s in others))
    weights = {"single": np.zeros(len(right)), "pair": np.zeros(len(right)), "all": ridge(others, penalty)}
    weights["single"][single] = np.sign(right[single])
    weights["pair"][list(pair)] = pairs[pair]
    of = [c for (t, _), c in cases.items() if t == scene]
    return {k: np.mean([unit_ranks(w @ z) @ y for z, y in of]) for k, w in weights.items()}, single, pair, penalty


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
              "correlation-group-q": ("group", lambda name: lambda s, n: s in GROUPS[name.split(" (")[0]]),
              "correlation-samples-q": ("samples", lambda name: lambda s, n: n == int(name))}
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
    for row in files["combinations-q"]:
        scene = row["scene left out"]
        own, single, pair, penalty = held_out(cases, scene)
        if (row["single measure"], row["pair"]) != (MEASURES[single], " + ".join(MEASURES[i] for i in pair)):
            sys.exit(f"{scene}: the report chooses {row['single measure']} and {row['pair']}, the rows "
                     f"{MEASURES[single]} and {[MEASURES[i] for i in pair]}")
        close(scene + ", penalty", row["penalty of all"], penalty)
        for column, key in (("its Spearman", "single"), ("pair's Spearman", "pair"), ("all's Spearman", "all")):
            close(f"{scene}, {key}", row[column], own[key])
            checked += 1
    if checked != 4 * (4 + 2 + 2) + 4 * 3:
        sys.exit(f"{checked} numbers were compared")


main(*sys.argv[1:])

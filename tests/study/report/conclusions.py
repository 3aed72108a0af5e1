#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""conclusions.py PROGRAM: a study whose answers are known by construction. Of every kind of conclusion one is true, one is
false and, where a kind has several tests, one is half true; the report has to say so. What stands beside them (ratios,
joint tests of z) is computed here again from the rows."""
import csv
import io
import json
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from schema import complain, finish, words

KOKSMA = Path(sys.argv[1]).resolve()
PALETTE = Path(__file__).resolve().parents[3] / "src/lab/plot/palette.def"

# By theory: jittered falls as n^-0.75 and random as n^-0.5 in l2-star; a lattice of centres leaves bands in a checkerboard
# at 45 degrees, and independent samples leave noise; and random samples err more than jittered ones everywhere.
PLAN = {
    "name": "known", "title": "Known", "metrics": ["grain"],
    "discrepancies": [{"id": "d", "patterns": ["jittered", "random"], "measures": ["l2-star"], "n": [16, 64, 256], "trials": 60},
                      {"id": "one", "patterns": ["jittered"], "measures": ["l2-star"], "n": [16, 64], "trials": 1},
                      {"patterns": ["n-rooks", "jittered", "half-jittered", "multi-jittered", "random"], "measures": ["l2-star", "min-distance"],
                       "n": [16], "trials": 60}],
    "images": [{"id": "i", "scenes": ["checker-45"], "size": [64, 48], "spp": [4], "trials": 8, "patterns": ["regular", "jittered", "random"],
                "references": [{"name": "r", "pattern": "sobol:scramble=owen", "spp": 1024, "replicates": 2}]},
               {"id": "shade", "scenes": ["ball"], "size": [128, 96], "spp": [4], "trials": 8, "patterns": ["zaremba"],
                "references": [{"name": "r", "pattern": "sobol:scramble=owen", "spp": 1024, "replicates": 2}]},
               {"scenes": ["checker"], "size": [64, 48], "spp": [16], "trials": 8,
                "patterns": ["n-rooks", "jittered", "half-jittered", "multi-jittered", "random"],
                "references": [{"name": "r", "pattern": "sobol:scramble=owen", "spp": 1024, "replicates": 2}]}],
    "tables": [{"id": "errors", "title": "E", "scene": "checker", "n": 16, "rows": [
                   {"pattern": p, "label": p, "published": [v]} for p, v in
                   [("n-rooks", 3), ("jittered", 2), ("half-jittered", 5), ("multi-jittered", 1), ("random", 4)]]},
               {"id": "bands", "title": "B", "scene": "checker-45", "n": 4, "rows": [
                   {"pattern": p, "label": p, "published": []} for p in ("regular", "random")]},
               {"id": "S", "symbol": "S", "title": "S", "measure": "l2-star", "n": 16, "rows": [
                   {"pattern": p, "label": p, "published": ["0.09" if p == "random" else "0.05"]} for p in
                   ("n-rooks", "jittered", "half-jittered", "multi-jittered", "random")]},
               {"id": "distance", "title": "Distances", "measure": "min-distance", "n": 16, "rows": [
                   {"pattern": p, "label": p, "published": []} for p in
                   ("n-rooks", "jittered", "half-jittered", "multi-jittered", "random")]},
               {"id": "sizes", "title": "N", "measure": "l2-star", "n": [16, 64, 256], "rows": [
                   {"pattern": "jittered", "label": "jittered", "published": ["0.1", "0.02", "0.01"], "rate": -0.75},
                   {"pattern": "random", "label": "Poisson, d = 2", "published": ["0.2", "0.2", "0.2"], "of-random": 1}],
                "notes": [{"statistic": "mean", "explained": False, "reason": "The procedure was inferred."}]},
               {"id": "other", "title": "O", "measure": "l2-star", "n": [16, 64], "rows": [
                   {"pattern": p, "label": p, "published": ["1", "1"]} for p in ("jittered", "random")],
                "notes": [{"statistic": "mean", "untested": True, "reason": "R"}]},
               {"id": "chosen", "title": "C", "measure": "l2-star", "n": 16, "rows": [
                   {"pattern": p, "label": p, "published": ["0.0500"]} for p in ("jittered", "n-rooks")],
                "notes": [{"pattern": "jittered", "statistic": "mean", "untested": True, "reason": "R"}]}],
    "figures": [{"id": of, "title": of, "scene": "glossy", "pattern": "jittered", "n": 16, "adaptive": f"hierarchical:levels=1,pairing={of}"}
                for of in ("aligned", "shuffled")],
}
FIVE = ["multi-jittered", "n-rooks", "jittered", "half-jittered", "random"]
CONCLUSIONS = [  # the words, the expected verdict, and the test
    ("order true", "holds", {"kind": "order", "tables": ["errors"], "patterns": ["multi-jittered", "jittered", "random"]}),
    ("order half true", "partly", {"kind": "order", "tables": ["errors"], "patterns": ["jittered", "multi-jittered", "random"]}),
    ("order false", "fails", {"kind": "order", "tables": ["errors"], "patterns": ["random", "jittered", "multi-jittered"]}),
    ("best true", "holds", {"kind": "best", "tables": ["errors"], "patterns": ["multi-jittered"]}),
    ("best half true", "partly", {"kind": "best", "tables": ["errors"], "patterns": ["jittered"], "against": ["multi-jittered", "n-rooks", "half-jittered"]}),
    ("best false", "fails", {"kind": "best", "tables": ["errors"], "patterns": ["random"]}),
    ("predictor true", "holds", {"kind": "predictor", "tables": ["errors"], "by": ["errors"], "patterns": FIVE}),
    ("predictor false", "fails", {"kind": "predictor", "tables": ["errors"], "by": ["distance"], "patterns": FIVE}),
    ("predictor half true", "partly", {"kind": "predictor", "tables": ["errors"], "by": ["distance", "errors", "S"], "patterns": FIVE}),
    ("predictor beside others", "holds", {"kind": "predictor", "tables": ["errors"], "by": ["errors"], "than": ["distance", "S"], "patterns": FIVE}),
    ("before true", "holds", {"kind": "before", "tables": ["sizes"], "patterns": ["jittered"], "against": ["random"]}),
    ("before false", "fails", {"kind": "before", "tables": ["sizes"], "patterns": ["random"], "against": ["jittered"]}),
    ("before of some other procedure", "holds", {"kind": "before", "tables": ["other", "sizes"], "patterns": ["jittered"], "against": ["random"]}),
    ("before by another procedure true", "undecided", {"kind": "before", "tables": ["other"], "patterns": ["jittered"], "against": ["random"]}),
    ("before by another procedure false", "undecided", {"kind": "before", "tables": ["other"], "patterns": ["random"], "against": ["jittered"]}),
    ("bands true", "holds", {"kind": "bands", "images": "i", "patterns": ["regular"], "against": ["random", "jittered"]}),
    ("bands beside", "holds", {"kind": "bands", "images": "i", "patterns": ["regular"], "beside": ["random"]}),
    ("bands half true", "partly", {"kind": "bands", "tables": ["bands"], "patterns": ["regular", "random"]}),
    ("bands of one slow wave", "fails", {"kind": "bands", "images": "shade", "patterns": ["zaremba"]}),
    ("bands false", "fails", {"kind": "bands", "tables": ["bands"], "patterns": ["random"], "against": ["regular"]}),
    ("metric true", "holds", {"kind": "metric", "images": "i", "metric": "rmse", "patterns": ["random"], "against": ["jittered"]}),
    ("metric false", "fails", {"kind": "metric", "images": "i", "metric": "rmse", "patterns": ["jittered"], "against": ["random"]}),
    ("rates true", "holds", {"kind": "rates", "discrepancies": "d", "patterns": ["jittered"]}),
    ("rates half true", "partly", {"kind": "rates", "discrepancies": "d", "patterns": ["jittered", "random"]}),
    ("rates false", "fails", {"kind": "rates", "discrepancies": "d", "patterns": ["random"]}),
    ("rates unknown", "undecided", {"kind": "rates", "discrepancies": "one", "patterns": ["jittered"]}),
    ("slopes true", "holds", {"kind": "slopes", "tables": ["sizes"], "patterns": ["jittered"], "against": ["random"]}),
    ("slopes half true", "partly", {"kind": "slopes", "tables": ["sizes"], "patterns": ["jittered", "random"]}),
    ("slopes false", "fails", {"kind": "slopes", "tables": ["sizes"], "patterns": ["random"], "against": ["jittered"]}),
    ("slopes of the same", "fails", {"kind": "slopes", "tables": ["sizes"], "by": ["sizes"], "patterns": ["jittered"]}),
    ("slopes by another procedure", "undecided", {"kind": "slopes", "tables": ["other"], "patterns": ["jittered"]}),
    # neighbours in the pixel are neighbours elsewhere only if all spaces have one connectivity
    ("adaptive true", "holds", {"kind": "adaptive", "figures": ["aligned", "shuffled"], "patterns": ["jittered"]}),
    ("adaptive false", "fails", {"kind": "adaptive", "figures": ["shuffled", "aligned"], "patterns": ["jittered"]}),
]


def blocks(content, under=()):
    for block in content:
        yield under, block
        yield from blocks(block.get("content", []), (*under, words(block.get("heading", []))))


def koksma(*arguments):
    return subprocess.run([KOKSMA, *arguments], capture_output=True, text=True)


def report_of(plan, folder):
    Path(f"{folder}.json").write_text(json.dumps(plan))
    run = koksma("study", "run", f"./{folder}.json", "-o", folder, "-q")
    if run.returncode:
        complain(f"{folder}: {run.stderr}")
        sys.exit(1)
    return json.loads(Path(folder, "report.json").read_text())


def check_verdicts(report, rows):
    said = {words(b["text"]).split(": ", 1)[1]: b for under, b in blocks(report["content"]) if under and ("concludes" in under[-1] or under[-1] == "Figures") and "answer" in b}
    for what, verdict, _ in CONCLUSIONS:
        found = [b for text, b in said.items() if text.startswith(what + ".")]
        if len(found) != 1 or found[0]["answer"] != verdict:
            complain(f"{what}: {[(b['answer'], words(b['text'])) for b in found]}, not {verdict}")
    # The interval of a ratio, by first-order propagation from those of both means (8 trials: Student's t is 2.3646).
    mean, half = {}, {}
    for pattern in ("random", "jittered"):
        values = [float(r["value"]) for r in rows if (r["scene"], r["metric"], r["pattern"]) == ("checker-45", "rmse", pattern)]
        mean[pattern] = sum(values) / 8
        half[pattern] = 2.3646 * math.sqrt(sum((v - mean[pattern]) ** 2 for v in values) / 7 / 8)
    ratio = mean["random"] / mean["jittered"]
    text = words(next(b for t, b in said.items() if t.startswith("metric true"))["text"])
    if f"rmse: {ratio:.2f} ± {ratio * math.hypot(*(half[p] / mean[p] for p in mean)):.2g} in checker-45; surely" not in text:
        complain(f"the ratio is {ratio}: {text}")
    # Each measure is named as its table computes it.
    text = words(next(b for t, b in said.items() if t.startswith("predictor half true"))["text"])
    if "On average min-distance -" not in text or "S l2-star" not in text:
        complain(f"predictors: {text}")
    # What stands beside a measure is averaged and no test.
    text = words(next(b for t, b in said.items() if t.startswith("predictor beside others"))["text"])
    if ", min-distance -" not in text or "1 of 1 correlations" not in text:
        complain(f"measures beside: {text}")


def check_agreement(report):
    """What a note calls no test agrees with nothing, whatever its z: the headline counts the cells that are left."""
    cells = [cell for _, b in blocks(report["content"]) if b["kind"] == "table" and b["name"] in ("table-S", "table-sizes", "table-other", "table-chosen")
             for row in b["rows"] for cell in row if isinstance(cell, dict) and "verdict" in cell]
    of = {v: sum(c["verdict"] == v for c in cells) for v in ("agrees", "unexplained", "untested")}
    headline = next(words(b["text"]) for _, b in blocks(report["content"]) if "published means of measures" in words(b.get("text", [])))
    near = [c for c in cells if c["verdict"] == "untested" and abs(c["z"]) < 2.6]
    if of["untested"] != 5 or not near or not headline.startswith(f"{of['agrees']} of {of['agrees'] + of['unexplained']} published means of measures agree"):
        complain(f"{of}, {len(near)} within chance: {headline}")


def check_joint_tests(report):
    """Which tables fail follows from the values of z that their cells have."""
    headline = next(words(b["text"]) for _, b in blocks(report["content"]) if "joint tests" in words(b.get("text", [])))
    verdicts = set()
    for _, table in blocks(report["content"]):
        if table.get("name") in ("table-S", "table-sizes"):
            z = [cell["z"] for row in table["rows"] for cell in row if isinstance(cell, dict) and "z" in cell]
            k, total, squares = len(z), sum(z) / math.sqrt(len(z)), sum(v * v for v in z)
            fails = abs(total) > 1.96 or squares > {2: 5.991, 5: 11.070, 6: 12.592}[k]
            verdicts.add(fails)
            if fails != (f"{table['name'][6:]} ({total:+.2f}, {squares:.1f} of {k})" in headline):
                complain(f"{table['name']}: {total:+.2f} and {squares:.1f} of {k}: {headline}")
    if verdicts != {True, False} or "1 of 2 tables" not in headline or "fail: table sizes (" not in headline or \
            "No test, because of its note: table other, chosen." not in headline:
        complain(headline)


def check_colours(report):
    """A curve has the colour of its row's pattern, whatever the row's label."""
    palette = [re.findall(r"[\w-]+", names) for names in re.findall(r"^COLOUR\(\w+, \w+, ([^)]*)\)", PALETTE.read_text(), re.M)]
    chart = next(b for _, b in blocks(report["content"]) if b["kind"] == "chart" and b["title"].startswith("Table sizes"))
    colours = {s["label"]: s["colour"] for s in chart["series"] if s["style"] == "line"}
    wanted = {"jittered": "jittered", "Poisson, d = 2": "random"}
    if colours != {label: next(i for i, names in enumerate(palette) if pattern in names) for label, pattern in wanted.items()}:
        complain(f"the colours are {colours}")


def check_slopes(report):
    """Printed slopes are least squares in the logarithms, as ours: of 0.1, 0.02, 0.01 at 16, 64, 256."""
    table = next(b for _, b in blocks(report["content"]) if b.get("name") == "table-sizes")
    at = [c["name"] for c in table["columns"]].index("slope")
    expected = (math.log(0.01) - math.log(0.1)) / (math.log(256) - math.log(16))  # the middle size has no weight
    if abs(table["rows"][0][at][0] - expected) > 1e-12:
        complain(f"the printed slope is {table['rows'][0][at][0]}, not {expected}")


def check_refusals():
    known = koksma("study", "run", "./kind.json", "-o", "never") if Path("kind.json").write_text(
        json.dumps({**PLAN, "conclusions": [{"kind": "x", "says": "X", "patterns": ["random"]}]})) else None
    kinds = {c[2]["kind"] for c in CONCLUSIONS}
    listed = re.split(", | or ", known.stderr.split("it takes ")[-1].strip())
    if known.returncode != 3 or set(listed) != kinds:
        complain(f"the kinds are {listed}; tested are {sorted(kinds)}")
    wrong = [({"kind": "order", "patterns": ["random"]}, "needs tables"), ({"kind": "order", "tables": ["none"], "patterns": ["random"]}, "no table of the plan has the id 'none'"),
             ({"kind": "order", "tables": ["errors"], "patterns": ["sobol"]}, "table errors has no row of sobol"),
             ({"kind": "order", "tables": ["S"], "patterns": ["random"]}, "table S is not one of a scene"),
             ({"kind": "rates", "discrepancies": "e", "patterns": ["random"]}, "no block of the plan has the id 'e'"),
             ({"kind": "rates", "discrepancies": "d", "patterns": ["sobol"]}, "a block 'd' lacks the pattern sobol"),
             ({"kind": "metric", "images": "i", "patterns": ["random"], "against": ["jittered"]}, "needs metric"),
             ({"kind": "slopes", "tables": ["S"], "patterns": ["random"]}, "table S has one number of points"),
             ({"kind": "slopes", "tables": ["sizes", "other"], "patterns": ["n-rooks"]}, "table other has no row of n-rooks"),
             ({"kind": "adaptive", "figures": ["aligned"], "patterns": ["jittered"]}, "figures come in pairs"),
             ({"kind": "adaptive", "figures": ["none"], "patterns": ["jittered"]}, "no figure with the id 'none' has an adaptive method")]
    for conclusion, message in wrong:
        Path("wrong.json").write_text(json.dumps({**PLAN, "conclusions": [{"says": "X", **conclusion}]}))
        run = koksma("study", "run", "./wrong.json", "-o", "never")
        if run.returncode != 3 or message not in run.stderr or "conclusions[0]" not in run.stderr:
            complain(f"{conclusion}: {run.returncode}, {run.stderr}")


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    plan = {**PLAN, "conclusions": [{"says": what + ".", **test} for what, _, test in CONCLUSIONS]}
    report = report_of(plan, "known")
    rows = list(csv.DictReader(io.StringIO(koksma("study", "export", "known").stdout)))
    check_verdicts(report, rows)
    check_agreement(report)
    check_joint_tests(report)
    check_colours(report)
    check_slopes(report)
    check_refusals()
finish(f" with {len(CONCLUSIONS)} conclusions")

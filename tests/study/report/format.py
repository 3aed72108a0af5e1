#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""format.py KOKSMA: a report for every kind of question (src/lab/study/plan/questions.def), asked by name, and for every section
(sections.def). Each report.json must be as docs/report.schema.json says and have the answer or the section; the page must
hold the same text; the same rows must give the same bytes; a study of blocks that a question can't be answered from must
say what it takes. Documents and error messages must name every kind of question. With sanitizers each report is made once."""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from schema import blocks, complain, errors, finish, words

ROOT = Path(__file__).resolve().parents[3]
KOKSMA = Path(sys.argv[1]).resolve()
SANITIZED = os.environ.get("KOKSMA_SANITIZED") == "1"
PATTERNS = ["random", "jittered", "n-rooks", "regular", "halton", "sobol", "zaremba"]
POINTS = {"id": "d", "patterns": PATTERNS, "measures": ["star", "l2-star"], "n": [4, 16, 64], "trials": 3}
IMAGES = {"id": "i", "scenes": ["checker", "ball"], "patterns": PATTERNS, "spp": [4, 16, 64], "size": [8, 6], "trials": 3,
          "options": {"filter": ["box", "tent"]}, "references": [{"name": "c", "pattern": "jittered", "spp": 64}]}


def lines_of(table, macro):
    text = (ROOT / "src/lab/study" / table).read_text()
    return re.findall(r"^%s\((\w+)" % macro, text, re.M)


SCHEMA = json.loads((ROOT / "docs/report.schema.json").read_text())


def check_schema(name, report, schema=SCHEMA):
    for error in list(errors(report, schema, SCHEMA))[:5]:
        complain(f"{name}: {error}")


# ---- What the schema can't say

def check_tables(name, report):
    for table in (b for b in blocks(report["content"]) if b["kind"] == "table"):
        columns = [column["name"] for column in table["columns"]]
        if len(set(columns)) < len(columns):
            complain(f"{name}: table {table['name']} has a column twice: {columns}")
        if not table["rows"]:
            complain(f"{name}: table {table['name']} has no rows")
        for row in table["rows"]:
            if len(row) > len(columns):
                complain(f"{name}: table {table['name']}: {len(row)} cells in {len(columns)} columns")
            for cell, column in zip(row, table["columns"]):
                if column["type"] in ("interval", "spread") and isinstance(cell, (str, int, float)):
                    complain(f"{name}: table {table['name']}, {column['name']}: {cell} has no interval")


PALETTE = [re.findall(r"[\w-]+", names) for names in re.findall(r"^COLOUR\(\w+, \w+, ([^)]*)\)", (ROOT / "src/lab/plot/palette.def").read_text(), re.M)]


def check_colours(name, report):
    """A pattern has its colour of the palette in every chart."""
    for chart in (b for b in blocks(report["content"]) if b["kind"] == "chart"):
        for s in (s for s in chart["series"] if s["style"] in ("line", "marks")):
            wanted = [i for i, names in enumerate(PALETTE) if re.split("[:@ ]", s["label"])[0] in names]
            if wanted and s["colour"] != wanted[0]:
                complain(f"{name}: {chart['title']}: {s['label']} has the colour {s['colour']}, in plots {wanted[0]}")


def check_numbers(name, report):
    """Every number of a paragraph is a value, too."""
    for block in blocks(report["content"]):
        for run in block.get("text", []):
            if isinstance(run, dict) and "value" in run and not re.fullmatch(r"[-+]?[0-9.]+(e[-+]\d+)?", run["text"]):
                complain(f"{name}: the number {run}")


def run_study(name, plan, limit=0):
    """Runs a plan and reads its report; limit: the seconds of a run that is to end early."""
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        (work / "plan.json").write_text(json.dumps({"name": name, "title": name, **plan}))
        done = subprocess.run([KOKSMA, "study", "run", "./plan.json", "-o", "out", "-q", "--time-limit", str(limit)], cwd=work, capture_output=True, text=True)
        if done.returncode != (limit > 0):
            complain(f"{name}: {done.stderr.strip()}")
            return None
        text, page = (work / "out/report.json").read_text(), (work / "out/report.html").read_text()
        if not SANITIZED:
            subprocess.run([KOKSMA, "study", "report", "out"], cwd=work, check=True)
        if (work / "out/report.json").read_text() != text or (work / "out/report.html").read_text() != page:
            complain(f"{name}: the same rows give another report")
    held = re.search(r'<script type="application/json" id="data">\n(.*?)</script>', page, re.S)
    if not held or held[1].strip() != text.strip():
        complain(f"{name}: the page does not hold report.json")
    try:
        report = json.loads(text)
    except ValueError as error:
        complain(f"{name}: report.json is no JSON: {error}")
        return None
    check_schema(name, report)
    check_colours(name, report)
    check_tables(name, report)
    check_numbers(name, report)
    if "\ufffd" in text:
        complain(f"{name}: a character was cut")
    if one := re.search(r"\b1 (points|samples|sets|trials|renders|scenes|patterns|images|rows)\b", text):
        complain(f"{name}: '{one[0]}'")
    return report


def check_question(kind):
    question = {"id": "q", "title": "Q", "kind": kind, "discrepancies": "d", "images": "i"}
    name = f"question {kind}"
    report = run_study(name, {"discrepancies": [POINTS], "images": [IMAGES], "questions": [question]})
    found = [b for b in blocks(report["content"]) if b.get("id") == "question-q"] if report else []
    if not found or not found[0]["content"]:
        complain(f"{name}: no answer")
    elif not any(b["kind"] == "table" for b in blocks(found[0]["content"])):
        complain(f"{name}: an answer without a table: {words(found[0]['content'][0].get('text', []))}")


def check_sections():
    """A plan for every section: published tables of both kinds, figures, questions, images."""
    row = {"pattern": "random", "label": "R", "published": [0.3]}
    plan = {"discrepancies": [POINTS], "images": [{**IMAGES, "options": {}}],
            "conclusions": [{"kind": "before", "says": "C.", "tables": ["1"], "patterns": [row["pattern"]], "against": [row["pattern"]]}],
            "tables": [{"id": "1", "title": "P", "measure": "star", "n": 16, "rows": [row]},
                       {"id": "2", "title": "S", "measure": "star", "n": [4, 16, 64], "rows": [{**row, "published": ["0.5", "0.3", "0.2"]}]},
                       {"id": "3", "title": "I", "scene": "ball", "n": 16, "rows": [row]}],
            "figures": [{"id": "1", "title": "F", "pattern": "random", "n": 16}, {"id": "2", "title": "S", "scene": "ball", "pattern": "regular", "n": 1},
                        {"id": "3", "title": "L", "pattern": "random", "n": 16, "lines": "dual"}],
            "questions": [{"id": "q", "title": "Q", "kind": "table", "discrepancies": "d"}]}
    plan["discrepancies"] = [{**POINTS, "n": [4, 8, 16, 64], "skip": True}]
    sections, undone = lines_of("report/sections.def", "SECTION"), "undone"  # the last is of a part of a study
    part = run_study("part", {"discrepancies": [POINTS]}, 1e-9)
    if part and undone not in [b["id"] for b in part["content"] if "id" in b]:
        complain("sections: a part of a study does not say what is not done")
    report = run_study("sections", plan)
    if report:
        found = [b["id"] for b in report["content"] if "id" in b]
        if found != [section for section in sections if section != undone]:
            complain(f"sections: {found} are shown, of {sections}")
        for block in (b for b in report["content"] if not b.get("content")):
            complain(f"sections: {block.get('id')} is empty")
        kinds = {b["kind"] for b in blocks(report["content"])}
        if kinds != {"section", "paragraph", "list", "table", "chart", "figure", "pictures"}:
            complain(f"sections: no block of a kind, only of {sorted(kinds)}")


def check_singular():
    """One of everything: run_study complains of "1 points"."""
    row = {"pattern": "random", "label": "R"}
    run_study("one of each", {"discrepancies": [{**POINTS, "n": [1, 4, 16], "trials": 1}],
                              "images": [{**IMAGES, "spp": [1], "trials": 1, "options": {}}],
                              "tables": [{"id": "1", "title": "P", "measure": "star", "n": 1, "rows": [{**row, "published": [0.3]}]},
                                         {"id": "2", "title": "S", "measure": "star", "n": [1, 4], "rows": [{**row, "published": ["0.5", "0.3"]}]},
                                         {"id": "3", "title": "I", "scene": "ball", "n": 1, "rows": [{**row, "published": [0.3]}]}],
                              "questions": [{"id": kind, "title": kind, "kind": kind, "discrepancies": "d", "images": "i"} for kind in ("table", "slopes", "correlation")]})


def check_documents():
    kinds = lines_of("plan/questions.def", "QUESTION")
    readme = (ROOT / "studies/README.md").read_text()
    for kind in kinds:
        if f"`{kind}`" not in readme:
            complain(f"studies/README.md does not name the kind of question '{kind}'")
    with tempfile.TemporaryDirectory() as folder:
        plan = {"name": "k", "title": "k", "discrepancies": [POINTS], "questions": [{"id": "q", "title": "Q", "kind": "none", "discrepancies": "d"}]}
        Path(folder, "k.json").write_text(json.dumps(plan))
        told = subprocess.run([KOKSMA, "study", "run", "./k.json", "-o", "k"], cwd=folder, capture_output=True, text=True).stderr
    if not told.rstrip().endswith(f"it takes {', '.join(kinds[:-1])} or {kinds[-1]}"):
        complain(f"the message on an unknown kind: {told}")
    format_text = (ROOT / "docs/report-format.md").read_text()
    for name in SCHEMA["$defs"]["column"]["properties"] | SCHEMA["properties"] | {o["$ref"].rsplit("/")[-1]: 0 for o in SCHEMA["$defs"]["block"]["oneOf"]}:
        if f"`{name}`" not in format_text:
            complain(f"docs/report-format.md does not say what '{name}' is")


# The validator itself sees what is wrong.
GOOD = {"format": "koksma-report", "version": 1, "title": "", "about": "", "plan": "", "koksma": "", "rows_sha256": "0" * 64,
        "content": []}
for wrong in ({"version": 2}, {"title": 3}, {"more": 1}, {"content": [{"kind": "table", "name": "t", "columns": [], "rows": []}]},
              {"content": [{"kind": "paragraph", "text": [{"text": "1", "value": "1"}]}]}, {"content": [{"kind": "none"}]}):
    assert list(errors({**GOOD, **wrong}, SCHEMA, SCHEMA)), f"the validator takes {wrong}"
assert not list(errors(GOOD, SCHEMA, SCHEMA))

for kind in lines_of("plan/questions.def", "QUESTION"):
    check_question(kind)
check_sections()
check_singular()
if not SANITIZED:
    check_documents()
finish()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""atlas.py KOKSMA [all]: `koksma atlas`. Pages are whole, static and linked; the numbers on them are those that their commands print;
a second build runs nothing, a new question its own commands alone; a question that asks for what the rows lack stops the build.
An entry that is altered, false or no better is refused with this reason; so is a copy.
all: the questions that ship, with ten numbers drawn at random and made again, in place of a small file of questions."""
import csv
import html.parser
import json
import math
import os
import random
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
KOKSMA = str(Path(sys.argv[1]).resolve())
problems = 0


def expect(holds, text):
    global problems
    if not holds:
        problems += 1
        print(text)


def run(*arguments, code=0):
    result = subprocess.run([KOKSMA, *arguments], capture_output=True, text=True)
    expect(result.returncode == code, f"{arguments}: exit {result.returncode}, not {code}: {result.stderr}")
    return result


def rows(*arguments, code=0):
    return [json.loads(line) for line in run(*arguments, "--json", code=code).stdout.splitlines()]


# ---- Pages


class Page(html.parser.HTMLParser):
    """The links, ids and commands of a page; its numbers with the command above them."""
    def __init__(self, path):
        super().__init__()
        self.plain = []  # documents that are named outside a link
        self.open = []
        self.links, self.ids, self.commands, self.numbers, self.in_code, self.tags = [], [], [], [], False, set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        a = dict(attributes)
        self.open += [tag] if tag in ("a", "pre") else []
        self.tags.add(tag)
        self.links += [a[k] for k in ("href", "src") if k in a]
        self.ids += [a["id"]] if "id" in a else []
        self.in_code = tag == "code" and bool(self.stack_pre)
        if tag == "pre":
            self.stack_pre = True
            self.commands.append("")
        if tag == "data" and self.commands:
            self.numbers.append((len(self.commands) - 1, float(a["value"])))

    stack_pre = False

    def handle_endtag(self, tag):
        self.stack_pre = self.stack_pre and tag != "pre"
        self.open = self.open[:-1] if tag in ("a", "pre") else self.open

    def handle_data(self, data):
        self.plain += re.findall(r"[\w/-]+/[\w-]+\.md", data) if not self.open else []
        if self.stack_pre:
            self.commands[-1] += data


def check_links(folder):
    for path in [*folder.glob("*.html"), *folder.glob("docs/*.html")]:
        page = Page(path)
        expect(not page.plain, f"{path.name}: no link to {page.plain}")
        expect("script" not in page.tags, f"{path.name} has a script")
        expect(len(page.ids) == len(set(page.ids)), f"{path.name}: an id occurs twice")
        for link in page.links:
            name, _, part = link.partition("#")
            target = path.parent / (name or path.name)
            expect(":" not in link and not link.startswith("/"), f"{path.name}: {link} is not relative")
            expect(target.exists(), f"{path.name}: {link} leads nowhere")
            expect(not part or part in Page(target).ids, f"{path.name}: {link}: no such part")
    linked = {link for path in folder.glob("*.html") for link in Page(path).links}
    for path in folder.glob("*.html"):
        expect(path.name in linked or path.name == "index.html", f"no page leads to {path.name}")


def numbers_in(value):
    """All numbers of parsed JSON, also of texts' digits."""
    if isinstance(value, dict):
        return {n for v in value.values() for n in numbers_in(v)}
    if isinstance(value, list):
        return {n for v in value for n in numbers_in(v)}
    return {float(value)} if isinstance(value, (int, float)) and not isinstance(value, bool) else set()


def made_again(folder, count):
    """Draws numbers from tables of all pages and runs the commands above them, in the folder of files, where they ran."""
    drawn = [(path.name, page.commands[i], number) for path in sorted(folder.glob("*.html")) for page in [Page(path)]
             for i, number in page.numbers if page.commands[i].startswith("koksma ")]
    for name, command, number in random.sample(drawn, min(count, len(drawn))):
        words = shlex.split(command)
        result = subprocess.run([KOKSMA, *words[1:]], capture_output=True, text=True, cwd=folder / "files")
        values = {n for line in result.stdout.splitlines() for n in numbers_in(json.loads(line))}
        expect(words[0] == "koksma" and number in values, f"{name}: {number!r} does not come from: {command}")
    return len(drawn)


QUESTIONS = {
    "title": "Test & atlas", "text": "One < two.", "notes": {"measure": "Of `koksma`."},
    "questions": [{
        "id": "one", "title": "Which is <more> even?", "threads": ["a#1"],
        "answer": "`{m|measure=star|least=value|source}` has {m|source=sobol@16|measure=star|value}; error {i|n=16|rmse low high}; "
                  "least {m|measure=star|source=sobol@16|list=source}; both {m|measure=star|list=source}; {i|n=16|rmse low high %}",
        "text": "See `docs/findings/any-n.md`.",
        "runs": [{"id": "m", "command": "koksma measure sobol@16 random@16 -m star,l2-star --json"},
                 {"id": "i", "command": "koksma integrate exp -p n-rooks -n 16,64,256 -t {8|16} --json"},
                 {"id": "g", "command": "koksma generate sobol -n 4 -o four.txt"},
                 {"id": "f", "command": "koksma measure four.txt -m star --json"},
                 {"id": "p", "command": "koksma plot sobol@16 -o points.svg", "alt": "16 points"}],
        "tables": [{"run": "m", "columns": ["source", "Value: value", "Again: `koksma measure {source} -m {measure}`"],
                    "where": ["measure=star"]},
                   {"run": "i", "columns": ["integrand", "n", "RMSE: rmse low high"]},
                   {"run": "f", "columns": ["source", "value"]}]}]}


def check_pages(work):
    file, folder = work / "q.json", work / "atlas"
    data = json.loads(json.dumps(QUESTIONS))

    def build(code=0, *more):
        file.write_text(json.dumps(data), encoding="utf-8")
        return run("atlas", "build", str(file), "-o", str(folder), "--json", *more, code=code)
    first = json.loads(build(0, "--quick").stdout)
    expect((first["computed"], first["kept"], first["pages"]) == (5, 0, 2), f"first build: {first}")
    text = (folder / "one.html").read_text(encoding="utf-8")
    star = rows("measure", "sobol@16", "-m", "star")[0]["value"]
    rmse = rows("integrate", "exp", "-p", "n-rooks", "-n", "16", "-t", "8")[0]
    expect(f'value="{star!r}"' in text, "the star discrepancy is not on the page")
    for unit, scale in (("", 1), (" %", 100)):  # rmse is about 0.1 with an interval of about 0.1: two digits of its width are decimals
        decimals = 1 - math.floor(math.log10(scale * (rmse["high"] - rmse["low"])))
        value, low, high = (f"{scale * rmse[k]:.{max(decimals, 0)}f}" for k in ("rmse", "low", "high"))
        expect(f"{value}</data>{unit} <span class=\"pm\">({low} to {high})</span>" in text, f"{value}{unit} ({low} to {high}) is not on the page")
    expect("least <code>sobol@16</code>;" in text, "one name")
    expect("both <code>sobol@16</code> and <code>random@16</code>, not told apart;" in text, "two names")
    expect(text.count("Of <code>koksma</code>.") == 1, "a note is below the first run of its command")
    expect("any-n" in text and (folder / "docs/any-n.html").read_text(encoding="utf-8").count("# ") > 1, "a copy of a document")
    expect("Which is &lt;more&gt; even?" in text and "<more>" not in text, "a title is not escaped")
    expect('<code>koksma measure random@16 -m star</code>' in text, "words with a row's values are not on the page")
    expect("slope" not in text, "the table shows rows of another kind")
    check_links(folder)
    expect(made_again(folder, 10) == 9, "9 numbers in tables")
    before = {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    second = json.loads(build(0, "--quick").stdout)
    expect((second["computed"], second["kept"]) == (0, 5), f"second build: {second}")
    expect(before == {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()}, "a second build changes a file")
    data["questions"].append({"id": "two", "title": "More?", "answer": "{h|value}", "text": "",
                              "runs": [{"id": "h", "command": "koksma measure halton@16 -m star --json"}]})
    third = json.loads(build(0, "--quick").stdout)
    expect((third["computed"], third["kept"], third["pages"]) == (1, 5, 3), f"a new question: {third}")
    full = json.loads(build().stdout)
    expect(full["computed"] == 1, f"without --quick one command differs: {full}")
    for answer, reason in (("{m|value}", "finds 4"), ("{m|source=none|value}", "finds 0"), ("{x|value}", "no run 'x'"), ("{m|source=none|list=source}", "finds none"),
                           ("{m|measure=star|least=value|nothing}", "nothing"), ("{m", "without '}'")):
        data["questions"][0]["answer"] = answer
        error = build(3).stderr
        expect(reason in error and error.count("\n") == 1, f"{answer}: {error}")
    data["questions"][0] = dict(QUESTIONS["questions"][0], runs=[{"id": "m", "command": "koksma measure nothing@16 --json"}])
    expect("nothing" in build(3).stderr, "a command that fails is not named")
    data["questions"][0]["runs"][0]["command"] = "rm -rf x"
    expect("koksma" in build(3).stderr, "another program is run")
    run("atlas", "build", "-o", str(work / "no" / "folder"), code=4)


# ---- Entries


def check_entries(work):
    def submit(name, points, measure="star"):
        (work / f"{name}.txt").write_text("".join(" ".join(map(repr, p)) + "\n" for p in points), encoding="utf-8")
        run("atlas", "submit", str(work / f"{name}.txt"), "-m", measure, "--author", "A. Author", "-o", str(work / name))
        return json.loads((work / name).read_text(encoding="utf-8"))

    def check(*names, code=1):
        return [(r["verdict"], r["reason"]) for r in rows("atlas", "check", *[str(work / n) for n in names], code=code)]

    def change(name, **members):
        entry = json.loads((work / "good").read_text(encoding="utf-8"))
        (work / name).write_text(json.dumps({**entry, **members}), encoding="utf-8")
    # no record is known for these: the centres of 5 strata, shuffled, in two dimensions by l2-centered
    points = [(.1, .5), (.3, .9), (.5, .1), (.7, .7), (.9, .3)]
    entry = submit("good", points, "l2-centered")
    expect(entry["points"] == [list(p) for p in points] and (entry["n"], entry["dim"]) == (5, 2), f"an entry: {entry}")
    expect(entry["value"] == rows("measure", str(work / "good.txt"), "-m", "l2-centered")[0]["value"], "the claim")
    def best_listed(measure, n):
        return min(r["value"] for r in rows("measure", "-p", "all", "-n", str(n), "-m", measure))
    verdict, reason = check("good", code=0)[0]
    least = best_listed("l2-centered", 5)
    expect(verdict == "accepted" and entry["value"] < least and "first entry for l2-centered, n = 5, dim = 2" in reason
           and f"{least:.17g}" in reason, f"a good entry: {verdict} {reason}, {least}")
    # altered: a point, the author, the measure
    change("point", points=[[.1, .5000001], *entry["points"][1:]])
    change("author", author="B. Other")
    change("measure", measure="star")
    expect([v for v, _ in check("point", "author", "measure")] == ["altered"] * 3, "altered entries")
    # a false claim, of which the reason has both numbers
    change("lie", value=entry["value"] * (1 - 1e-9))
    verdict, reason = check("lie")[0]
    expect(verdict == "false" and repr(entry["value"])[:12] in reason, f"a false claim: {verdict} {reason}")
    # copies: the entry itself, reordered and reflected (l2-centered stays), a shift on the torus (l2-periodic stays), points moved by rounding
    submit("mirror", [(1 - x, y) for x, y in points[::-1]], "l2-centered")
    moved = min(submit(name, [(.1, y), *points[1:]], "l2-centered")["value"] for name, y in (("up", .5 + 1e-9), ("down", .5 - 1e-9)))
    got = [v for v, _ in check("good", "good", "mirror", "up", "down")]
    expect(got == ["accepted"] + ["worse"] * 4 and moved < entry["value"] - 1e-12, f"copies of an entry: {got}, {moved}")
    submit("plain", points, "l2-periodic")  # which a listed pattern beats
    verdict, reason = check("plain")[0]
    expect(verdict == "worse" and f"{best_listed('l2-periodic', 5):.17g}" in reason, f"worse than a pattern: {verdict} {reason}")
    run("optimise", "l2-periodic", "-n", "6", "--steps", "1", "-o", str(work / "six.txt"))
    six = [tuple(map(float, line.split())) for line in (work / "six.txt").read_text().splitlines() if line[0] != "#"]
    submit("torus", six, "l2-periodic")
    submit("shift", [((x + .25) % 1, (y + .4) % 1) for x, y in six], "l2-periodic")
    expect([v for v, _ in check("torus", "shift")] == ["accepted", "worse"], "a shift on the torus")
    submit("other", [(.1, .1), (.3, .7), (.5, .3), (.7, .9), (.9, .5)], "l2-centered")
    expect(check("good", "other")[1][0] == "worse", "another set that is no better")
    # against the sets that ship: the record, turned, and worse ones
    record = [tuple(map(float, line.split())) for line in run("generate", "record", "-n", "16").stdout.splitlines()
              if line[0] != "#"]
    submit("record", [(y, x) for x, y in reversed(record)])
    submit("sobol", [tuple(map(float, line.split())) for line in run("generate", "sobol", "-n", "16").stdout.splitlines()
                     if line[0] != "#"])
    (first, why), (second, value) = check("record", "sobol")
    expect(first == "worse" and "record" in why, f"the record again: {first} {why}")
    expect(second == "worse" and "0.0738" in value, f"worse than the record: {second} {value}")
    # a better one than an accepted entry is accepted in its turn: the best of few random permutations by brute force
    best = min((rows("measure", str(work / f"{n}.txt"), "-m", "l2-centered")[0]["value"], n) for n in ("good", "other"))
    worst = "other" if best[1] == "good" else "good"
    expect([v for v, _ in check(worst, best[1], code=0)] == ["accepted"] * 2, "a better entry after another")
    # no entries
    (work / "text").write_text("0.5 0.5\n", encoding="utf-8")
    for name, members in (("n", {"n": 6}), ("range", {"points": [[1.5, 0]] * 5}), ("nan", {"value": None}), ("key", {"extra": 1}),
                          ("sampled", {"measure": "edge-sampled"}), ("empty", {"n": 0, "points": []})):
        change(name, **members)
    names = ("text", "n", "range", "nan", "key", "sampled", "empty", "missing")
    for name in names:
        result = run("atlas", "check", str(work / name), "--json", code=3)
        row = json.loads(result.stdout)
        expect(row["verdict"] == "invalid" and name in row["reason"] and result.stderr.endswith(f"{row['reason']}\n")
               and result.stderr.count("\n") == 1, f"{name}: {result}")
    # all entries have a verdict, also behind files that are none; the exit code is the worst
    got = [v for v, _ in check("text", best[1], "missing", "lie", code=3)]
    expect(got == ["invalid", "accepted", "invalid", "false"], f"entries behind invalid ones: {got}")
    # the hint for pixels is not for a command without --scale
    (work / "pixels.txt").write_text("0.1 0.2\n1.5 0.3\n", encoding="utf-8")
    error = run("atlas", "submit", str(work / "pixels.txt"), "--author", "A", code=3).stderr
    expect("1.5" in error and "--scale" not in error, f"pixels: {error}")
    run("atlas", "submit", "sobol@16", code=2)
    run("atlas", "submit", "sobol@16", "--author", "A", "-m", "edge-sampled", code=2)


def check_ties(folder, data):
    """The answer of a question about pictures names all patterns of each first position, and says where they are several."""
    for q in data["questions"]:
        text = (folder / f"{q['id']}.html").read_text(encoding="utf-8")
        answer = re.search(r'<p class="decided">(.*?)</p>', text, re.S)[1]
        ranked = [{**r, "link": link} for link in re.findall(r"rows/\w+\.json", text)
                  for line in (folder / link).read_text(encoding="utf-8").splitlines()
                  for r in [json.loads(line)] if "position" in r and r["state"] == "ranked"]
        if any("--target-error" in r["command"] for r in q["runs"]):
            continue
        for case in {(r["link"], r["scene"], r["spp"]) for r in ranked}:
            first = [r["pattern"] for r in ranked if (r["link"], r["scene"], r["spp"]) == case and r["position"] == 1]
            names = [f"<code>{n}</code>" for n in dict.fromkeys(first)]
            told = names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}, not told apart"
            expect(told in answer, f"{q['id']}: {case}: {told} is not in the answer")
        for low, high in re.findall(r"\((\S+) to (\S+)\)</span>", text):
            expect(low != high, f"{q['id']}: no digit of ({low} to {high}) shows its width")


def check_mitsuba(work):
    """The stored summary is that of the stored rows: made again, and by other words from the rows."""
    stored = ROOT / "studies/atlas/mitsuba-samplers"
    table = list(csv.DictReader(stored.with_suffix(".csv").open(encoding="utf-8")))
    subprocess.run([ROOT / "tools/mitsuba_samplers.py", "--summary", stored.with_suffix(".csv"), work / "again.json"], check=True)
    lines = [[json.loads(line) for line in path.open(encoding="utf-8")] for path in (stored.with_suffix(".json"), work / "again.json")]
    expect(lines[0] == lines[1], "mitsuba-samplers.json is not the summary of mitsuba-samplers.csv")
    scenes = {r["scene"] for r in table}
    expect(len(table) == len(scenes) * 3 * 12 and len(lines[0]) == 3 * 12 + 3 * len(scenes), f"{len(table)} rows of {len(scenes)} scenes")
    for row in lines[0]:
        mine = [r for r in table if int(r["spp"]) == row["spp"]]
        errors = {(r["scene"], r["sampler"]): float(r["error"]) for r in mine}
        if "scene" in row:
            first = {r["sampler"] for r in mine if r["scene"] == row["scene"] and r["position"] == "1" and float(r["low"]) > 0}
            least = min(e for (scene, _), e in errors.items() if scene == row["scene"])
            expect(set(re.split(", | and ", row["best"].removesuffix(", not told apart"))) == first and
                   (len(first) > 1) == row["best"].endswith(", not told apart"), f"{row}: {first}")
            expect(math.isclose(row["ratio"], least / errors[row["scene"], "independent"], rel_tol=1e-12), f"{row}")
        else:
            sound = scenes - {r["scene"] for r in mine if float(r["low"]) == 0}
            product = math.prod(errors[s, row["sampler"]] / errors[s, "independent"] for s in sound)
            expect(math.isclose(row["mean"], product ** (1 / len(sound)), rel_tol=1e-9) and row["scenes"] == len(sound), f"{row}")


def check_shipped(work):
    """The twenty questions. Datasheets of three patterns stand for all, which take minutes."""
    data = json.loads((ROOT / "studies/atlas/questions.json").read_text(encoding="utf-8"))
    expect(len(data["questions"]) == 20, "twenty questions")
    for q in data["questions"] + data["pages"]:
        for r in q["runs"]:
            expect(not re.search(r"-[pm] all\b", r["command"]), f"{q['id']}: 'all' hides what the result depends on")
    names = [p["pattern"] for p in rows("list", "patterns")]
    data["slow"] = {n: "left out of this test" for n in names if n not in ("sobol", "n-rooks", "fibonacci")}
    file, folder = work / "shipped.json", work / "shipped"
    file.write_text(json.dumps(data), encoding="utf-8")
    summary = rows("atlas", "build", str(file), "-o", str(folder), "--quick")[0]
    expect(summary["pages"] == 24 and len(list(folder.glob("sheets/*.html"))) == 2, f"shipped questions: {summary}")
    check_links(folder)
    check_ties(folder, data)
    check_mitsuba(work)
    expect(made_again(folder, 10) > 200, "numbers of the shipped questions")
    node = os.environ.get("KOKSMA_NODE", str(ROOT / "build/node"))
    if (Path(node) / "node_modules/playwright-core").exists() and Path("/usr/bin/chromium").exists():
        wide = subprocess.run(["node", Path(__file__).with_name("chromium.js"), folder], capture_output=True, text=True,
                              env={**os.environ, "KOKSMA_NODE": node})
        expect(wide.returncode == 0 and not wide.stdout, f"at 400 pixels: {wide.stdout}{wide.stderr}")
    size = sum(p.stat().st_size for p in folder.rglob("*"))
    expect(size < 30e6 - 45 * 280e3, f"{size} bytes without the other datasheets")
    for name in random.sample(sorted(re.findall(r"<code>(koksma measure record:[^<]*)</code>",
                                                (folder / "records.html").read_text(encoding="utf-8"))), 3):
        words = shlex.split(name)[1:]
        measure, n, dim = re.match(r"record:measure=([\w-]+)@(\d+)@(\d)", words[1]).groups()
        known = [r["value"] for r in rows("list", "records") if (r["measure"], r["n"], r["dim"]) == (measure, int(n), int(dim))]
        expect(abs(rows(*words)[0]["value"] - known[0]) < 1e-11, f"{name} is not the record")


seed = int(os.environ.get("KOKSMA_SEED", random.randrange(1 << 32)))
random.seed(seed)
with tempfile.TemporaryDirectory() as name:
    if sys.argv[2:] == ["all"]:
        check_shipped(Path(name))
    else:
        check_pages(Path(name))
        check_entries(Path(name))
if problems:
    print(f"KOKSMA_SEED={seed}")
sys.exit(problems > 0)

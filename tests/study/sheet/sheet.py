#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""sheet.py KOKSMA: datasheets. Each is as docs/datasheet.schema.json says; every command that it prints is run, and gives the
numbers that stand above it; threads change nothing but the time; a family of files is measured at the sizes and seeds that
it has; the verdict follows from the numbers; what cannot serve is left out with a reason. With sanitizers the sheets are made, and
their commands are left to the tests of these."""
import json
import math
import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests/study/report"))
from schema import blocks, complain, errors, finish, words as text_of  # noqa: E402

KOKSMA = str(Path(sys.argv[1]).resolve())
SANITIZED = os.environ.get("KOKSMA_SANITIZED") == "1"
REPORT = json.loads((ROOT / "docs/report.schema.json").read_text())
SHEET = json.loads((ROOT / "docs/datasheet.schema.json").read_text())


def expect(holds, text):
    if not holds:
        complain(text)


def run(*arguments, code=0):
    result = subprocess.run([KOKSMA, *arguments], capture_output=True, text=True)
    expect(result.returncode == code, f"{arguments}: exit {result.returncode}: {result.stderr}")
    return result


def sheet(*arguments):
    text = run("datasheet", *arguments, "--json").stdout
    data = json.loads(text)
    for error in list(errors(data, SHEET, REPORT))[:5]:
        expect(False, f"{arguments}: {error}")
    return text, data


def tables(data):
    return {b["name"]: [dict(zip([c["name"] for c in b["columns"]], row)) for row in b["rows"]]
            for b in blocks(data["content"]) if b["kind"] == "table"}


def rows_of(command):
    """The rows that a printed command gives; rank's exit code 1 says that it is undecided."""
    words = shlex.split(command)
    result = subprocess.run([KOKSMA, *words[1:], "--json", "-q"], capture_output=True, text=True)
    expect(words[0] == "koksma" and result.returncode in (0, 1), f"{command}: {result.stderr}")
    return [json.loads(line) for line in result.stdout.splitlines()]


def same(a, b):
    return (a is None and b is None) or (a is not None and b is not None and math.isclose(a, b, rel_tol=1e-12, abs_tol=1e-300))


def student(degrees):
    """The 97.5 % quantile of Student's t for the numbers of trials and sizes here (Abramowitz and Stegun, table 26.10)."""
    return {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776, 7: 2.365, 15: 2.131}[degrees]


def check_measure(command, rows, data):
    all_tables = tables(data)
    values = {(r["sampler"], r["measure"], r["n"]): r for r in all_tables["values"]}
    deep = {(r["sampler"], r["measure"], r["n"]): r for r in all_tables.get("projections", [])}
    slopes = {(r["sampler"], r["measure"]): r for r in all_tables.get("slopes", [])}  # none of one size
    for row in rows:
        source = row["source"].removeprefix("pattern:")
        sampler = source.rsplit("@", 2 if row["dim"] > 2 else 1)[0]
        if row["measure"].startswith("slope of "):
            mine = slopes[sampler, row["measure"].removeprefix("slope of ")]["slope"]
            expect(same(mine[0], row["value"]), f"{command}: slope {mine} is {row['value']}")
            of_residuals = row["trials"] == 1  # a deterministic sampler has one set: its slope has the error of the residuals
            sizes = sum(1 for r in rows if (r["source"], "slope of " + r["measure"]) == (row["source"], row["measure"]))
            half = student(sizes - 2) * row["residual_error"] if of_residuals else student(row["trials"] - 1) * row["standard_error"]
            expect(of_residuals == (sampler in ("sobol", "regular")), f"{command}: {row}")
            expect(math.isclose(mine[2] - mine[0], half, rel_tol=1e-3, abs_tol=1e-12), f"{command}: half of the interval: {mine}, {half}")
            continue
        mine = (deep if row["dim"] > 2 else values)[sampler, row["measure"], row["n"]]
        expect(same(mine["mean"][0], row["value"]) and mine["sets"] == row["trials"], f"{command}: {mine} is {row}")
        if row["trials"] == 1:
            expect(mine["mean"][1:] == [mine["mean"][0]] * 2 and mine["SD"] is row["standard_error"] is None, f"{command}: {mine} is {row}")
            continue
        half = student(row["trials"] - 1) * row["standard_error"]
        expect(math.isclose(mine["mean"][2] - mine["mean"][0], half, rel_tol=1e-3, abs_tol=1e-12), f"{command}: {mine}, {half}")
    return bool(rows)


def check_integrate(command, rows, data):
    mine = {(r["integrand"], r["sampler"]): r for r in tables(data)["integrals"]}
    charts = {b["title"]: b for b in blocks(data["content"]) if b["kind"] == "chart" and b["title"] in {m[0] for m in mine}}
    for row in rows:
        if "slope_of" in row:
            own, theirs = mine[row["slope_of"], row["source"]]["slope"], (row["slope"], row["low"], row["high"])
            expect(all(same(a, b) for a, b in zip(own, theirs)), f"{command}: {own} is {theirs}")
            continue
        if not charts:  # one size has a table, and one chart of all functions
            own, low = mine[row["integrand"], row["source"]], [row["low"], row["high"]]
            expect(same(own["RMSE"][0], row["rmse"]) and (row["trials"] == 1 or own["RMSE"][1:] == low), f"{command}: {own} is {row}")
            continue
        series = next(s for s in charts[row["integrand"]]["series"] if s["label"] == row["source"])
        point = next(p for p in series["points"] if p[0] == row["n"])
        expect(all(same(a, b) for a, b in zip(point[1:], (row["rmse"], row["low"], row["high"]))), f"{command}: {point} is {row}")
        if row["n"] == max(p[0] for p in series["points"]):
            own = mine[row["integrand"], row["source"]]
            expect(same(own["RMSE"][0], row["rmse"]) and same(own["gain"], row["gain"]) and own["sets"] == row["trials"], f"{command}: {own} is {row}")
    return bool(rows)


def check_rank(command, rows, data):
    mine = {(r["samples a pixel"], r["sampler"]): r for r in tables(data)["scene-" + rows[0]["scene"]]}
    expect(len(mine) == len(rows), f"{command}: {len(rows)} rows, {len(mine)} on the sheet")
    for row in rows:
        own = mine[row["spp"], row["pattern"]]
        # The command prints error and interval in full to JSON.
        expect(all(math.isclose(a, b, rel_tol=1e-3, abs_tol=1e-12) for a, b in zip(own["error"], (row["error"], row["low"], row["high"]))) and
               own["position"] == row["position"] and own["images"] == row["trials"] and
               own["coherent"] == ("yes" if row["coherent"] else "no"), f"{command}: {own} is {row}")
    return True


def check_curve(command, rows, data, name):
    spec = rows[0]["source"].removeprefix("pattern:").rsplit("@", 1)
    sampler, n = spec[0], int(spec[1])
    if name == "quality":
        mine = next(r for r in tables(data)["spectra"] if r["sampler"] == sampler)
        pairs = [(mine["effective Nyquist"], rows[0]["effective_nyquist"]), (mine["over sqrt(n)/2"], rows[0]["relative_nyquist"]),
                 (mine["oscillation"], rows[0]["oscillation"])]
    else:
        title = {"rings": "Radial mean of the power", "pairs": "Pair correlation"}[name]
        chart = next(b for b in blocks(data["content"]) if b["kind"] == "chart" and b["title"] == title)
        points = next(s["points"] for s in chart["series"] if s["label"] == sampler)
        x = [row["frequency"] / math.sqrt(n) if name == "rings" else row["distance"] * math.sqrt(n) for row in rows]
        expect(len(points) == len(rows), f"{command}: {len(rows)} rows, {len(points)} in the chart")
        pairs = [(p[0], a) for p, a in zip(points, x)] + [(p[1], row["value"]) for p, row in zip(points, rows)]
    expect(all(same(a, b) for a, b in pairs), f"{command}: {[p for p in pairs if not same(*p)][:2]}")
    return True


def check_verify(command, rows, data):
    if " --seeds " in command:
        said = text_of(next(b for b in data["content"] if b.get("id") == "verdict")["content"][0]["text"])
        found = next(r for r in rows if r["property"] == "unbiased")
        expect(said.startswith("Unbiased" if found["holds"] else "Biased") and (found["holds"] or found["detail"] in said), f"{command}: {said}")
        return True
    spec = rows[0]["source"].removeprefix("pattern:")
    deep = rows[0]["dim"] > 2
    sampler = spec.rsplit("@", 2 if deep else 1)[0]
    if sampler == data["samplers"][0]:
        mine = [(r["property"], r["subject"], r["holds"], r["value"], r["detail"])
                for r in tables(data)["projection-findings" if deep else "findings"]]
        theirs = [(r["property"], r["subject"], "yes" if r["holds"] else "no", r["value"], r["detail"]) for r in rows]
        expect(len(mine) == len(theirs) and all(a[:3] + a[4:] == b[:3] + b[4:] and same(a[3], b[3]) for a, b in zip(mine, theirs)), f"{command}: findings differ")
    if not deep:
        for r in tables(data)["properties"]:
            held = [row["holds"] for row in rows if row["property"] == r["property"]]
            word = "–" if not held else "yes" if all(held) else "no" if not any(held) else f"{sum(held)} of {len(held)}"
            expect(r[sampler] == word, f"{command}: {r['property']}: {r[sampler]}, not {word}")
    return True


def check_commands(data):
    """Runs every command of the sheet; returns how many of each kind."""
    done = {}
    if SANITIZED:
        return done
    for block in blocks(data["content"]):
        for command in block.get("lines", []):
            words = shlex.split(command)
            if words[1] == "plot":
                subprocess.run([KOKSMA, *words[1:]], check=True)
                expect(Path(words[-1]).stat().st_size > 500, command)
                checked = True
            else:
                rows = rows_of(command)
                expect(rows, f"{command}: no rows")
                checked = rows and {"measure": check_measure, "rank": check_rank, "verify": check_verify, "integrate": check_integrate}[words[1]](command, rows, data) \
                    if words[1] != "curve" else check_curve(command, rows, data, words[2])
            done[words[1]] = done.get(words[1], 0) + bool(checked)
    return done


def check_verdict(data):
    """Whom the verdict calls best has the least mean of all; whom it calls beaten has not."""
    n = max(r["n"] for r in tables(data)["values"])
    larger = {"min-distance", "relative-radius"}
    section = next(b for b in data["content"] if b.get("id") == "verdict")
    items = [text_of(i) for b in section["content"] if b["kind"] == "list" for i in b["items"]]
    counted = 0
    for item in items:
        head, _, names = item.partition(": ")
        if head != "Best" and not head.startswith("Beaten by "):
            continue
        for name in (part.split(" ")[0] for part in names.split(", ")):
            means = {r["sampler"]: r["mean"][0] * (-1 if name in larger else 1) for r in tables(data)["values"] if r["measure"] == name and r["n"] == n}
            best = min(means, key=means.get)
            expect(best == (data["samplers"][0] if head == "Best" else head.removeprefix("Beaten by ")), f"{item}: {name}: {means}")
            counted += 1
    said = " ".join(text_of(b["text"]) for b in section["content"] if b["kind"] == "paragraph")
    expect(f"{sum(len(i.partition(': ')[2].split(', ')) for i in items if i.startswith('Best: '))} of " in said, f"{said} {items}")
    return counted


def check_patterns():
    text, data = sheet("sobol:scramble=owen", "--beside", "random" if SANITIZED else "random,jittered", "--scenes", "ball", "--quick", "--threads", "2")
    if SANITIZED:
        return
    seen = run("datasheet", "sobol:scramble=owen", "--beside", "none", "--scenes", "ball", "--quick", "--progress", "always", "-o", "s.html").stderr
    percents = [int(p) for p in re.findall(r"(\d+) %", seen)]
    expect(percents and percents == sorted(percents) and percents[-1] <= 100, f"progress goes back: {percents}")
    again, _ = sheet("sobol:scramble=owen", "--beside", "random,jittered", "--scenes", "ball", "--quick", "--threads", "1")
    expect(text.rsplit("\n", 1)[0] == again.rsplit("\n", 1)[0] or text.split('"seconds"')[0] == again.split('"seconds"')[0], "threads change the sheet")
    expect([b["id"] for b in data["content"]] == ["verdict", "points", "scenes", "measures", "integrals", "spectra", "properties", "projections", "origin"], "sections")
    expect("Decisions of each scene" in verdict_of(data)[1], "certainty of scenes")
    said = "".join(text_of(b["text"]) for b in blocks(data["content"]) if b["kind"] == "paragraph")
    expect("Behind: the relative difference of the error to that of the first row" in said, "what behind is relative to")
    rows = tables(data)["scene-ball"]
    expect(rows[0]["behind the first"][0] == 0 and all(r["behind the first"][0] > 0 for r in rows[1:]), f"behind: {rows}")
    done = check_commands(data)
    expect(done == {"plot": 3, "rank": 1, "measure": 6, "integrate": 3, "curve": 9, "verify": 5}, f"commands: {done}")
    expect(check_verdict(data) >= 12, "the verdict says little of sobol")


def check_family():
    Path("sets").mkdir()
    for n in (16, 36, 100):
        for seed in range(3, 8):
            run("generate", "jittered", "-n", str(n), "-s", str(seed), "-q", "-o", f"sets/my_{n}_{seed}.npy")
    run("generate", "jittered", "-n", "64", "-s", "3", "-q", "-o", "sets/my_64_3.npy")  # one set of five: too few
    text, data = sheet("sets/my_{n}_{seed}.npy", "--beside", "jittered,pmj02", "--scenes", "none" if SANITIZED else "checker", "--quick")
    expect(data["samplers"][0] == "file:sets/my_{n}_{seed}.npy", data["samplers"])
    values = [r for r in tables(data)["values"] if r["sampler"] == data["samplers"][0]]
    expect({r["n"] for r in values} == {16, 36, 100} and all(r["sets"] == 5 for r in values), "sizes and seeds of the files")
    reference = rows_of("koksma measure pattern:jittered@100 --sizes 16,36,100 -m star,l2-disk --trials 5 --seed 3")
    for row in reference:
        for r in values:
            if (r["measure"], r["n"]) == (row["measure"], row["n"]):
                expect(same(r["mean"][0], row["value"]), f"{r} is {row}")
    expect(SANITIZED or {r["samples a pixel"] for r in tables(data)["scene-checker"]} == {16}, "samples a pixel")
    left = [text_of(i) for b in blocks(data["content"]) if b.get("id") == "left-out" for i in b["items"]]
    expect(any(i.startswith("t-value: n = ") for i in left), f"100 points are no net: {left}")
    expect("t-value" not in {r["measure"] for r in values}, "t-value of 100 points")
    check_commands(data)
    check_verdict(data)


def check_biased():
    """Points whose first coordinate is never in [1/4, 3/4): the first that the sheet says; no praise, and no gains."""
    Path("biased").mkdir()
    for seed in range(64):
        run("generate", "sobol:scramble=owen", "-n", "16", "-s", str(seed), "-q", "-o", "b.txt")
        with open("b.txt") as points, open(f"biased/my_16_{seed}.txt", "w") as out:
            for line in points:
                if not line.startswith("#"):
                    x, y = map(float, line.split())
                    print(repr(x / 2 if x < .5 else x / 2 + .5), repr(y), file=out)
    _, data = sheet("biased/my_{n}_{seed}.txt", "--beside", "random", "--scenes", "none", "--quick")
    section = next(b for b in data["content"] if b.get("id") == "verdict")
    said = [text_of(b["text"]) for b in section["content"] if b["kind"] == "paragraph"]
    expect(said[0].startswith("Biased: over 64 sets of 16 points") and "z = " in said[0], said[0])
    expect(not any("better than every other" in s for s in said), said)
    expect(not {"Best", "Equal to the best"} & set(verdict_of(data)[0]), verdict_of(data))
    gains = {r["integrand"]: r["gain"] for r in tables(data)["integrals"] if r["sampler"] == data["samplers"][0]}
    expect(set(gains.values()) == {None}, gains)


def check_single_file():
    run("generate", "halton", "-n", "100", "-d", "3", "-q", "-o", "mine.txt")
    _, data = sheet("mine.txt", "--beside", "random", "--scenes", "none", "--quick")
    values = [r for r in tables(data)["values"] if r["sampler"] == "file:mine.txt"]
    expect({r["n"] for r in values} == {100}, "the size of the file")
    expect(next(b for b in data["content"] if b.get("id") == "projections")["content"][0]["text"][1] != "", "projections of 3 dimensions")
    expect(not any(name.startswith("scene-") for name in tables(data)), "no scenes were asked for")
    check_commands(data)


def verdict_of(data):
    """The numbers of measures of each outcome, and the paragraph on how sure they are."""
    section = next(b for b in data["content"] if b.get("id") == "verdict")
    items = [text_of(i).partition(": ") for b in section["content"] if b["kind"] == "list" for i in b["items"]]
    count = {}
    for head, _, names in items:
        head = "Beaten" if head.startswith("Beaten by ") else head
        count[head] = count.get(head, 0) + len(names.split(", "))
    return count, text_of(section["content"][-1]["text"])


def check_names():
    """Names of files that a shell or a list would read otherwise: every command that is printed serves, and where no command
    can have the name, the page says so."""
    where = Path("it's here; {a} & " + "long" * 40)
    where.mkdir()
    Path("a scene.json").write_bytes((ROOT / "scenes/ball.json").read_bytes())
    for name in ("a,b.txt",) if SANITIZED else ("a.txt", "a,b.txt"):
        run("generate", "jittered", "-n", "4" if SANITIZED else "64", "-q", "-o", str(where / name))
        _, data = sheet(str(where / name), "--beside", "random", "--scenes", "./a scene.json", "--quick")
        done = check_commands(data)
        expect(SANITIZED or done == {"plot": 1, "measure": 2, "integrate": 2, "curve": 6, "verify": 2} | ({"rank": 1} if name == "a.txt" else {}), done)
        said = [text_of(b["text"]) for b in blocks(data["content"]) if b["kind"] == "paragraph"]
        expect(any("No command is given" in s for s in said) == ("," in name), said)


def check_one_set():
    """The values of a deterministic sampler are exact, and it has one set of each size in every table; its slopes have the
    errors of their residuals. Two such samplers are compared exactly; beside a random one, only that one's sets vary."""
    _, data = sheet("regular", "--beside", "none", "--scenes", "none", "--quick")
    for name in ("values", "spectra", "integrals"):
        expect(all(row["sets"] == 1 for row in tables(data)[name]), f"sets of regular in {name}: {tables(data)[name][0]}")
    for row in tables(data)["values"]:
        expect(row["mean"][1:] == [row["mean"][0]] * 2 and row["SD"] is None, f"the one set of regular: {row}")
    for row in tables(data)["measures"]:
        expect(row["mean"][1:] == [row["mean"][0]] * 2, f"the one set of regular: {row}")
    slopes = [r["slope"] for r in tables(data)["slopes"] if None not in r["slope"]]
    expect(sum(s[1] < s[0] < s[2] for s in slopes) > 10, f"slopes of regular: {slopes}")  # some means are exactly n^-1/2
    check_commands(data)
    if SANITIZED:
        return
    _, exact = sheet("regular", "--beside", "sobol", "--scenes", "none", "--quick")
    count, sure = verdict_of(exact)
    expect("Not decided" not in count and count["Best"] and count["Beaten"], f"two deterministic samplers: {count}")
    expect("1 set of the sampler" in sure and "exact" in sure and "scene" not in sure, sure)
    check_verdict(exact)
    run("generate", "sobol", "-n", "64", "-q", "-o", "sobol.txt")
    _, same_points = sheet("sobol.txt", "--beside", "sobol", "--scenes", "none", "--quick")
    expect(set(verdict_of(same_points)[0]) == {"Equal to the best"}, f"the same points twice: {verdict_of(same_points)}")
    os.rename("sobol.txt", "one_64_0.txt")
    _, one_of_many = sheet("one_{n}_{seed}.txt", "--beside", "sobol", "--scenes", "none", "--quick")
    expect(set(verdict_of(one_of_many)[0]) == {"Not decided"}, f"one set of a random sampler: {verdict_of(one_of_many)}")
    _, beside = sheet("regular", "--beside", "jittered", "--scenes", "none", "--quick")
    of = {(r["sampler"], r["measure"]): r for r in tables(beside)["values"] if r["n"] == 256}
    tests = len(of) // 2
    for (sampler, measure), row in of.items():
        if sampler == "jittered" and row["SD"]:
            # Student's quantile at 1 - 0.025 / tests with 7 degrees of freedom lies between 5 and 6.5 for 15 to 20 tests.
            distance = abs(row["mean"][0] - of["regular", measure]["mean"][0]) / (row["SD"] / math.sqrt(8))
            said = next(text_of(i) for b in blocks(beside["content"]) if b["kind"] == "list" for i in b["items"] if measure in
                        [w.split(" ")[0] for w in text_of(i).partition(": ")[2].split(", ")])
            expect(15 <= tests <= 20 and (distance < 6.5 or not said.startswith("Not decided")) and
                   (distance > 4.5 or said.startswith("Not decided")), f"{measure}: {distance} standard errors: {said}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        check_patterns()
        check_family()
        check_biased()
        check_single_file()
        check_one_set()
        check_names()


main()
finish()

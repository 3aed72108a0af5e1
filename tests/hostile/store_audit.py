#!/usr/bin/env python3
"""store_audit.py KOKSMA: what `koksma study audit` says of folders that a stranger made. All reference images are
rendered again, whichever rows are drawn, and those that cannot be are counted. No text of a plan or store reaches the
terminal with control characters, and --json is JSON."""
import json
import os
import re
import shutil
import sqlite3
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE + "/../study")
from reseal import reseal  # noqa: E402
from stores import KOKSMA, check, end, koksma, own_folder  # noqa: E402

PLAN = """{"name": "h", "title": "h",
  "discrepancies": [{"patterns": ["random"], "measures": ["star", "l2-star", "extreme", "l2-extreme"], "n": [4], "trials": 1000}],
  "images": [{"scenes": ["checker", "./mine.json"], "patterns": ["random"], "spp": [1], "size": [8, 6], "trials": 2,
              "references": [{"name": "r", "pattern": "jittered", "spp": 4, "replicates": 2}]}]}"""


def audit(folder, *more, **how):
    return koksma("study", "audit", folder, *more, **how)


def copy(name, of="sound"):
    shutil.rmtree(name, ignore_errors=True)
    shutil.copytree(of, name)
    return name


def change(folder, *statements, sealed=True):
    database = sqlite3.connect(folder + "/results.sqlite")
    for statement in statements:
        database.execute(statement)
    database.commit()
    database.close()
    if sealed:
        reseal(folder)


def says(told, code, *lines):
    """Whether the audit ended with the exit code, and printed a line that matches each pattern."""
    check(told.returncode == code and not told.stderr, f"exit code {code}: {told}")
    for line in lines:
        check(re.search("^" + line + "$", told.stdout, re.MULTILINE), f"'{line}' is a line of {told.stdout}")


# ---- References -----------------------------------------------------------------------------------------------


def references():
    """No drawn row needs a reference (the first draw is of one row), and all are compared."""
    of_row = "--rows", "1", "-s", "1"
    says(audit("sound", *of_row), 0, "2 reference images rendered again, of which 2 agree")
    first, second = (f"r/references/{name}" for name in sorted(os.listdir("sound/references")))
    copy("r")
    os.rename(first, "kept")
    os.rename(second, first)
    os.rename("kept", second)
    for more in of_row, ("--rows", "all"), (*of_row, "--threads", "1"):
        told = audit("r", *more)
        says(told, 1, "2 reference images rendered again, of which 0 agree")
        check(told.stdout.count("differ from those rendered now") == 2, f"swapped: {told}")
    copy("r")
    open(first, "wb").close()
    says(audit("r", *of_row), 1, "2 reference images rendered again, of which 1 agree", f"differs: reference .*{first}: empty")
    # References without any image are still references.
    copy("r")
    change("r", "DELETE FROM result WHERE id & 4294967295 IN (SELECT id FROM series WHERE kind <> 'discrepancy')",
           "DELETE FROM series WHERE kind <> 'discrepancy'")
    says(audit("r"), 0, "2 reference images rendered again, of which 2 agree")
    open(first, "wb").close()
    says(audit("r"), 1, "2 reference images rendered again, of which 1 agree")
    # Those of a scene that is not there, and of other revisions, are counted, and the rest are compared.
    copy("r")
    os.rename("mine.json", "elsewhere.json")
    told = audit("r", *of_row)
    says(told, 1, r"differs: reference r:jittered@4x2 of \./mine\.json, 8 x 6 can't be rendered again: .*mine\.json.*No such file.*",
         r"differs: image \./mine\.json, .*: its 2 rows can't be computed again: .*No such file.*",
         "1 reference images rendered again, of which 1 agree; 1 can't be rendered again")
    os.rename("elsewhere.json", "mine.json")
    change("r", "UPDATE reference SET made_by = 'renderer 0, jittered 77' WHERE scene = 'checker'",
           "UPDATE series SET measured_by = replace(measured_by, 'jittered 0', 'jittered 77') WHERE scene = 'checker'")
    says(audit("r", *of_row), 0, "1 reference images rendered again, of which 1 agree",
         r"not compared: 12 rows and 1 reference images made by other revisions, such as .*77.*")


def reasons():
    """A row that can't be computed again has the reason: a file that is not there has not changed."""
    with open("files.json", "w") as file:
        json.dump({"name": "f", "title": "f", "discrepancies": [{"patterns": ["file:points.txt"], "measures": ["star"], "n": [16], "trials": 1}],
                   "images": [{"scenes": ["./mine.json"], "patterns": ["random"], "spp": [16], "size": [8, 6], "trials": 1,
                               "references": [{"name": "r", "pattern": "file:points.txt", "spp": 16}]}]}, file)
    check(koksma("study", "run", "./files.json", "-o", "files", "-q").returncode == 0, "a study of files")
    of_row = r"differs: discrepancy file:points\.txt, .* can't be computed again: a file that its pattern names"
    of_reference = r"differs: reference r:file:points\.txt@16x1 of \./mine\.json, 8 x 6 can't be rendered again: "
    says(audit("files"), 0, "1 reference images rendered again, of which 1 agree")
    os.rename("points.txt", "kept.txt")
    says(audit("files"), 1, of_row + r": points\.txt: can't be read: No such file or directory",
         of_reference + r"a file that its pattern names: points\.txt: can't be read: No such file or directory")
    os.mkfifo("points.txt")
    says(audit("files"), 1, of_row + r": points\.txt: can't be read: it is a pipe .*")
    os.remove("points.txt")
    os.mkdir("points.txt")
    says(audit("files"), 1, of_row + r": points\.txt: .*directory.*")
    os.rmdir("points.txt")
    shutil.copy("mine.json", "points.txt")
    says(audit("files"), 1, of_row + " has changed since", of_reference + "a file that its pattern names has changed since")
    os.rename("kept.txt", "points.txt")
    with open("mine.json", "a") as file:
        file.write("\n")
    says(audit("files"), 1, r"differs: image \./mine\.json, .* can't be computed again: its scene has changed since",
         of_reference + "its scene has changed since")
    shutil.copy(HERE + "/../../scenes/checker.json", "mine.json")


def values():
    """Standard errors that are missing or infinite, and times of runs that are."""
    of_checker = r"reference r:jittered@4x2 of checker"
    copy("v")
    change("v", "UPDATE reference SET standard_error = NULL WHERE scene = 'checker'")
    says(audit("v"), 1, f"differs: {of_checker}: its stored standard error is none, but computing it again gives 0\\.[0-9]+",
         "2 reference images rendered again, of which 1 agree")
    copy("v")
    change("v", "DELETE FROM reference WHERE scene = 'checker'")
    says(audit("v"), 1, f"differs: {of_checker}: its stored standard error is none, but .*")
    copy("v")
    change("v", "UPDATE reference SET standard_error = 9e999 WHERE scene = 'checker'")
    for verb in ("audit",), ("export", "-o", "v.csv"), ("report",):
        told = koksma("study", verb[0], "v", *verb[1:])
        check(told.returncode == 3 and re.search(f"the standard error of {of_checker}, 8 x 6, is infinite or no number", told.stderr), f"{verb}: {told}")
    for column in "seconds", "idle_seconds", "processor_seconds", "store_seconds":
        copy("v")
        change("v", f"UPDATE run SET {column} = 9e999")
        told = koksma("study", "report", "v")
        check(told.returncode == 3 and re.search(r"the run of 20\d\d-.* has a time that is infinite or no number", told.stderr), f"{column}: {told}")
        check("inf" not in open("v/report.json").read(), f"{column} in the report")
    for rows in "0", "-1", "1e9", "ALL", "", "9223372036854775808", "all ":
        told = audit("sound", "--rows", rows)
        check(told.returncode == 2 and re.match(f"koksma study: --rows {rows}: .*it takes 'all', or a whole number from 1 to 9223372036854775807$",
                                                told.stderr), f"--rows {rows}: {told}")
    # While a reader holds SQLite's shared lock, as an audit does, a run says who may be using the store.
    copy("v")
    reader = sqlite3.connect("v/results.sqlite", isolation_level=None)
    reader.execute("BEGIN")
    reader.execute("SELECT * FROM meta").fetchall()
    told = koksma("study", "run", "./plan.json", "-o", "v", "-q")
    reader.close()
    check(told.returncode == 4 and "v/results.sqlite: another run, or an export, report or audit, is using it" in told.stderr, f"run beside a reader: {told}")


def trials():
    """A trial number that no plan has is damage; a row that was moved to another trial has the seed of its own."""
    of_first = "UPDATE result SET id = (id & 4294967295) + 4294967296 * {} WHERE id = (SELECT min(id) FROM result)"
    for trial in 2147483647, 100000000:
        copy("n")
        change("n", of_first.format(trial))
        for verb in ("audit",), ("export", "-o", "n.csv"), ("report",):
            told = koksma("study", verb[0], "n", *verb[1:])
            check(told.returncode == 3 and "out of range" in told.stderr and told.stderr.count("\n") == 1, f"trial {trial}: {verb}: {told}")
    copy("n")
    change("n", of_first.format(1000))
    says(audit("n", "--rows", "all"), 1, "differs: discrepancy random, n = 4, dim 2, star, trial 1000: the stored seed .*",
         "4024 rows drawn, of which 4020 agree: these are all", "2 reference images rendered again, of which 2 agree")
    says(audit("n", "--rows", "4023"), 1)


# ---- Keys -----------------------------------------------------------------------------------------------------

WIDE = """{"name": "w", "title": "w", "metric": "relmse", "metrics": ["smape"],
  "discrepancies": [
    {"patterns": ["random", "poisson-disk:d=0.2", "sobol"], "measures": ["star", "l2-star", "extreme", "l2-extreme"],
     "integrands": ["wave"], "n": [4, 8], "trials": 2},
    {"patterns": ["random"], "warps": ["polar-disk", "concentric-disk"], "measures": ["edge", "l2-edge"], "n": [4], "trials": 2},
    {"patterns": ["file:p_{n}_{seed}.txt", "file:./p_16_1.txt"], "measures": ["star"], "n": [16], "trials": 9}],
  "images": [
    {"scenes": ["ball", "./mine.json"], "patterns": ["random", "n-rooks", "jittered;lens=file:p_16_1.txt"], "spp": [16], "size": [16, 12], "trials": 3,
     "options": {"pairing": ["shuffled", "aligned"], "filter": ["box", "gaussian"], "splat": ["no", "yes"]},
     "references": [{"name": "c", "pattern": "jittered", "spp": 64, "replicates": 2}, {"name": "d", "pattern": "n-rooks", "spp": 4}]},
    {"scenes": ["ball"], "patterns": ["random"], "spp": [16], "size": [8, 6], "trials": 2,
     "options": {"pairing": ["native"], "integrator": ["distribution", "whitted"], "lights": ["one"], "scope": ["image"]},
     "references": [{"name": "c", "pattern": "jittered", "spp": 4, "replicates": 2}]},
    {"scenes": ["ball"], "patterns": ["random"], "spp": [16], "size": [8, 6], "trials": 2,
     "options": {"adaptive": ["none", "contrast", "confidence:test=chi2", "hierarchical:levels=3,threshold=0"]},
     "references": [{"name": "c", "pattern": "jittered", "spp": 4, "replicates": 2}]}],
  "figures": [{"id": "1", "title": "f", "pattern": "random", "n": 4}]}"""


def keys():
    """A key is the one that a run writes: every text canonical, every column without a use empty."""
    for i in range(1, 5):
        with open(f"p_16_{i}.txt", "w") as file:
            file.writelines(f"{k / 16} {((2 * i + 1) * k + i) % 16 / 16}\n" for k in range(16))
    with open("wide.json", "w") as file:
        file.write(WIDE)
    told = koksma("study", "run", "./wide.json", "-o", "wide", "-q")
    check(told.returncode == 0, f"a study of everything: {told}")
    told = audit("wide", "--rows", "all")
    says(told, 0, r"\d+ rows drawn, of which \d+ agree: these are all", r"\d+ reference images rendered again, of which \d+ agree")
    for columns, where in (("scene = 'checker'", "kind = 'discrepancy'"), ("width = 7", "kind = 'discrepancy'"), ("height = 7", "kind = 'discrepancy'"),
                           ("dim = 5", "kind = 'image'"), ("dim = 5", "kind = 'coherence'"), ("dim = 5", "kind = 'metric'"),
                           ("id = id + 2", "kind = 'image'"), ("options = 'zzz=1'", "kind = 'image' AND options = ''"),
                           ("options = ','", "kind = 'image' AND options = ''"), ("options = 'lights=all'", "kind = 'metric' AND options = ''"),
                           ("options = 'filter=box'", "kind = 'coherence' AND options = ''"), ("options = options||';'", "options = 'pairing=aligned'"),
                           ("options = 'pairing=shuffled'", "kind = 'image' AND options = ''"),
                           ("options = 'filter=gaussian;splat=yes'", "options = 'splat=yes;filter=gaussian'"),
                           ("options = 'polar-disk'", "what LIKE 'error of %'"),
                           ("what = 'star:'", "what = 'star'"), ("what = 'error of wave:'", "what LIKE 'error of %'"),
                           ("what = 'c:jittered@064x2'", "what = 'c:jittered@64x2'"), ("what = 'c:jittered@+64x2'", "what = 'c:jittered@64x2'"),
                           ("what = 'c:jittered:@64x2'", "what = 'c:jittered@64x2'"), ("metric = 'relmse:'", "metric = 'relmse'"),
                           ("pattern = 'n-rooks:'", "kind = 'metric' AND pattern = 'n-rooks'"), ("pattern = 'poisson-disk:d=0.20'", "pattern LIKE 'poisson%'")):
        copy("k", "wide")
        change("k", f"UPDATE series SET {columns} WHERE {where} AND made_by NOT LIKE '%zzz%'")
        told = audit("k", "--rows", "all")
        says(told, 1, "differs: .* can't be computed again: no run writes such a key: .*")
    copy("k", "wide")
    change("k", "UPDATE reference SET options = 'pairing=aligned' WHERE options = '' AND scene = 'ball' AND width = 16")
    says(audit("k"), 1, "differs: reference .*")
    copy("k", "wide")
    change("k", "UPDATE reference SET reference = 'c:jittered@064x2' WHERE reference = 'c:jittered@64x2' AND scene = 'ball' AND options = ''")
    says(audit("k"), 1, "differs: reference c:jittered@064x2 of ball, .* no run writes such a key: reference = 'c:jittered@064x2', where .*")


def revisions():
    """Other revisions have the names that the row's texts give, and whole numbers; anything else is a difference."""
    of = "kind = 'discrepancy' AND pattern = 'random'"
    for column, table, texts_of in (
            ("made_by", f"series WHERE {of}", ("", "random", "random -1", "random +1", "random 01", "random 1.0", "random  1", "random 1 ", "random 0, ",
                                               "random 0, random 0", "jittered 0", "zzz 1", "random 99999999999", "random 2147483648", "random 1,", ", random 1")),
            ("measured_by", f"series WHERE {of}", ("", "star", "star -1", "random 1", "star 1, l2-star 0")),
            ("made_by", "series WHERE kind = 'image' AND scene = 'checker'", ("random 0", "random 0, renderer 1", "renderer 0", "renderer 0,random 0", "renderer 0; random 0",
                                                                               "renderer 0, jittered 0", "renderer 0, random 0, jittered 0")),
            ("measured_by", "series WHERE kind = 'metric' AND metric = 'relmse'", ("renderer 0, jittered 0", "renderer 0, relmse 0, jittered 0", "relmse 0, renderer 0, random 0")),
            ("made_by", "reference WHERE scene = 'checker'", ("", "renderer 1", "renderer 0, random 0", "jittered 0", "renderer 0, jittered -1"))):
        for text in texts_of:
            copy("v")
            name, where = table.split(" ", 1)
            change("v", f"UPDATE {name} SET {column} = '{text}' {where}")
            says(audit("v", "--rows", "1"), 1, r"differs: .* again: no version makes it by '.*', which would be '.*' here")
    newest = "not compared: 1000 rows made by other revisions, such as "
    for text, told in ("random 2147483647", "of a newer version "), ("random 1", "of a newer version "):
        copy("v")
        change("v", f"UPDATE series SET made_by = '{text}' WHERE {of} AND what = 'star'")
        says(audit("v", "--rows", "1"), 0, newest + re.escape(f"{text}; star 0 {told}(here: random 0; star 0)"))
    # An older revision, and a newer one beside it: the newer one is named.
    copy("v")
    change("v", "UPDATE series SET made_by = 'renderer 0, random 0' WHERE kind = 'image' AND scene = 'checker'")
    says(audit("v"), 0, re.escape("not compared: 2 rows made by other revisions, such as renderer 0, random 0; renderer 3, jittered 0 "
                                  "(here: renderer 3, random 0; renderer 3, jittered 0)"))
    change("v", "UPDATE series SET made_by = 'renderer 7, random 0' WHERE kind = 'metric' AND scene <> 'checker' AND metric = 'smape'")
    says(audit("v"), 0, "not compared: 4 rows made by other revisions, such as renderer 7, random 0; .* of a newer version .*")


def gaps():
    """Rows that are not there are counted, as a killed run leaves gaps, too. A row without its value is a difference."""
    gap = r"not there: {} rows of earlier trials: a run was cut short, jobs failed, or somebody removed them; the next run makes them"
    trials_of = "id & 4294967295 = (SELECT min(id) & ~3 FROM series WHERE {})"
    points, image = trials_of.format("kind = 'discrepancy'"), trials_of.format("kind = 'image' AND scene = 'checker'")
    check("not there" not in audit("sound").stdout and json.loads(audit("sound", "--json").stdout)["rows_missing"] == 0, "no row is missing")
    copy("g")
    change("g", f"DELETE FROM result WHERE {points} AND id >> 32 IN (0, 7, 998)", f"DELETE FROM result WHERE {image} AND id >> 32 = 0")
    says(audit("g", "--rows", "all"), 0, gap.format(13), "4011 rows drawn, of which 4011 agree: these are all")
    check(json.loads(audit("g", "--json").stdout)["rows_missing"] == 13, "missing rows in JSON")
    check(koksma("study", "run", "./plan.json", "-o", "g", "-q").returncode == 0 and "not there" not in audit("g").stdout, "the next run makes them")
    copy("g")
    change("g", f"DELETE FROM result WHERE {points} AND id >> 32 = 999")  # the end of a series leaves no gap
    check("not there" not in audit("g").stdout, "the last row")
    # A value of one of the row's measures may be missing: the study had fewer measures when the row was made.
    copy("g")
    change("g", f"UPDATE result SET v0 = NULL, v2 = NULL WHERE {points} AND id >> 32 = 3")
    says(audit("g", "--rows", "all"), 0, gap.format(2), "4022 rows drawn, of which 4022 agree: these are all")
    copy("g")
    change("g", f"UPDATE result SET v0 = NULL, v1 = NULL, v2 = NULL, v3 = NULL WHERE {points} AND id >> 32 = 3")
    says(audit("g", "--rows", "all"), 1, "differs: discrepancy random, n = 4, dim 2, star, trial 3: the stored value is none, but computing it again gives 0\\.[0-9]+",
         gap.format(3))
    for values in "v0 = NULL", "v1 = NULL", "v3 = NULL", "v0 = NULL, v1 = NULL, v2 = NULL, v3 = NULL":
        for kind in "image", "coherence", "metric":
            if kind == "metric" and values == "v3 = NULL":
                continue  # runs write none
            copy("g")
            change("g", f"UPDATE result SET {values} WHERE {trials_of.format(f'kind = {kind!r}')} AND id >> 32 = 1")
            says(audit("g", "--rows", "all"), 1, f"differs: {kind} .*, trial 1: the stored value is none, but computing it again gives .*",
                 "4024 rows drawn, of which 4023 agree: these are all")
    copy("g")
    change("g", f"UPDATE result SET v3 = 1 WHERE {trials_of.format(chr(39).join(('kind = ', 'metric', '')))} AND id >> 32 = 1")
    says(audit("g", "--rows", "all"), 1, "differs: metric .*, trial 1: the stored value is 1, but computing it again gives none")
    # Values of no series, which no export shows.
    for row in "404, 1, 0.5, NULL, NULL, NULL", "1 << 33 | 400000, 1, NULL, NULL, NULL, NULL":
        copy("g")
        change("g", f"INSERT INTO result VALUES ({row})")
        says(audit("g", "--rows", "all"), 1, "differs: g/results.sqlite: 1 values are of no series")


# ---- Texts ----------------------------------------------------------------------------------------------------


def texts():
    """Control characters of plans and stores are escaped once, wherever they are printed."""
    name = "pts\x1b[31m\nred\x9b1m.txt"
    shutil.copy("points.txt", name)
    with open("red.json", "w") as file:
        json.dump({"name": "red", "title": "r", "discrepancies": [{"patterns": ["file:" + name, "random"], "measures": ["star"],
                                                                   "n": [16, 32], "trials": 2, "skip": True}]}, file)
    escaped = r"file:pts\x1b[31m\x0ared\xc2\x9b1m.txt"
    for more in ("study", "run", "./red.json", "-o", "red"), ("study", "export", "red", "-o", "red.csv"):
        told = koksma(*more)
        (line,) = [line for line in told.stderr.split("\n") if "left out" in line]
        check(line.startswith(f"left out: {escaped}, N = 32: ") and plain(told.stderr), f"{more}: {told}")
    evil = "char(27)||'[31m'||char(10)||'x'"
    for column, kind, change_of in (("scene", "a difference", f"UPDATE series SET scene = {evil} WHERE scene = 'checker'"),
                                    ("made_by", "a difference", f"UPDATE series SET made_by = {evil}"),
                                    ("pattern", "a difference", f"UPDATE series SET pattern = {evil}"),
                                    ("options", "a difference", f"UPDATE reference SET options = {evil}"),
                                    ("made_by", "a reference", f"UPDATE reference SET made_by = {evil}"),
                                    ("left out", "a list", "INSERT OR REPLACE INTO meta VALUES ('left-out', char(27)||'[31mx'||char(10))"),
                                    ("left out", "a list", "INSERT OR REPLACE INTO meta VALUES ('failed', char(27)||'[31mx'||char(9)||'1'||"
                                     "char(9)||'1'||char(9)||'1'||char(9)||char(27))")):
        copy("t", "red" if column == "left out" else "sound")
        change("t", change_of)
        for verb in ("audit", "--rows", "all"), ("export", "-o", "t.csv"), ("report",):
            told = koksma("study", verb[0], "t", *verb[1:])
            check(plain(told.stdout) and plain(told.stderr), f"{column} in {kind}: {verb}: {told}")
        if column != "left out":
            check("\\x1b[31m\\x0ax" in audit("t", "--rows", "all").stdout, f"{column} in {kind} is shown escaped")
    told = koksma("measure", name, "-m", "star")
    check(plain(told.stdout) and r"pts\x1b[31m\x0ared" in told.stdout, f"a cell of a table: {told}")
    for value in "x'ff41'", "x'c3'", "x'eda080'", "x'f4908080'", "x'41c28541'", "x'7f0a22'", "x'e2829a'":
        for column in ("scene", "pattern", "made_by")[:3 if value == "x'ff41'" else 1]:
            copy("t")
            change("t", f"UPDATE series SET {column} = CAST({value} AS TEXT) WHERE scene = 'checker'", sealed=False)
            told = subprocess.run([KOKSMA, "study", "audit", "t", "--rows", "all", "--json"], capture_output=True, timeout=1800)
            try:
                rows = [json.loads(line) for line in told.stdout.decode().rstrip("\n").split("\n")]
                check("differences" in rows[-1] and plain(told.stdout.decode()), f"{column} = {value}: {told}")
            except ValueError as problem:
                check(False, f"{column} = {value}: {problem}: {told}")
    with open(b"\xff\xc2\x85\xc3\xa9.txt", "w") as file:
        file.write("0.5 0.5\n")
    told = subprocess.run([KOKSMA.encode(), b"measure", b"\xff\xc2\x85\xc3\xa9.txt", b"-m", b"star", b"--json"], capture_output=True)
    check(b'"source":"\xef\xbf\xbd\\u0085\xc3\xa9.txt"' in told.stdout, f"a name that is no UTF-8: {told}")


def plain(text):
    """Whether no line has a control character, which also U+0080 to U+009F are."""
    return not re.search("[\x00-\x09\x0b-\x1f\x7f-\x9f]", text)


with own_folder():
    with open("plan.json", "w") as file:
        file.write(PLAN)
    shutil.copy(HERE + "/../../scenes/checker.json", "mine.json")
    with open("points.txt", "w") as file:
        file.writelines(f"{i / 16} {(3 * i + 1) % 16 / 16}\n" for i in range(16))
    made = koksma("study", "run", "./plan.json", "-o", "sound", "-q")
    assert made.returncode == 0, made.stderr
    for part in references, reasons, values, trials, keys, revisions, gaps, texts:
        part()
end()

#!/usr/bin/env python3
"""store_audit.py KOKSMA: what `koksma study audit` says of folders that a stranger made. All reference images of the plan
are rendered again, whichever rows are drawn. No text of a plan or store reaches the terminal with control characters, and
--json is JSON."""
import json
import os
import re
import shutil
import sqlite3
import subprocess

from files import KOKSMA, Checks, koksma, own_folder

checks = Checks()
check = checks.check

HERE = os.path.dirname(os.path.abspath(__file__))
PLAN = """{"name": "h", "title": "h",
  "discrepancies": [{"patterns": ["random"], "measures": ["star", "l2-star", "extreme", "l2-extreme"], "n": [4], "trials": 1000}],
  "images": [{"scenes": ["checker", "./mine.json"], "patterns": ["random"], "spp": [1], "size": [8, 6], "trials": 2,
              "references": [{"name": "r", "pattern": "jittered", "spp": 4, "replicates": 2}]}]}"""


def audit(folder, *more):
    return koksma("study", "audit", folder, *more)


def copy(name, of="sound"):
    shutil.rmtree(name, ignore_errors=True)
    shutil.copytree(of, name)
    return name


def change(folder, *statements):
    database = sqlite3.connect(folder + "/results.sqlite")
    for statement in statements:
        database.execute(statement)
    database.commit()
    database.close()


def says(told, code, *lines):
    """Whether the audit ended with the exit code, and printed a line that matches each pattern."""
    check(told.returncode == code and not told.stderr, f"exit code {code}: {told}")
    for line in lines:
        check(re.search("^" + line + "$", told.stdout, re.MULTILINE), f"'{line}' is a line of {told.stdout}")


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
    # What the plan names must be there.
    copy("r")
    os.rename("mine.json", "elsewhere.json")
    told = audit("r", *of_row)
    check(told.returncode == 3 and "mine.json" in told.stderr and "No such file" in told.stderr, f"no scene: {told}")
    os.rename("elsewhere.json", "mine.json")


def values():
    """Standard errors that are missing or infinite, and times of runs that are."""
    of_checker = r"reference r:jittered@4x2 of checker"
    copy("v")
    change("v", "UPDATE reference SET standard_error = NULL WHERE scene = 'checker'")
    says(audit("v"), 1, f"differs: {of_checker}: its stored standard error is none, but computing it again gives 0\\.[0-9]+",
         "2 reference images rendered again, of which 1 agree")
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
    copy("n")
    change("n", of_first.format(2147483647))
    for verb in ("audit",), ("export", "-o", "n.csv"), ("report",):
        told = koksma("study", verb[0], "n", *verb[1:])
        check(told.returncode == 3 and "out of range" in told.stderr and told.stderr.count("\n") == 1, f"{verb}: {told}")
    copy("n")
    change("n", "DELETE FROM result WHERE id = (SELECT min(id) FROM result WHERE id >> 32 = 999)", of_first.format(999))
    says(audit("n", "--rows", "all"), 1, "differs: discrepancy random, n = 4, dim 2, star, trial 999: the stored seed .*",
         "4023 rows drawn, of which 4022 agree: these are all", "2 reference images rendered again, of which 2 agree")


def gaps():
    """Rows that are not there are counted, as a killed run leaves gaps, too. A row without its value is a difference."""
    gap = r"not there: {} rows of earlier trials: a run was cut short, jobs failed, or somebody removed them; the next run makes them"
    trials_of = "id & 4294967295 IN (SELECT id FROM series WHERE {})"
    points, image = trials_of.format("kind = 'discrepancy'"), trials_of.format("kind = 'image' AND scene = 'checker'")
    check("not there" not in audit("sound").stdout and json.loads(audit("sound", "--json").stdout)["rows_missing"] == 0, "no row is missing")
    copy("g")
    change("g", f"DELETE FROM result WHERE {points} AND id >> 32 IN (0, 7, 998)", f"DELETE FROM result WHERE {image} AND id >> 32 = 0")
    says(audit("g", "--rows", "all"), 0, gap.format(13), "4011 rows drawn, of which 4011 agree: these are all")
    check(koksma("study", "run", "./plan.json", "-o", "g", "-q").returncode == 0 and "not there" not in audit("g").stdout, "the next run makes them")
    for values in "v0 = NULL", "v3 = NULL":
        for kind in ("image", "coherence", "metric")[:3 if values == "v0 = NULL" else 2]:  # runs write no v3 of a metric
            copy("g")
            change("g", f"UPDATE result SET {values} WHERE id = (SELECT min(id) + (1 << 32) FROM series WHERE kind = {kind!r})")
            says(audit("g", "--rows", "all"), 1, f"differs: {kind} .*, trial 1: the stored value is none, but computing it again gives .*",
                 "4024 rows drawn, of which 4023 agree: these are all")


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
    for column, of, change_of in (
            ("pattern", "sound", "UPDATE series SET pattern = char(27)||'[31m'||char(10)||'x'"),
            ("left out", "red", "INSERT INTO left_out (line) VALUES (char(27)||'[31mx'||char(10))"),
            ("left out", "red", "INSERT INTO failed (label, n, failed, trials, reason) VALUES (char(27)||'[31mx', 1, 1, 1, char(27))")):
        copy("t", of)
        change("t", change_of)
        for verb in ("audit", "--rows", "all"), ("export", "-o", "t.csv"), ("report",):
            told = koksma("study", verb[0], "t", *verb[1:])
            check(plain(told.stdout) and plain(told.stderr), f"{column}: {verb}: {told}")
    copy("t", "red")
    change("t", "UPDATE result SET v0 = 0.5 WHERE v0 IS NOT NULL")
    check(escaped.replace("file:", "") in audit("t", "--rows", "all").stdout, "a name is shown escaped")
    told = koksma("study", "audit", "t", "--rows", "all", "--json")
    rows = [json.loads(line) for line in told.stdout.rstrip("\n").split("\n")]
    check(rows[-1]["differences"] and plain(told.stdout), f"JSON: {told}")
    told = koksma("measure", name, "-m", "star")
    check(plain(told.stdout) and r"pts\x1b[31m\x0ared" in told.stdout, f"a cell of a table: {told}")
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
    for part in references, values, trials, gaps, texts:
        part()
checks.end()

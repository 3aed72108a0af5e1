#!/usr/bin/env python3
"""store_attacks.py KOKSMA: folders of studies as a stranger may make them. Databases of other programs, triggers, views,
tables of their own, values that are no numbers: refused with exit code 3 by export, report, run and audit, and not a
byte of the folder is changed. Rows and references of the plan that were changed by hand:
found by the audit. Stored specs that name programs or devices start nothing."""
import hashlib
import os
import re
import shutil
import sqlite3
import subprocess

from files import KOKSMA, SANITIZED, Checks, koksma, own_folder

checks = Checks()
check = checks.check

PLAN = """{"name": "h", "title": "h",
  "discrepancies": [{"patterns": ["random", "zaremba"], "measures": ["star", "l2-star"], "n": [4, 9], "trials": 5}],
  "images": [{"scenes": ["checker"], "patterns": ["random"], "spp": [1], "size": [8, 6], "trials": 3,
              "references": [{"name": "r", "pattern": "jittered", "spp": 4, "replicates": 2}]}]}"""


def study(verb, folder, *more):
    if verb == "run":
        return koksma("study", "run", "./plan.json", "-o", folder, "-q", "--trials", "7")
    return koksma("study", verb, folder, *more)


def bytes_of(folder):
    names = sorted(os.path.join(at, name) for at, _, files in os.walk(folder) for name in files)
    return {name: hashlib.sha256(open(name, "rb").read()).hexdigest() for name in names}


def change(folder, *statements, unchecked=False):
    database = sqlite3.connect(folder + "/results.sqlite")
    if unchecked:
        database.execute("PRAGMA ignore_check_constraints=ON")
    for statement in statements:
        database.execute(statement)
    database.commit()
    database.close()


def copy(name):
    shutil.rmtree(name, ignore_errors=True)
    shutil.copytree("sound", name)
    return name


turn = 0


def refused(name, folder, verbs=("export", "report", "run", "audit"), code=3):
    """By each of the verbs; with sanitizers by one, each in its turn."""
    global turn
    turn += 1
    verbs = [verbs[turn % len(verbs)]] if SANITIZED else verbs
    before = bytes_of(folder)
    for verb in verbs:
        told = study(verb, folder)
        check(told.returncode == code, f"{name}: {verb} has exit code {told.returncode}: {told.stdout}{told.stderr}")
        lines = told.stderr.rstrip().split("\n")
        check(len(lines) == 1 and folder in lines[0], f"{name}: {verb} says {told.stderr}")
        now = bytes_of(folder)
        check(now == before, f"{name}: {verb} has changed {[k for k in {**now, **before} if now.get(k) != before.get(k)]}")


# ---- Databases that are not ours ------------------------------------------------------------------------------


def foreign():
    os.mkdir("f")
    for name, statements in {
        "another program's": ["CREATE TABLE moz_places (id INTEGER PRIMARY KEY, url TEXT)", "INSERT INTO moz_places VALUES (1, 'x')"],
        "empty of tables": ["PRAGMA user_version=6"],
        "with an application's id": ["PRAGMA application_id=252006673", "CREATE TABLE t (x)"],
        "with our id": ["PRAGMA application_id=1265333101", "PRAGMA user_version=8", "CREATE TABLE t (x)"],
        "of schema 7": ["PRAGMA application_id=1265333101", "PRAGMA user_version=7", "CREATE TABLE t (x)"],
        "of a newer schema": ["PRAGMA application_id=1265333101", "PRAGMA user_version=9", "CREATE TABLE t (x)"],
        "without a schema": ["PRAGMA application_id=1265333101", "CREATE TABLE t (x)"],
        "with a meta of its own": ["CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID",
                                   "INSERT INTO meta VALUES ('schema', '5')"],
    }.items():
        change("f", *statements)
        refused(name, "f")
        os.remove("f/results.sqlite")
    # By a link, as it lies elsewhere.
    change(".", "CREATE TABLE t (x)")
    os.symlink("../results.sqlite", "f/results.sqlite")
    refused("behind a link", "f")
    os.remove("f/results.sqlite")
    for name, content in {"text": b"no database, but long enough to be one\n" * 9, "the head alone": b"SQLite format 3\0",
                          "empty": b""}.items():
        with open("f/results.sqlite", "wb") as file:
            file.write(content)
        refused(name, "f", *(() if content else [("export", "report", "audit")]))  # a killed run leaves it; the next goes on
    os.remove("f/results.sqlite")
    os.mkfifo("f/results.sqlite")
    for verb in "export", "report", "run", "audit":
        check(study(verb, "f").returncode == 3, f"a fifo: {verb}")
    os.remove("f/results.sqlite")
    shutil.rmtree("f")


def schema():
    for name, statement in {
        "trigger": "CREATE TRIGGER t AFTER INSERT ON result BEGIN UPDATE result SET v0 = 0.0 WHERE id = new.id; END",
        "trigger on a view": "CREATE TRIGGER t INSTEAD OF INSERT ON rows BEGIN SELECT 1; END",
        "view": "CREATE VIEW mine AS SELECT 1",
        "table": "CREATE TABLE more (x)",
        "index": "CREATE INDEX more ON result (v0)",
        "statistics": "ANALYZE",
        "virtual table": "CREATE VIRTUAL TABLE v USING fts5(x)",
        "column": "ALTER TABLE result ADD COLUMN v4 REAL",
        "renamed": "ALTER TABLE run RENAME TO ran",
        "less": "DROP VIEW rows",
    }.items():
        copy("s")
        change("s", statement)
        refused(name, "s")
    # The same name with another meaning.
    copy("s")
    change("s", "DROP TABLE result", "CREATE VIEW result AS SELECT 1 AS id, 0 AS seed, 0.0 AS v0, 0.0 AS v1, 0.0 AS v2, 0.0 AS v3")
    refused("a view for a table", "s")


# ---- Values ---------------------------------------------------------------------------------------------------


def values():
    """STRICT tables and CHECKs refuse these; so they are put in by the bytes of the file and by switched-off checks."""
    for value in ("9e999", "-9e999"):
        copy("v")
        change("v", f"UPDATE result SET v0 = {value} WHERE id = (SELECT min(id) FROM result)", unchecked=True)
        refused(f"v0 = {value}", "v")
    for value in ("'abc'", "x'00'"):
        copy("v")
        try:
            change("v", f"UPDATE result SET v0 = {value}")
            check(False, f"the tables take {value} for a number")
        except sqlite3.IntegrityError:
            pass


def found(name, folder, in_words=""):
    told = study("audit", folder, "--rows", "all")
    check(told.returncode == 1 and "differs: " in told.stdout and in_words in told.stdout, f"{name}: {told}")


def rows():
    first = "(SELECT min(id) FROM result)"
    of_metric = "id = (SELECT min(result.id) FROM result JOIN series ON result.id & 4294967295 = series.id WHERE kind = 'metric')"
    edits = {
        "a metric": (f"UPDATE result SET v0 = v0 * (1 + 2.3e-16) WHERE {of_metric}", "the stored value is"),
        "a robust value": (f"UPDATE result SET v1 = v1 * (1 + 2.3e-16) WHERE {of_metric}", "the stored value is"),
        "a top share": (f"UPDATE result SET v2 = 2.3e-16 WHERE {of_metric}", "the stored value is 2.29"),
        "no top share": (f"UPDATE result SET v2 = NULL WHERE {of_metric}", "the stored value is"),
        "value": (f"UPDATE result SET v0 = v0 * (1 + 2.3e-16) WHERE id = {first}", "the stored value is"),
        "seed": (f"UPDATE result SET seed = seed + 1 WHERE id = {first}", "seed"),
        "a row of another": ("UPDATE result SET v0 = (SELECT v0 FROM result ORDER BY id LIMIT 1 OFFSET 1)", "the stored value is"),
        "hash": ("UPDATE reference SET pixels = replace(pixels, substr(pixels, 1, 3), 'abc')", "hash"),
        "own error": ("UPDATE reference SET standard_error = standard_error * 2", "its stored standard error is "),
    }
    for name, (statement, words) in edits.items():
        copy("r")
        change("r", statement)
        check(study("export", "r").returncode == 0, f"{name}: it is exported")
        found(name, "r", words)
    # Rows of other plans, files, scenes and revisions are no row of the report: they are counted.
    for name, statement, n in (("added", "INSERT INTO result SELECT id + (100 << 32), seed, v0, v1, v2, v3 FROM result WHERE id & 4294967295 IN (SELECT id FROM series WHERE kind = 'discrepancy' ORDER BY id LIMIT 2) AND id >> 32 = 0", 2),
                               ("pattern", "UPDATE series SET pattern = 'none' WHERE pattern = 'random' AND kind = 'discrepancy'", 20),
                               ("scene", "UPDATE series SET scene_hash = '00' WHERE kind = 'image'", 18),
                               ("revision", "UPDATE series SET made_by = 'random 1' WHERE made_by = 'random 0'", 20)):
        copy("r")
        change("r", statement)
        told = study("audit", "r", "--rows", "all")
        check(told.returncode == 0 and f"not compared: {n} rows" in told.stdout, f"{name}: {told}")
    copy("r")
    change("r", "UPDATE series SET n = n + 100")
    found("no row of the plan", "r", "none is compared")
    # A run makes rows of its own beside those of another revision.
    copy("r")
    change("r", "UPDATE series SET made_by = 'random 1' WHERE made_by = 'random 0'")
    koksma("study", "run", "./plan.json", "-o", "r", "-q")
    export = study("export", "r").stdout.split("\n")
    check(sorted(r for r in export if "random 1" not in r) == sorted(SOUND.split("\n")), "rows beside those of another revision")
    # The damaged plan is that of the store, not the file whose name it has.
    copy("emptied")
    change("emptied", "UPDATE meta SET value = '{}' WHERE key = 'plan-text-0'")
    refused("an empty plan", "emptied", ("report", "audit"))
    for value in "0 7 0", "-1 7 0", "1 -7 0", "2 7 0", "", "one":
        copy("r")
        change("r", f"UPDATE meta SET value = '{value}' WHERE key = 'plan-texts'")
        refused(f"plans and trials '{value}'", "r", ("report", "audit"))


def references():
    name = "references/" + os.listdir("sound/references")[0]
    copy("x")
    koksma("render", "checker", "--size", "8x6", "-n", "1", "-q", "-o", "other.exr")
    for content, words in ((open("other.exr", "rb").read(), "the pixels of the file"), (b"no image", "")):
        with open("x/" + name, "wb") as file:
            file.write(content)
        before = bytes_of("x")
        for verb in "report", "run":
            told = study(verb, "x")
            check(told.returncode == 3 and name in told.stderr, f"another reference: {verb}: {told}")
        check({k: v for k, v in bytes_of("x").items() if "results" not in k} ==
              {k: v for k, v in before.items() if "results" not in k}, "another reference: files changed")
        found("another reference", "x", words)
    os.remove("x/" + name)
    told = study("audit", "x")
    check(told.returncode == 0 and "the files of 1 are missing" in told.stdout, f"no reference: {told}")
    check(study("run", "x").returncode == 0, "a run makes a reference again")
    koksma("study", "run", "./plan.json", "-o", "whole", "-q", "--trials", "7")
    check(study("export", "x").stdout == study("export", "whole").stdout, "rows with a reference that was made again")
    # What is no plain file is not opened: a fifo would be waited for.
    copy("x")
    os.rename("x/" + name, "elsewhere.exr")
    os.mkfifo("fifo-elsewhere")
    for make in os.mkfifo, lambda path: os.symlink("../../fifo-elsewhere", path), os.mkdir:
        make("x/" + name)
        for verb in "report", "run":
            told = study(verb, "x")
            check(told.returncode == 3 and name in told.stderr, f"a reference that is no file: {verb}: {told}")
        found("a reference that is no file", "x", name)
        (os.rmdir if make is os.mkdir else os.remove)("x/" + name)


def exports():
    """No export replaces the results that it reads, by whatever name."""
    copy("e")
    os.symlink("results.sqlite", "e/link.csv")
    os.link("e/results.sqlite", "second.npy")
    os.symlink("e/results.sqlite", "far.json")
    before = bytes_of("e")
    for path in "e/results.sqlite", "e/link.csv", "second.npy", "far.json", "./e/../e/results.sqlite":
        told = study("export", "e", "--format", "csv", "-o", path)
        check(told.returncode == 2 and path in told.stderr, f"an export over the results: {told}")
        check(bytes_of("e") == before, f"an export over the results as {path}: they are changed")
    os.symlink("e/results.sqlite-wal", "log.csv")
    for path in "e/results.sqlite-journal", "e/results.sqlite-wal", "e/../e/results.sqlite-shm", "log.csv":
        told = study("export", "e", "--format", "csv", "-o", path)
        check(told.returncode == 2 and path in told.stderr, f"an export where SQLite expects a log: {told}")
        check(sorted(os.listdir("e")) == sorted([*os.listdir("sound"), "link.csv"]), f"an export to {path} made a file")
    image = "e/references/" + os.listdir("e/references")[0]
    os.symlink(image, "image.exr")
    os.symlink("references", "e/into")
    before = bytes_of("e")
    for path in image, "e/references/new.csv", "./e/../e/references/new.csv", "image.exr", "e/into/new.csv":
        told = study("export", "e", "--format", "csv", "-o", path)
        check(told.returncode == 2 and f"{path}: the study keeps its results" in told.stderr, f"an export among the references: {told}")
        check(bytes_of("e") == before, f"an export among the references as {path}: they are changed")
    told = subprocess.run([KOKSMA, "study", "export", "..", "-o", "-"], cwd="e/references", capture_output=True, text=True, timeout=1800)
    check(told.returncode == 0 and told.stdout, f"an export to standard output from there: {told}")
    for name in "e/results.sqlite.csv", "e/results.csv", "results.sqlite-wal", "e/references/../results.csv":
        check(study("export", "e", "--format", "csv", "-o", name).returncode == 0, f"an export to {name}")


def programs():
    """Nothing that a stored spec names is started, and no device is read for ever."""
    specs = ["program:touch started", "command:touch started", "exec:touch started", "|touch started", "file:|touch started",
             "file:$(touch started)", "file:/dev/zero", "file:fifo", "`touch started`"]
    os.mkfifo("fifo")
    for spec in specs:
        copy("p")
        quoted = spec.replace("'", "''")
        change("p", f"UPDATE series SET pattern = '{quoted}', made_by = 'file 0' WHERE pattern = 'random' AND kind = 'discrepancy'",
               f"UPDATE series SET what = '{quoted}' WHERE what = 'star'")
        for verb in "export", "report", "audit":
            check(study(verb, "p").returncode in (0, 3), f"{spec}: {verb}")
    copy("p")
    change("p", "UPDATE series SET scene = '/dev/zero' WHERE scene = 'checker'")
    check(study("audit", "p").returncode == 0, "a device for a scene")
    check(not os.path.exists("started"), "a stored spec has started a program")


if __name__ == "__main__":
    with own_folder():
        with open("plan.json", "w", encoding="ascii") as file:
            file.write(PLAN)
        assert koksma("study", "run", "./plan.json", "-o", "sound", "-q").returncode == 0
        SOUND = study("export", "sound").stdout
        for attack in foreign, schema, values, rows, references, exports, programs:
            attack()
    checks.end()

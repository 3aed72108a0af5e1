#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the table of docs/conventions-of-others.md by running the packages of conventions.toml.

    conventions.py run [PACKAGE ...]       runs generators and compares what they do with docs/conventions-of-others.json
    conventions.py record [PACKAGE ...]    the same, and writes what it saw into that file and the table of the page
    conventions.py table                   writes the table of the page from that file alone
    conventions.py check                   ends with 1 if table, file and the point files of tests/identify/sets differ
    conventions.py draw SEED DIR [N]       N sets with random sizes, dimensions, skips and seeds, changed as users do,
                                           and how many of them `koksma identify` names as the table says

Options of run, record and draw: --koksma PROGRAM (default: the one on PATH), --python PROGRAM,.. (interpreters
that have the versions already, in place of a fresh environment for each package), --save DIR (the sets of 64 points).

A row is run with 64 points in four dimensions and seed 1, unless conventions.toml says otherwise; then with a dimension
more, with a point more, for 20 points, and at its limit of dimensions. It ends with 1 and names the row if anything has
changed. Packages are installed with the stated versions into a temporary folder, those of Debian with apt before.
"""
import argparse
import hashlib
import json
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE, FACTS = ROOT / "docs" / "conventions-of-others.md", ROOT / "docs" / "conventions-of-others.json"
SETS = ROOT / "tests" / "identify" / "sets"
COLUMNS = {"generator": "generator", "first": "first point", "order": "order and numbers", "randomisation": "randomisation",
           "kept": "kept; limit", "equal": "equal to"}
WRITTEN = ("generator", "first", "order", "randomisation", "limit", "equal")
POINTS, DIM, SEED = 64, 4, 1
UNNAMED = ("unknown", "scaled", "rounded")
ALIKE = ({"equal", "reordered", "part"}, {"linear-scramble", "digital-shift", "nested-scramble"},
         {"nested-scramble", "digit-permutation"})

# ---- Programs of each language: {setup} and the rows' {bodies} become one program, called with ROW DIMENSION POINTS SEED

PYTHON = """import json, sys, warnings
warnings.filterwarnings("ignore")
space = {}
job = json.load(open("job.json"))
exec(job["setup"], space)
answers = []
for text, d, n, seed in job["calls"]:
    try:
        space.update(d=d, n=n, seed=seed)
        points = eval(text, space)
        points = points.tolist() if hasattr(points, "tolist") else points
        answers.append([float(x) for p in points for x in (p if hasattr(p, "__len__") else [p])])
    except Exception as error:
        answers.append(f"{type(error).__name__}: {error}"[:200])
json.dump(answers, open("answers.json", "w"))
"""
C = """#include <stdio.h>
#include <stdlib.h>
{setup}
static void put(double x) {{ printf("%.17g\\n", x); }}
{bodies}
int main(int argc, char **argv)
{{
    const int row = atoi(argv[1]), d = atoi(argv[2]), n = atoi(argv[3]), seed = atoi(argv[4]);
    (void)argc; (void)put;
    {calls}
    return 0;
}}
"""
RUST = """{setup}
fn put(x: f64) {{ println!("{{:e}}", x) }}
{bodies}
fn main() {{
    let a: Vec<usize> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
    let (row, d, n, seed) = (a[0], a[1], a[2], a[3]);
    {calls}
}}
"""
GO = """package main

import (
	"fmt"
	"os"
	"strconv"
{setup}
)

func put(x float64) {{ fmt.Println(strconv.FormatFloat(x, 'e', -1, 64)) }}
{bodies}
func main() {{
	row, _ := strconv.Atoi(os.Args[1])
	d, _ := strconv.Atoi(os.Args[2])
	n, _ := strconv.Atoi(os.Args[3])
	seed, _ := strconv.Atoi(os.Args[4])
	{calls}
}}
"""
JAVA = """{setup}
class Points {{
    static void put(double x) {{ System.out.println(x); }}
    {bodies}
    public static void main(String[] a) throws Exception {{
        int row = Integer.parseInt(a[0]), d = Integer.parseInt(a[1]), n = Integer.parseInt(a[2]), seed = Integer.parseInt(a[3]);
        {calls}
    }}
}}
"""
NODE = """{setup}
const [row, d, n, seed] = process.argv.slice(2).map(Number);
const lines = [];
const put = (x) => lines.push(x);
{calls}
console.log(lines.join('\\n'));
"""
R = """{setup}
a <- as.integer(commandArgs(TRUE)); row <- a[1]; d <- a[2]; n <- a[3]; seed <- a[4]
put <- function(x) cat(sprintf("%.17g\\n", t(x)), sep = "")
{calls}
"""


def sh(*command, cwd, **more):
    """Runs a command; a failure ends this script with what the command printed."""
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False, **more)
    if done.returncode:
        sys.exit(f"conventions.py: {' '.join(map(str, command))[:200]}: {(done.stderr or done.stdout).strip()[-2000:]}")
    return done.stdout


def debian(package):
    """Stops unless Debian's packages are here in the stated versions."""
    for pinned in package["install"]:
        name, version = pinned.split("=")
        done = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", name], capture_output=True, text=True, check=False)
        if not done.stdout.split(":")[-1].startswith(version):
            sys.exit(f"conventions.py: {name} {version} is needed, here is {done.stdout or 'none'}; apt-get install {name}")


def program(package, here):
    """Installs a package into the folder `here` and returns the command that makes points. Each language has its own way."""
    language, setup, install = package["language"], package.get("setup", ""), package["install"]
    rows = list(enumerate(package["row"]))

    def write(name, template, body, call):
        text = template.format(setup=setup, bodies="\n".join(body.format(i=i, points=r["points"]) for i, r in rows),
                               calls="\n".join(call.format(i=i, points=r["points"]) for i, r in rows))
        (here / name).write_text(text, encoding="utf-8")

    if language in ("c", "c++"):
        debian(package)
        name, compiler = ("main.c", "cc") if language == "c" else ("main.cpp", "c++")
        write(name, C, "static void row{i}(int d, int n, int seed) {{ (void)seed; {points} }}", "if (row == {i}) row{i}(d, n, seed);")
        sh(compiler, "-O1", name, "-o", "points", *package.get("libraries", []), cwd=here)
        return ["./points"]
    if language == "r":
        debian(package)
        write("points.R", R, "", "if (row == {i}) put({points})")
        return ["Rscript", "points.R"]
    if language == "rust":
        sh("cargo", "init", "-q", "--vcs", "none", "--name", "points", cwd=here)
        for crate in install:
            sh("cargo", "add", "-q", crate, cwd=here)
        write("src/main.rs", RUST, "fn row{i}(d: usize, n: usize, seed: usize) {{ let _ = seed; {points} }}",
              "if row == {i} {{ row{i}(d, n, seed) }}")
        sh("cargo", "build", "-q", "--release", cwd=here)
        return ["target/release/points"]
    if language == "go":
        write("main.go", GO, "func row{i}(d, n, seed int) {{ {points} }}", "if row == {i} {{ row{i}(d, n, seed) }}")
        sh("go", "mod", "init", "points", cwd=here)
        for module in install:
            sh("go", "get", module, cwd=here)
        sh("go", "mod", "tidy", cwd=here)
        sh("go", "build", "-o", "points", cwd=here)
        return ["./points"]
    if language == "java":
        for artifact in install:
            sh("mvn", "-q", "dependency:copy", f"-Dartifact={artifact}", "-DoutputDirectory=.", cwd=here)
        write("Points.java", JAVA, "static void row{i}(int d, int n, int seed) throws Exception {{ {points} }}",
              "if (row == {i}) row{i}(d, n, seed);")
        sh("javac", "-cp", "*", "Points.java", cwd=here)
        return ["java", "-cp", "*:.", "Points"]
    sh("npm", "install", "--silent", "--no-audit", "--no-fund", "--ignore-scripts", *install, cwd=here)
    write("points.mjs", NODE, "", "if (row === {i}) {{ {points} }}")
    return ["node", "points.mjs"]


def present(entry, interpreters):
    """The first of some interpreters of Python, in a list with commas, that has the stated version of a package."""
    wanted, version_of = entry.get("install_alone", entry["install"])[0].split("=="), "import importlib.metadata as m; print(m.version({!r}))"
    for python in interpreters.split(","):
        done = subprocess.run([python, "-c", version_of.format(wanted[0])], capture_output=True, text=True, check=False)
        if done.stdout.strip() == wanted[1]:
            return python
    sys.exit(f"conventions.py: {' '.join(wanted)} is needed, not in {interpreters}")


class Package:
    """One package, installed in a temporary folder."""

    def __init__(self, entry, python):
        self.entry, self.folder = entry, Path(tempfile.mkdtemp(prefix="conventions-"))
        if entry["language"] != "python":
            self.command = program(entry, self.folder)
        elif python:
            self.command = [present(entry, python)]
        else:
            sh(sys.executable, "-m", "venv", "venv", cwd=self.folder)
            for option, key in (((), "install"), (("--no-deps",), "install_alone")):
                if entry.get(key):
                    sh("venv/bin/pip", "install", "-q", "--disable-pip-version-check", *option, *entry[key], cwd=self.folder)
            self.command = [str(self.folder / "venv" / "bin" / "python")]

    def calls(self, calls):
        """Points of each (row number, dimension, points, seed) as a list of rows, or the text of an error."""
        if self.entry["language"] == "python":
            flat = self.python(calls)
        else:
            flat = [self.one(call) for call in calls]
        return [x if isinstance(x, str) else [x[i : i + call[1]] for i in range(0, len(x), call[1])]
                for x, call in zip(flat, calls)]

    def python(self, calls):
        """All calls in one process of Python: imports take most of the time."""
        texts = [(self.entry["row"][row]["points"], d, n, seed) for row, d, n, seed in calls]
        (self.folder / "job.json").write_text(json.dumps({"setup": self.entry.get("setup", ""), "calls": texts}))
        (self.folder / "job.py").write_text(PYTHON)
        sh(*self.command, "job.py", cwd=self.folder, timeout=1800)
        return json.loads((self.folder / "answers.json").read_text())

    def one(self, call):
        """One call in a process of its own."""
        done = subprocess.run([*self.command, *map(str, call)], cwd=self.folder, capture_output=True, text=True, timeout=600,
                              check=False)
        if done.returncode:
            return (done.stderr or done.stdout).strip()[-200:] or f"exit code {done.returncode}"
        return [float(x) for x in done.stdout.split()]

    def close(self):
        """Removes the folder."""
        shutil.rmtree(self.folder, ignore_errors=True)


def digest(points):
    """A short hash of coordinates in units of 2^-40: the last bits differ between processors where there is a power or a root."""
    text = ",".join(str(int(x * 2**40 + 0.5)) for p in points for x in p)
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def write_npy(path, points):
    """A .npy file of doubles."""
    head = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({len(points)}, {len(points[0])}), }}"
    head += " " * (-(len(head) + 11) % 64) + "\n"
    values = [x for p in points for x in p]
    path.write_bytes(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head.encode() + struct.pack(f"<{len(values)}d", *values))


def read_npy(path):
    """The points of a .npy file of doubles in either order."""
    data = path.read_bytes()
    size = struct.unpack("<H", data[8:10])[0]
    head = data[10 : 10 + size].decode()
    n, dim = map(int, re.search(r"\((\d+), (\d+)\)", head).groups())
    values = struct.unpack(f"<{n * dim}d", data[10 + size :])
    across = "True" in head
    return [[values[k * n + i if across else i * dim + k] for k in range(dim)] for i in range(n)]


def identify(koksma, path):
    """What `koksma identify` says of a file: all its statements."""
    done = subprocess.run([koksma, "identify", str(path), "--json"], capture_output=True, text=True, check=False)
    if done.returncode > 1:
        sys.exit(f"conventions.py: {done.stderr.strip()}")
    return [json.loads(line) for line in done.stdout.splitlines()]


def name(said):
    """The statement that names points, or that they are unknown."""
    named = [x for x in said if x["relation"] not in UNNAMED]
    x = (named or [{"relation": "unknown", "what": "", "spec": "-", "first": 0}])[0]
    return {k: x[k] for k in ("relation", "what", "spec", "first")}


def facts(entry, options):
    """Runs all rows of a package and returns what they do: one dictionary for each row."""
    package, rows, calls = Package(entry, options.python), entry["row"], []
    for i, row in enumerate(rows):
        d, n, limit = row.get("d", DIM), row.get("n", POINTS), row.get("limit", 0)
        calls += [(i, d, n, SEED), (i, d, n, SEED), (i, d + 1, n, SEED), (i, d, 2 * n, SEED), (i, d, 20, SEED)]
        calls += [(i, limit, row.get("limit_n", 2), SEED), (i, limit + 1, row.get("limit_n", 2), SEED)] if limit else []
    answers = iter(package.calls(calls))
    found = []
    for row in rows:
        points, again, wider, longer, twenty = (next(answers) for _ in range(5))
        if isinstance(points, str):
            sys.exit(f"conventions.py: {entry['name']}, {row['generator']}: {points}")
        limits = [next(answers) for _ in range(2)] if "limit" in row else []
        if limits and (isinstance(limits[0], str) or isinstance(limits[1], str) == row.get("unchecked", False)):
            sys.exit(f"conventions.py: {entry['name']}, {row['generator']}: {row['limit']} dimensions are not its limit, "
                     f"or whether it refuses more has changed: {str(limits[0])[:200]}")
        kept = [] if isinstance(wider, str) or "d" in row else ["dimension"] * ([p[: row.get("d", DIM)] for p in wider] == points)
        kept += ["points"] * (not isinstance(longer, str) and longer[: len(points)] == points)
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(options.save or folder)
            folder.mkdir(parents=True, exist_ok=True)
            path = folder / (re.sub(r"[^a-z0-9]+", "-", (entry["name"] + " " + row["generator"]).lower()).strip("-") + ".npy")
            write_npy(path, points)
            named = name(identify(options.koksma, path))
        given = "-" if isinstance(twenty, str) else len(twenty)
        found.append({"package": entry["name"], "version": version(entry), **{k: row.get(k, "") for k in WRITTEN},
                      "unchecked": row.get("unchecked", False), "kept": kept, "twenty": given, "identify": named, "points": [len(points), len(points[0])],
                      "digest": digest(points) if again == points else "differs in each run"})
    package.close()
    return found


def version(entry):
    """The version of a package: that of the first requirement."""
    return re.split("==|=|@|:", entry.get("install_alone", entry["install"])[0])[-1].lstrip("=v")


def held(row):
    """The letters of what a seed keeps, how many points are given for 20 if not as many, and the most dimensions."""
    words = ["".join(word[0] for word in row["kept"])]
    words += [f"20 give {row['twenty']}"] * (row["twenty"] not in (20, "-"))
    words += [f"{row['limit']}{'+' * row['unchecked']}"] if row["limit"] else []
    return "; ".join(filter(None, words))


def table(rows):
    """The lines of the page's table: one for each group of neighbours of a package that differ in their generator alone."""
    lines, last, groups = ["| package | " + " | ".join(COLUMNS.values()) + " |", "|---" * (len(COLUMNS) + 1) + "|"], None, []
    for row in rows:
        package = f"{row['package']} {row['version']}"
        cells = [row[k] if k != "kept" else held(row) for k in COLUMNS if k != "generator"]
        if groups and groups[-1][0] == package and groups[-1][2] == cells:
            groups[-1][1].append(row["generator"])
        else:
            groups.append((package, [row["generator"]], cells))
    for package, generators, cells in groups:
        cells = [re.sub(r"^none$", "", re.sub("^none; the kind of", "~", cell)) for cell in cells]
        lines.append(f"| {package if package != last else ''} | " + " | ".join([", ".join(generators), *cells]) + " |")
        last = package
    return [re.sub(r"\|  (?=\|)", "| ", line) for line in lines]


def page(rows):
    """The page with its first table made of the rows."""
    lines = PAGE.read_text(encoding="utf-8").split("\n")
    start = lines.index("## Sequences and sets") + 2
    end = start
    while lines[end].startswith("|"):
        end += 1
    return "\n".join(lines[:start] + table(rows) + lines[end:])


def dump(rows):
    """The file of facts: one row a line."""
    return "[\n" + ",\n".join(json.dumps(row, ensure_ascii=False) for row in rows) + "\n]\n"


def run(entries, options, record):
    """Runs packages; compares with the file of facts, or writes it."""
    old = json.loads(FACTS.read_text(encoding="utf-8")) if FACTS.exists() else []
    key, bad, new, failed = (lambda row: (row["package"], row["generator"])), 0, {}, 0
    for entry in entries:
        if options.packages and entry["name"] not in options.packages:
            continue
        print(f"{entry['name']} {version(entry)} ...", flush=True)
        before = {key(row): row for row in old}
        try:
            seen = facts(entry, options)
        except (SystemExit, subprocess.TimeoutExpired) as failure:
            print(f"  fails: {failure}", flush=True)
            failed += 1
            continue
        for row in seen:
            was = before.get(key(row), {})
            new[key(row)] = row
            for k in [k for k in row if row[k] != was.get(k)] if was else ["identify"]:
                bad += not record
                print(f"  {row['generator']}: {k}: {was.get(k, 'nothing')} -> {row[k]}")
    if record:
        known = {key(row): row for row in old} | new
        order = [(e["name"], r["generator"]) for e in entries for r in e["row"]]
        rows = [known[k] for k in order if k in known]
        FACTS.write_text(dump(rows), encoding="utf-8")
        PAGE.write_text(page(rows), encoding="utf-8")
    print(f"{len(new)} generators, {bad} differences, {failed} packages that fail")
    return bad + failed > 0


def check(entries):
    """The page's table is made of the file of facts, that has each row of conventions.toml, and the sets are theirs."""
    rows = json.loads(FACTS.read_text(encoding="utf-8"))
    bad = [] if page(rows) == PAGE.read_text(encoding="utf-8") else [f"{PAGE.name}: not the table of {FACTS.name}: conventions.py table"]
    written = [(e["name"], version(e), *(str(r.get(k, "")) for k in WRITTEN)) for e in entries for r in e["row"]]
    measured = [(r["package"], r["version"], *(str(r[k]) for k in WRITTEN)) for r in rows]
    bad += [f"{FACTS.name}: has no such row: {row}; run conventions.py record" for row in written if row not in measured]
    bad += [f"conventions.toml: has no such row: {row}" for row in measured if row not in written]
    of = {r["set"]: (e["name"], r["generator"]) for e in entries for r in e["row"] if "set" in r}
    for path in sorted(SETS.glob("*.npy")):
        row = next((r for r in rows if (r["package"], r["generator"]) == of.get(path.stem)), None)
        if row is None or row["digest"] != digest(read_npy(path)):
            bad.append(f"{path.name}: not the points of a row of {FACTS.name} with set = \"{path.stem}\"")
    print("\n".join(bad) or f"{len(rows)} rows of {len({r['package'] for r in rows})} packages, {len(of)} sets")
    return bool(bad)


def change(points, draw):
    """What users do: columns in another order, floats, [-1,1], points removed, eight places. Returns points and words."""
    kind = draw.randrange(10)
    if kind == 0:
        order = draw.sample(range(len(points[0])), len(points[0]))
        return [[p[k] for k in order] for p in points], "permuted"
    if kind == 1:
        return [[struct.unpack("f", struct.pack("f", x))[0] for x in p] for p in points], "as float"
    if kind == 2 and all(0 <= x <= 1 for p in points for x in p):
        return [[2 * x - 1 for x in p] for p in points], "[-1,1]"
    if kind == 3 and len(points) > 100:
        gone = set(draw.sample(range(len(points)), 5))
        return [p for i, p in enumerate(points) if i not in gone], "5 removed"
    if kind == 4:
        return [[round(x, 8) for x in p] for p in points], "8 places"
    return points, ""


def alike(one, other, dim):
    """Whether two statements name one thing: the order, the numbers and the kind of scramble are their matter. In one and two
    dimensions the sequences of Sobol', Niederreiter in base 2 and Faure are one."""
    same = one["relation"] == other["relation"] or any({one["relation"], other["relation"]} <= kinds for kinds in ALIKE)
    names = [x["what"].split()[0].rstrip(",:") for x in (one, other)]
    return same and (names[0] == names[1] or dim < 3 and set(names) <= {"Sobol'", "Niederreiter", "Faure"})


def held_out(entries, options):
    """Draws sets of the rows that the table has a name for, and asks `koksma identify`."""
    draw, folder = random.Random(int(options.packages[0])), Path(options.packages[1])
    count = int(options.packages[2]) if len(options.packages) > 2 else 40
    known = {(r["package"], r["generator"]): r for r in json.loads(FACTS.read_text(encoding="utf-8"))}
    pool = [(e, i, known[e["name"], r["generator"]]) for e in entries for i, r in enumerate(e["row"])]
    pool = [x for x in pool if x[2]["identify"]["relation"] != "unknown"]
    drawn = {}
    for entry, i, row in draw.sample(pool, count):
        source = entry["row"][i]
        d = source.get("d", draw.randint(2, min(9, source.get("limit", 9))))
        n = source.get("n", 2 ** draw.randint(6, 11) if source.get("powers") else draw.randint(40, 1500))
        skip = draw.randint(1, 3000) if "points" in row["kept"] and not source.get("powers") and draw.random() < 0.5 else 0
        drawn.setdefault(entry["name"], []).append(((i, d, n + skip, draw.randint(2, 10**6)), skip, row))
    folder.mkdir(parents=True, exist_ok=True)
    named = done = 0
    for entry in (e for e in entries if e["name"] in drawn):
        package = Package(entry, options.python)
        for points, (call, skip, row) in zip(package.calls([x[0] for x in drawn[entry["name"]]]), drawn[entry["name"]]):
            if isinstance(points, str):
                sys.exit(f"conventions.py: {entry['name']} {row['generator']} {call}: {points}")
            points, how = change(points[skip:], draw)
            path = folder / f"{done:02d}.npy"
            write_npy(path, points)
            said = [x for x in identify(options.koksma, path) if x["relation"] not in UNNAMED]
            good = any(alike(x, row["identify"], call[1]) for x in said)
            done, named = done + 1, named + good
            print("named" if good else "NOT NAMED", path.name, entry["name"], row["generator"], f"{len(points)} points, {call[1]} dimensions, seed {call[3]},",
                  f"skip {skip}", how, "->", *[f"{x['relation']}: {x['what']};" for x in said[:2]], flush=True)
        package.close()
    print(f"{named} of {done} named")
    return False


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command", choices=("run", "record", "table", "check", "draw"))
    parser.add_argument("packages", nargs="*")
    parser.add_argument("--koksma", default="koksma")
    parser.add_argument("--python", default="")
    parser.add_argument("--save", default="")
    options = parser.parse_intermixed_args()
    options.koksma = str(Path(shutil.which(options.koksma) or options.koksma).absolute())
    with open(ROOT / "findings" / "conventions.toml", "rb") as file:
        entries = tomllib.load(file)["package"]
    if options.command in ("run", "record", "draw") and not os.access(options.koksma, os.X_OK):
        sys.exit(f"conventions.py: no program {options.koksma}: build it, and name it with --koksma")
    unknown = set(options.packages) - {e["name"] for e in entries}
    if options.command in ("run", "record") and unknown:
        sys.exit(f"conventions.py: no package {', '.join(unknown)} in conventions.toml; it has {', '.join(e['name'] for e in entries)}")
    if options.command == "table":
        PAGE.write_text(page(json.loads(FACTS.read_text(encoding="utf-8"))), encoding="utf-8")
        return False
    if options.command == "check":
        return check(entries)
    return held_out(entries, options) if options.command == "draw" else run(entries, options, options.command == "record")


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""store_point_files.py KOKSMA: no file that a pattern names may change without new rows of a study.

Each way in which a pattern names a file, a family of files, a program or a library (CASES) is run in a study, then the
file changes, and the study is run again. The new row must have another hash and the value that `koksma measure` gives now;
an audit must agree with the new row, and not compare the old one. File names have characters that
separate patterns in the text of an image: in that of a set of points they are part of the name.
"""
import csv
import io
import json
import os
import shutil
import subprocess

from files import Checks, koksma, own_folder

checks = Checks()
check = checks.check

INCLUDE = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../include"))
PLUGIN = """#include <koksma/plugin.h>
static int diagonal(uint64_t seed, size_t n, int dim, double *xs, char reason[KOKSMA_PLUGIN_REASON])
{
    (void)seed, (void)reason;
    for (size_t i = 0; i < n * (size_t)dim; i++) {
        xs[i] = ((double)(i / (size_t)dim) + %s) / (double)n;
    }
    return 0;
}
static const koksma_plugin plugin = {KOKSMA_PLUGIN_VERSION, "diagonal", 1, 9, diagonal};
const koksma_plugin *koksma_plugin_at(size_t i) { return i ? NULL : &plugin; }
"""
N = 8


def points(name, step):
    """A rank-1 lattice; the steps 3 and 1 have different discrepancies."""
    if os.path.dirname(name):
        os.makedirs(os.path.dirname(name), exist_ok=True)
    with open(name, "w") as file:
        file.writelines(f"{i / N} {step * i % N / N}\n" for i in range(N))


def library(name, step):
    with open("plugin.c", "w") as file:
        file.write(PLUGIN % (0.5 if step == 3 else 0.25))
    subprocess.run(["cc", "-shared", "-fPIC", "-I", INCLUDE, "plugin.c", "-o", "built.so"], check=True)
    os.makedirs(os.path.dirname(name) or ".", exist_ok=True)
    os.replace("built.so", name)


def program(name, step):
    with open(name, "w") as file:
        file.write("#!/bin/sh\ni=0\nwhile [ $i -lt $1 ]; do echo \"0.$i 0.$((i * %d %% 8))\"; i=$((i + 1)); done\n" % step)
    os.chmod(name, 0o755)


# Pattern, what writes its file, the file.
CASES = (
    *((f"file:{name}", points, name) for name in ("plain.txt", "a;b.txt", "a=b.txt", "a;b=c.txt", "a;lens=sobol", "lens=sobol",
                                                  "a;lens=file:b.txt", "a=file:b.txt", "pixel+lens=x;time=y.txt", "a ;lens=sobol",
                                                  "a:b;c=d")),
    ("file:fd/p;s=x_{seed}.txt", points, "fd/p;s=x_3.txt"),
    ("file:fn/lens=x_{n}.txt", points, f"fn/lens=x_{N}.txt"),
    ("plugin:./diagonal.so", library, "diagonal.so"),
    ("plugin:./named.so:diagonal", library, "named.so"),
    ("plugin:bare.so:diagonal", library, "bare.so"),
    ("plugin:./co:lon/d.so:diagonal", library, "co:lon/d.so"),
    ("plugin:./co:lon/e.so", library, "co:lon/e.so"),
    ("plugin:./d{n}.so", library, "d{n}.so"),
    ("plugin:./d{seed};lens=x.so:diagonal", library, "d{seed};lens=x.so"),
    ("exec:./p{n}_{seed}.sh", program, "p{n}_{seed}.sh"),
    ("exec:./p:a;lens=b.sh", program, "p:a;lens=b.sh"),
)


def plan(name, patterns, kind="discrepancies", trials=1):
    block = {"patterns": patterns, "measures": ["l2-star"], "n": [N], "trials": trials}
    if kind == "images":
        block = {"scenes": ["checker"], "patterns": patterns, "spp": [N], "size": [8, 6], "trials": trials,
                 "references": [{"name": "r", "pattern": "jittered", "spp": 4}]}
    with open(name, "w") as file:
        json.dump({"name": "p", "title": "p", kind: [block]}, file)
    return name


def rows(folder, plan_name):
    """Runs the plan and returns all rows of the study."""
    ran = koksma("study", "run", plan_name, "-o", folder, "-q", "--allow-exec")
    check(ran.returncode == 0, f"{plan_name}: {ran}")
    return list(csv.DictReader(io.StringIO(koksma("study", "export", folder, "-q").stdout)))


def measured(pattern):
    """The value of a pattern that is no family now."""
    told = koksma("measure", f"pattern:{pattern}@{N}", "-m", "l2-star", "--json", "--allow-exec")
    check(told.returncode == 0, f"{pattern}: {told}")
    return json.loads(told.stdout)["value"]


def change_each():
    for i, (pattern, write, name) in enumerate(CASES):
        write(name, 3)
        text = plan("./plan.json", [pattern])
        folder = f"study{i}"
        first = rows(folder, text)
        write(name, 1)
        second = rows(folder, text)
        check(len(first) == 1 and len(second) == 2 and len({row["scene_hash"] for row in second} - {"", 16 * "0"}) == 2,
              f"{pattern}: {len(first)} row, then {len(second)}, of {[row['scene_hash'] for row in second]}")
        value = measured(pattern.replace("{seed}", "3").replace("{n}", str(N)) if write is points else pattern)
        new = [float(row["value"]) for row in second if row["scene_hash"] not in {row["scene_hash"] for row in first}]
        check(new == [value], f"{pattern}: {new} is not {value}")
        told = koksma("study", "audit", folder, "--allow-exec")
        check(told.returncode == 0 and "1 rows drawn, of which 1 agree" in told.stdout and "not compared: 1 rows" in told.stdout, f"{pattern}: {told}")


def change_one_use():
    """In the text of an image the file of each use counts; a library's sampler has its name behind it."""
    points("use.txt", 3)
    library("use.so", 3)
    text = plan("./images.json", ["n-rooks;lens=file:use.txt;pixel=plugin:./use.so:diagonal"], "images")
    count = [len(rows("images", text))]
    for write, name in (points, "use.txt"), (library, "use.so"):
        write(name, 1)
        count.append(len(rows("images", text)))
    check(count[0] and count == [count[0], 2 * count[0], 3 * count[0]], f"rows of images: {count}")


def rename_of_a_family():
    """A set under another number is another set, whose rows have its seed."""
    points("ren/x_3.txt", 3)
    points("ren/x_5.txt", 1)
    text = plan("./ren.json", ["file:ren/x_{seed}.txt"], trials=5)
    check(sorted(row["seed"] for row in rows("renamed", text)) == ["3", "5"], "two seeds")
    os.rename("ren/x_5.txt", "ren/x_7.txt")
    check(sorted(row["seed"] for row in rows("renamed", text)) == ["3", "3", "5", "7"], "the renamed family has new rows")
    told = koksma("study", "audit", "renamed")
    check("2 rows drawn, of which 2 agree" in told.stdout and "not compared: 2 rows" in told.stdout, f"renamed: {told}")
    shutil.rmtree("renamed")
    rows("renamed", text)
    told = koksma("study", "audit", "renamed")
    check(told.returncode == 0 and "2 rows drawn, of which 2 agree" in told.stdout, f"a study begun anew: {told}")


with own_folder():
    for part in change_each, change_one_use, rename_of_a_family:
        part()
checks.end()

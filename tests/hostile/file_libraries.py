#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_libraries.py PROGRAM: only an integrand of the command line opens a shared library.

The library leaves a file behind as soon as it is opened. `koksma integrate ./LIBRARY.so` must open it, which shows that the
trap works. Then each place at which a scene, model, plan, stored spec or any other command names a file, a pattern, a measure or an
integrand is pointed at it, under endings that these places read as well: nothing may be left behind, and a place that can
be refused is refused with exit code 2 or 3 and a line. With sanitizers each place has one of the specs in turn.
"""
import itertools
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile

import file_inputs
import files

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../study"))
from reseal import reseal  # noqa: E402

SOURCE = """#include <fcntl.h>
#include <koksma/integrate.h>
__attribute__((constructor)) static void trap(void) { creat("opened", 0600); }
static double at(const double *x, int dim, void *context) { (void)dim, (void)context; return x[0]; }
static const koksma_function one = {"f", 1, 9, at, 0, .5};
const koksma_function *koksma_function_at(size_t i) { return i < 1 ? &one : 0; }
"""
SPECS = ("./trap.so", "./trap.so:f", "{}/trap.so", "{}/trap.so:f", "trap.so:f", "error of ./trap.so:f", "file:./trap.so",
         "net-file:./trap.so", "lattice-file:./trap.so")


def build(folder):
    source, library = (os.path.join(folder, name) for name in ("trap.c", "trap.so"))
    file_inputs.put(source, SOURCE)
    include = os.path.join(file_inputs.SOURCE, "include")
    subprocess.run(["cc", "-shared", "-fPIC", "-I", include, source, "-o", library], check=True)
    return library


def with_integrand(spec):
    """The plan of the other tests with an integrand beside its measure."""
    made = file_inputs.plan()
    made["discrepancies"][0]["integrands"] = [spec]
    return made


def with_measure(spec):
    made = file_inputs.plan()
    made["discrepancies"][0]["measures"] = [spec]
    return made


def commands(spec):
    """Those that take a spec: of a pattern, a measure or an integrand that is in no file's name."""
    yield ["generate", spec, "-n", "4"]
    yield ["measure", f"pattern:{spec}@4", "-m", "l2-star"]
    yield ["measure", "pattern:random@4", "-m", spec]
    yield ["integrate", "disk", "-p", spec, "-n", "4"]
    yield ["render", "checker", "-p", spec, "--size", "4x4", "-n", "1", "-q", "-o", "out.pfm"]
    yield ["render", spec, "-q", "-o", "out.pfm"]
    yield ["optimise", spec, "-n", "4", "--steps", "1", "-q", "-o", "out.txt"]
    yield ["study", "quick", "-p", spec, "-m", "star", "-n", "4", "--trials", "1", "-q", "-o", "quick"]
    yield ["study", "quick", "-p", "random", "--integrands", spec, "-n", "4", "--trials", "1", "-q", "-o", "quick"]
    yield ["study", "run", file_inputs.put("plan.json", file_inputs.plan(pattern=spec)), "-q", "-o", "out"]
    yield ["study", "run", file_inputs.put("plan.json", file_inputs.plan(scenes=[spec])), "-q", "-o", "out"]
    yield ["study", "run", file_inputs.put("plan.json", with_integrand(spec)), "-q", "-o", "out"]
    yield ["study", "run", file_inputs.put("plan.json", with_measure(spec)), "-q", "-o", "out"]


def change(folder, column, spec):
    """A stored study of an integrand's errors, of which a stranger wrote another spec and sealed it anew."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree("kept", folder)
    database = sqlite3.connect(folder + "/results.sqlite")
    database.execute(f"UPDATE series SET {column} = ? WHERE what LIKE 'error of%'", (spec,))
    database.commit()
    database.close()
    reseal(folder)


def main():
    program, checks = os.path.abspath(sys.argv[1]), files.Checks()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        library = build(folder)

        def opened(*arguments):
            """The run, and whether it has opened the library."""
            done = files.run(program, *arguments)
            found = os.path.exists("opened")
            if found:
                os.remove("opened")
            return done, found

        for spec in SPECS[:4]:
            done, found = opened("integrate", spec.format(folder), "random@4")
            checks.check(done.code == 0 and found, f"integrate {spec} opens it")
        for _, ending, what, arguments in file_inputs.named_by_files(folder) + file_inputs.named_by_user():
            name = "named" + ending
            shutil.copy(library, name)
            for path in (name, "trap.so")[files.SANITIZED:]:
                done, found = opened(*arguments(path))
                checks.check(not found and done.code in (1, 2, 3) and done.err, f"{what}: {path}: {done.code}, opened: {found}")
        for i, spec in files.each(range(len(list(commands("")))), SPECS):
            arguments = next(itertools.islice(commands(spec.format(folder)), i, None))  # it writes the plan that it names
            done, found = opened(*arguments)
            checks.check(not found and done.code in (2, 3), f"{arguments}: {done.code}, opened: {found}")
        file_inputs.put("plan.json", with_integrand("disk"))
        made, _ = opened("study", "run", "plan.json", "-q", "-o", "kept")
        checks.check(made.code == 0, f"a study: {made.err}")
        verbs = (["export"], ["report"], ["audit"], ["run", "plan.json", "-q", "-o"])
        for (column, verb), spec in files.each(itertools.product(("what", "pattern", "measured_by", "made_by"), verbs), SPECS):
            change("stored", column, spec.format(folder))
            done, found = opened("study", *verb, "stored")
            checks.check(not found and done.code in (0, 1, 2, 3), f"{column} {spec}: {verb[0]}: {done.code}, opened: {found}")
    checks.end()


if __name__ == "__main__":
    main()

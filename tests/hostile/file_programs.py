#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""file_programs.py PROGRAM FAULTS: patterns that run code, exec:PROGRAM and plugin:LIBRARY.

Without --allow-exec no command runs them or opens a library, whatever a spec, plan or stored study says: a marker file shows who ran. With it
the examples take part as other patterns do, with the same results on any threads and ranks. Programs that hang, fork, print
rubbish or too much, die or change their minds give one line and exit code 3; a mark in the environment, which every process
below inherits, shows in /proc that none of the group is left. With sanitizers each place of a spec has one of the specs in turn.
"""
import itertools
import json
import os
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import uuid

import file_inputs
import files


ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
MARK = "KOKSMA_TEST_" + uuid.uuid4().hex
os.environ[MARK] = "1"
POINTS = "echo 0.1 0.2; echo 0.3 0.4"  # two points of two dimensions

# NAME: what the program does, and words of the line.
BAD = {
    "hangs": ("sleep 1000", "ended after"),
    "hangs_on": ("trap '' TERM INT HUP; while :; do sleep 1000; done", "ended after"),
    "stopped": ("kill -STOP $$", "ended after"),
    "closes": ("exec >&- 2>&-; sleep 1000", "ended after"),
    "rubbish": ("echo '0.1 0.2'; echo 'here it is'", "line 2"),
    "binary": ("head -c 4096 /dev/zero", "control character"),
    "nothing": (":", "printed nothing"),
    "few": ("echo 0.1 0.2", "printed 1 points"),
    "many": (POINTS + "; echo 0.5 0.6", "printed 3 points"),
    "flat": ("echo 0.1; echo 0.2", "1 dimensions"),
    "edge": ("echo 0.1 0.2; echo 1 0.5", "coordinate of 1"),
    "outside": ("echo 0.1 0.2; echo -0.1 0.5", "outside"),
    "nan": ("echo 0.1 0.2; echo nan 0.5", "nan"),
    "endless": ("while :; do echo 0.1 0.2; done", "prints more than"),
    "torrent": ("cat /dev/zero", "prints more than"),
    "fails": ("echo 'the disk is full' >&2; exit 3", "exit code 3: the disk is full"),
    "escapes": ("printf 'a\\033[31mb\\n' >&2; exit 1", "exit code 1: a\\x1b[31mb"),
    "mutters": ("yes 2>/dev/null | head -c 9000000 >&2; echo last >&2; exit 1", "exit code 1: last"),
    "segv": (POINTS + "; kill -SEGV $$", "signal 11"),
    "killed": (POINTS + "; kill -KILL $$", "signal 9"),
    "clock": ("echo 0.1 0.2; echo 0.3 0.$(date +%N)1", "different points"),
}
# Programs with other processes: the points are right.
FORKS = {
    "background": "sleep 1000 & " + POINTS,
    "floods": "setsid sh -c 'yes >&2' & " + POINTS,  # ends by SIGPIPE
    "holds": POINTS + "; (sleep 1000) &",
    "bomb": "for i in 1 2 3 4 5 6 7 8; do (sleep 1000 & sh -c 'sleep 1000; sleep 1000' &); done; " + POINTS,
}
PLUGIN = """#include <koksma/plugin.h>
#include <stdio.h>
__attribute__((constructor)) static void opened(void) { fclose(fopen("ran", "w")); }
static int good(uint64_t seed, size_t n, int dim, double *xs, char *reason)
{ for (size_t i = 0; i < n * (size_t)dim; i++) xs[i] = 0.25; return 0; }
static int outside(uint64_t seed, size_t n, int dim, double *xs, char *reason) { for (size_t i = 0; i < n * (size_t)dim; i++) xs[i] = 1; return 0; }
static int unwritten(uint64_t seed, size_t n, int dim, double *xs, char *reason) { xs[0] = 0.5; return 0; }
static int fails(uint64_t seed, size_t n, int dim, double *xs, char *reason) { snprintf(reason, KOKSMA_PLUGIN_REASON, "only\\nprimes"); return 1; }
static int moods(uint64_t seed, size_t n, int dim, double *xs, char *reason) { static double x; for (size_t i = 0; i < n * (size_t)dim; i++) xs[i] = x += 1e-3; return 0; }
static const koksma_plugin all[] = {{1, "good", 1, 4, good}, {1, "outside", 1, 4, outside}, {1, "unwritten", 1, 4, unwritten},
  {1, "fails", 1, 4, fails}, {1, "moods", 1, 4, moods}, {1, "none", 1, 4, NULL}};
static const koksma_plugin other = {2, "other", 1, 4, good};
const koksma_plugin *koksma_plugin_at(size_t i) { return i < 6 ? &all[i] : i == 6 ? &other : NULL; }
"""


def write_program(name, body, interpreter="/bin/sh"):
    with open(name, "w", encoding="utf-8") as file:
        file.write(f"#!{interpreter}\n{body}\n")
    os.chmod(name, 0o755)


def marked():
    """The processes that have the mark, beside this one."""
    found = []
    for entry in os.listdir("/proc"):
        if entry.isdigit() and int(entry) != os.getpid():
            try:
                with open(f"/proc/{entry}/environ", "rb") as file:
                    found += [int(entry)] if MARK.encode() in file.read() else []
            except OSError:
                pass
    return found


def left():
    """The marked processes that do not end: a killed one may take a moment to go."""
    deadline = time.monotonic() + 600
    while marked() and time.monotonic() < deadline:
        time.sleep(0.01)
    return marked()


def compile_plugin(source, out):
    subprocess.run(["cc", "-shared", "-fPIC", "-w", "-O1", "-I", os.path.join(ROOT, "include"), "-o", out, source], check=True)


def plan(pattern, **more):
    return json.dumps({"name": "p", "title": "p", "discrepancies": [{"patterns": [pattern, "random"], "measures": ["l2-star"],
                       "n": [2], "trials": 3}], **more})


def check_permission(checks, program):
    write_program("mark", "touch ran; " + POINTS)
    with open("p.json", "w", encoding="utf-8") as file:
        file.write(plan("exec:./mark"))
    commands = (["generate", "{}", "-n", "2"], ["measure", "{}@2", "-m", "star"], ["integrate", "disk", "{}@2"], ["verify", "{}@2"],
                ["plot", "{}@2", "-o", "o.svg"], ["generate", "-p", "{}", "-n", "2"], ["curve", "power", "{}@2"],
                ["render", "ball", "-p", "{}", "-n", "2", "--size", "8x6", "-o", "o.pfm"], ["datasheet", "{}", "--quick", "-o", "sheet.html"])
    for command, spec in files.each(commands, ("exec:./mark", "plugin:./p.so", "plugin:./p.so:good", "exec:./mark,shift=1")):
        words = [word.replace("{}", spec) for word in command]
        checks.refused(" ".join(words), files.run(program, *words), 2, "--allow-exec")
    done = files.run(program, "rank", "ball", "-p", "exec:./mark,random", "--spp", "2", "--size", "8x6")
    checks.check(b"--allow-exec" in done.out + done.err, f"rank: {done.out} {done.err}")
    done = files.run(program, "study", "run", "p.json", "-o", "refused", "-q")
    checks.check(done.code == 2 and b"--allow-exec" in done.err, f"study run: {done.code} {done.err}")
    checks.refused("seconds alone", files.run(program, "generate", "random", "-n", "2", "--exec-seconds", "3"), 2, "--allow-exec")
    checks.check(not os.path.exists("ran"), "a program or library ran without --allow-exec")


# Specs that name a library, and may not open it.
LIBRARIES = "./p.so", "./p.so:f", "error of ./p.so:f", "file:./p.so", "net-file:./p.so", "lattice-file:./p.so"
# Of each command where a spec could stand: "{}" is the spec. A command without a row fails the test.
PLACES = {
    "list": [["{}"], ["patterns", "{}"]],
    "generate": [["{}", "-n", "2"], ["-p", "{}", "-n", "2"], ["{}", "-n", "2", "--first", "1"], ["{}", "-n", "2", "--warp", "polar-disk"],
                 ["{}"]],
    "measure": [["{}@2", "-m", "star"], ["pattern:{}@2", "-m", "star"], ["{}", "-m", "star"], ["pattern:random@2", "-m", "{}"],
                ["{}@2", "-m", "star", "--trials", "2", "--threads", "2"]],
    "integrate": [["{}", "random@4"], ["disk", "-p", "{}", "-n", "2"], ["disk", "{}@2"], ["disk", "-p", "random,{}", "-n", "2", "-t", "3", "--threads", "2"]],
    "optimise": [["star", "--from", "{}", "-o", "o.txt"], ["{}", "-n", "4", "-o", "o.txt"], ["star", "-n", "2", "-p", "{}", "-o", "o.txt"]],
    "curve": [["power", "{}@2"], ["{}", "random@4"]],
    "verify": [["{}@2"], ["{}"]],
    "identify": [["{}@2"], ["{}"]],
    "mask": [["check", "{}"], ["-o", "m.png", "--size", "8x8", "--swaps", "1", "--from", "{}"], ["-o", "m.png", "--filter", "{}"]],
    "plot": [["{}@2", "-o", "o.svg"], ["random@2", "{}@2", "-o", "o.svg"]],
    "render": [["ball", "-p", "{}", "-n", "2", "--size", "8x6", "-o", "o.pfm"], ["{}", "-n", "2", "-o", "o.pfm"],
               ["ball", "-p", "random;lens={}", "-n", "2", "--size", "8x6", "-o", "o.pfm"],
               ["ball", "-p", "random;pixel+time={}", "-n", "2", "--size", "8x6", "-o", "o.pfm"],
               ["ball", "-p", "{}", "-n", "8", "--size", "8x6", "--adaptive", "variance", "-o", "o.pfm"],
               ["ball", "-p", "{}", "-n", "2", "--size", "8x6", "--threads", "4", "--scope", "image", "-o", "o.pfm"]],
    "scene": [["check", "{}"]],
    "compare": [["{}", "{}"]],
    "atlas": [["submit", "{}@4", "--author", "A", "-o", "e.json"], ["check", "{}"], ["build", "{}", "-o", "q"], ["build", "a.json", "-o", "q"]],
    "rank": [["ball", "-p", "{},random", "--spp", "2", "--size", "8x6"], ["ball", "-p", "{}", "--spp", "2", "--size", "8x6"], ["{}"]],
    "datasheet": [["{}", "--quick", "-o", "s.html"], ["random", "{}", "--quick", "-o", "s.html"]],
    "study": [["quick", "-p", "{}", "-n", "2", "--trials", "2", "-o", "q"], ["quick", "-p", "random", "-m", "{}", "-n", "2", "-o", "q"],
              ["quick", "-p", "random", "-n", "2", "--scene", "{}", "-o", "q"], ["estimate", "a.json"], ["run", "a.json", "-o", "q"],
              ["run", "{}", "-o", "q"], ["report", "{}"], ["audit", "{}"], ["export", "{}"]],
    "reproduce": [["{}", "-o", "q"], ["./a.json", "-o", "q"]],
    "completion": [["{}"]],
    "manual": [["{}"]],
    "help": [["{}"]],
    "version": [["{}"]],
}


def plans(spec):
    """Plans with the spec wherever a plan has one for a pattern, or could."""
    points = {"patterns": ["random"], "measures": ["l2-star"], "n": [2], "trials": 2}
    image = {"id": "i", "scenes": ["ball"], "patterns": ["random"], "spp": [2], "size": [4, 3], "trials": 2,
             "references": [{"name": "r", "pattern": "random", "spp": 4, "replicates": 2}]}
    yield {"discrepancies": [{**points, "patterns": [spec]}]}
    yield {"discrepancies": [{**points, "patterns": [spec + ",shift=1"], "integrands": ["disk"]}]}
    yield {"discrepancies": [{**points, "measures": [spec]}]}
    yield {"discrepancies": [{**points, "integrands": [spec]}]}
    yield {"images": [{**image, "patterns": [spec]}]}
    yield {"images": [{**image, "patterns": ["random;lens=" + spec]}]}
    yield {"images": [{**image, "scenes": [spec]}]}
    yield {"images": [{**image, "references": [{"name": "r", "pattern": spec, "spp": 2, "replicates": 2}]}]}
    yield {"discrepancies": [points], "figures": [{"id": "1", "title": "t", "pattern": spec, "n": 2}]}
    yield {"images": [image], "figures": [{"id": "1", "title": "t", "pattern": spec, "n": 2, "scene": "ball"}]}
    yield {"discrepancies": [points], "tables": [{"id": "1", "title": "t", "measure": "l2-star", "n": 2, "rows": [
        {"pattern": spec, "label": "x", "published": ["0.1"]}]}]}
    yield {"discrepancies": [points], "allow-exec": True, "comment": "--allow-exec"}
    yield {"discrepancies": [{**points, "patterns": [spec], "options": {"allow-exec": ["yes"]}}]}


def check_every_command(checks, program):
    """No command, plan or stored study runs a program or opens a library without the option, on any thread."""
    said = files.run(program, "--help").out.decode()
    names = re.findall("^  ([a-z]+)  +[a-z]", said, re.M)
    checks.check(sorted(names) == sorted(PLACES), f"commands without a row: {sorted(set(names) ^ set(PLACES))}")
    write_program("mark", "touch ran; " + POINTS)
    with open("d.pfm", "wb") as file:
        file.write(b"Pf\n1 1\n-1.0\n\0\0\x80?")
    with open("t.obj", "w", encoding="utf-8") as file:
        file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    for _, ending, what, arguments in file_inputs.named_by_files(os.getcwd()) + file_inputs.named_by_user():
        shutil.copy("p.so", "named" + ending)
        done = files.run(program, *arguments("named" + ending))
        checks.check(not os.path.exists("ran") and done.code in (1, 2, 3) and done.err, f"{what}: {done.code}, opened")
    specs = ("exec:./mark", "plugin:./p.so", "plugin:./p.so:good", f"exec:{os.getcwd()}/mark", *LIBRARIES)
    for (command, row), spec in files.each([(command, row) for command, rows in PLACES.items() for row in rows], specs):
        with open("a.json", "w", encoding="utf-8") as file:
            file.write(plan(spec))
        words = [word.replace("{}", spec) for word in row]
        done = files.run(program, command, *words)
        checks.check(not os.path.exists("ran") and done and done.code in (0, 1, 2, 3), f"{command} {words}: {done and done.code}, ran")
    for i, spec in files.each(range(len(list(plans("")))), specs):
        one = list(plans(spec))[i]
        with open("a.json", "w", encoding="utf-8") as file:
            json.dump({"name": "p", "title": "p", **one}, file)
        for words in ["run", "a.json", "-o", "stored"], ["estimate", "a.json"], ["report", "stored"], ["audit", "stored"], ["export", "stored"]:
            done = files.run(program, "study", *words, "-q" if words[0] == "run" else "--quiet")
            checks.check(not os.path.exists("ran") and done and done.code in (0, 1, 2, 3), f"{one}: {words}: {done and done.code}, ran")
        shutil.rmtree("stored", ignore_errors=True)


def check_rows(checks, program):
    """A stored study of a harmless pattern, in whose rows a stranger wrote the spec."""
    with open("a.json", "w", encoding="utf-8") as file:
        file.write(plan("jittered:columns=1"))
    checks.check(files.run(program, "study", "run", "a.json", "-o", "kept", "-q").code == 0, "a study")
    verbs = ["export"], ["report"], ["audit", "--rows", "all"], ["run", "a.json", "-q", "-o"]
    for (verb, column), spec in files.each(itertools.product(verbs, ("what", "pattern", "made_by", "measured_by")), ("exec:./mark", "plugin:./p.so:good", *LIBRARIES)):
        shutil.rmtree("stored", ignore_errors=True)
        shutil.copytree("kept", "stored")
        database = sqlite3.connect("stored/results.sqlite")
        database.execute(f"UPDATE series SET {column} = ? WHERE pattern LIKE 'jittered%'", (spec,))
        database.commit()
        database.close()
        done = files.run(program, "study", *verb, "stored")
        checks.check(not os.path.exists("ran") and done and done.code in (0, 1, 2, 3), f"{column} {spec}: {verb}: {done and done.code}, ran")
    shutil.rmtree("stored", ignore_errors=True)


def check_paths(checks, program):
    """Plans in other folders name the file that the user meant, of every pattern that has one."""
    os.makedirs("folder", exist_ok=True)
    with open("net.txt", "w", encoding="utf-8") as file:
        file.write("# soboljk\n2 1 0 1\n")
    with open("lattice.txt", "w", encoding="utf-8") as file:
        file.write("# lattice\n2\n16\n1\n5\n")
    with open("points.txt", "w", encoding="utf-8") as file:
        file.write(".1 .2\n.3 .4\n")
    specs = "exec:./mark", "exec:mark", "plugin:./p.so", "plugin:p.so:good", "net-file:net.txt", "lattice-file:./lattice.txt", "file:points.txt"
    for spec in specs:
        kind, path = spec.split(":", 1)
        with open("folder/a.json", "w", encoding="utf-8") as file:
            file.write(plan(kind + ":../" + path))
        done = files.run(program, "study", "run", "folder/a.json", "-q", "-o", "quick2", "--allow-exec")
        checks.check(done.code == 0, f"a plan in another folder, {spec}: {done.code} {done.err}")
        shutil.rmtree("quick2", ignore_errors=True)
        with open("folder/a.json", "w", encoding="utf-8") as file:
            json.dump({"name": "p", "title": "p", "images": [{"id": "i", "scenes": ["ball"], "patterns": [f"random;lens={kind}:../{path}"],
                       "spp": [2], "size": [4, 3], "trials": 1, "references": [{"name": "r", "pattern": "random", "spp": 4, "replicates": 2}]}]}, file)
        done = files.run(program, "study", "run", "folder/a.json", "-q", "-o", "quick2", "--allow-exec")
        checks.check(done.code == 0, f"a use of a plan in another folder, {spec}: {done.code} {done.err}")
        shutil.rmtree("quick2", ignore_errors=True)
    os.path.exists("ran") and os.remove("ran")


def check_study(checks, program):
    """A stored study: export and report without running, audit only with the word; any threads."""
    figure = [{"id": "1", "title": "t", "pattern": "exec:./mark", "n": 2}]
    with open("s.json", "w", encoding="utf-8") as file:
        file.write(plan("exec:./mark", figures=figure))
    done = files.run(program, "study", "run", "s.json", "-o", "one", "-q", "--threads", "1", "--allow-exec")
    checks.check(done.code == 0 and os.path.exists("ran"), f"study run: {done.code} {done.err}")
    done = files.run(program, "study", "run", "s.json", "-o", "four", "-q", "--threads", "4", "--allow-exec")
    os.remove("ran")
    rows = [files.run(program, "study", "export", folder) for folder in ("one", "four")]
    checks.check(done.code == 0 and rows[0].out == rows[1].out and rows[0].out.count(b"exec:./mark") == 3, f"threads: {done.err} {rows[0].out}")
    done = files.run(program, "study", "report", "one", "-q")
    checks.check(done.code == 0, f"report: {done.code} {done.err}")
    with open("one/report.html", encoding="utf-8") as file:
        checks.check("needs --allow-exec" in file.read(), "the report does not say why it draws no points")
    done = files.run(program, "study", "audit", "one", "--rows", "all", "-q")
    checks.check(done.code != 0 and b"--allow-exec" in done.out + done.err, f"audit: {done.code} {done.out} {done.err}")
    checks.check(not os.path.exists("ran"), "report, export or audit ran a program")
    done = files.run(program, "study", "audit", "one", "--rows", "all", "-q", "--allow-exec")
    checks.check(done.code == 0 and os.path.exists("ran"), f"audit --allow-exec: {done.code} {done.out} {done.err}")


def check_ranks(checks, program):
    allow = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
    try:
        version = files.run("mpirun", "-n", "1", program, "version", env=allow)
    except FileNotFoundError:
        return
    if b"MPI: " not in version.out or b"MPI: left out" in version.out:
        return
    for options, code in (["--allow-exec"], 0), ([], 2):
        done = files.run("mpirun", "-n", "3", program, "study", "run", "s.json", "-o", f"ranks{code}", "-q", *options, env=allow)
        checks.check(done.code == code, f"ranks: {done.code} {done.err}")
    rows = [files.run(program, "study", "export", folder) for folder in ("one", "ranks0")]
    checks.check(rows[0].out == rows[1].out, "ranks give other rows than one process")
    checks.check(b"exec" not in files.run(program, "study", "export", "ranks2").out, "ranks ran a program without --allow-exec")


def check_bad(checks, program):
    for name, (body, words) in BAD.items():
        write_program(name, body)
        seconds = "0.5" if words == "ended after" else "100"
        done = files.run(program, "generate", f"exec:./{name}", "-n", "2", "--allow-exec", "--exec-seconds", seconds)
        checks.refused(name, done, 3, f"exec:./{name}: ", words)
        checks.check(not left(), f"{name}: processes are left: {marked()}")
    write_program("hog", "x = bytearray(16 << 30)", sys.executable)
    checks.refused("hog", files.run(program, "generate", "exec:./hog", "-n", "2", "--allow-exec"), 3, "MemoryError")
    with open("text", "w", encoding="utf-8") as file:
        file.write("echo 0.1 0.2\n")
    checks.refused("not executable", files.run(program, "generate", "exec:./text", "-n", "2", "--allow-exec"), 3, "ermission")
    os.chmod("text", 0o755)
    checks.refused("no #!", files.run(program, "generate", "exec:./text", "-n", "2", "--allow-exec"), 3, "#!")
    checks.refused("missing", files.run(program, "generate", "exec:./absent", "-n", "2", "--allow-exec"), 3, "No such file")
    checks.refused("a folder", files.run(program, "generate", "exec:.", "-n", "2", "--allow-exec"), 3, "ermission")
    checks.refused("the search path", files.run(program, "generate", "exec:true", "-n", "2", "--allow-exec"), 3, "No such file")
    for name, body in FORKS.items():
        write_program(name, body)
        done = files.run(program, "generate", f"exec:./{name}", "-n", "2", "--allow-exec")
        checks.check(done.code == 0 and not left(), f"{name}: {done.code} {done.err}, left: {marked()}")


def check_signals(checks, program):
    """Ctrl-C and SIGTERM end the program and its children."""
    for number, code in (signal.SIGINT, 130), (signal.SIGTERM, 130):
        if os.path.exists("started"):
            os.remove("started")
        write_program("starts", "sleep 1000 & touch started; sleep 1000")
        process = subprocess.Popen([program, "generate", "exec:./starts", "-n", "2", "--allow-exec", "--exec-seconds", "600"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not os.path.exists("started") and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(number)
        checks.check(process.wait() == code, f"{number}: {process.returncode}")
        checks.check(not left(), f"{number}: processes are left: {marked()}")


def check_plugins(checks, program):
    run = lambda spec, *more: files.run(program, "generate", spec, "-n", "2", "--allow-exec", *more)
    checks.check(run("plugin:./p.so").code == 0 and run("plugin:p.so:good").code == 0, "plugin: the good one")
    for name, code, words in (("outside", 3, "is 1;"), ("unwritten", 3, "coordinate 1 of point 0"), ("fails", 2, "dim = 2: only"),
                              ("moods", 3, "different points"), ("none", 3, "no function"), ("other", 3, "no function")):
        checks.refused(name, run(f"plugin:./p.so:{name}"), code, words)
    checks.refused("dimensions", run("plugin:./p.so", "-d", "5"), 2, "dim = 1 to 4")
    with open("old.c", "w", encoding="utf-8") as file:
        file.write(PLUGIN.replace("{1, \"good\"", "{7, \"good\""))
    compile_plugin("old.c", "old.so")
    checks.refused("version", run("plugin:./old.so"), 3, "version 7")
    with open("empty.c", "w", encoding="utf-8") as file:
        file.write("int nothing;\n")
    compile_plugin("empty.c", "empty.so")
    checks.refused("no entry", run("plugin:./empty.so"), 3, "koksma_plugin_at")
    checks.refused("no library", run("plugin:./p.json"), 3, "can't be loaded")
    checks.refused("missing", run("plugin:./absent.so"), 3, "no file")
    checks.refused("not found by name", run("plugin:libm.so.6"), 3, "no file ./libm.so.6")


def check_examples(checks, program):
    examples = os.path.join(ROOT, "examples", "samplers")
    compile_plugin(os.path.join(examples, "rank1.c"), "rank1.so")
    for spec in (f"exec:{examples}/stratified.py", f"exec:{examples}/weyl.sh", "plugin:./rank1.so", "plugin:rank1.so:shifted"):
        done = files.run(program, "generate", spec, "-n", "64", "-d", "3", "--seed", "9", "--allow-exec", "-o", "o.txt")
        again = files.run(program, "measure", "o.txt", f"{spec}@64@3", "-m", "l2-star,star", "--json", "--allow-exec")
        checks.check(done.code == 0 and again.code == 0 and again.out.count(b"value") == 4, f"{spec}: {done.err} {again.err}")
        done = files.run(program, "render", "ball", "-p", f"{spec},shift=1", "-n", "4", "--size", "4x3", "-q", "--allow-exec", "-o", "o.pfm")
        checks.check(done.code == 0, f"render {spec}: {done.err}")
    done = files.run(program, "measure", "plugin:./rank1.so@64", "korobov:a=17@64", "-m", "l2-star", "--json", "--allow-exec")
    values = [json.loads(line)["value"] for line in done.out.splitlines()]
    checks.check(len(values) == 2 and values[0] == values[1], f"a lattice by both: {done.out} {done.err}")


def main():
    program = os.path.abspath(sys.argv[1])
    checks = files.Checks()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        with open("p.c", "w", encoding="utf-8") as file:
            file.write(PLUGIN)
        compile_plugin("p.c", "p.so")
        for check in check_permission, check_every_command, check_rows, check_paths, check_study, check_ranks, check_bad, check_signals, check_plugins, check_examples:
            check(checks, program)
        os.chdir("/")
    checks.end()


main()

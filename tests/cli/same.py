#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""same.py KOKSMA: options mean the same in all commands. Walks the command table: a letter stands for one option everywhere;
-n N, -p PATTERN, SPEC@N and pattern:SPEC@N are the same points for every command that takes a pattern, and `all` is taken
by every list of patterns or measures; every command that writes refuses a file whose ending it does not know, before it
works, and names those that it does."""
import os
import re
import subprocess
import sys
import tempfile

KOKSMA = os.path.abspath(sys.argv[1])
failures = []
# Options of one letter that have two names, by what they take: a set's points or a pixel's samples, a measure of
# points or of an image's error, one or a list.
TWO_NAMES = {"n": {"n", "spp"}, "p": {"patterns", "pattern"}, "m": {"measures", "measure", "metric"}}


def check(good, what):
    """Notes a failure."""
    if not good:
        failures.append(what)


def ask(*arguments):
    """A run of the program."""
    return subprocess.run([KOKSMA, *arguments], capture_output=True, text=True, check=False)


def result(path, *arguments):
    """What a command line gives, without the name of its source and its time: stdout, and the file that it writes."""
    done = ask(*arguments)
    check(done.returncode == 0, f"{arguments}: {done.returncode}, {done.stderr}")
    text = re.sub(r'"(source|seconds)":("[^"]*"|[0-9.e-]*)', "", done.stdout)
    if not path:
        return text
    with open(path, "rb") as file:
        return text, re.sub(rb"(pattern:)?sobol(@16)?", b"", file.read())


# How each command takes points of sobol: words before and behind, where the pattern comes, and the file that it writes.
OPERAND, OPTION, BEHIND = "operand", "option", "behind another operand"
TAKES = {
    "generate": (OPERAND, [], ["-o", "out.txt"], "out.txt"),
    "measure": (OPERAND, [], ["--json"], None),
    "verify": (OPERAND, [], ["--json"], None),
    "identify": (OPERAND, [], ["--json"], None),
    "curve": (OPERAND, ["power"], ["--json"], None),
    "plot": (OPERAND, [], ["-o", "out.svg"], "out.svg"),
    "render": (OPTION, ["ball"], ["--size", "16x12", "-o", "out.pfm", "--json"], "out.pfm"),
    "integrate": (BEHIND, ["disk"], ["--json"], None),
    "rank": (OPTION, ["ball"], ["--size", "16x12", "--max-trials", "8", "--one-size", "-q", "--json"], None),
}
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    helps = {name: ask(name, "--help").stdout for name in re.findall(r"^  ([a-z]+)  ", ask("--help").stdout, re.M)}
    check(len(helps) > 15, f"only {list(helps)}")
    letters = {}
    for name, text in helps.items():
        for letter, option in re.findall(r"^  -([a-z]), --([a-z-]+)", text, re.M):
            letters.setdefault(letter, {}).setdefault(option, []).append(name)
        listed = re.findall(r"--(patterns|measures) ((?:PATTERN|MEASURE),\.\.\S*)", text)
        check(all(argument.strip("]").endswith("|all") for _, argument in listed), f"{name}: 'all' is not taken: {listed}")
        takes = re.search(r"SPEC@N", text.split("\n\n")[1]) or re.search(r"^  -p, ", text, re.M)
        # a study has plans, and atlas submits one set
        check(not takes or name in (*TAKES, "study", "atlas"), f"{name} takes patterns, and is not tested here")
    for letter, names in letters.items():
        check(len(names) == 1 or set(names) == TWO_NAMES.get(letter), f"-{letter} is {names}")
    for name, (kind, before, behind, path) in TAKES.items():
        if kind == OPERAND:
            ways = (["sobol@16"], ["pattern:sobol@16"], ["sobol", "-n", "16"], ["pattern:sobol", "-n", "16"], ["-p", "sobol", "-n", "16"],
                    ["-p", "sobol@16"], ["-p", "pattern:sobol@16"], ["sobol@16@2"], ["sobol", "-n", "16", "-d", "2"])
        elif kind == BEHIND:
            ways = (["sobol@16"], ["pattern:sobol@16"], ["-p", "sobol", "-n", "16"], ["-p", "sobol@16"], ["-p", "pattern:sobol@16"], ["sobol@16@2"])
        else:
            ways = (["-p", "sobol", "-n", "16"], ["-p", "sobol@16"], ["-p", "pattern:sobol@16"], ["-n", "16", "-p", "sobol@16"])
        results = [result(path, name, *before, *way, *behind) for way in ways]
        for way, found in zip(ways, results):
            check(found == results[0] and results[0], f"{name} {way} is not {name} {ways[0]}")
        for wrong, says in ((["-p", "sobl@16"], "did you mean 'sobol'"), (["sobol@16", "-n", "4"] if kind == OPERAND else ["-p", "sobol@16", "-n", "4"], "-n 4")):
            done = ask(name, *before, *wrong, *behind)
            check(done.returncode == 2 and says in done.stderr.replace("-n is 4", "-n 4"), f"{name} {wrong}: {done.returncode}, {done.stderr}")
    optima = [result("o.txt", "optimise", "l2-star", "--steps", "1", *way, "-o", "o.txt", "--json") for way in (
        ["--from", "sobol", "-n", "16"], ["--from", "sobol@16"], ["--from", "pattern:sobol@16"], ["--from", "pattern:sobol", "-n", "16"])]
    check(all(found == optima[0] for found in optima), "optimise --from")
    every = ask("measure", "-p", "all", "-n", "16", "-m", "star")
    check(every.returncode == 0 and len(every.stdout.splitlines()) > 25 and "leaves out" in every.stderr, f"-p all: {every.stderr}")

    # Files to write, by the nouns of options and operands.
    writes = {"generate": ["sobol@4", "-o"], "optimise": ["star", "-n", "4", "--steps", "1", "-o"], "curve": ["power", "sobol@16", "-o"],
              "plot": ["sobol@16", "-o"], "datasheet": ["sobol", "-o"], "render": ["ball", "-o"], "compare": ["a.pfm", "b.pfm", "-o"],
              "mask": ["--size", "8x8", "--swaps", "1", "-o"], "atlas": ["submit", "sobol@4@2", "--author", "A", "-o"]}
    folders = ("reproduce", "study")
    for name, text in helps.items():
        output = re.search(r"^  -o, --output (\S+)", text, re.M)
        check(not output or name in writes or name in folders, f"{name} writes, and is not tested here")
        for option, endings in re.findall(r"^ +(?:-\w, )?--([a-z-]+) FILE((?:\|?\.[a-z]+)+)", text, re.M):
            check(name in writes, f"{name} --{option} {endings}")
    lines = [[name, *line] for name, line in writes.items()] + [["study", "new"], ["study", "export", "x", "-o"],
                                                                ["render", "ball", "-o", "a.pfm", "--counts"]]
    for line in lines:
        for wrong in ("out.foo", "out.d/out.txtx", "out.npy.bak"):
            done = ask(*line, wrong)
            check(done.returncode == 2 and re.search(r" ends in \.\w+|\.\w+ or \.", done.stderr), f"{line} {wrong}: {done.returncode}, {done.stderr}")
            check(not os.path.exists(wrong) and not os.path.exists("a.pfm"), f"{line} {wrong}: it is written")
    subprocess.run([KOKSMA, "generate", "sobol@4", "-o", "out"], check=True)  # without an ending: text
    check(os.path.getsize("out"), "no file 'out'")
print("\n".join(failures) or f"{len(helps)} commands")
sys.exit(bool(failures))

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""misspellings.py KOKSMA: the program suggests the word that was meant. Of 200 random misspellings (a letter left out,
put in, replaced, or two neighbours swapped) of the names of commands, options, patterns and measures, fifty of each, at
least 95 % are answered with the right name. A misspelling that is itself a name or an abbreviation is drawn again, and
where another name is just as near as the one meant (pmj0 is one letter from pmj02), that one is right, too. Then 100
of scenes, parameters, and words of closed lists: values of parameters and options, verbs, uses."""
import json
import random
import re
import string
import subprocess
import sys

KOKSMA = sys.argv[1]
SEED = 20261123
OPTIONS_OF = "measure"


def output(*arguments):
    return subprocess.run([KOKSMA, *arguments], capture_output=True, text=True, check=False)


def listed(table):
    return [json.loads(line) for line in output("list", table, "--json").stdout.splitlines()]


def names(table, key):
    return [row[key] for row in listed(table)]


def misspell(word, rng):
    at, letter = rng.randrange(len(word)), rng.choice(string.ascii_lowercase)
    swapped = word[:at] + word[at + 1:at + 2] + word[at:at + 1] + word[at + 2:]
    return rng.choice([word[:at] + word[at + 1:], word[:at] + letter + word[at:], word[:at] + letter + word[at + 1:], swapped])


def one_edit(a, b):
    """By the definition: whether one edit makes b of a."""
    letters = set(a) | set(b)
    edits = {a[:i] + a[i + 1:] for i in range(len(a))} | {a[:i] + a[i + 1:i + 2] + a[i:i + 1] + a[i + 2:] for i in range(len(a))}
    edits |= {a[:i] + c + a[i + k:] for i in range(len(a) + 1) for k in (0, 1) for c in letters}
    return b in edits


def answered(rng, draws, what):
    """Whether 95 % of misspellings are answered with the right name; draws: kind, known names, the command line."""
    wrong = []
    for kind, known, line in draws:
        if len(known) < (10 if what == "names" else 2):
            sys.exit(f"only {len(known)} names of kind {kind} were found: {known}")
        word = rng.choice(known)
        bad = misspell(word, rng)
        while not bad or bad in known or any(name.startswith(bad) for name in known) or bad.startswith("-"):
            bad = misspell(word := rng.choice(known), rng)
        answer = output(*line(bad))
        if answer.returncode != 2:
            sys.exit(f"{line(bad)}: exit code {answer.returncode}, not 2")
        said = re.search(r"did you mean '?(?:--)?([a-z0-9-]+)'?\?", answer.stderr)
        if not said or said[1] != word and not (one_edit(bad, said[1]) and said[1] in known):
            wrong.append(f"{bad} for {word}: {answer.stderr.strip()}")
    print(f"{len(draws) - len(wrong)} of {len(draws)} misspelt {what} were answered with the right one", *wrong, sep="\n")
    return len(wrong) <= len(draws) / 20


def main():
    rng = random.Random(SEED)
    commands = re.findall(r"^  ([a-z]+)  ", output("--help").stdout, re.M)
    options = re.findall(r"^  (?:-.,|   ) --([a-z-]+)", output(OPTIONS_OF, "--help").stdout, re.M)
    kinds = {
        "command": (commands, lambda w: [w]),
        "option": (options, lambda w: [OPTIONS_OF, f"--{w}", "pattern:random@4"]),
        "pattern": (names("patterns", "pattern"), lambda w: ["generate", w, "-n", "4"]),
        "measure": (names("measures", "measure"), lambda w: ["measure", "-m", w, "pattern:random@4"]),
    }
    words = {  # of closed lists, which may be short
        "scene": (names("scenes", "scene"), lambda w: ["render", w, "-o", "x.pfm"]),
        "parameter": ([row["parameter"] for row in listed("parameters") if row["of"] in ("sobol", "any pattern")],
                      lambda w: ["generate", f"sobol:{w}=1", "-n", "4"]),
        "scrambling": (["none", "digital-shift", "lms", "owen", "hash-owen"], lambda w: ["generate", f"sobol:scramble={w}", "-n", "4"]),
        "law": (["isotropic", "mitchell"], lambda w: ["measure", "-m", f"l2-edge:law={w}", "random@4"]),
        "path": (["steps", "bridge"], lambda w: ["integrate", f"asian:path={w}", "-p", "random", "-n", "4"]),
        "table": (["patterns", "measures", "integrands", "scenes", "warps"], lambda w: ["list", w]),
        "verb": (["estimate", "export", "report", "audit", "images"], lambda w: ["study", w]),
        "property": (names("properties", "property"), lambda w: ["verify", "random@4", "-e", w]),
        "curve": (["power", "rings", "quality", "screen", "pairs"], lambda w: ["curve", w, "random@4"]),
        "drawn curve": (["rings", "anisotropy", "convergence"], lambda w: ["plot", "random@4", "-c", w, "-o", "x.svg"]),
        "warp": (names("warps", "warp"), lambda w: ["measure", "random@4", "--warp", w]),
        "pairing": (["shuffled", "aligned", "native"], lambda w: ["render", "ball", "--pairing", w, "-o", "x.pfm"]),
        "use": (["pixel", "lens", "time", "light-choice", "roulette"], lambda w: ["render", "ball", "-p", f"{w}=random", "-o", "x.pfm"]),
        "progress": (["auto", "always", "never"], lambda w: ["generate", "random", "-n", "4", "--progress", w]),
        "plan": (names("plans", "plan"), lambda w: ["reproduce", w, "-o", "x"]),
        "page": (commands, lambda w: ["manual", w]),
        "shell": (["bash", "zsh", "fish"], lambda w: ["completion", w]),
    }
    of_names = answered(rng, [(kind, *kinds[kind]) for kind in kinds for _ in range(50)], "names")
    return 0 if answered(rng, [(kind, *words[kind]) for kind in (list(words) * 6)[:100]], "words of lists") and of_names else 1


sys.exit(main())

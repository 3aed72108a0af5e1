#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""misspellings.py KOKSMA: the program suggests the word that was meant. Of 200 random misspellings (a letter left out,
put in, replaced, or two neighbours swapped) of the names of commands, options, patterns and measures, fifty of each, at
least 95 % are answered with the right name. A misspelling that is itself a name or an abbreviation is drawn again, and
where another name is just as near as the one meant (pmj0 is one letter from pmj02), that one is right, too."""
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


def names(table, key):
    return [json.loads(line)[key] for line in output("list", table, "--json").stdout.splitlines()]


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
    right, wrong = 0, []
    for kind, (known, line) in kinds.items():
        if len(known) < 10:
            sys.exit(f"only {len(known)} names of kind {kind} were found: {known}")
        for _ in range(50):
            word = rng.choice(known)
            bad = misspell(word, rng)
            while not bad or bad in known or any(name.startswith(bad) for name in known) or bad.startswith("-"):
                bad = misspell(word := rng.choice(known), rng)
            answer = output(*line(bad))
            if answer.returncode != 2:
                sys.exit(f"{line(bad)}: exit code {answer.returncode}, not 2")
            said = re.search(r"did you mean '?(?:--)?([a-z0-9-]+)'?\?", answer.stderr)
            if said and (said[1] == word or one_edit(bad, said[1]) and said[1] in known):
                right += 1
            else:
                wrong.append(f"{bad} for {word}: {answer.stderr.strip()}")
    print(f"{right} of 200 misspellings were answered with the right name", *wrong, sep="\n")
    return 0 if right >= 190 else 1


sys.exit(main())

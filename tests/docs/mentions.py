#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""mentions.py PROGRAM: every command line that a document shows, run elsewhere or not, has a command and options that
exist, and every pattern:SPEC, scene and table in it is known."""
import re
import subprocess
import sys
from pathlib import Path

PROGRAM, ROOT = str(Path(sys.argv[1]).resolve()), Path(__file__).resolve().parent.parent.parent
helps, failures, count = {}, [], 0


def ask(*arguments):
    """What the program prints, and its exit code."""
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
    return done.stdout, done.returncode


known = {m[1] for m in re.finditer(r"^  (\w+) ", ask("--help")[0], re.M)}
documents = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
for document in documents:
    text = (ROOT / document).read_text(encoding="utf-8").replace("\n", " \n")
    lines = [m[1] for m in re.finditer(r"`(koksma [^`]+)`", text, re.S)]
    lines += [m[1] for m in re.finditer(r"^(?:    |\$ )?(?:mpirun -n \d+ |srun \S+ )?(koksma .*)$", text, re.M)]
    for line in lines:
        words = line.split(" #")[0].split("|")[0].split()
        command = words[1] if len(words) > 1 else ""
        if command not in known:
            if re.fullmatch(r"[a-z]+", command):
                failures.append(f"{document}: no command {command}: {line.strip()}")
            continue
        count += 1
        if command not in helps:
            helps[command] = ask(command, "--help")[0]
        for word in words[2:]:
            option = re.match(r"(--?[a-z][a-z-]*)", word)
            if option and not re.search(rf"(^|[ ,]){re.escape(option[1])}\b", helps[command], re.M):
                failures.append(f"{document}: {command} has no {option[1]}: {line.strip()}")
            for spec in re.findall(r"^pattern:([^@\s]+)@\d+", word):
                if ask("generate", spec, "-n", "16", "-q")[1] and ask("generate", spec, "-n", "25", "-q")[1]:
                    failures.append(f"{document}: no pattern {spec}: {line.strip()}")
print("\n".join(failures) or f"{count} command lines in {len(documents)} documents")
sys.exit(bool(failures) or count < 30)

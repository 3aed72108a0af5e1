#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws sentences at random from headers, comments, help and messages, for a reader who has not seen the project.

    tools/draw_sentences.py SEED [COUNT]

Prints COUNT (30) sentences of four words or more with their files. Equal seeds give equal draws from equal sources. Each
that is not clear at first reading is rewritten; then another seed is drawn, until a draw has none.
"""
import random
import re
import subprocess
import sys


def paragraphs(text):
    """The paragraphs of comments, the rows of tables in them, and adjacent string literals."""
    for comment in re.findall(r"/\*(.*?)\*/", text, re.S):
        for part in re.split(r"\n\s*\*?\s*\n", re.sub(r"^\s*\*(?=\s)", "", comment, flags=re.M)):
            # A row of a table is a name and, two blanks later, its meaning; a row begins a paragraph.
            yield from re.split(r"\n(?=\s{3,}\S+(?: \S+)?\s{2,}\S)|\n(?=\s*(?:Errors|Source|Cost|Limits|Formula):)", part)
    bare = re.sub(r"/\*.*?\*/|^#include.*?$", "", text, flags=re.S | re.M)
    for strings in re.findall(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', bare):
        literal = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', strings))
        yield from re.split(r"\\n\\n", literal.replace(r"\"", '"'))


def sentences():
    names = subprocess.run(["git", "ls-files", "include/*.h", "include/*.def", "src/*.[ch]", "src/*.def", "cli/*.[ch]"],
                           capture_output=True, text=True, check=True).stdout.split()
    for name in names:
        with open(name, encoding="utf-8") as file:
            for paragraph in paragraphs(file.read()):
                flat = " ".join(paragraph.replace("\\n", " ").split())
                for sentence in re.split(r"(?<=[.;:?])\s+(?=[A-Z])", flat):
                    if len(re.findall(r"\b[A-Za-z]{2,}\b", sentence)) >= 4 and "SPDX" not in sentence:
                        yield name, sentence


if not 2 <= len(sys.argv) <= 3 or not all(word.isdigit() for word in sys.argv[1:]):
    sys.exit(__doc__)
found = sorted(set(sentences()))
for where, what in random.Random(int(sys.argv[1])).sample(found, int(sys.argv[2]) if len(sys.argv) > 2 else 30):
    print("%s: %s" % (where, what))

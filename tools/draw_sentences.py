#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws sentences at random for a reader who has not seen the project: are they clear at first reading?

Usage: tools/draw_sentences.py PROGRAM [SEED [COUNT]]    (default: seed 1, 30 sentences)

The sources are the program's --help texts, comments of public headers, comments of src/ and cli/, and error messages of
src/ and cli/; each source is drawn with equal probability, then a sentence of it. The same seed and tree give the same
sentences. It only draws; people judge. A sentence that needs reading twice is rewritten, and another seed is drawn until
a draw has none.
"""
import os
import random
import re
import subprocess
import sys

os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))


def sentences(text):
    """Splits prose into sentences of at least four words; formulas and tables are left out."""
    # A line of a list (NAME  what it is), an item of a help text and "Errors:" begin a paragraph.
    text = re.sub(r"\n(?= *[\w][\w, /-]{0,30} {2,}\S| *Errors:|\w+: )", "\n\n", text)
    text = re.sub(r"^ +\w[\w, /-]{0,30} {2,}(?=\S)|^\w+ {2,}(?=\S)", "", text, flags=re.M)
    for paragraph in re.split(r"\n\s*\n", text):
        if re.search(r"\S {3,}\S", paragraph) and "\n" not in paragraph:
            continue
        for sentence in re.split(r"(?<=[.;])\s+(?=[A-Z`'a-z(])", re.sub(r"\s+", " ", paragraph).strip()):
            letters = sum(c.isalpha() or c.isspace() for c in sentence)
            if len(sentence.split()) >= 4 and letters > 0.75 * len(sentence):
                yield sentence


def files(pattern):
    """The files of a git pathspec, in order."""
    return subprocess.run(["sh", "-c", f". tests/lint/files.sh; files {pattern}"], capture_output=True, text=True,
                          check=True).stdout.split()


def comments(paths):
    """All sentences of the comments of these files, with where they are."""
    for path in paths:
        source = open(path, encoding="utf-8").read()
        for comment in re.finditer(r"/\*(.*?)\*/", source, re.S):
            if "SPDX" in comment.group(1):
                continue
            text = re.sub(r"^ \* ?", "", comment.group(1), flags=re.M)
            line = source.count("\n", 0, comment.start()) + 1
            for sentence in sentences(text):
                yield f"{path}:{line}", sentence


def messages(paths):
    """The formats of all error messages, and of lines for stderr."""
    call = r'(?:koksma__fail|koksma__malformed|cli_usage_error|fprintf|koksma__scene_fail|koksma__\w*fail\w*)\s*\('
    for path in paths:
        source = open(path, encoding="utf-8").read()
        for match in re.finditer(call + r'[^;"]*((?:"(?:[^"\\]|\\.)*"\s*)+)', source, re.S):
            text = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', match.group(1))).replace("\\n", " ").strip()
            if len(text.split()) >= 4:
                yield f"{path}:{source.count(chr(10), 0, match.start()) + 1}", text


def helps(program):
    """Sentences of the program's help texts."""
    names = re.findall(r"COMMAND\((\w+)\)", open("cli/commands.def", encoding="utf-8").read())
    for name in names:
        text = subprocess.run([program, name, "--help"], capture_output=True, text=True, check=False).stdout
        for line in re.findall(r"^ +(?:-\w, )?--?[\w-]+(?: \S+)?  +(.*)$", text, re.M):
            if len(line.split()) >= 4:
                yield f"koksma {name} --help", line
        for sentence in sentences(text.split("this text\n")[-1]):
            yield f"koksma {name} --help", sentence


def main():
    """Draws and prints."""
    program = sys.argv[1]
    seed, count = int(sys.argv[2]) if len(sys.argv) > 2 else 1, int(sys.argv[3]) if len(sys.argv) > 3 else 30
    code = files("'src/*.[ch]' 'cli/*.[ch]'")
    sources = [list(helps(program)), list(comments(files("'include/*.h'"))), list(comments(code)), list(messages(code))]
    draw = random.Random(seed)
    print(f"seed {seed}; sentences to draw from: help {len(sources[0])}, headers {len(sources[1])}, "
          f"comments {len(sources[2])}, messages {len(sources[3])}")
    for i in range(count):
        where, text = draw.choice(draw.choice(sources))
        print(f"{i + 1}. [{where}] {text}")


if __name__ == "__main__":
    main()

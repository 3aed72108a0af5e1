#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""paper.py: no number of docs/paper/paper.typ is typed by hand: outside of names, labels, citations, strings and the indices of code
it has no digit."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def digits(text):
    """Lines with a digit where none may be."""
    text = re.sub(r"//.*", "", text)
    text = re.sub(r"```.*?```|`[^`\n]*`|\"[^\"\n]*\"", "", text, flags=re.S)  # names of patterns and measures, keys, files
    text = re.sub(r"@[\w-]+|<[a-z-]+>|\bH\d\b|L_2", "", text)  # citations, labels, hypotheses, a norm
    text = re.sub(r"\.at\(\d\)|\bdigits: \d|columns: \d|\(size: [\d.]+pt|#?v\([\d.]+em\)|\bx: [\d.]+cm|gutter: [\d.]+cm|rows2|sum2|\band \d\b",
                  "", text)
    text = re.sub(r"[<>] 1\b|[<>] 0\b|\b100 \*", "", text)  # comparisons with equality, in code
    return [line for line in text.splitlines() if re.search(r"\d", line)]


paper = (ROOT / "docs/paper/paper.typ").read_text(encoding="utf-8")
bad = digits(paper)
for line in bad:
    print(f"docs/paper/paper.typ: a number typed by hand: {line.strip()}")
for planted in ("leaves 7 % less", "a gain of 0.93", "in 119,680 pictures", "p < 0.05", "10 scenes"):  # the check can fail
    if not digits(planted):
        print(f"the check passes '{planted}'")
        bad.append(planted)
sys.exit(bool(bad))

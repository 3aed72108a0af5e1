#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""terminal.py KOKSMA: tables on a terminal. Every table of `koksma list` and of the commands below, on pseudo terminals of
several widths (with sanitizers one): no line is wider; every column of the table that a pipe gets is a column, in the line above or named as left
out; and a terminal that is wide enough, or --long, shows what a pipe gets, where nothing is cut. Numbers of a pipe are those
of JSON to five digits; JSON and files hold them to the last bit. Every command that may take long shows one bar, which never
falls and is gone before anything else is printed."""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from pseudo_terminal import shown  # pylint: disable=wrong-import-position

KOKSMA = os.path.abspath(sys.argv[1])
SANITIZED = os.environ.get("KOKSMA_SANITIZED") == "1"
PLANS = Path(__file__).resolve().parent / "plans"
WIDTHS = (40,) if SANITIZED else (40, 60, 80, 132)
failures, tables = [], 0


def check(good, what):
    """Notes a failure."""
    if not good:
        failures.append(what)


def on_terminal(arguments, width, columns=None, stderr=subprocess.DEVNULL):
    """What the program prints on a terminal of a width: its stdout, and its stderr when it is told to be STDOUT."""
    environment = {key: value for key, value in os.environ.items() if key != "COLUMNS"}
    environment |= {"COLUMNS": str(columns)} if columns else {}
    return shown([KOKSMA, *arguments], width, environment, stderr=stderr)[0]


def piped(*arguments):
    """What the program prints into a pipe, which nothing may cut, whatever COLUMNS is."""
    return subprocess.run([KOKSMA, *arguments], capture_output=True, text=True, check=False, env=dict(os.environ, COLUMNS="40")).stdout


def rows(*arguments):
    """The rows of --json."""
    return [json.loads(line) for line in piped(*arguments, "--json").splitlines()]


def look(*arguments):
    """A table on terminals of several widths."""
    global tables
    tables += 1
    name, whole = " ".join(arguments), piped(*arguments)
    header = whole.split("\n")[0].split()
    check(header and not re.search(r" $", whole, re.M), f"{name}: no table, or blanks at the end of a line")
    for width in WIDTHS:
        text = on_terminal(arguments, width)
        check(max(map(len, text.split("\n"))) <= width, f"{name}: a line of more than {width} columns: {text}")
        check(SANITIZED or text == on_terminal(arguments, 80, width), f"{name}: COLUMNS={width} is not a terminal of that width")
        words = re.findall(r"[\w%-]+", text)
        check(all(key in words for key in header), f"{name} in {width}: not told of {[key for key in header if key not in words]}")
        if max(map(len, whole.split("\n"))) <= width:
            check(text == whole, f"{name}: fits in {width}, but is not what a pipe gets")
    if SANITIZED:
        return
    check(on_terminal([*arguments, "--long"], 80) == whole, f"{name}: --long is not what a pipe gets")
    check(on_terminal(arguments, 5000) == whole, f"{name}: a wide terminal has not what a pipe gets")


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    lists = re.search(r"one of (.*)", subprocess.run([KOKSMA, "list", "nosuch"], capture_output=True, text=True, check=False).stderr)[1].split(", ")
    check(len(lists) > 15, f"only {lists}")
    for kind in lists:
        look("list", kind)
        if kind not in ("records", "parameters", "plans", "formats"):
            text = on_terminal(["list", kind], 80)
            check(re.search(r"^\w+ +what( |$)", text, re.M), f"list {kind}: what the names are does not come first: {text}")
    for row in rows("list", "patterns")[:1 if SANITIZED else None]:
        check(row["source"] in piped("list", "patterns") and row["claims"] in piped("list", "patterns"), "a pipe's table is cut")
    subprocess.run([KOKSMA, "generate", "random", "-n", "32", "-o", "a file of points whose name is rather long, with a comma.txt"], check=True)
    for seed in ("1", "2"):
        subprocess.run([KOKSMA, "render", "ball", "--size", "32x24", "-n", "1", "-s", seed, "-o", f"{seed}.pfm"], check=True,
                       stdout=subprocess.DEVNULL)
    long_source = "pattern:halton:scramble=owen@64"
    for line in (["measure", "pattern:halton@64"], ["measure", long_source, "-m", "all"],
                 ["measure", long_source, "pattern:random@16@3", "-m", "all", "--trials", "2", "--time-limit", "1e6"],
                 ["measure", "a file of points whose name is rather long, with a comma.txt", "pattern:random@4"],
                 ["measure", long_source, "--prefixes", "powers"], ["measure", "--at", "0.3,0.7", long_source, "pattern:random@7"],
                 ["measure", "--paired", "--trials", "3", "--warp", "concentric-disk,polar-disk", long_source],
                 ["verify", long_source], ["verify", "pattern:sobol@16"], ["verify", "--record", "pattern:record@40"],
                 ["curve", "power", long_source], ["curve", "pairs", "pattern:random@16", long_source],
                 ["rank", "ball", "--size", "16x12", "--spp", "1,4", "--max-trials", "8", "--one-size", "-p", "random,sobol:scramble=owen"],
                 ["compare", "1.pfm", "2.pfm"], ["compare", "1.pfm", "1.pfm", "2.pfm"], ["scene", "check", "ball"],
                 ["optimise", "l2-star", "-n", "6", "--steps", "1", "-o", "six.txt"]):
        look(*line)
        check(SANITIZED or rows(*line), f"{line}: no JSON")
    # Text has five digits, --digits others; JSON and files have all.
    for row, five, nine in zip(rows("measure", "pattern:random@64", "-m", "all"), piped("measure", "pattern:random@64", "-m", "all").splitlines()[1:],
                               piped("measure", "pattern:random@64", "-m", "all", "--digits", "9").splitlines()[1:]):
        value = row["value"]
        check(five.split()[4] == (f"{value:.5g}" if value != int(value) else str(int(value))), f"five digits: {five}, {value}")
        check(nine.split()[4] == (f"{value:.9g}" if value != int(value) else str(int(value))), f"nine digits: {nine}, {value}")
    for ending in (".txt", ".csv", ".npy"):
        subprocess.run([KOKSMA, "generate", "random", "-n", "50", "-s", "3", "-o", f"p{ending}"], check=True)
        of_file, of_pattern = (rows("measure", source, "-m", "all", "-s", "3") for source in (f"p{ending}", "pattern:random@50"))
        for a, b in zip(of_file, of_pattern):
            check(len(of_file) > 15 and a["value"] == b["value"] and a["witness"] == b["witness"], f"{ending}: {a} is not {b}")
    # One bar: in place, never falling, cleared before messages and tables, and not in a pipe.
    subprocess.run([KOKSMA, "study", "new", "plan.json"], check=True)
    slow = {"measure": ["random@400", "-m", "star,l2-star", "--trials", "3"], "verify": ["sobol@256", "halton@256"],
            "generate": ["best-candidate", "-n", "1500", "-o", "b.txt"], "curve": ["power", "random@400", "--trials", "9"],
            "plot": ["random@400", "--curve", "power", "--trials", "9", "-o", "b.png"], "render": ["ball", "-o", "b.png"],
            "rank": ["ball", "--size", "16x12", "--max-trials", "8", "--one-size", "-p", "random,jittered"],
            "optimise": ["l2-star", "-n", "12", "--steps", "2", "-o", "b.txt"], "study": ["run", "./plan.json", "-o", "results", "--quick"],
            "reproduce": ["./plan.json", "-o", "again", "--quick"]}
    if SANITIZED:
        slow |= {"measure": ["random@100", "-m", "star,l2-star", "--trials", "3"], "verify": ["sobol@64", "halton@64"],
                 "generate": ["best-candidate", "-n", "400", "-o", "b.txt"], "curve": ["power", "random@100", "--trials", "9"],
                 "plot": ["random@100", "--curve", "power", "--trials", "9", "-o", "b.png"], "render": ["ball", "--size", "64x48", "-o", "b.png"],
                 "optimise": ["l2-star", "-n", "8", "--steps", "2", "-o", "b.txt"],
                 "study": ["run", f"{PLANS}/small.json", "-o", "results", "--trials", "2"],
                 "reproduce": [f"{PLANS}/small.json", "-o", "again", "--trials", "2"]}
    for command, more in slow.items():
        text = on_terminal([command, *more, "--seed", "1"] if command not in ("rank", "study", "reproduce") else [command, *more], 80, None, subprocess.STDOUT)
        # A message follows on the line that was cleared, perhaps with a percentage of its own, but has a colon.
        bars = re.findall(r"\r\x1b\[K([^\r\n:]* +(\d+) %[^\r\n:]*)([\r\n:]|$)", text)
        check(bars and all(after == "\r" for _, _, after in bars), f"{command}: no bar, or something is printed behind it: {text[-400:]!r}")
        parts = [int(part) for _, part, _ in bars]
        check(parts == sorted(parts) and parts[-1] <= 100 and all(len(bar) < 80 for bar, _, _ in bars), f"{command}: {parts}")
        check(SANITIZED or "%" not in subprocess.run([KOKSMA, command, *more], capture_output=True, text=True, check=False).stderr.split("workers")[0].split("leaves")[0],
              f"{command}: a bar in a pipe")
    # Points follow on the terminal: no bar stands before them or between them.
    for points in (["random", "-n", "5"], ["gaussian-jittered", "-n", "400"], ["random", "-n", "9", "--warp", "polar-disk"]):
        text = on_terminal(["generate", *points], 80, None, subprocess.STDOUT)
        check(re.sub(r"\r\x1b\[K([^\r\n]*\r\x1b\[K)?", "", text) == piped("generate", *points), f"generate {points}: {text[:200]!r}")
    # A ranking may end at any time before its limit, so its bar is the share of the limit that has passed.
    text = on_terminal(["rank", "ball", "--size", "16x12", "--max-trials", "8", "--one-size", "-p", "random,jittered", "--time-limit", "1e6",
                        "--spp", "4"], 80, None, subprocess.STDOUT)
    check(re.findall(r"ranking +(\d+) %, at most (?:\d+) h", text) and set(re.findall(r"ranking +(\d+) %", text)) == {"0"}, f"rank: {text[:400]!r}")
print("\n".join(failures) or f"{tables} tables")
sys.exit(bool(failures))

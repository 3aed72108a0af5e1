#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`koksma rank --with COMMAND`: samplers of another renderer. The renderer here adds noise of a known standard deviation
to a known picture, so that errors follow from the definition: the mean absolute value of normal noise of deviation s is
s sqrt(2 / pi).

    rank_with.py PROGRAM
"""
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time

PROGRAM = os.path.abspath(sys.argv[1])

RENDERER = r'''
import math, random, struct, sys
scene, pattern, spp, seed, width, height, out = sys.argv[1:8]
spp, seed, width, height = int(spp), int(seed), int(width) or 40, int(height) or 30
if pattern == "broken":
    print("first line"); print("no such sampler: broken", file=sys.stderr); sys.exit(3)
if pattern == "pairs" and spp < 2:
    print("it takes 2 samples or more", file=sys.stderr); sys.exit(7)
assert scene == "a 'scene' $HOME", scene
noise = random.Random(f"{pattern} {seed} {spp}")
deviation = {"fine": .1, "coarse": .2, "bands": .1, "same": 0, "pairs": .05}[pattern] / math.sqrt(spp)
pixels = []
for y in range(height):
    for x in range(width):
        off = math.sin(x) * math.sqrt(2) if pattern == "bands" and spp == 4 else noise.gauss(0, 1)
        pixels.append(.5 + .3 * x / width + deviation * off)
with open(out, "wb") as file:
    file.write(b"Pf\n%d %d\n-1\n" % (width, height) + struct.pack("<%df" % len(pixels), *pixels))
'''

failures = 0


def check(what, good, seen=""):
    global failures
    if not good:
        failures += 1
        print(f"FAILED: {what}: {seen}")


def rank(command, patterns, *options):
    done = subprocess.run([PROGRAM, "rank", "a 'scene' $HOME", "--spp", "4", "-p", patterns, "--with", command,
                           "--json", "--time-limit", "600", *options], capture_output=True, text=True)
    return done.returncode, [json.loads(line) for line in done.stdout.splitlines()], done.stderr


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.environ["TMPDIR"] = os.path.join(folder, "tmp")
        os.mkdir(os.environ["TMPDIR"])
        script = os.path.join(folder, "renderer.py")
        with open(script, "w") as file:
            file.write(RENDERER)
        command = f"{sys.executable} -S {script} {{scene}} {{pattern}} {{spp}} {{seed}} {{width}} {{height}} {{out.pfm}}"

        code, rows, said = rank(command, "coarse,fine,broken,bands", "--threads", "2")
        by = {row["pattern"]: row for row in rows}
        check("decided", code == 0 and by["coarse"]["settled"], (code, said))
        check("the renderer's own size", (by["fine"]["width"], by["fine"]["height"]) == (40, 30), by["fine"])
        for pattern, deviation in (("fine", .1), ("coarse", .2)):
            expected = deviation / 2 * math.sqrt(2 / math.pi)
            check(f"error of {pattern}", by[pattern]["low"] <= expected <= by[pattern]["high"], (by[pattern], expected))
        check("ratio", by["fine"]["position"] < by["coarse"]["position"] and
              (by["fine"]["behind"] or 0) < by["coarse"]["behind"], rows)
        check("bands are coherent, noise is not", by["bands"]["coherent"] and not by["fine"]["coherent"], rows)
        check("advised", by["fine"]["advised"] == "fine", by["fine"])
        check("a sampler that fails is left out, with what it said", by["broken"]["state"] == "refused" and
              "no such sampler: broken" in by["broken"]["reason"] and "3" in by["broken"]["reason"], by["broken"])
        check("the command is in the rows", by["fine"]["with"] == command, by["fine"])
        check("one thread gives the same", rank(command, "coarse,fine,broken,bands", "--threads", "1")[:2] == (code, rows))
        check("nothing is left", not os.listdir(os.environ["TMPDIR"]), os.listdir(os.environ["TMPDIR"]))

        for patterns, reference in (("broken,coarse,fine", "fine"), ("pairs,broken", "pairs"), ("broken,pairs,fine", "pairs")):
            done = rank(command, patterns, "--reference", reference)
            check(f"{patterns}: the size is that of a sampler that has a picture", done[0] == 0 and all(
                (row["width"], row["height"]) == (40, 30) and (row["state"] == "refused") == (row["pattern"] == "broken")
                for row in done[1]), done)
        check("only samplers that fail", rank(command, "broken", "--reference", "broken")[0] in (2, 3), "")

        sized = rank(command, "fine,coarse", "--size", "48x32")
        check("another size, checked at half and twice", sized[0] == 0 and sized[1][0]["half_size"] == "confirmed" and
              sized[1][0]["twice_width"] == 96, sized)
        other = rank(command, "coarse,fine", "--reference", "fine")
        check("another reference", other[0] == 0 and
              1.8 < rows[0]["reference_error"] / other[1][0]["reference_error"] < 2.2, other)

        for bad, reason in ((command.replace("{seed}", "7"), "the same picture for every seed"),
                            (command.replace("{seed}", "{sed}"), "{sed} is unknown"),
                            (command.replace("{out.pfm}", "x"), "lacks {out}"),
                            ("exit 5", "lacks {out}"),
                            ("exit 5; echo {out}", "exit code 5"),
                            ("echo the beginning of %0900d; exit 5; echo {out}".replace("%0900d", "0" * 900), "exit code 5: the beginning of 0"),
                            ("echo text >{out}", "neither EXR nor PNG nor PFM nor JPG"),
                            ("true {out}", "No such file"),
                            (f"{command.replace('{width}', '9')}", "9 x ")):
            code, rows, said = rank(bad + " # {pattern} {width} {height}", "fine,coarse", "--size", "48x32")
            lines = [line for line in said.splitlines() if "samples took" not in line]  # said of slow pictures
            check(bad, code not in (0, 1) and reason in said and len(lines) == 1 and not rows, (code, rows, said))
        fixed = "w={width}; h={height}; " + command.replace("{width} {height}", "48 32")
        code, rows, said = rank(fixed, "fine,coarse", "--size", "48x32")
        check("a renderer of one size is ranked at this size", code == 0 and said.count("--one-size") == 2 and
              [row["half_size"] for row in rows] == ["failed", "failed"], (code, rows, said))
        for word, *options in (("{pattern}",), ("{spp}", "--spp", "4,8"), ("{spp}", "--target-error", ".1"), ("{width}", "--size", "48x32"),
                               ("{height}", "--size", "48x32")):
            done = subprocess.run([PROGRAM, "rank", "s", "-p", "fine,coarse", "--with", command.replace(word, "4"), *options],
                                  capture_output=True, text=True)
            check(f"{options} needs {word}", done.returncode == 2 and f"lacks {word}" in done.stderr and done.stderr.count("\n") == 1, done)
        check("nothing is left after failures", not os.listdir(os.environ["TMPDIR"]))

        for arguments, reason in ((["--with", command], "--with needs --patterns"),
                                  (["--reference", "random"], "--reference random: without --with it takes an image"),
                                  *((["-p", "fine,coarse", "--with", command, *option], f"{option[0]} has no effect with --with")
                                    for option in (["--integrator", "path"], ["--filter", "box"], ["--unknown", "refuse"], ["--allow-exec"]))):
            done = subprocess.run([PROGRAM, "rank", "ball", *arguments], capture_output=True, text=True)
            check(reason, done.returncode == 2 and reason in done.stderr, done)

        # --with mitsuba: the module of the interpreter that KOKSMA_PYTHON names, here one that draws with RENDERER.
        python = os.path.join(folder, "a python")
        with open(python, "w") as file:
            file.write(f'#!/bin/sh\n[ "$1 $2" = "-m koksma.mitsuba" ] || exit 9\nshift 2\nexec {sys.executable} -S {script} "$@"\n')
        os.chmod(python, 0o755)
        before = rank(command.replace("out.pfm", "out"), "fine,coarse", "--size", "48x32", "--max-trials", "8", "--one-size")
        help_text = " ".join(subprocess.run([PROGRAM, "rank", "--help"], capture_output=True, text=True).stdout.split())
        check("the help has arithmetic on a quoted text", "a variable: s={seed}; echo $((s % 3))." in help_text, help_text)
        counted = rank("s={seed}; " + command.replace("{seed}", "$((s + 0))"), "fine,coarse", "--size", "48x32", "--max-trials", "8",
                       "--one-size")
        check("a variable has a text's number", [{**row, "with": ""} for row in counted[1]] == [{**row, "with": ""} for row in before[1]]
              and len(counted[1]) == 2, (before, counted))
        os.environ["KOKSMA_PYTHON"] = python
        by_name = rank("mitsuba", "fine,coarse", "--size", "48x32", "--max-trials", "8", "--one-size")
        check("--with mitsuba runs KOKSMA_PYTHON", [{**row, "with": ""} for row in before[1]] == [{**row, "with": ""} for row in by_name[1]]
              and len(by_name[1]) == 2 and by_name[1][0]["error"] > 0, (before, by_name))
        os.environ["KOKSMA_PYTHON"] = "/no/such/python"
        by_name = rank("mitsuba", "fine,coarse", "--size", "48x32")
        check("a missing interpreter is named", by_name[0] not in (0, 1) and "/no/such/python" in by_name[2], by_name)

        mark = os.path.join(folder, "started")
        with subprocess.Popen([PROGRAM, "rank", "s", "-p", "a", "--with", f"touch {mark}; sleep 1000; echo {{out}}"],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as stopped:
            while not os.path.exists(mark):
                time.sleep(.01)
            stopped.send_signal(signal.SIGINT)
            check("an interruption ends the command", stopped.wait() == 130, stopped.returncode)
        check("nothing is left after an interruption", not os.listdir(os.environ["TMPDIR"]))
    print(f"{'FAILED' if failures else 'passed'}: rank --with")
    return bool(failures)


sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants faults in the code, one at a time, and sees whether the tests find them.

    tools/plant_faults.py draw SEED [OLD] > faults.json     draw ten faults in each of six areas of src/ and cli/
    tools/plant_faults.py run faults.json BUILD [CTEST..]   try each; a line of JSON a fault, which a second run continues

A fault is a change of one line of C: a constant, a dropped term, an off-by-one (a comparison), a wrong sign. `draw` takes
lines at random: every line that can be changed is as likely as another. With OLD, a checkout of an earlier commit, only lines
are taken that are there as well, in a file of the same name, so that both commits' tests can be asked about the same fault.
`run` works in the checkout that it is in, which must be clean: it edits the file, builds BUILD (a folder of ninja), runs
ctest there with the arguments CTEST (-LE nightly) until a test fails, and puts the file back. A fault that does not compile
is said to be so, and the next of its kind in that area takes its place.
"""
import json
import os
import random
import re
import resource
import subprocess
import sys
import time

AREAS = {
    "patterns": (r"^src/engine/(patterns|kernels|domains|warps|optimise)", "pattern|point|key|lattice|net|claim|sampl|kernel|mask|golden|optimise|warp"),
    "measures": (r"^src/engine/(measures|stats|integrands|verify)", "measure|star|extreme|l2|disk|edge|integr|verify|stat|spectr|golden|curve"),
    "render": (r"^src/render/(?!scene/)", "render|bsdf|light|shape|camera|film|filter|pixel|integrator|image|adaptive|accel|medium"),
    "files": (r"^src/(files|render/scene)/", "mesh|image|import|scene|json|gltf|pbrt|mitsuba|domain|format|model|file"),
    "lab": (r"^src/lab/", "study|report|rank|datasheet|plot|plan|store|table|coverage|document"),
    "cli": (r"^cli/", "^cli_|datasheet|python"),
}
EACH = 10
LONGEST = 2400  # seconds for the tests of a fault: what hangs is found, by the tests' own limits
MEMORY = 12 << 30  # bytes for a process, which a fault may want without end
KINDS = ("constant", "term", "comparison", "sign")
WORD = r"[A-Za-z_][\w.>\[\]-]*|\d[\w.]*"


def changes(line):
    """(kind, changed line) for each single change of this line of code."""
    code = re.sub(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])+\'|//.*|/\*.*?\*/', lambda m: " " * len(m.group()), line)
    if re.match(r"\s*(#|\*|/\*|KOKSMA__REQUIRE|case )", code) or not code.strip():
        return

    def put(m, text):
        return line[:m.start()] + text + line[m.end():]
    for m in re.finditer(r"(?<![\w.])\d+(\.\d*)?(e-?\d+)?(?![\w.])", code):
        yield "constant", put(m, str(int(m.group()) + 1) if m.group().isdigit() else "(%s * 1.25)" % m.group())
    for m in re.finditer(r" [+-] (%s)(?=[;,) ])" % WORD, code):
        yield "term", put(m, "")
    for m in re.finditer(r" (<=?|>=?) ", code):
        yield "comparison", put(m, {"<": " <= ", "<=": " < ", ">": " >= ", ">=": " > "}[m.group(1)])
    for m in re.finditer(r" ([+-]) ", code):
        yield "sign", put(m, " - " if m.group(1) == "+" else " + ")


def lines_of(root):
    """{file name: set of lines} of a checkout."""
    found = {}
    for path in listed(root):
        with open(os.path.join(root, path), encoding="utf-8") as file:
            found.setdefault(os.path.basename(path), set()).update(line.strip() for line in file)
    return found


def listed(root):
    return subprocess.run(["git", "ls-files", "src/*.c", "cli/*.c"], cwd=root, capture_output=True, text=True, check=True).stdout.split()


def draw(seed, old):
    known = lines_of(old) if old else None
    everywhere = set().union(*known.values()) if known else None
    drawn = []
    for area, (where, _) in AREAS.items():
        choice = random.Random("%s %s" % (seed, area))
        found = {kind: [] for kind in KINDS}
        for path in sorted(p for p in listed(".") if re.search(where, p)):
            with open(path, encoding="utf-8") as file:
                comment = False
                for number, line in enumerate(file, 1):
                    comment = comment or line.lstrip().startswith("/*")
                    if not comment and (known is None or line.strip() in everywhere):
                        for kind, changed in changes(line.rstrip("\n")):
                            found[kind].append({"area": area, "file": path, "line": number, "kind": kind,
                                                "from": line.rstrip("\n"), "to": changed})
                    comment = comment and "*/" not in line
        for kind in KINDS:
            choice.shuffle(found[kind])
        # Ten at first, the rest to take the place of those that do not compile.
        drawn += [dict(found[KINDS[i % 4]][i // 4], place=i) for i in range(3 * EACH)]
    return drawn


def edit(fault, old, new):
    with open(fault["file"], encoding="utf-8") as file:
        lines = file.read().split("\n")
    if lines[fault["line"] - 1] != old:
        sys.exit("%s:%d is not '%s': draw the faults anew" % (fault["file"], fault["line"], old))
    lines[fault["line"] - 1] = new
    with open(fault["file"], "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


def bounded():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def first_failure(build, arguments, words):
    """The name of a test that fails, or None: first those whose names have words of the area, then the others."""
    for way in ("-R", "-E"):
        command = ["ctest", "--test-dir", build, "-j", str(os.cpu_count()), "--stop-on-failure", way, words, *arguments]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, preexec_fn=bounded)
        except subprocess.TimeoutExpired:
            return "hangs"
        failed = re.search(r"Test +#\d+: (\S+) \.*\*\*\*(?!Skipped)", done.stdout)
        if failed:
            return failed.group(1)
        if done.returncode and "No tests were found" not in done.stdout + done.stderr and "Skipped" not in done.stdout:
            return "ctest: " + done.stderr.strip()[-200:]
    return None


def attempt(fault, build, arguments):
    start = time.time()
    edit(fault, fault["from"], fault["to"])
    try:
        if subprocess.run(["ninja", "-C", build], capture_output=True).returncode:
            return "does not compile", 0
        return first_failure(build, arguments, AREAS[fault["area"]][1]) or "not found", round(time.time() - start)
    finally:
        edit(fault, fault["to"], fault["from"])


def run(path, build, arguments):
    with open(path, encoding="utf-8") as file:
        faults = json.load(file)
    results = path.replace(".json", "") + ".results"
    done = {}
    if os.path.exists(results):
        with open(results, encoding="utf-8") as file:
            done = {(r["file"], r["line"], r["to"]): r for r in map(json.loads, file)}
    for area in AREAS:
        left = EACH
        for fault in (f for f in faults if f["area"] == area):
            if not left:
                break
            result = done.get((fault["file"], fault["line"], fault["to"]))
            if not result:
                outcome, seconds = attempt(fault, build, arguments)
                result = dict(fault, outcome=outcome, seconds=seconds)
                with open(results, "a", encoding="utf-8") as file:
                    file.write(json.dumps(result) + "\n")
            print("%-9s %-10s %s:%d  %s  %s" % (area, fault["kind"], fault["file"], fault["line"], result["outcome"], fault["to"].strip()), flush=True)
            left -= result["outcome"] != "does not compile"


def main():
    arguments = sys.argv[1:]
    if arguments[:1] == ["draw"] and len(arguments) in (2, 3):
        json.dump(draw(arguments[1], arguments[2] if len(arguments) > 2 else None), sys.stdout, indent=0)
    elif arguments[:1] == ["run"] and len(arguments) >= 3:
        run(arguments[1], os.path.abspath(arguments[2]), arguments[3:] or ["-LE", "nightly"])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants faults in the code, one at a time, and sees whether the tests find them.

    tools/plant_faults.py draw SEED [OLD] > faults.json          draw ten faults in each of six areas of src/ and cli/
    tools/plant_faults.py run faults.json BUILD [EACH] [CTEST..]  try EACH of an area (10); one line of JSON a fault is kept
                                                                  in faults.results, which a second run continues

A fault is a change of one line of C: a constant, a dropped term, an off-by-one (a comparison), a wrong sign. `draw` takes
lines at random: every line that can be changed, and that is in the tree once, is as likely as another. With OLD, a checkout
of another commit, only lines are taken that are there once as well, wherever they lie, so that both commits' tests can be
asked about the same fault. `run` works in the checkout that it is in, which must be clean: it edits the file, builds and
tests in BUILD (a folder of ninja) in four steps, and puts the file back. The first step's tests have a word of the file's
name in theirs, the second's the folder's, the third's belong to the area, the fourth's are all others; each stops at the
first failure, and the first two build nothing but their own programs. CTEST are arguments of ctest; without them no test runs that is nightly or that reads
the sources' texts (lint). A fault that does not compile is said to be so, and the next of its area takes its place.
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
    "patterns": (r"^src/engine/(patterns|kernels|warps|optimise)", "pattern|point|key|lattice|net|claim|sampl|kernel|mask|golden|optimise|warp"),
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


def listed(root):
    return subprocess.run(["git", "ls-files", "src/*.c", "cli/*.c"], cwd=root, capture_output=True, text=True, check=True).stdout.split()


def places(root):
    """{line without indentation: [(path, number from 0)]} of a checkout."""
    found = {}
    for path in listed(root):
        with open(os.path.join(root, path), encoding="utf-8") as file:
            for number, line in enumerate(file):
                found.setdefault(line.strip(), []).append((path, number))
    return found


def draw(seed, old):
    here = places(".")
    there = places(old) if old else here
    drawn = []
    for area, (where, _) in AREAS.items():
        choice = random.Random("%s %s" % (seed, area))
        found = {kind: [] for kind in KINDS}
        for path in sorted(p for p in listed(".") if re.search(where, p)):
            with open(path, encoding="utf-8") as file:
                comment = False
                for line in file:
                    comment = comment or line.lstrip().startswith("/*")
                    text = line.strip()
                    if not comment and len(here[text]) == 1 and len(there.get(text, ())) == 1:
                        for kind, changed in changes(text):
                            found[kind].append({"area": area, "file": path, "kind": kind, "from": text, "to": changed})
                    comment = comment and "*/" not in line
        for kind in KINDS:
            choice.shuffle(found[kind])
        # Ten at first, the rest to take the place of those that do not compile.
        drawn += [found[KINDS[i % 4]][i // 4] for i in range(3 * EACH)]
    return drawn


class Planted:
    """A file with the fault in it, put back at the end."""

    def __init__(self, fault):
        found = places(".").get(fault["from"], [])
        if len(found) != 1:
            sys.exit("'%s' is in %d places: draw the faults anew" % (fault["from"], len(found)))
        self.path, self.number = found[0]
        self.fault = fault

    def __enter__(self):
        with open(self.path, encoding="utf-8") as file:
            self.text = file.read()
        lines = self.text.split("\n")
        lines[self.number] = lines[self.number].replace(self.fault["from"], self.fault["to"])
        self.write("\n".join(lines))
        return self

    def __exit__(self, *_):
        self.write(self.text)

    def write(self, text):
        with open(self.path, "w", encoding="utf-8") as file:
            file.write(text)


def steps(path, area, build, arguments):
    """Four lists of names of tests, the likeliest to find a fault in `path` first."""
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1", *arguments], capture_output=True, text=True, check=True)
    names = [test["name"] for test in json.loads(shown.stdout)["tests"]]
    words = [w for w in re.split(r"[_.]", os.path.basename(path)[:-2]) if len(w) > 2]
    folder = os.path.basename(os.path.dirname(path)).rstrip("s")
    ways = ["|".join(words) or "$^", folder, AREAS[area][1], ""]
    taken, out = set(), []
    for way in ways:
        out.append([n for n in names if n not in taken and re.search(way, n)])
        taken.update(out[-1])
    return out


def bounded():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def built(build, targets):
    return subprocess.run(["ninja", "-C", build, *targets], capture_output=True).returncode == 0


def failure(build, tests):
    """The name of a test of these that fails, or None."""
    command = ["ctest", "--test-dir", build, "-j", str(os.cpu_count()), "--stop-on-failure", "-R", "^(%s)$" % "|".join(map(re.escape, tests))]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, preexec_fn=bounded)
    except subprocess.TimeoutExpired:
        return "hangs"
    failed = re.search(r"Test +#\d+: (\S+) \.*\*\*\*(?!Skipped|Not Run)", done.stdout)
    if done.returncode and not failed:
        return "ctest: " + (done.stderr or done.stdout).strip()[-200:]
    return failed.group(1) if failed else None


def attempt(fault, build, arguments):
    """(the test that found it, or why there is none; seconds; tests that were to run until then)"""
    start = time.time()
    with Planted(fault) as planted:
        targets = subprocess.run(["ninja", "-C", build, "-t", "targets", "all"], capture_output=True, text=True, check=True).stdout
        ran = 0
        for number, tests in enumerate(steps(planted.path, fault["area"], build, arguments)):
            own = [t for t in tests if "\n%s: phony" % t in targets]
            if not built(build, ["koksma-program", *own] if number < 2 else []):
                return "does not compile", 0, 0
            found = failure(build, tests) if tests else None
            ran += len(tests)
            if found:
                return found, round(time.time() - start), ran
    return "not found", round(time.time() - start), ran


def run(path, build, each, arguments):
    with open(path, encoding="utf-8") as file:
        faults = json.load(file)
    results = re.sub(r"\.json$", "", path) + ".results"
    done = {}
    if os.path.exists(results):
        with open(results, encoding="utf-8") as file:
            done = {(r["from"], r["to"]): r for r in map(json.loads, file)}
    if subprocess.run(["git", "diff", "--quiet", "HEAD", "--", "src", "cli"]).returncode:
        sys.exit("src and cli have changes that are not committed: faults are planted in a clean checkout")
    if not built(build, []):
        sys.exit("%s does not build without a fault" % build)
    for area in AREAS:
        left = each
        for fault in (f for f in faults if f["area"] == area):
            if not left:
                break
            result = done.get((fault["from"], fault["to"]))
            if not result:
                outcome, seconds, ran = attempt(fault, build, arguments)
                result = dict(fault, outcome=outcome, seconds=seconds, tests=ran)
                with open(results, "a", encoding="utf-8") as file:
                    file.write(json.dumps(result) + "\n")
            print("%-9s %-10s %s  %s in %s s  %s" % (area, fault["kind"], os.path.basename(fault["file"]), result["outcome"],
                                                   result["seconds"], fault["to"]), flush=True)
            left -= result["outcome"] != "does not compile"


def main():
    arguments = sys.argv[1:]
    if arguments[:1] == ["draw"] and len(arguments) in (2, 3):
        json.dump(draw(arguments[1], arguments[2] if len(arguments) > 2 else None), sys.stdout, indent=0)
    elif arguments[:1] == ["run"] and len(arguments) >= 3:
        each = int(arguments[3]) if len(arguments) > 3 and arguments[3].isdigit() else EACH
        rest = [a for a in arguments[3:] if not a.isdigit()]
        run(arguments[1], os.path.abspath(arguments[2]), each, rest or ["-LE", "^(nightly|lint)$"])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()

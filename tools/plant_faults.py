#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants faults in the code and sees whether `make test` finds them.

    tools/plant_faults.py SEED OUT [EACH]     EACH faults (10) in each of six areas; writes OUT.json and OUT.md

A fault is a change of one line of C, drawn at random: a constant, a dropped term or statement, a bound that is off by one,
a wrong sign or comparison. What does not compile, or gives the same object code, is no fault. The checkout must be clean,
after `make test`. Each fault meets the tests nearest to its file first: those with a word of its name, of its folder, the
short ones of its area. Those not found are planted together for all of `make test` but lint, which would see any changed
text; each then meets alone what failed near it, and those left together what failed, until all passes. Again, it goes on.
"""
import contextlib
import itertools
import json
import pathlib
import random
import re
import subprocess
import sys
import time

AREAS = {  # files; words of the names of tests
    "patterns": (r"^src/engine/(patterns|kernels|masks|optimise|warps)/", "pattern|net|claim|sampl|kernel|mask|values"),
    "measures": (r"^src/engine/(measures|stats|integrands|verify|identify)/", "measure|star|l2|disk|integr|stat|values"),
    "render": (r"^src/render/(?!scene/)", "render|bsdf|light|shape|camera|film|filter|pixel|integrator|adaptive|medium"),
    "files": (r"^src/(files|render/scene)/", "mesh|image|import|scene|json|gltf|pbrt|mitsuba|format|model|file"),
    "lab": (r"^src/lab/", "study|report|rank|datasheet|plot|plan|store|table|coverage|atlas"),
    "cli": (r"^cli/", "^cli_|datasheet|python"),
}
SUITES = [("build/clang", "all", ["-LE", "^(nightly|once|lint)$"]), ("build/dev", "memory-tests", ["-L", "^memory$"])]
SHORT = (20, 5, 3)  # seconds of a test of each of the first steps
LONGEST, MEMORY = "400", 12 << 30  # seconds and bytes of any test (sanitizers map more): what hangs or grows is found
WORD = r"\w[\w.]*(?:->[\w.]+)*(?:\[\w+\])?"
TEXTS = r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])+\'|//.*?$|/\*.*?\*/|^ *#.*?[^\\]$|^ *case.*?$'  # and what is no expression
OTHER = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "+": "-", "-": "+", "==": "!=", "!=": "=="}


def changes(line, code, before):
    """(kind, changed line) for each single change of this line; `code` is it, and `before` the one above, without texts."""
    def put(m, text):
        return line[:m.start()] + text + line[m.end():]
    for m in re.finditer(r"(?<![\w.])\d+(\.\d*)?(e-?\d+)?(?![\w.])", code):
        yield "constant", put(m, str(int(m.group()) + 1) if m.group().isdigit() else "(%s * 1.25)" % m.group())
    for m in re.finditer(r" [+-] %s(?=[];,)]| [+-] )" % WORD, code):
        yield "term", put(m, "")
    statement = re.match(r"(\s+)\*?[\w.>\[\]+-]+( [^\w ]*= .*|\(.*)?;$", code.rstrip())
    whole = re.search(r"[;{}:)]$", before.rstrip()) and code.count("(") == code.count(")")
    if statement and whole and not re.match(r"\s+(return|break|continue)", code):
        yield "statement", statement.group(1) + ";"
    for kind, signs in (("bound", "<=?|>=?"), ("sign", "[+-]"), ("comparison", "[=!]=")):
        for m in re.finditer(r"(?<= )(%s)(?= )" % signs, code):
            yield kind, put(m, OTHER[m.group()])


def draw(seed, area):
    """All faults of an area in random order, one kind after the other."""
    found = {kind: [] for kind in ("constant", "term", "statement", "bound", "sign", "comparison")}
    for path in run("git", "ls-files", "src/*.c", "cli/*.c").stdout.split():
        if re.search(AREAS[area][0], path):
            text = pathlib.Path(path).read_text()
            codes = re.sub(TEXTS, lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.S | re.M).split("\n")
            for number, line in enumerate(text.split("\n")):
                for kind, changed in changes(line, codes[number], codes[number - 1]):
                    found[kind].append({"area": area, "file": path, "line": number + 1, "kind": kind, "to": changed,
                                        "from": line.strip()})
    for kind, faults in found.items():
        random.Random("%s %s %s" % (seed, area, kind)).shuffle(faults)
    return itertools.chain(*zip(*found.values()))


@contextlib.contextmanager
def planted(faults):
    """These faults in their files, which are git's again at the end."""
    try:
        for fault in faults:
            path = pathlib.Path(fault["file"])
            lines, n = path.read_text().split("\n"), fault["line"]
            path.write_text("\n".join([*lines[:n - 1], fault["to"], *lines[n:]]))
        yield
    finally:
        run("git", "checkout", "-q", "--", *(fault["file"] for fault in faults))


def run(*command):
    return subprocess.run(command, capture_output=True, text=True)


def built(build, *targets):
    return run("ninja", "-C", build, "-j2", *targets).returncode == 0


def failures(build, tests, *options):
    """The tests of these that fail."""
    names = "^(%s)$" % "|".join(map(re.escape, tests))
    ctest = ["ctest", "--test-dir", build, "-j2", "--timeout", LONGEST, *options, "-R", names]
    ran = run("prlimit", "--data=%s" % ("unlimited" if build == "build/dev" else MEMORY), *ctest)
    failed = re.findall(r"Test +#\d+: (\S+) \.*[^*\n]*\*\*\*(?!Skipped)", ran.stdout)
    if ran.returncode and not failed:
        sys.exit("ctest: " + (ran.stderr or ran.stdout)[-400:])
    return failed


def tests_of(build, options):
    """{test: (seconds when it last ran, its labels)}"""
    shown = json.loads(run("ctest", "--test-dir", build, "--show-only=json-v1", *options).stdout)["tests"]
    past = pathlib.Path(build, "Testing/Temporary/CTestCostData.txt").read_text()
    cost = dict(re.findall(r"^(\S+) \d+ (\S+)$", past, re.M))
    labels = {t["name"]: sum((p["value"] for p in t["properties"] if p["name"] == "LABELS"), []) for t in shown}
    return {name: (float(cost.get(name, 0)), labels[name]) for name in labels}


def near(fault, tests):
    """Three lists of tests, the likeliest to find this fault first."""
    *_, folder, file = fault["file"].split("/")
    words = "|".join(w.rstrip("s") for w in re.split(r"[_.]", file[:-2]) if len(w) > 2) or "$^"
    left = dict(tests)
    for way, most in zip((words, folder.rstrip("s"), AREAS[fault["area"]][1]), SHORT):
        step = [t for t, (_, labels) in left.items() if re.search(way, t) or way + "s" in labels]
        yield [t for t in step if left.pop(t)[0] < most]


def report(faults, out):
    pathlib.Path(out + ".json").write_text(json.dumps(faults, indent=1))
    rows = ["| area | line | changed to | from | found by | s |\n|---|---|---|---|---|---|\n"]
    for f in (f for f in faults if f["state"] != "none"):
        texts = ("`%s`" % f[key].strip().replace("|", "\\|") for key in ("to", "from"))
        rows.append("| %s | %s:%d | %s | %s | " % (f["area"], f["file"], f["line"], *texts))
        rows.append("%s | %d |\n" % (f.get("test", "none"), f["seconds"]))
    pathlib.Path(out + ".md").write_text("".join(rows))


def main(seed, out, each="10"):
    if run("git", "diff", "--quiet", "HEAD", "--", "src", "cli").returncode:
        sys.exit("src and cli have changes that are not committed: faults are planted in a clean checkout")
    kept = pathlib.Path(out + ".json")
    faults = json.loads(kept.read_text()) if kept.exists() else []
    build, target, options = SUITES[0]
    built(build, target) or sys.exit("%s does not build without a fault" % build)
    targets = run("ninja", "-C", build, "-t", "targets", "all").stdout
    objects = re.findall(r"^(\S+\.dir/\S+\.c\.o):", targets, re.M)
    programs = re.findall(r"^((?:koksma-|test_)\w+): phony", targets, re.M)

    def code(fault):  # the object code of its file, False if it does not compile
        own = [o for o in objects if fault["file"].endswith(re.sub(r"^.*\.dir/|\.o$", "", o))]
        return built(build, *own) and [pathlib.Path(build, o).read_bytes() for o in own]
    unsure = set()  # tests that fail without a fault, as on a busy machine

    def ask(fault, steps, build):
        """Runs the steps with this fault alone until a test fails that passes without it."""
        start, steps = time.time(), [list(step) for step in steps]
        while fault["state"] == "survived" and steps:
            step = [t for t in steps[0] if t not in unsure]
            with planted([fault]):
                near_by = [p for p in programs if p in step or p.startswith("koksma-")]
                targets = ["memory-tests"] if build == "build/dev" else near_by
                built(build, *targets) or sys.exit("%s with %s does not link" % (build, fault))
                failed = step and failures(build, step, "--stop-on-failure")
            if not failed:
                del steps[0]
            elif built(build, *targets) and not failures(build, failed[:1]):
                fault.update(state="found", test=failed[0])
            else:
                unsure.add(failed[0])
        fault["seconds"] = round(fault.get("seconds", 0) + time.time() - start)
        report(faults, out)
        print("%(area)s %(file)s:%(line)d %(to)s | %(state)s in %(seconds)d s" % fault, fault.get("test", ""), flush=True)

    tests = tests_of(build, options)
    for area in AREAS:
        known = [f for f in faults if f["area"] == area]
        for fault in itertools.islice(draw(seed, area), len(known), None):
            if sum(f["state"] != "none" for f in known) == int(each):
                break
            good = code(fault)
            with planted([fault]):
                fault["state"] = "none" if code(fault) in (good, False) else "survived"
            faults.append(fault)
            known.append(fault)
            if fault["state"] != "none":
                ask(fault, near(fault, tests), build)
    for build, target, options in SUITES:
        tests = tests_of(build, options)
        while tests:
            left = [f for f in faults if f["state"] == "survived"]
            with planted(left):
                built(build, target) or sys.exit("%s does not build with all that are left" % build)
                failed = set(failures(build, list(tests))) - unsure
            tests = {t: (0, tests[t][1]) for t in sorted(failed, key=lambda t: tests[t][0])}
            print(build, "with", len(left), "faults fails:", *tests, flush=True)
            for fault in left:
                ask(fault, near(fault, tests), build)
            if all(f["state"] == "survived" for f in left):  # no failure is of a test that is near: ask each
                for fault in left:
                    ask(fault, ([t] for t in tests), build)
                break


if __name__ == "__main__":
    main(*sys.argv[1:]) if len(sys.argv) in (3, 4) else sys.exit(__doc__)

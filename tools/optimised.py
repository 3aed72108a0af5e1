#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the experiment of docs/findings/optimised.md: which measure, when sets are optimised for it, wins the picture?

    tools/optimised.py --koksma PROGRAM -o DIR [--seed R] [--quick] [--keep]

It follows studies/optimised/design.json: searches sets for each target (koksma optimise), measures them, renders them by a plan
of koksma study in DIR/study-R, and estimates the bias of arms. What is done is kept: an interrupted run continues when it is
started again, and `koksma study audit study-R`, started in DIR, makes its rows again. The rows are DIR/images-R.csv.xz,
sets-R.csv.xz and bias-R.csv.xz; --keep copies them to studies/optimised, where tools/optimised_models.py reads them. Another
seed R, 1 or more, gives other random starts, searches and shifts, and the other reference of the design. --quick: fewer n, sets
and trials. Everything runs on one thread, and equal arguments give equal rows."""
import argparse
import csv
import io
import itertools
import json
import lzma
import os
import pathlib
import re
import shutil
import sqlite3
import subprocess
import sys

import numpy as np

TREE = pathlib.Path(__file__).resolve().parent.parent
HOME = TREE / "studies" / "optimised"
SET = re.compile(r"file:sets-\d+/(?P<target>[a-z0-9-]+)_\{n\}_(?P<search>\d+)\.txt(?P<rest>.*)")


def read_design(quick):
    design = json.loads((HOME / "design.json").read_text(encoding="utf-8"))
    if quick:
        design.update(design["quick"])
        design["bias"]["n"] = design["quick"]["n"][:1]
    return design


class Run:
    """A run in a folder, with one seed."""

    def __init__(self, program, folder, seed, design):
        self.program, self.folder, self.seed, self.design = os.path.abspath(program), pathlib.Path(folder), seed, design
        self.sets = f"sets-{seed}"
        (self.folder / self.sets).mkdir(parents=True, exist_ok=True)
        (self.folder / "scenes").mkdir(exist_ok=True)
        for scene in design["scenes"]:
            if "file" in scene:  # here, so that no row depends on where the tree lies
                shutil.copy(HOME / f"{scene['name']}.json", self.folder / "scenes")

    def koksma(self, *arguments, **options):
        return subprocess.run([self.program, *map(str, arguments)], cwd=self.folder, check=True, **options)

    def scene(self, scene):
        return f"./scenes/{scene['name']}.json" if "file" in scene else scene["name"]

    def all_sets(self):
        names = [t["name"] for t in self.design["targets"]]
        return list(itertools.product(self.design["n"], names, range(self.design["searches"])))

    def search(self):
        """Makes every set that is not there; a search with the same number starts from the same random points."""
        targets = {t["name"]: t for t in self.design["targets"]}
        todo = [(n, t, s) for n, t, s in self.all_sets() if not (self.folder / self.sets / f"{t}_{n}_{s}.txt").exists()]
        for k, (n, name, s) in enumerate(todo):
            part = self.folder / self.sets / "part.txt"
            self.koksma("optimise", *targets[name]["arguments"], "-n", n, "--from", f"random@{n}", "-s", 1000 * self.seed + s,
                        "--steps", targets[name]["steps"], "--threads", 1, "-q", "-o", part, stdout=subprocess.DEVNULL)
            part.rename(part.with_name(f"{name}_{n}_{s}.txt"))
            progress(f"sets: {k + 1} of {len(todo)}")

    def measure(self):
        """The values of all measures: a row for each set."""
        sets = self.all_sets()
        done = self.koksma("measure", *(f"{self.sets}/{t}_{n}_{s}.txt" for n, t, s in sets), "-m", ",".join(self.design["measures"]),
                           "--json", "--threads", 1, stdout=subprocess.PIPE, text=True)
        values = [json.loads(line)["value"] for line in done.stdout.splitlines()]
        width = len(self.design["measures"])
        rows = [[t, n, s, *(f"{v:.8g}" for v in values[i * width:(i + 1) * width])] for i, (n, t, s) in enumerate(sets)]
        self.write("sets", ["target", "n", "search", *self.design["measures"]], rows)

    def plan(self):
        """The plan of koksma study; blocks are split by filter and integrator, which only some have."""
        design, blocks = self.design, []
        sets = [f"file:{self.sets}/{t['name']}_{{n}}_{s}.txt" for t in design["targets"] for s in range(design["searches"])]
        reference = design["references"][(self.seed - 1) % len(design["references"])]
        def add(patterns, trials, filters, **more):
            for integrator in sorted({s.get("integrator", "") for s in design["scenes"]}):
                scenes = [self.scene(s) for s in design["scenes"] if s.get("integrator", "") == integrator]
                options = {"filter": filters, **({"integrator": [integrator]} if integrator else {})}
                blocks.append({"scenes": scenes, "size": design["size"], "patterns": patterns, "spp": design["n"], "trials": trials,
                               "options": options, "references": [reference], **more})
        for arm in design["arms"].values():
            phases = range(1, arm["phases"] + 1) if "phases" in arm else [0]
            patterns = [arm["pattern"].format(set=s, phase=1000 * self.seed + k) for k in phases for s in sets]
            add(patterns, arm.get("trials", 1), arm["filters"])
        add(design["patterns"], self.seed * design["pattern-trials"], ["box", "gaussian"], id="patterns", skip=True)
        return {"name": f"optimised-{self.seed}", "title": design["title"], "about": design["about"], "images": blocks,
                "questions": [{"id": "patterns", "title": "The patterns of the house", "kind": "table", "images": "patterns"}]}

    def render(self):
        (self.folder / f"plan-{self.seed}.json").write_text(json.dumps(self.plan()), encoding="utf-8")
        self.koksma("study", "run", f"./plan-{self.seed}.json", "-o", f"study-{self.seed}", "--threads", 1)
        with sqlite3.connect(f"file:{self.folder}/study-{self.seed}/results.sqlite?mode=ro", uri=True) as database:
            found = database.execute("SELECT scene, options, pattern, n, result.id >> 32, v0, v3 FROM result CROSS JOIN series"
                                     " ON series.id = (result.id & 4294967295) WHERE kind = 'image'").fetchall()
        rows = [row for row in (self.image_row(*f) for f in found) if row]
        self.write("images", ["target", "n", "search", "scene", "filter", "arm", "trial", "mae", "rmse"], sorted(rows))

    def image_row(self, scene, options, pattern, n, trial, mae, rmse):
        """A row of the study as a row of the experiment; None: a trial of a pattern that belongs to another seed."""
        name = pathlib.PurePath(scene).stem
        box = "gaussian" if "filter=gaussian" in options else "box"
        match = SET.fullmatch(pattern)
        if not match:
            trial -= (self.seed - 1) * self.design["pattern-trials"]
            return (f"pattern:{pattern}", n, -1, name, box, "pattern", trial, f"{mae:.6g}", f"{rmse:.6g}") if trial >= 0 else None
        rest = match["rest"]
        phase = re.search(r"phase=(\d+)", rest)
        arm = "phase" if phase else "shift" if "shift" in rest else "turned" if "mirror" in rest else "fixed"
        trial = int(phase[1]) - 1000 * self.seed - 1 if phase else trial
        return match["target"], n, int(match["search"]), name, box, arm, trial, f"{mae:.6g}", f"{rmse:.6g}"

    def picture(self, scene, pattern, n, seed):
        """A render as an array of luminance, or of the one channel that it has."""
        path = self.folder / "picture.pfm"
        more = ["--integrator", scene["integrator"]] if "integrator" in scene else []
        self.koksma("render", self.scene(scene), "-p", pattern, "-n", n, "-s", seed, "--size", "{}x{}".format(*self.design["size"]),
                    *more, "--threads", 1, "-q", "-o", path.name, stdout=subprocess.DEVNULL)
        image = read_pfm(path)
        return image @ ([1.0] if image.shape[2] == 1 else [0.2126, 0.7152, 0.0722])

    def bias(self):
        """The squared bias of search 0 of each target: products of the errors of different replicates have that mean."""
        design, rows = self.design["bias"], []
        path = self.folder / f"bias-{self.seed}.part.csv"
        done = set()
        if path.exists():
            rows = [r for r in csv.reader(io.StringIO(path.read_text(encoding="utf-8"))) if len(r) == 7]
            done = {tuple(r[:4]) for r in rows}
        with open(path, "a", encoding="utf-8") as part:
            for scene in self.design["scenes"]:
                exact = None
                for n, target, arm in itertools.product(design["n"], self.design["targets"], design["arms"]):
                    key = (target["name"], str(n), scene["name"], arm)
                    if key in done:
                        continue
                    if exact is None:
                        exact = np.mean([self.picture(scene, "sobol:scramble=owen", 4096, 10**6 * self.seed + k) for k in range(2)], axis=0)
                    points = f"file:{self.sets}/{target['name']}_{n}_0.txt"
                    pattern = self.design["arms"][arm]["pattern"].format(set=points)
                    errors = np.array([self.picture(scene, pattern, n, 1000 * self.seed + k) - exact for k in range(design["replicates"])])
                    mse, count = float(np.mean(errors**2)), len(errors)
                    squared = (count * float(np.mean(errors.mean(axis=0)**2)) - mse) / (count - 1)
                    rows.append([*key, str(count), f"{mse:.6g}", f"{squared:.6g}"])
                    part.write(",".join(rows[-1]) + "\n")
                    part.flush()
                progress(f"bias: {scene['name']}")
        self.write("bias", ["target", "n", "scene", "arm", "replicates", "mse", "bias2"], sorted(rows))

    def write(self, kind, head, rows):
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows([head, *rows])
        (self.folder / f"{kind}-{self.seed}.csv.xz").write_bytes(lzma.compress(text.getvalue().encode(), preset=9 | lzma.PRESET_EXTREME))


def read_pfm(path):
    """The pixels of a PFM file, of shape (height, width, channels)."""
    with open(path, "rb") as file:
        file.readline()
        (width, height), scale = map(int, file.readline().split()), float(file.readline())
        return np.frombuffer(file.read(), "<f4" if scale < 0 else ">f4").reshape(height, width, -1).astype(float)


def progress(text):
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="\n" if text.startswith("bias") else "", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--koksma", default="koksma")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    if arguments.seed < 1 or arguments.quick and arguments.keep:
        parser.error("--seed is 1 or more, and --keep takes full runs only")
    run = Run(shutil.which(arguments.koksma) or parser.error(f"{arguments.koksma}: no such program"), arguments.output, arguments.seed,
              read_design(arguments.quick))
    try:
        run.search()
        run.measure()
        run.render()
        run.bias()
    except KeyboardInterrupt:
        print("optimised.py: interrupted; the same command continues", file=sys.stderr)
        return 130
    except subprocess.CalledProcessError as error:
        print(f"optimised.py: {' '.join(error.cmd[:3])} ... ended with exit code {error.returncode}", file=sys.stderr)
        return 130 if error.returncode in (130, -2) else 4
    if arguments.keep:
        for kind in ("images", "sets", "bias"):
            shutil.copy(run.folder / f"{kind}-{run.seed}.csv.xz", HOME)
    return 0


if __name__ == "__main__":
    sys.exit(main())

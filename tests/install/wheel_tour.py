#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""wheel_tour.py [NOTEBOOKS]: a tour of an installed wheel, for a system that has Python and nothing of ours: what README and
docs/install.md show, every module, the program, and the code cells of notebooks. Values are those of the documents, files
are known by their formats' marks. scripts/wheel runs it."""
import json
import os
import subprocess
import sys
import sysconfig
import tempfile

import numpy as np

import koksma

# What pip puts there on Windows wine's Python lacks.
WINDOWS = os.name == "nt"
PROGRAM = [sys.executable, "-c", "from koksma._program import main; main()"] if WINDOWS else [os.path.join(sysconfig.get_path("scripts"), "koksma")]


def first_lines():
    """The five lines of docs/install.md, then those of README; the engine is SciPy's where that is installed."""
    points = koksma.generate("poisson-disk:d=0.2", 16, seed=7)
    value = koksma.measure(points, "star")
    assert (f"{value.value:.6f}", value.witness.count) == ("0.175024", 10), value
    assert len(koksma.spectrum(points).ring_power) > 0
    assert koksma.render("ball", "multi-jittered", spp=4, size=(32, 24)).shape == (24, 32, 1)
    assert koksma.Engine("sobol:scramble=owen", d=2, seed=7).random(8).shape == (8, 2)
    points = koksma.generate("sobol:scramble=owen", 16, seed=7)
    assert koksma.measure(points, "star").value < 0.2  # random points: 0.29 on average
    assert koksma.render("ball", "pmj02", spp=16).ndim == 3
    assert koksma.Engine("sobol:scramble=owen", d=2).random(4).shape == (4, 2)


def whole_package(folder):
    ranking = koksma.rank("checker", ["n-rooks", "random"], 4, size=(16, 12), one_size=True, max_trials=16, time_limit=60)
    assert ranking.rows[0].pattern == "n-rooks", ranking
    plan = {"name": "tour", "title": "Tour", "discrepancies": [
        {"id": "d", "patterns": ["random", "n-rooks"], "measures": ["star"], "n": [16], "trials": 4}]}
    with koksma.Study(plan, os.path.join(folder, "study")) as study:
        assert study.run().complete
        report = study.report()
        assert len(study.rows()) == 8
    assert os.path.getsize(report) > 1000
    points = koksma.generate("n-rooks", 64)
    version = subprocess.run([*PROGRAM, "version"], capture_output=True, text=True, check=True).stdout
    cairo, exr = "pdf and png: left out" not in version, "exr images: left out" not in version
    for format, mark in [("svg", b"<")] + cairo * [("pdf", b"%PDF"), ("png", b"\x89PNG")]:
        assert koksma.plot(points).bytes(format).startswith(mark), format
    assert koksma.optimise("l2-star", n=16, steps=100).value > 0
    assert koksma.integrate("genz-gaussian", "n-rooks", 64).rmse[0] > 0
    image = koksma.render("ball", "n-rooks", spp=4, size=(32, 24))
    for name, mark in [("a.png", b"\x89PNG"), ("a.pfm", b"P")] + exr * [("a.exr", b"\x76\x2f\x31\x01")]:
        koksma.write_image(os.path.join(folder, name), image)
        with open(os.path.join(folder, name), "rb") as file:
            assert file.read(4).startswith(mark), name
        assert koksma.read_image(os.path.join(folder, name)).shape[:2] == (24, 32)


def program(folder):
    run = subprocess.run([*PROGRAM, "measure", "pattern:poisson-disk:d=0.2@16", "-m", "star", "--seed", "7"], capture_output=True,
                         text=True, check=True, cwd=folder)
    assert "0.17502" in run.stdout, run.stdout
    said = subprocess.run([*PROGRAM, "rank", "scene", "-p", "a", "--with", 'echo "$KOKSMA_PYTHON"; exit 3; : {out}'], capture_output=True,
                          text=True, cwd=folder).stderr
    assert ("on this system Koksma runs no programs" if WINDOWS else sys.executable) in said, said  # what `--with mitsuba` runs
    for what in ("patterns", "measures", "scenes"):
        subprocess.run([*PROGRAM, "list", what], stdout=subprocess.DEVNULL, check=True)


def notebooks(folder):
    """The code cells of each, in a namespace of its own."""
    before = os.getcwd()
    os.chdir(folder)
    for name in sorted(os.listdir(".")):
        if name.endswith(".ipynb"):
            with open(name, encoding="utf-8") as file:
                cells = json.load(file)["cells"]
            space = {}
            for cell in cells:
                code = "".join(cell["source"])
                if cell["cell_type"] == "code":
                    exec(compile("\n".join(line for line in code.split("\n") if not line.startswith("%")), name, "exec"), space)
    os.chdir(before)


def main():
    with tempfile.TemporaryDirectory() as folder:
        first_lines()
        whole_package(folder)
        program(folder)
    for books in sys.argv[1:]:
        notebooks(books)
    print(f"koksma {koksma.version()} at {os.path.dirname(koksma.__file__)}: Python {sys.version.split()[0]}, NumPy {np.__version__}")


if __name__ == "__main__":
    main()

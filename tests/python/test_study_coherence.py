#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The coherence rows of a study are the peak of the Fourier transform's power over its mean, computed here by numpy
from the images and the reference; p is Fisher's probability; the frequency is where the peak is; an error that is
the same in all pixels has none. Images of one ring of frequencies, so that no ring excuses a peak."""
import csv
import glob
import json
import math
import os
import subprocess
import tempfile

import numpy as np

import koksma

WIDTH, HEIGHT = 15, 12
EVEN = {"camera": {"eye": [0, 1, 0], "target": [0, 1, -1], "fov_deg": 20}, "background": 0.5, "ambient": 1,
        "materials": [], "shapes": [], "image": {"width": WIDTH, "height": HEIGHT}}
PLAN = {"name": "p", "title": "p", "images": [
    {"scenes": ["checker", "even.json"], "size": [WIDTH, HEIGHT], "patterns": ["random", "regular"], "spp": [4],
     "trials": 3, "references": [{"name": "a", "pattern": "regular", "spp": 9},
                                 {"name": "c", "pattern": "jittered", "spp": 256}]}]}


def run(*arguments):
    return subprocess.run([os.environ["KOKSMA"], *arguments], check=True, capture_output=True, text=True).stdout


def luminance(image):
    image = image.astype(float)
    return image @ [0.2126, 0.7152, 0.0722] if image.shape[2] == 3 else image[..., 0]


def expected(error):
    """Coherence, p, and the frequencies that have a power so near the peak's that either may be it."""
    power = np.abs(np.fft.fft2(error - error.mean())) ** 2
    power[0, 0] = 0
    power *= (power.size - 1) / power.sum()
    peak, free = power.max(), power.size - 1
    own = sum(math.isclose(2 * u % WIDTH, 0) and math.isclose(2 * v % HEIGHT, 0)
              for u in range(WIDTH) for v in range(HEIGHT)) - 1
    wave = max(1 - 2 * peak / free, 0) ** ((free - 2) / 2)
    p = 1 - (1 - wave) ** ((free - own) // 2) * (1 - math.erfc(math.sqrt(peak / 2))) ** own
    return peak, p, {(u, v) for v, u in zip(*np.nonzero(power > peak * (1 - 1e-9)))}


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for name, value in (("even.json", EVEN), ("plan.json", PLAN)):
        with open(name, "w", encoding="utf-8") as file:
            json.dump(value, file)
    run("study", "run", "./plan.json", "-o", "results", "-q")
    rows = list(csv.DictReader(run("study", "export", "results").splitlines()))
    references = [luminance(koksma.read_image(path)) for path in glob.glob("results/references/*.exr")]
    seen = {"checker": 0, "even.json": 0}
    for row in (r for r in rows if r["kind"] == "coherence"):
        assert row["what"] == "c:jittered@256x1" and row["sd"] == row["max"] == row["rmse"] == "", row
        value, p = float(row["value"]), float(row["p"])
        x, y = float(row["frequency_x"]), float(row["frequency_y"])
        seen[row["scene"]] += 1
        if row["scene"] == "even.json":
            assert (value, p, x, y) == (0, 1, 0, 0), row
            continue
        run("render", "checker", "--size", f"{WIDTH}x{HEIGHT}", "-p", row["pattern"], "-n", "4", "-s", row["seed"],
            "-o", "image.exr", "-q")
        image = luminance(koksma.read_image("image.exr"))
        error = min((image - r for r in references), key=lambda e: abs(np.abs(e).mean() - float(next(
            r["value"] for r in rows if r["kind"] == "image" and all(
                r[k] == row[k] for k in ("scene", "pattern", "what", "trial"))))))
        peak, tail, places = expected(error)
        assert abs(value / peak - 1) < 1e-6, (value, peak)
        assert abs(p - tail) < 1e-4, (p, tail)
        place = (round(x * WIDTH), round(-y * HEIGHT) % HEIGHT)
        assert place in places or ((WIDTH - place[0]) % WIDTH, -place[1] % HEIGHT) in places, (row, places)
    assert seen == {"checker": 6, "even.json": 6}, seen
    assert all(r["p"] == "" for r in rows if r["kind"] == "image")
    # JSON has the same numbers.
    lines = [json.loads(line) for line in run("study", "export", "results", "--format", "json").splitlines()]
    for key in ("p", "frequency_y"):
        assert [line[key] for line in lines] == [float(r[key]) if r[key] else None for r in rows]

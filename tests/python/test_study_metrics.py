#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The rows of metrics in a study are their definitions, computed here by numpy from the images and the reference: mae,
rmse, relmse and smape with the robust value and the share of the 0.1 % of the pixels with the largest errors. FLIP, whose
definition tests/image/test_metrics.c has, is as koksma.compare gives it, and measured only where the plan names it. The
rows of images keep their numbers."""
import csv
import glob
import json
import os
import subprocess
import tempfile

import numpy as np

import koksma

WIDTH, HEIGHT = 56, 40  # two pixels are 0.1 %
PLAN = {"name": "p", "title": "p", "metric": "relmse:epsilon=0.1", "metrics": ["ldr-flip:ppd=20", "smape"], "images": [
    {"id": "i", "scenes": ["ball"], "size": [WIDTH, HEIGHT], "patterns": ["random", "jittered"], "spp": [4], "trials": 2,
     "references": [{"name": "a", "pattern": "regular", "spp": 9}, {"name": "c", "pattern": "jittered", "spp": 64}]}],
    "questions": [{"id": "1", "title": "t", "kind": "table", "images": "i", "metric": "hdr-flip"}]}
METRICS = ["mae", "rmse", "relmse", "smape", "relmse:epsilon=0.1", "ldr-flip:ppd=20", "hdr-flip"]


def run(*arguments):
    return subprocess.run([os.environ["KOKSMA"], *arguments], check=True, capture_output=True, text=True).stdout


def rgb(image):
    image = np.asarray(image, dtype=float)
    return image if image.shape[2] == 3 else np.repeat(image, 3, axis=2)


def errors_of(metric, x, y):
    """The error of each pixel; the value is its mean, of rmse the root of its mean."""
    name, _, epsilon = metric.partition(":epsilon=")
    difference = (x - y) @ [0.2126, 0.7152, 0.0722]
    if name in ("mae", "rmse"):
        return np.abs(difference) if name == "mae" else difference ** 2
    epsilon = float(epsilon or 0.01)
    each = (x - y) ** 2 / (y ** 2 + epsilon) if name == "relmse" else np.abs(x - y) / (np.abs(x) + np.abs(y) + epsilon)
    return each.mean(axis=2)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    with open("plan.json", "w", encoding="utf-8") as file:
        json.dump(PLAN, file)
    run("study", "run", "./plan.json", "-o", "results", "-q")
    rows = list(csv.DictReader(run("study", "export", "results").splitlines()))
    references = [koksma.read_image(path) for path in glob.glob("results/references/*.exr")]
    assert len(references) == 2
    images = {(r["pattern"], r["trial"]): r for r in rows if r["kind"] == "image" and r["what"].startswith("c:")}
    metrics = [r for r in rows if r["kind"] == "metric"]
    assert len(images) == 4 and len(metrics) == 4 * len(METRICS), (len(images), len(metrics))
    for (pattern, trial), row in images.items():
        assert row["robust"] == row["top_share"] == row["metric"] == "", row
        run("render", "ball", "--size", f"{WIDTH}x{HEIGHT}", "-p", pattern, "-n", "4", "-s", row["seed"], "-o", "image.exr", "-q")
        image = koksma.read_image("image.exr")
        # the reference of these rows is the one whose mean absolute error they have
        reference = min(references, key=lambda r: abs(errors_of("mae", rgb(image), rgb(r)).mean() - float(row["value"])))
        mine = {r["metric"]: r for r in metrics if (r["pattern"], r["trial"]) == (pattern, trial)}
        assert sorted(mine) == sorted(METRICS), mine
        for metric, found in mine.items():
            value, robust, share = (float(found[name]) for name in ("value", "robust", "top_share"))
            assert found["what"] == row["what"] and found["seed"] == row["seed"], found
            assert found["sd"] == found["max"] == found["rmse"] == found["p"] == found["frequency_x"] == "", found
            assert found["measured_by"] == f"{metric.partition(':')[0]} {int('flip' in metric)}, {row['measured_by']}", found  # the metric's revision
            if "flip" in metric:
                c = koksma.compare(image, reference, metrics=[metric]).metrics[metric]
                assert (value, robust, share) == (c.value, c.robust, c.top_share), (found, c)
                continue
            e = np.sort(errors_of(metric, rgb(image), rgb(reference)).ravel())
            root = np.sqrt if metric == "rmse" else lambda v: v
            expected = root(e.mean()), root(e[:-2].mean()), e[-2:].sum() / e.sum()
            assert np.allclose((value, robust, share), expected, rtol=1e-12, atol=0), (found, expected)
        assert abs(float(mine["mae"]["value"]) / float(row["value"]) - 1) < 1e-13, row
        assert abs(float(mine["rmse"]["value"]) / float(row["rmse"]) - 1) < 1e-13, row

    # In Python the rows have the same columns.
    with koksma.Study((), "results") as study:
        table = study.rows()
    relmse = table[(table["kind"] == "metric") & (table["metric"] == "relmse")]
    assert sorted(map(str, relmse["value"])) == sorted(str(float(r["value"])) for r in metrics if r["metric"] == "relmse")
    assert not np.isnan(relmse["robust"]).any() and np.isnan(table["robust"][table["kind"] == "image"]).all()

    # The same rows without the metrics that only this plan names, bit for bit.
    with open("plain.json", "w", encoding="utf-8") as file:
        json.dump({"name": "p", "title": "p", "images": PLAN["images"]}, file)
    run("study", "run", "./plain.json", "-o", "plain", "-q")
    plain = list(csv.DictReader(run("study", "export", "plain").splitlines()))
    assert plain == [r for r in rows if r["metric"] in ("", "mae", "rmse", "relmse", "smape")]
    assert not any("flip" in r["metric"] for r in plain)
    print("passed")

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the samples that `koksma rank --target-error` names give the error that it states.

    PYTHONPATH=python KOKSMA_LIBRARY_DIR=build/clang/src tools/rank_target_coverage.py [RUNS [SCENE:ERROR...]]

For each scene and pattern: runs of the command with different seeds, in how many of them its 95 % interval holds the mean error
of 400 images of other seeds against an image of 65,536 samples, and the medians of the numbers of samples and of that error."""
import statistics
import sys

import numpy as np

import koksma

SIZE, IMAGES, EXACT = (16, 12), 400, 65536
PATTERNS = ("sobol:scramble=owen", "pmj02", "jittered", "random")
SCENES = ("ball:0.01", "balls:0.002", "glossy:0.002")


def render(scene, pattern, spp, seed):
    image = koksma.render(scene, pattern, spp, size=SIZE, seed=seed, integrator="distribution", filter="box", lights="all")
    return image @ np.array([0.2126, 0.7152, 0.0722]) if image.shape[2] == 3 else image[:, :, 0].astype(float)


def main(runs, *scenes):
    print("| scene | error | pattern | samples | error of other images | held |\n|---|---|---|---|---|---|")
    for scene, target in (part.split(":") for part in scenes or SCENES):
        exact, known = render(scene, "sobol:scramble=owen", EXACT, 1), {}
        found = {pattern: [] for pattern in PATTERNS}
        for run in range(runs):
            for row in koksma.rank_to_error(scene, float(target), PATTERNS, size=SIZE, seed=run, time_limit=None):
                key = row.pattern, row.spp
                if key not in known:
                    known[key] = np.mean([abs(render(scene, *key, 10**6 + seed) - exact).mean() for seed in range(IMAGES)])
                low, high = row.interval
                found[row.pattern].append((row.spp, known[key], low <= known[key] <= high))
        for pattern, rows in found.items():
            samples, errors, held = zip(*rows)
            print(f"| {scene} | {target} | `{pattern}` | {statistics.median(samples):.0f} | {statistics.median(errors):.3g} | "
                  f"{sum(held)} of {runs} |", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100, *sys.argv[2:])

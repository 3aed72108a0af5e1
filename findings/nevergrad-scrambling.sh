#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the points of ScrHaltonSearch are those of a randomised Halton sequence: over the seeds the first point is
# anywhere in the cube.
# Seen: the digits' permutations keep 0 and are all that is random: the first coordinate, in base 2, is never
# changed, and the first point is a multiple of 1/2, 1/3, 1/5. An average over seeds is not that of uniform points.
# Packages: numpy==2.3.5 nevergrad==1.0.12
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 nevergrad==1.0.12
venv/bin/python - <<'END'
import nevergrad as ng
import numpy as np


def points(seed):
    box = ng.p.Array(shape=(3,), lower=0, upper=1)
    box.random_state.seed(seed)
    search = ng.optimizers.registry["ScrHaltonSearch"](parametrization=box, budget=4)
    asked = []
    for _ in range(4):
        candidate = search.ask()
        asked.append(candidate.value.copy())
        search.tell(candidate, 0.0)
    return np.array(asked)


sets = np.array([points(seed) for seed in range(1, 13)])
firsts = {tuple(np.round(s[0] * [2, 3, 5], 6).tolist()) for s in sets}
print("first points, in units of 1/2, 1/3, 1/5:", sorted(firsts))
print("first coordinates:", np.unique(np.round(sets[:, :, 0], 6), axis=0).tolist())
whole = all(float(x).is_integer() for p in firsts for x in p)
raise SystemExit(bool(not whole or len(firsts) < 2 or np.ptp(sets[:, :, 0], axis=0).max() > 1e-6))
END

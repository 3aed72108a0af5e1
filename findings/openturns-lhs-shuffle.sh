#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: each generate() of an LHSExperiment is a new Latin hypercube, independent of the last.
# Seen: all designs of one experiment have one permutation of cells, and only the places in the cells are new:
# averages over designs of one experiment do not approach what independent designs give. setAlwaysShuffle(True) draws
# a permutation each time.
# Packages: numpy==2.3.5 openturns==1.27.post1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 openturns==1.27.post1
venv/bin/python - <<'END'
import numpy as np
import openturns as ot

uniform = ot.JointDistribution([ot.Uniform(0, 1)] * 2)


def cells(experiment):
    x = np.array(experiment.generate())
    return tuple((x[np.argsort(x[:, 0]), 1] * 8).astype(int).tolist())


usual = ot.LHSExperiment(uniform, 8)
shuffled = ot.LHSExperiment(uniform, 8)
shuffled.setAlwaysShuffle(True)
kept, drawn = {cells(usual) for _ in range(5)}, {cells(shuffled) for _ in range(5)}
print("permutations of five designs:", len(kept), "and with setAlwaysShuffle:", len(drawn))
raise SystemExit(len(kept) != 1 or len(drawn) < 4)
END

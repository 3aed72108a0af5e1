#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: QMCSampler's 16 trials of an unscrambled Sobol' study are its first 16 points, one in each of 4 x 4 squares.
# Seen: the first trial is an independent random point, since the search space is known only after it; the Sobol'
# points begin at the second trial, with the origin, and 16 trials have 15 of them.
# Packages: numpy==2.3.5 scipy==1.17.1 optuna==5.0.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 optuna==5.0.0
venv/bin/python - <<'END'
import optuna
optuna.logging.set_verbosity(optuna.logging.ERROR)
study = optuna.create_study(sampler=optuna.samplers.QMCSampler(scramble=False, seed=1))
study.optimize(lambda trial: trial.suggest_float("x", 0, 1) + trial.suggest_float("y", 0, 1), n_trials=16)
points = [(trial.params["x"], trial.params["y"]) for trial in study.trials]
print("trials 1 to 3:", points[:3])
squares = len({(int(4 * x), int(4 * y)) for x, y in points})
print("squares of 4 x 4 that have a trial: %d" % squares)
raise SystemExit(not (points[1] == (0.0, 0.0) and points[2] == (0.5, 0.5) and points[0] != (0.0, 0.0) and squares < 16))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: ff.sample of a problem with three parameters gives a design of three columns and leaves the problem as it was.
# Seen: it gives four columns and adds a parameter dummy_0 to the caller's dictionary, as it needs a power of two:
# whatever samples the problem after it, latin or sobol, has four columns, too, and other points.
# Packages: numpy==2.3.5 scipy==1.17.1 SALib==1.6.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 SALib==1.6.0
venv/bin/python - <<'END_OF_CHECK'
from SALib.sample import ff, latin, sobol

seen = True
for kind, sample in (("latin", lambda p: latin.sample(p, 8, seed=1)), ("sobol", lambda p: sobol.sample(p, 8, seed=1))):
    problem = {"num_vars": 3, "names": ["a", "b", "c"], "bounds": [[0, 1]] * 3}
    before, design, after = sample(problem), ff.sample(problem), sample(problem)
    print(f"{kind} {before.shape}, ff {design.shape}, {kind} {after.shape}; names", problem["names"])
    seen = seen and (before.shape[1], design.shape[1], after.shape[1]) == (3, 4, 4) and len(problem["names"]) == 4
raise SystemExit(not seen)
END_OF_CHECK

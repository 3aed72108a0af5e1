#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: sample(16, rule="grid") of two dimensions gives 16 points, a grid of 4 x 4, as rule="random" gives 16.
# Seen: it gives 256: the number is that along an axis. rule="chebyshev" does the same; "halton", "sobol", "hammersley",
# "korobov" and "latin_hypercube" give 16. A comparison of rules at one size compares n with n^dim points.
# Packages: numpy==2.3.5 chaospy==4.3.21
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 chaospy==4.3.21
venv/bin/python - <<'END'
import chaospy

square = chaospy.J(chaospy.Uniform(0, 1), chaospy.Uniform(0, 1))
rules = ["random", "halton", "sobol", "hammersley", "korobov", "latin_hypercube", "grid", "chebyshev"]
counts = {rule: square.sample(16, rule=rule, seed=1).shape[1] for rule in rules}
print("points of sample(16):", counts)
raise SystemExit(any(n != (256 if rule in ("grid", "chebyshev") else 16) for rule, n in counts.items()))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: an unknown name of a tone mapper is an error, and names are matched in lower and upper case alike or not at
# all.
# Seen: REINHARD is taken in silence, but as the default, ACES: HDR-FLIP is that of aces and not that of reinhard.
# Packages: numpy==2.3.5 flip-evaluator==1.7
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 flip-evaluator==1.7
venv/bin/python - <<'END'
import numpy, flip_evaluator
reference = numpy.full((32, 32, 3), 2.0, numpy.float32)
reference[:16] = 0.2
test = reference.copy()
test[8:12] *= 1.3
flip = {name: flip_evaluator.evaluate(reference, test, "HDR", parameters={"tonemapper": name})[1] for name in ("aces", "reinhard", "REINHARD")}
print({name: round(float(value), 5) for name, value in flip.items()})
raise SystemExit(not (flip["REINHARD"] == flip["aces"] != flip["reinhard"]))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: asked for 18 samples, the stratified samplers take 18 or the next power of two; the warning says what is
# needed.
# Seen: stratified takes 25, multijitter 20, orthogonal 25 (the square of a prime), ldsampler 64 (a power of four).
# The warning of stratified and ldsampler, that the count should be square and a power of two, is true of the latter
# alone: stratified takes 9 as it is.
# Packages: numpy==2.3.5 mitsuba==3.9.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 mitsuba==3.9.1
venv/bin/python - <<'END'
import mitsuba
mitsuba.set_variant("scalar_rgb")
mitsuba.set_log_level(mitsuba.LogLevel.Error)
def taken(kind, count):
    return mitsuba.load_dict({"type": kind, "sample_count": count}).sample_count()
counts = {kind: taken(kind, 18) for kind in ("independent", "stratified", "multijitter", "orthogonal", "ldsampler")}
print("18 samples become", counts, "and 9 of stratified", taken("stratified", 9))
expected = {"independent": 18, "stratified": 25, "multijitter": 20, "orthogonal": 25, "ldsampler": 64}
raise SystemExit(not (counts == expected and taken("stratified", 9) == 9))
END

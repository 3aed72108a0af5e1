#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: farthest-point sampling with start_idx=7 begins at point 7, in every function of the package, and all exact
# ones agree.
# Seen: fps_sampling begins at point 7; bucket_fps_kdtree_sampling and bucket_fps_kdline_sampling with the same
# start_idx begin at others.
# Packages: numpy==1.26.4 fpsample==1.0.2
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==1.26.4 fpsample==1.0.2
venv/bin/python - <<'END'
import fpsample, numpy
x = numpy.random.default_rng(0).random((500, 2))
plain = int(fpsample.fps_sampling(x, 5, start_idx=7)[0])
tree = int(fpsample.bucket_fps_kdtree_sampling(x, 5, start_idx=7)[0])
line = int(fpsample.bucket_fps_kdline_sampling(x, 5, 3, start_idx=7)[0])
print("first points: fps %d, kdtree %d, kdline %d" % (plain, tree, line))
raise SystemExit(not (plain == 7 and tree != 7 and line != 7))
END

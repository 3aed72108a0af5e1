#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the radial distribution function of independent points in a periodic box is 1 on average, at any number of
# points.
# Seen: it is (N - 1) / N: .9 for ten points. normalization_mode='finite_size' gives 1.
# Packages: numpy==2.3.5 scipy==1.17.1 freud-analysis==3.4.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 freud-analysis==3.4.0
venv/bin/python - <<'END'
import freud, numpy
random, box = numpy.random.default_rng(1), freud.box.Box.square(1.0)
def mean(**options):
    total = 0
    for _ in range(500):
        points = numpy.zeros((10, 3))
        points[:, :2] = random.random((10, 2)) - 0.5
        rdf = freud.density.RDF(bins=1, r_max=0.4, **options)
        total += float(rdf.compute((box, points)).rdf[0])
    return total / 500
values = mean(), mean(normalization_mode="finite_size")
print("ten random points: %.3f by default, %.3f with finite_size" % values)
raise SystemExit(not (abs(values[0] - 0.9) < 0.03 and abs(values[1] - 1) < 0.03))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: Ripley's K of one point set at one distance is nearly the same in two packages, up to the correction at the
# border.
# Seen: 200 points in the middle quarter of the unit square: astropy, which is told the window, has .10 at r = .1;
# pointpats, whose k takes none and goes by the points' own extent, has .025. pi r^2 is .031: clustered for one,
# regular for the other.
# Packages: numpy==2.3.5 scipy==1.17.1 astropy==8.0.2 pointpats==2.5.5
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 astropy==8.0.2 pointpats==2.5.5
venv/bin/python - <<'END'
import numpy
from astropy.stats import RipleysKEstimator
from pointpats import k
points = numpy.random.default_rng(0).random((200, 2)) * 0.5 + 0.25
r = numpy.array([0.1])
a = float(RipleysKEstimator(area=1.0, x_min=0, x_max=1, y_min=0, y_max=1)(points, r, mode="none")[0])
b = float(k(points, support=r)[1][0])
print("K(.1): astropy %.4f, pointpats %.4f, pi r^2 %.4f" % (a, b, 0.01 * numpy.pi))
raise SystemExit(not (abs(a - 0.103) < 0.003 and abs(b - 0.0252) < 0.002))
END

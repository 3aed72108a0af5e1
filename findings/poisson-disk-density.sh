#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: five implementations of Bridson's algorithm fill the square with one radius, .03, by nearly the same number
# of points.
# Seen: about 560 (bridson), 680 (scipy, poisson-disc), 720 (poisson-disk-sampling) and 1,000 (fast-2d-poisson-disk-
# sampling): candidates lie in the shell up to twice the radius, uniform in volume or in distance, or on its inner
# edge. SciPy has the last as hypersphere='surface': 940. The distance is kept by all.
# Packages: numpy==1.26.4 scipy 1.17.1, poisson-disc 0.2.1, bridson 0.1.0 (PyPI); poisson-disk-sampling 2.3.1, fast-2d-poisson-disk-sampling 1.0.3 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==1.26.4 scipy==1.17.1 poisson-disc==0.2.1 bridson==0.1.0
npm install --silent --no-audit --no-fund --ignore-scripts poisson-disk-sampling@2.3.1 fast-2d-poisson-disk-sampling@1.0.3
cat >check.mjs <<'END'
import Sampling from 'poisson-disk-sampling';
import Fast from 'fast-2d-poisson-disk-sampling';
console.log(new Sampling({ shape: [100, 100], minDistance: 3 }).fill().length);
console.log(new Fast({ shape: [100, 100], radius: 3 }).fill().length);
END
node check.mjs >counts
venv/bin/python - <<'END'
import bridson, numpy, poisson_disc
from scipy.stats import qmc
slow, fast = map(int, open("counts"))
counts = {
    "bridson": (len(bridson.poisson_disc_samples(100, 100, 3)), 530, 600),
    "poisson-disc": (len(poisson_disc.Bridson_sampling(dims=numpy.array([100.0, 100.0]), radius=3)), 650, 715),
    "scipy": (len(qmc.PoissonDisk(2, radius=0.03).fill_space()), 650, 715),
    "scipy, surface": (len(qmc.PoissonDisk(2, radius=0.03, hypersphere="surface").fill_space()), 915, 970),
    "poisson-disk-sampling": (slow, 685, 760),
    "fast-2d-poisson-disk-sampling": (fast, 960, 1030),
}
for name, (count, _, _) in counts.items():
    print(count, name)
raise SystemExit(not all(low <= count <= high for count, low, high in counts.values()))
END

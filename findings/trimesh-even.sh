#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: sample_surface_even keeps a distance r and leaves no place farther than r from all of its points, as a
# Poisson disk set does, at least where it gives as many points as asked for.
# Seen: it gives all of 1,000 points on a sphere, at least r = sqrt(area / 3000) apart, and a fifth of the surface is
# farther than r from all of them: the set is thinned out of random points, not filled.
# Packages: numpy==2.3.5 scipy==1.17.1 rtree==1.4.1 trimesh==5.2.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1 rtree==1.4.1 trimesh==5.2.0
venv/bin/python - <<'END'
import numpy, trimesh
from scipy.spatial import cKDTree
mesh = trimesh.creation.icosphere(4)
points, _ = trimesh.sample.sample_surface_even(mesh, 1000, seed=1)
radius = numpy.sqrt(mesh.area / 3000)
apart = cKDTree(points).query(points, k=2)[0][:, 1].min()
bare = (cKDTree(points).query(trimesh.sample.sample_surface(mesh, 20000, seed=2)[0])[0] > radius).mean()
print("%d points, %.3f r apart at least; %.1f %% of the surface is bare" % (len(points), apart / radius, 100 * bare))
raise SystemExit(not (len(points) == 1000 and apart >= radius and 0.15 < bare < 0.3))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: sample_mesh_poisson_disk with num_samples=1000 gives 1,000 points of a mesh, or somewhat fewer.
# Seen: about 45 % more: some 1,440 for 1,000 and 148 for 100 on a sphere, whatever the seed.
# Packages: numpy==1.26.4 point-cloud-utils==0.34.0
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==1.26.4 point-cloud-utils==0.34.0
venv/bin/python - <<'END'
import numpy, point_cloud_utils
# An octahedron, its triangles split five times and put onto the sphere.
vertices = [numpy.array(v, float) for v in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))]
faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
for _ in range(5):
    middles, finer = {}, []
    def middle(a, b):
        key = min(a, b), max(a, b)
        if key not in middles:
            v = vertices[a] + vertices[b]
            middles[key] = len(vertices)
            vertices.append(v / numpy.linalg.norm(v))
        return middles[key]
    for a, b, c in faces:
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    faces = finer
v, f = numpy.array(vertices), numpy.array(faces, numpy.int32)
counts = [len(point_cloud_utils.sample_mesh_poisson_disk(v, f, n, random_seed=1)[0]) for n in (100, 1000)]
print("asked for 100 and 1000 points, got", counts)
raise SystemExit(not (130 <= counts[0] <= 165 and 1350 <= counts[1] <= 1550))
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: in an OBJ file `f -3 -2 -1` is the triangle of the three vertices above it for every reader, also if more follow.
# Seen: PyWavefront, libigl and PyMeshLab read it so. meshio takes each corner one place too early; trimesh counts from the end
# of the file, so that every such triangle is the last one; Mitsuba raises an error.
# Packages: numpy==2.4.6 meshio==5.3.5 trimesh==5.2.0 PyWavefront==1.3.3 libigl==2.6.3 pymeshlab==2025.7.post1 mitsuba==3.9.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.4.6 meshio==5.3.5 trimesh==5.2.0 PyWavefront==1.3.3 libigl==2.6.3 \
    pymeshlab==2025.7.post1 mitsuba==3.9.1
printf '%s\n' 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'f -3 -2 -1' 'v 5 0 0' 'v 6 0 0' 'v 5 1 0' 'f -3 -2 -1' > relative.obj
venv/bin/python - <<'END'
import igl
import meshio
import mitsuba
import numpy as np
import pymeshlab
import pywavefront
import trimesh

right = [[0, 1, 2], [3, 4, 5]]
X = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [6, 0, 0], [5, 1, 0]])


def lab():
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh("relative.obj")
    return meshes.current_mesh().face_matrix().tolist()


def corners(triangles):
    """The numbers of the vertices at given places."""
    return [[int(np.where((X == v).all(1))[0][0]) for v in t] for t in triangles]


mesh = meshio.read("relative.obj")
seen = {"PyWavefront": pywavefront.Wavefront("relative.obj", collect_faces=True).mesh_list[0].faces,
        "libigl": igl.readOBJ("relative.obj")[3].tolist(), "PyMeshLab": lab(),
        "meshio": corners(mesh.points[mesh.cells[0].data]),
        "trimesh": corners(trimesh.load("relative.obj", process=False).triangles)}
mitsuba.set_variant("scalar_rgb")
try:
    mitsuba.load_dict({"type": "obj", "filename": "relative.obj"})
    seen["Mitsuba"] = "read"
except RuntimeError:
    seen["Mitsuba"] = "refused"
for name, faces in seen.items():
    print(name, faces)
wrong = {"meshio": [[2, 3, 4], [2, 3, 4]], "trimesh": [[3, 4, 5], [3, 4, 5]], "Mitsuba": "refused"}
raise SystemExit(any(faces != wrong.get(name, right) for name, faces in seen.items()))
END

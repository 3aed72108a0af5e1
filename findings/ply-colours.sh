#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: vertex colours of a PLY file are 128 of 255 if they are bytes and .5 if they are floats, so that both mean about
# .5 to each reader, possibly as sRGB.
# Seen: of five, trimesh alone reads both as .5, and three reads both as .21, since it takes them for sRGB. Mitsuba has
# bytes as 128, a reflectance of 128, with a warning; Open3D divides floats by 255, too, so that .5 is .002; MeshLab has
# floats of .25, .5 and .75 as 1.
# Packages: numpy==2.4.6 mitsuba==3.9.1 open3d==0.20.0 pymeshlab==2025.7.post1 trimesh==5.2.0 (PyPI), three 0.187.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
for kind in "uchar 64 128 191" "float .25 .5 .75"; do
    set -- $kind
    {
        printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n'
        printf "property $1 red\nproperty $1 green\nproperty $1 blue\nelement face 1\n"
        printf 'property list uchar int vertex_indices\nend_header\n'
        printf "0 0 0 $2 $3 $4\n1 0 0 $2 $3 $4\n0 1 0 $2 $3 $4\n3 0 1 2\n"
    } >"$1.ply"
done
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0
cat >colours.mjs <<'END'
import { readFileSync } from 'node:fs';
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
for (const kind of ['uchar', 'float']) {
    const { color } = new PLYLoader().parse(readFileSync(kind + '.ply', 'utf8')).attributes;
    console.log(color.getX(0), color.getY(0), color.getZ(0));
}
END
node colours.mjs >three.txt
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.4.6 mitsuba==3.9.1 open3d==0.20.0 pymeshlab==2025.7.post1 \
    trimesh==5.2.0
venv/bin/python - <<'END'
import mitsuba as mi
import numpy as np
import open3d
import pymeshlab
import trimesh

mi.set_variant("scalar_rgb")


def meshlab(path):
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(path)
    return meshes.current_mesh().vertex_color_matrix()[0]


readers = {
    "trimesh": lambda path: trimesh.load(path).visual.vertex_colors[0] / 255,
    "Mitsuba": lambda path: mi.traverse(mi.load_dict({"type": "ply", "filename": path}))["vertex_color"],
    "Open3D": lambda path: np.asarray(open3d.io.read_triangle_mesh(path).vertex_colors)[0],
    "MeshLab": meshlab,
}
seen = {(name, kind): np.array(read(kind + ".ply"))[:3] for name, read in readers.items() for kind in ("uchar", "float")}
seen |= {("three", kind): numbers for kind, numbers in zip(("uchar", "float"), np.loadtxt("three.txt"))}
even = np.array([.25, .5, .75])
expected = {key: even for key in seen} | {("Mitsuba", "uchar"): np.array([64, 128, 191])}
expected |= {("Open3D", "float"): even / 255, ("MeshLab", "float"): np.ones(3)}
linear = ((even + .055) / 1.055) ** 2.4
expected |= {("three", kind): linear for kind in ("uchar", "float")}
for key, colour in seen.items():
    print(*key, colour)
raise SystemExit(not all(np.allclose(seen[key], expected[key], rtol=.02) for key in seen))
END

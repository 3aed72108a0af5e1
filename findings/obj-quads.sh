#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a face of four corners in an OBJ file becomes the triangles 0 1 2 and 0 2 3 in every reader that makes
# triangles.
# Seen: trimesh, Mitsuba and three do that; tinyobjloader cuts along the shorter diagonal. Where the corners are not in
# one plane, renderers that read through it have another surface, and points on it differ.
# Packages: numpy==2.3.5 trimesh==5.2.0 tinyobjloader==2.0.0rc13 mitsuba==3.9.1 (PyPI), three 0.187.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >quad.obj <<'END'
v 0 0 0
v 4 0 1
v 4 1 0
v 0.5 1 1
f 1 2 3 4
END
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0
cat >quad.mjs <<'END'
import fs from 'fs';
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
const at = new OBJLoader().parse(fs.readFileSync('quad.obj', 'utf8')).children[0].geometry.attributes.position.array.join(' ');
console.log('three:', at);
process.exit(at === '0 0 0 4 0 1 4 1 0 0 0 0 4 1 0 0.5 1 1' ? 0 : 1);
END
node quad.mjs
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 trimesh==5.2.0 tinyobjloader==2.0.0rc13 mitsuba==3.9.1
venv/bin/python - <<'END'
import mitsuba as mi
import numpy as np
import tinyobjloader
import trimesh

mi.set_variant("scalar_rgb")


def triangles(indices):
    return sorted(tuple(sorted(t)) for t in np.array(indices).reshape(-1, 3).tolist())


config = tinyobjloader.ObjReaderConfig()
config.triangulate = True
reader = tinyobjloader.ObjReader()
reader.ParseFromFile("quad.obj", config)
found = {
    "tinyobjloader": triangles([i.vertex_index for i in reader.GetShapes()[0].mesh.indices]),
    "trimesh": triangles(trimesh.load("quad.obj", process=False).faces),
    "Mitsuba": triangles(mi.traverse(mi.load_dict({"type": "obj", "filename": "quad.obj"}))["faces"]),
}
print(found)
fan, shorter = [(0, 1, 2), (0, 2, 3)], [(0, 1, 3), (1, 2, 3)]
raise SystemExit(found != {"tinyobjloader": shorter, "trimesh": fan, "Mitsuba": fan})
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: `Kd .5 .5 .5` of an MTL file is a reflectance of .5 to each reader, and where `Ns 100` becomes a roughness it is
# about (2 / 102)^(1/4) = .37, at which a microfacet lobe is as wide as Phong's.
# Seen: Kd is .5 in linear light to Blender and trimesh, but .214 to three, which takes it for sRGB. Ns 100 is a roughness
# of .37 to trimesh and of .68 to Blender, 1 - sqrt(Ns / 1000): one file, two brightnesses, two widths of highlights.
# Packages: bpy==5.0.1 (350 MB; Python 3.11), trimesh==5.2.0 numpy==2.4.6 pillow==13.0.0 (PyPI), three 0.187.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
printf 'newmtl grey\nKd .5 .5 .5\nKs .5 .5 .5\nNs 100\n' >file.mtl
printf 'mtllib file.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl grey\nf 1/1 2/1 3/1\n' >file.obj
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0
cat >colour.mjs <<'END'
import { readFileSync } from 'node:fs';
import { MTLLoader } from 'three/addons/loaders/MTLLoader.js';
const materials = new MTLLoader().parse(readFileSync('file.mtl', 'utf8'), '');
materials.preload();
console.log(materials.materials.grey.color.r);
END
node colour.mjs >three.txt
python3 -m venv blender
blender/bin/pip install -q --disable-pip-version-check bpy==5.0.1
cat >blender.py <<'END'
import bpy

bpy.ops.wm.obj_import(filepath="file.obj")
nodes = bpy.data.materials["grey"].node_tree.nodes
inputs = next(node for node in nodes if node.type == "BSDF_PRINCIPLED").inputs
with open("blender.txt", "w") as file:
    file.write("%g %g" % (inputs["Base Color"].default_value[0], inputs["Roughness"].default_value))
END
blender/bin/python blender.py >/dev/null
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check trimesh==5.2.0 numpy==2.4.6 pillow==13.0.0
venv/bin/python - <<'END'
from math import isclose

import trimesh

material = trimesh.load("file.obj", force="mesh").visual.material
theirs = material.diffuse[0] / 255, material.to_pbr().roughnessFactor
blender = tuple(map(float, open("blender.txt").read().split()))
three = float(open("three.txt").read())
print("Kd .5: Blender %.3f, trimesh %.3f, three %.3f" % (blender[0], theirs[0], three))
print("Ns 100: roughness %.3f in Blender, %.3f in trimesh" % (blender[1], theirs[1]))
seen = isclose(blender[0], .5, abs_tol=.01) and isclose(theirs[0], .5, abs_tol=.01) and isclose(three, .214, abs_tol=.001)
seen &= isclose(blender[1], 1 - .1 ** .5, abs_tol=1e-3) and isclose(theirs[1], (2 / 102) ** .25, abs_tol=1e-3)
raise SystemExit(not seen)
END

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: visual.uv of a mesh that trimesh has read from glTF is the file's TEXCOORD_0, as in VTK's reader.
# Seen: v is 1 - v, since trimesh counts from the bottom of the picture and glTF from its top: code that looks a texture
# up by glTF's rule with these numbers has it upside down. Of a file without a material there are no coordinates at all.
# Packages: numpy==2.3.5 pillow==13.0.0 trimesh==5.2.0 vtk==9.7.2
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 pillow==13.0.0 trimesh==5.2.0 vtk==9.7.2
venv/bin/python - 2>log <<'END_OF_CHECK'
import base64
import io
import json

import numpy as np
import trimesh
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkGLTFReader


def link(kind, data):
    return f"data:{kind};base64," + base64.b64encode(data).decode()


places, coordinates = np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), np.float32([[.1, .25], [.9, .25], [.1, .6]])
data = places.tobytes() + coordinates.tobytes() + np.uint16([0, 1, 2]).tobytes()
png = io.BytesIO()
Image.new("RGB", (2, 2)).save(png, "PNG")
plain = {
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2}]}],
    "buffers": [{"byteLength": len(data), "uri": link("application/octet-stream", data)}],
    "bufferViews": [{"buffer": 0, "byteOffset": o, "byteLength": n} for o, n in ((0, 36), (36, 24), (60, 6))],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
                  {"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"}]}
with open("plain.gltf", "w") as file:
    json.dump(plain, file)
plain["meshes"][0]["primitives"][0]["material"] = 0
plain |= {"materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
          "images": [{"uri": link("image/png", png.getvalue())}]}
with open("textured.gltf", "w") as file:
    json.dump(plain, file)

reader = vtkGLTFReader()
reader.SetFileName("textured.gltf")
reader.Update()
leaf = reader.GetOutput().NewIterator()
leaf.InitTraversal()
theirs = vtk_to_numpy(leaf.GetCurrentDataObject().GetPointData().GetArray("TEXCOORD_0"))
turned = trimesh.load("textured.gltf", force="mesh", process=False).visual.uv
none = getattr(trimesh.load("plain.gltf", force="mesh", process=False).visual, "uv", None)
print("VTK:", theirs.round(3).tolist(), "\ntrimesh:", turned.round(3).tolist(), "\nwithout a material:", none)
down = coordinates * [1, -1] + [0, 1]
raise SystemExit(not (np.allclose(theirs, coordinates) and np.allclose(turned, down) and none is None))
END_OF_CHECK

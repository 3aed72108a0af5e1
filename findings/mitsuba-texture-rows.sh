#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a square whose texture coordinates go from (0, 0) at its lower left corner to (1, 1) shows a bitmap upright,
# the same in a file of each kind and as Mitsuba's rectangle, seen with y upward.
# Seen: only the OBJ file shows the bitmap's first row at the top. The same corners and coordinates in a PLY file, and
# the rectangle, show it at the bottom: v goes down the bitmap, and of the three only the reader of OBJ turns v over.
# Packages: numpy==2.3.5 mitsuba==3.9.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 mitsuba==3.9.1
cat >square.obj <<'END_OF_OBJ'
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
f 1/1 2/2 3/3
f 1/1 3/3 4/4
END_OF_OBJ
cat >square.ply <<'END_OF_PLY'
ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property float u
property float v
element face 2
property list uchar int vertex_indices
end_header
-1 -1 0 0 0
1 -1 0 1 0
1 1 0 1 1
-1 1 0 0 1
3 0 1 2
3 0 2 3
END_OF_PLY
venv/bin/python - <<'END'
import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
bitmap = mi.Bitmap(np.float32([[[1, 1, 1], [1, 1, 1]], [[0, 0, 0], [0, 0, 0]]]))  # the first row is white, the second black
radiance = {"type": "bitmap", "bitmap": bitmap, "raw": True, "filter_type": "nearest"}
look = mi.ScalarTransform4f().look_at(origin=[0, 0, 1], target=[0, 0, 0], up=[0, 1, 0])
light = {"type": "area", "radiance": radiance}
film = {"type": "hdrfilm", "width": 4, "height": 4, "rfilter": {"type": "box"}}


def rows(shape):
    """The picture's first and last rows: the square fills it."""
    picture = np.array(mi.render(mi.load_dict({
        "type": "scene", "integrator": {"type": "path"}, "square": shape | {"light": light},
        "camera": {"type": "perspective", "fov": 90, "to_world": look, "film": film}})))
    return float(picture[0].mean()), float(picture[3].mean())


seen = {"OBJ": rows({"type": "obj", "filename": "square.obj"}), "PLY": rows({"type": "ply", "filename": "square.ply"}),
        "rectangle": rows({"type": "rectangle"})}
for name, (top, bottom) in seen.items():
    print(f"{name:9}: top {top:.0f}, bottom {bottom:.0f}")

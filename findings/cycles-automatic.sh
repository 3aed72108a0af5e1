#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: Cycles' default sampling pattern AUTOMATIC is the tabulated Sobol' of its files, and the first 8 of 16 samples
# (a subset, for a render in parts) are the picture of 8 samples, whatever the pattern.
# Seen: AUTOMATIC is BLUE_NOISE bit for bit, and its first 8 of 16 samples are not those of 8; those of TABULATED_SOBOL
# are.
# Packages: bpy==5.0.1 (350 MB; Python 3.11)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check bpy==5.0.1
cat >render.py <<'END'
import os
import bpy
import numpy
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
cycles, render = scene.cycles, scene.render
cycles.device, cycles.use_denoising, cycles.use_adaptive_sampling = "CPU", False, False
render.resolution_x = render.resolution_y = 32
render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
bpy.ops.mesh.primitive_plane_add(size=8)
bpy.ops.mesh.primitive_uv_sphere_add(location=(0, 0, 1))
bpy.ops.object.light_add(type="AREA", location=(2, 2, 4))
bpy.context.object.data.energy = 300
bpy.ops.object.camera_add(location=(0, -6, 3), rotation=(1.15, 0, 0))
scene.camera = bpy.context.object


def picture(pattern, samples, part=0):
    cycles.sampling_pattern, cycles.samples = pattern, samples
    cycles.use_sample_subset, cycles.sample_subset_length = bool(part), part or samples
    render.filepath = os.path.abspath("picture.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load("picture.exr")
    pixels = numpy.array(image.pixels[:])
    bpy.data.images.remove(image)
    return pixels


auto = picture("AUTOMATIC", 16)
same = {p: bool((picture(p, 16) == auto).all()) for p in ("BLUE_NOISE", "TABULATED_SOBOL")}
first = {p: bool((picture(p, 8) == picture(p, 16, 8)).all()) for p in ("AUTOMATIC", "TABULATED_SOBOL")}
print("the picture of AUTOMATIC:", same, "8 of 16 samples are those of 8:", first)
raise SystemExit(not (same == {"BLUE_NOISE": True, "TABULATED_SOBOL": False} and first == {"AUTOMATIC": False, "TABULATED_SOBOL": True}))
END
venv/bin/python render.py >log 2>&1 || { cat log; exit 1; }
grep "^the picture" log

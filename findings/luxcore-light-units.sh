#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: lights of colour 1 and gain 1 in LuxCore agree where they do one thing: a point light and the middle of a spot
# light at one distance, and a distant light of a small angle and a sharp one.
# Seen: colour is the intensity of a spot light but the power of a point light, whose intensity is 1 / (4 pi): the spot
# is 12.6 times as bright. It is the irradiance of sharpdistant but the radiance of distant, which with theta = 1 gives
# 1/1045 of the other, and less the smaller the angle.
# Packages: numpy==2.3.5 pyluxcore==2.11.2 (500 MB with what it needs)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
status=0
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 pyluxcore==2.11.2
venv/bin/python - >log 2>&1 <<'END_OF_CHECK' || status=$?
import time

import numpy as np
import pyluxcore

SCENE = """
scene.camera.type = perspective
scene.camera.lookat.orig = 0 0 1
scene.camera.lookat.target = 0 0 0
scene.camera.up = 0 1 0
scene.camera.fieldofview = 10
scene.materials.grey.type = matte
scene.materials.grey.kd = .5 .5 .5
scene.shapes.square.type = inlinedmesh
scene.shapes.square.vertices = -2 -2 0 2 -2 0 2 2 0 -2 2 0
scene.shapes.square.faces = 0 1 2 0 2 3
scene.objects.wall.shape = square
scene.objects.wall.material = grey
scene.lights.one.color = 1 1 1
"""
CONFIGURATION = """
renderengine.type = PATHCPU
renderengine.seed = 1
sampler.type = RANDOM
native.threads.count = 1
film.width = 16
film.height = 16
film.filter.type = NONE
film.imagepipelines.0.0.type = NOP
film.outputs.0.type = RGB
film.outputs.0.filename = out.exr
batch.haltspp = 64
"""


def irradiance(light):
    """That of the wall's middle: it is a matte grey of 1/2, seen by radiances of irradiance / (2 pi)."""
    scene, texts = pyluxcore.Scene(), [pyluxcore.Properties(), pyluxcore.Properties()]
    texts[0].SetFromString(SCENE + "".join(f"scene.lights.one.{key} = {value}\n" for key, value in light.items()))
    texts[1].SetFromString(CONFIGURATION)
    scene.Parse(texts[0])
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(texts[1], scene))
    session.Start()
    while not session.HasDone():
        session.UpdateStats()
        time.sleep(.05)
    session.Stop()
    picture = np.zeros((16, 16, 3), np.float32)
    session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, picture)
    return 2 * np.pi * float(picture.mean())


pyluxcore.Init()
place, seen = {"position": "0 0 1"}, True
for light, right in (({"type": "point"} | place, 1 / (4 * np.pi)),
                     ({"type": "spot", "target": "0 0 0", "coneangle": 30} | place, 1),
                     ({"type": "sharpdistant", "direction": "0 0 -1"}, 1),
                     ({"type": "distant", "direction": "0 0 -1", "theta": 1}, 1 / 1045),
                     ({"type": "distant", "direction": "0 0 -1", "theta": 4}, 16 / 1045)):
    value = irradiance(light)
    with open("values", "a") as file:
        print(f"{light['type']:12} {light.get('theta', ''):2}: irradiance {value:.5f}", file=file)
    seen = seen and abs(value / right - 1) < .05
raise SystemExit(not seen)
END_OF_CHECK
cat values
exit $status

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a light whose radiance is 1 at all wavelengths has one colour in Mitsuba, however it is written: as the plug-in
# uniform or as spectrum, in variants of rgb and of spectra.
# Seen: in scalar_spectral both are (1.21, .95, .91), pink beside the white D65. In scalar_rgb the spectrum is so, too,
# but uniform is white, (1, 1, 1): a scene with it changes its colour with the variant. Reflectances of 1/2 are (.5, .5,
# .5) in all four.
# Packages: numpy==2.3.5 mitsuba==3.9.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 mitsuba==3.9.1
venv/bin/python - <<'END_OF_CHECK'
import mitsuba as mi
import numpy as np


def colour(surface):
    """The mean colour of a square that fills the picture, below a sky of D65 if it is no light itself."""
    look = mi.ScalarTransform4f().look_at(origin=[0, 0, 1], target=[0, 0, 0], up=[0, 1, 0])
    sampler = {"type": "independent", "sample_count": 20000}
    scene = mi.load_dict({
        "type": "scene", "integrator": {"type": "path"}, "square": {"type": "rectangle", "surface": surface},
        "camera": {"type": "perspective", "fov": 45, "to_world": look, "sampler": sampler,
                   "film": {"type": "hdrfilm", "width": 4, "height": 4, "rfilter": {"type": "box"}}}}
        | ({} if surface["type"] == "area" else {"sky": {"type": "constant", "radiance": {"type": "d65"}}}))
    return np.array(mi.render(scene)).mean(axis=(0, 1))


seen, pink = True, (1.206, .949, .909)
for variant, plugin, right in (("scalar_rgb", "uniform", (1, 1, 1)), ("scalar_rgb", "spectrum", pink),
                               ("scalar_spectral", "uniform", pink), ("scalar_spectral", "spectrum", pink)):
    mi.set_variant(variant)
    light = colour({"type": "area", "radiance": {"type": plugin, "value": 1.}})
    paint = colour({"type": "diffuse", "reflectance": {"type": plugin, "value": .5}})
    print(f"{variant:15} {plugin:8}: light {light.round(3)}, reflected {paint.round(3)}")
    seen = seen and np.allclose(light, right, atol=.01) and np.allclose(paint, .5, atol=.01)
raise SystemExit(not seen)
END_OF_CHECK

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a checkerboard from 0 to 1 as the weight of a blendbsdf shows material a on the squares where a checkerboard of the
# reflectance has color0, since the weight there is color0, 0.
# Seen: it shows b there: a texture's value as a number (eval_1) swaps the squares of its value as a colour (eval).
# Packages: mitsuba==3.9.1
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check mitsuba==3.9.1
venv/bin/python - <<'END'
import drjit as dr
import mitsuba as mi

mi.set_variant("scalar_rgb")
red, blue, up = [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], mi.Vector3f(0, 0, 1)


def colour(value):
    return {"type": "rgb", "value": value}


def board(first, second):
    return {"type": "checkerboard", "color0": colour(first), "color1": colour(second)}


def at(u, v):
    si = dr.zeros(mi.SurfaceInteraction3f)
    si.uv, si.wi, si.t = mi.Point2f(u, v), up, 1.0
    return si


weight = mi.load_dict(board([0.0] * 3, [1.0] * 3))
blend = mi.load_dict({"type": "blendbsdf", "weight": board([0.0] * 3, [1.0] * 3),
                      "a": {"type": "diffuse", "reflectance": colour(red)}, "b": {"type": "diffuse", "reflectance": colour(blue)}})
plain = mi.load_dict({"type": "diffuse", "reflectance": board(red, blue)})
swapped = True
for u in (0.25, 0.75):
    x = at(u, 0.25)
    one, three = weight.eval_1(x), list(weight.eval(x))
    mixed, direct = (list(b.eval(mi.BSDFContext(), x, up)) for b in (blend, plain))
    print(f"u {u}: weight {one:g} as a number, {three[0]:g} as a colour; blend {'red' if mixed[0] else 'blue'}, reflectance "
          f"{'red' if direct[0] else 'blue'}")
    swapped &= one == 1 - three[0] and (mixed[0] > 0) != (direct[0] > 0)
raise SystemExit(not swapped)
END

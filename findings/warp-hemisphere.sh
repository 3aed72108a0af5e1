#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: wp.sample_unit_hemisphere gives directions, uniform on the half of the sphere: length 1, mean height 1/2.
# Seen: points inside the half ball, uniform by volume: lengths from .01 to 1, mean height 3/8. Directions are
# wp.sample_unit_hemisphere_surface; wp.sample_unit_square is centred, from -1/2 to 1/2.
# Packages: warp-lang==1.19.0, numpy==2.4.6
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check warp-lang==1.19.0 numpy==2.4.6
cat > draw.py <<'END'
import numpy as np
import warp as wp

wp.config.quiet, wp.config.kernel_cache_dir = True, "cache"


@wp.kernel
def draw(inside: wp.array(dtype=wp.vec3), surface: wp.array(dtype=wp.vec3), square: wp.array(dtype=wp.vec2)):
    i = wp.tid()
    state = wp.rand_init(1, i)
    inside[i] = wp.sample_unit_hemisphere(state)
    surface[i] = wp.sample_unit_hemisphere_surface(state)
    square[i] = wp.sample_unit_square(state)


n = 1 << 18
arrays = [wp.zeros(n, dtype=kind, device="cpu") for kind in (wp.vec3, wp.vec3, wp.vec2)]
wp.launch(draw, n, inputs=arrays, device="cpu")
inside, surface, square = (a.numpy() for a in arrays)
for name, v in (("sample_unit_hemisphere", inside), ("sample_unit_hemisphere_surface", surface)):
    length = np.linalg.norm(v, axis=1)
    print(f"{name}: lengths {length.min():.2f} to {length.max():.2f}, mean height {v[:, 2].mean():.3f}")
print(f"sample_unit_square: {square.min():.2f} to {square.max():.2f}")
raise SystemExit(not (abs(inside[:, 2].mean() - 3 / 8) < 0.002 and abs(surface[:, 2].mean() - 1 / 2) < 0.002 and square.min() < -0.49))
END
venv/bin/python draw.py

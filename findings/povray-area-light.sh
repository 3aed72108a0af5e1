#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: area_light with n x n lights has them in the centres of n x n cells of its area: two in a row of length 2 lie
# at -1/2 and 1/2.
# Seen: they go from edge to edge: two at -1 and 1, four at -1, -1/3, 1/3 and 1. The variance along a side is (n + 1) /
# (n - 1) times that of the area, 3 times for two lights and 5/3 for four: penumbrae become narrower with more lights.
# Packages: povray 3.7.0.10 (Debian)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# Half of a floor of height 0 is below a plate at 1 whose edge is at x = 0; a light at (x, 2) ends its shadow at -x.
cat >scene.pov <<'END_OF_SCENE'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, .5, 0> right 4*x up .01*y direction -y sky z }
plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } }
box { <0, 1, -100>, <100, 1.001, 100> pigment { rgb 0 } }
light_source { <0, 2, 0> rgb 1 area_light 2*x, 2*z, N, N }
END_OF_SCENE
for n in 2 3 4 8; do
  povray +Iscene.pov +W400 +H1 -A Declare=N=$n +FP16 +Oshadow$n.ppm -D +WT1 File_Gamma=1 >log 2>&1
done
python3 - <<'END_OF_CHECK'
seen = True
for n in (2, 3, 4, 8):
    with open(f"shadow{n}.ppm", "rb") as file:
        row = file.read()[-2400:]
    values = [int.from_bytes(row[6 * i:6 * i + 2], "big") for i in range(400)]
    edges = [(i - 200) / 100 for i in range(1, 400) if abs(values[i] - values[i - 1]) > 1000]
    print(f"{n} x {n}: shadows end at", edges)
    ends = [2 * k / (n - 1) - 1 for k in range(n)]
    seen = seen and len(edges) == n and all(abs(a - b) < .02 for a, b in zip(edges, ends))
raise SystemExit(not seen)
END_OF_CHECK

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: antialiasing by method 1 with +R3 and no jitter takes 3 x 3 samples of a pixel: a square of a quarter of a
# pixel's width in its centre has 1/9.
# Seen: it has 2/10. The ray through the centre is one sample more, at each R (R^2 + 1 in all), and where R is odd the
# centre is counted twice.
# Packages: povray 3.7.0.10 (Debian)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >scene.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> right 4*x up 4*y direction z }
#declare i = -1.5;
#while (i < 2)
  box { <-1.625, i - .125, 0>, <-1.375, i + .125, 1> pigment { rgb 1 } finish { emission 1 ambient 0 diffuse 0 } }
  #declare i = i + 1;
#end
END
for r in 2 3 4 5; do
  povray +Iscene.pov +W4 +H4 +A0.0 +AM1 +R$r -J +FP16 +Opicture$r.ppm -D +WT1 File_Gamma=1 >log 2>&1
done
python3 - <<'END'
changed = False
for r, hits, samples in ((2, 1, 5), (3, 2, 10), (4, 5, 17), (5, 2, 26)):
    with open(f"picture{r}.ppm", "rb") as file:
        seen = int.from_bytes(file.read()[-96:-94], "big") / 65535
    print(f"+R{r}: {seen:.4f}; {hits} of {samples} is {hits / samples:.4f}")
    changed |= abs(seen - hits / samples) > 1e-4
raise SystemExit(changed)
END

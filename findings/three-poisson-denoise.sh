#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the poissonDisk[] of PoissonDenoiseShader, by which GTAOPass smooths its occlusion, is a Poisson disk set: places
# in all directions from the pixel, none much nearer to another than the rest.
# Seen: they are a spiral. With the defaults, 16 samples on 2 turns with an exponent of 2, there are only 8 directions, each
# twice, and half of the places are within a third of the radius (8 pixels), where uniform ones have 2 of 16. Numbers of
# samples that the turns do not divide have more directions: 15 have 15.
# Packages: three 0.187.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0
cat >spiral.mjs <<'END'
import { generatePdSamplePointInitializer } from 'three/addons/shaders/PoissonDenoiseShader.js';
const pixels = 8;
function places(count) {
    const vectors = [...generatePdSamplePointInitializer(count, 2, 2).matchAll(/vec3\(([^)]*)\)/g)];
    return vectors.map(([, numbers]) => numbers.split(',').map(Number)).map(([x, y, z]) => {
        const distance = 1 + z * (pixels - 1); // as the shader has it
        return [x * distance, y * distance];
    });
}
const directions = (set) => new Set(set.map(([x, y]) => (Math.atan2(y, x) + 10).toFixed(6))).size;
const inner = (set) => set.filter(([x, y]) => Math.hypot(x, y) < pixels / 3).length;
for (const count of [15, 16])
    console.log(count, 'places:', directions(places(count)), 'directions,', inner(places(count)), 'in the inner third');
process.exit(directions(places(16)) === 8 && directions(places(15)) === 15 && inner(places(16)) === 8 ? 0 : 1);
END
node spiral.mjs

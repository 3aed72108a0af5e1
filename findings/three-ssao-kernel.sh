#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the sample directions of SSAOPass are uniform on the hemisphere, or weighted by the cosine, so that they are even
# around the normal.
# Seen: they are points of a cube drawn to length 1: within pi / 16 of the four diagonals are .33 of them, within pi / 16 of
# the axes .20, where even ones have a quarter each. The distances are not random: sample i of n has .1 + .9 (i / n)^2, so
# that 17 of 32 are within a third of the radius.
# Packages: three 0.187.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0
cat >kernel.mjs <<'END'
import { SSAOPass } from 'three/addons/postprocessing/SSAOPass.js';
const size = 32, runs = 4000, pass = Object.create(SSAOPass.prototype);
let diagonal = 0, axis = 0, farthest = 0, inner = 0;
for (let run = 0; run < runs; run++) {
    pass.kernel = [];
    pass._generateSampleKernel(size);
    pass.kernel.forEach((v, i) => {
        const angle = Math.atan2(Math.abs(v.y), Math.abs(v.x)) / Math.PI * 16; // from 0, an axis, to 8, the other
        diagonal += Math.abs(angle - 4) < 1 ? 1 : 0;
        axis += Math.abs(angle - 4) > 3 ? 1 : 0;
        farthest = Math.max(farthest, Math.abs(v.length() - .1 - .9 * (i / size) ** 2));
        inner += v.length() < 1 / 3 ? 1 : 0;
    });
}
const all = size * runs;
console.log('at the diagonals', diagonal / all, 'at the axes', axis / all, 'within a third of the radius', inner / all);
console.log('distances differ from .1 + .9 (i / n)^2 by', farthest);
process.exit(diagonal / all > .31 && axis / all < .22 && farthest < 1e-6 && inner === 17 * runs ? 0 : 1);
END
node kernel.mjs

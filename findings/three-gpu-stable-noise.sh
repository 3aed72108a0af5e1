#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: stableNoise of three-gpu-pathtracer repeats the random numbers of a picture and leaves them as good: the
# stratified samples of four coordinates come in a shuffled order, of a fixed seed.
# Seen: reset(), which it calls before each picture, puts the 8^4 strata in order, and they are shuffled first after all
# 4,096. Of the first 64 samples the third and fourth coordinates are below 1/8, of the first 512 the fourth, up to one
# offset for a pixel: pictures of as many samples have lights and materials sampled in one corner.
# Packages: three-gpu-pathtracer 0.0.26, three-mesh-bvh 0.9.17, three 0.187.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts --legacy-peer-deps \
  three@0.187.0 three-mesh-bvh@0.9.17 three-gpu-pathtracer@0.0.26
cat >order.mjs <<'END_OF_SCRIPT'
import { StratifiedSamplesTexture } from 'three-gpu-pathtracer/src/uniforms/StratifiedSamplesTexture.js';

const texture = new StratifiedSamplesTexture(20, 15); // the sizes that the renderer takes for ten bounces

/** How many of the eight intervals of each of the first four coordinates n samples meet. */
function met(n) {
    const intervals = [0, 1, 2, 3].map(() => new Set());
    for (let i = 0; i < n; i++) {
        texture.next();
        intervals.forEach((set, k) => set.add(Math.floor(8 * texture.image.data[k])));
    }
    return intervals.map((set) => set.size).join(' ');
}

const plain = met(64);
texture.stableNoise = true; // as PathTracingRenderer.reset() does
texture.reset();
const first = met(64), later = met(448);
console.log('of 8, without stableNoise:', plain, '; with it, first 64:', first, '; next 448:', later);
process.exit(plain === '8 8 8 8' && first === '8 8 1 1' && later === '8 8 7 1' ? 0 : 1);
END_OF_SCRIPT
node order.mjs 2>log

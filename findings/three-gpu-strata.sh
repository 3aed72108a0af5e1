#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: three-gpu-pathtracer's stratified samples with 8 strata have one of 64 samples in each of 8 x 8 squares of two
# coordinates, as pbrt's stratified sampler, to which its source points.
# Seen: the 8 strata are of four coordinates together, 4,096 boxes in random order. 64 samples leave some 24 of 64
# squares empty, as many as random numbers do (64 / e): no two coordinates are stratified before sample 4,096.
# Packages: three-gpu-pathtracer 0.0.26, three-mesh-bvh 0.9.17, three 0.187.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts --legacy-peer-deps \
  three@0.187.0 three-mesh-bvh@0.9.17 three-gpu-pathtracer@0.0.26
cat >squares.mjs <<'END_OF_SCRIPT'
import { StratifiedSamplesTexture } from 'three-gpu-pathtracer/src/uniforms/StratifiedSamplesTexture.js';

const trials = 400;
let empty = 0, random = 0, last;
for (let trial = 0; trial < trials; trial++) {
    const texture = new StratifiedSamplesTexture(1, 1), squares = new Set(), others = new Set();
    const square = ([x, y]) => 8 * Math.floor(8 * x) + Math.floor(8 * y);
    for (let i = 0; i < 64; i++) {
        squares.add(square(texture.image.data));
        others.add(square([Math.random(), Math.random()]));
        texture.next();
    }
    empty += (64 - squares.size) / trials;
    random += (64 - others.size) / trials;
    last = texture;
}
const boxes = new Set();
for (let i = 64; i < 4096; i++) last.next();
for (let i = 0; i < 4096; i++) {
    boxes.add(last.image.data.reduce((sum, v) => 8 * sum + Math.floor(8 * v), 0));
    last.next();
}
console.log('empty of 64:', empty.toFixed(1), 'random:', random.toFixed(1));
console.log('boxes of 4096 that as many samples meet:', boxes.size);
process.exit(Math.abs(empty - random) < 2 && boxes.size === 4096 ? 0 : 1);
END_OF_SCRIPT
node squares.mjs 2>log

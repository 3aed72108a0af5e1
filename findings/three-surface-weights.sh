#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: with a weight of 0 at the left corners of a square and 1 at the right ones, MeshSurfaceSampler's points grow
# linearly from none at the left to twice the mean at the right, as a colour at the corners would.
# Seen: each triangle has one density, by the sum of its three weights: two thirds of the mean at the left, four thirds
# at the right, of which the whole is the diagonal's doing. Corners of weight 0 get points; only finer triangles help.
# Packages: three 0.187.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0
cat >weights.mjs <<'END_OF_SCRIPT'
import { BufferGeometry, Float32BufferAttribute, Mesh, Vector3 } from 'three';
import { MeshSurfaceSampler } from 'three/examples/jsm/math/MeshSurfaceSampler.js';

let state = 1;
const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
const square = new BufferGeometry().setIndex([0, 1, 2, 0, 2, 3]);
square.setAttribute('position', new Float32BufferAttribute([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], 3));
square.setAttribute('weight', new Float32BufferAttribute([0, 1, 1, 0], 1));
const sampler = new MeshSurfaceSampler(new Mesh(square)).setWeightAttribute('weight').setRandomGenerator(random).build();

const n = 200000, stripes = new Array(8).fill(0), point = new Vector3();
for (let i = 0; i < n; i++) {
    sampler.sample(point);
    stripes[Math.min(7, Math.floor(8 * point.x))] += 8 / n;
}
const linear = stripes.map((_, i) => (2 * i + 1) / 8), byFaces = stripes.map((_, i) => 2 / 3 + (2 * i + 1) / 24);
console.log('density in eight stripes:', stripes.map((v) => v.toFixed(2)).join(' '));
console.log('linear in the weights:   ', linear.map((v) => v.toFixed(2)).join(' '));
process.exit(stripes.every((v, i) => Math.abs(v - byFaces[i]) < 0.03) ? 0 : 1);
END_OF_SCRIPT
node weights.mjs

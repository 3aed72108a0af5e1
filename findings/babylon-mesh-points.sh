#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the points of Babylon's MeshParticleEmitter are uniform over its mesh by area, as those of its
# PointsCloudSystem are.
# Seen: each triangle has as many points, whatever its size: of two, one of them a hundredth of the other, each has
# half. Within a triangle they crowd at the first corner: half of them are in the quarter there, .15 in each of the
# others. Finely divided parts of a mesh get most points.
# Packages: @babylonjs/core 9.35.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts @babylonjs/core@9.35.0
cat >points.mjs <<'END_OF_SCRIPT'
import { NullEngine } from '@babylonjs/core/Engines/nullEngine.js';
import { Matrix, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Mesh } from '@babylonjs/core/Meshes/mesh.js';
import { VertexData } from '@babylonjs/core/Meshes/mesh.vertexData.js';
import { MeshParticleEmitter } from '@babylonjs/core/Particles/EmitterTypes/meshParticleEmitter.js';
import { PointsCloudSystem } from '@babylonjs/core/Particles/pointsCloudSystem.js';
import { Scene } from '@babylonjs/core/scene.js';

const scene = new Scene(new NullEngine());
const mesh = new Mesh('triangles', scene), data = new VertexData(), n = 50000;
data.positions = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0, 1, 0, 0.1, 1]; // the small one is at z = 1
data.indices = [0, 1, 2, 3, 4, 5];
data.normals = [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1];
data.applyToMesh(mesh);

/** The part of the points that is on the small triangle, and of the others those near its three corners. */
function parts(points) {
    const large = points.filter((p) => p.z < 0.5), part = (near) => large.filter(near).length / large.length;
    return [1 - large.length / points.length, part((p) => p.x + p.y < 0.5), part((p) => p.x > 0.5), part((p) => p.y > 0.5)];
}

const emitter = new MeshParticleEmitter(mesh), cloud = new PointsCloudSystem('cloud', 1, scene);
const emitted = parts(Array.from({ length: n }, () => {
    const point = new Vector3();
    emitter.startPositionFunction(Matrix.Identity(), point, null, false);
    return point;
}));
cloud.addSurfacePoints(mesh, n);
await cloud.buildMeshAsync();
const clouded = parts(cloud.particles.map((p) => p.position));
const near = (a, b) => a.every((v, i) => Math.abs(v - b[i]) < 0.02);
console.log('by area:            0.010 0.250 0.250 0.250');
console.log('MeshParticleEmitter:', emitted.map((v) => v.toFixed(3)).join(' '));
console.log('PointsCloudSystem:  ', clouded.map((v) => v.toFixed(3)).join(' '));
const far = (1 - Math.LN2) / 2; // of weights u, v (1 - u) and the rest
process.exit(near(emitted, [0.5, 0.5, far, far]) && near(clouded, [0.01, 0.25, 0.25, 0.25]) ? 0 : 1);
END_OF_SCRIPT
node points.mjs

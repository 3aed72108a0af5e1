#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: Babylon's SphereParticleEmitter with radiusRange 1, "entire radius", fills the ball evenly, as its
# CylinderParticleEmitter fills a cylinder: an eighth of the points are within half the radius.
# Seen: half of them are, and so are those of HemisphericParticleEmitter: the distance from the centre is uniform, and the
# density falls with its square. The cylinder's points are even, a quarter within half its radius.
# Packages: @babylonjs/core 9.35.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts @babylonjs/core@9.35.0
cat >ball.mjs <<'END'
import { Matrix, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { CylinderParticleEmitter } from '@babylonjs/core/Particles/EmitterTypes/cylinderParticleEmitter.js';
import { HemisphericParticleEmitter } from '@babylonjs/core/Particles/EmitterTypes/hemisphericParticleEmitter.js';
import { SphereParticleEmitter } from '@babylonjs/core/Particles/EmitterTypes/sphereParticleEmitter.js';
const count = 100000, place = new Vector3();
function within(emitter, distance) {
    let inside = 0;
    for (let i = 0; i < count; i++) {
        emitter.startPositionFunction(Matrix.Identity(), place, null, true);
        inside += distance(place) < .5;
    }
    return inside / count;
}
const sphere = within(new SphereParticleEmitter(1, 1), (p) => p.length());
const hemisphere = within(new HemisphericParticleEmitter(1, 1), (p) => p.length());
const cylinder = within(new CylinderParticleEmitter(1, 2, 1), (p) => Math.hypot(p.x, p.z));
console.log(`within half the radius: sphere ${sphere}, hemisphere ${hemisphere}, even 1/8; cylinder ${cylinder}, even 1/4`);
const near = (share, other) => Math.abs(share - other) < .01;
process.exit(near(sphere, 1 / 2) && near(hemisphere, 1 / 2) && near(cylinder, 1 / 4) ? 0 : 1);
END
node ball.mjs

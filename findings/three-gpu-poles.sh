#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: three-gpu-pathtracer samples an environment map by brightness and solid angle, as the chapter of pbrt has it to
# which its source points: of a white map each row is taken in proportion to the sine of its angle from the pole.
# Seen: rows are weighted by brightness alone: a white map has as many samples in the rows at the poles as at the
# horizon, 1/4 of them above 45 degrees, where .146 of the sphere is. Pictures stay right, as the density says so, but
# the variance of a white sky, averaged over surfaces of all directions, is (pi^2 / 3 - 1) / (8 / 3 - 1) = 1.37 times
# that of uniform directions.
# Packages: three-gpu-pathtracer 0.0.26, three-mesh-bvh 0.9.17, three 0.187.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts --legacy-peer-deps \
  three@0.187.0 three-mesh-bvh@0.9.17 three-gpu-pathtracer@0.0.26
cat >rows.mjs <<'END_OF_SCRIPT'
import { DataTexture, DataUtils, FloatType, RGBAFormat } from 'three';
import { EquirectHdrInfoUniform } from 'three-gpu-pathtracer/src/uniforms/EquirectHdrInfoUniform.js';

const width = 64, height = 32;
const info = new EquirectHdrInfoUniform();
info.updateFrom(new DataTexture(new Float32Array(4 * width * height).fill(1), width, height, RGBAFormat, FloatType));

// The table takes equally likely numbers to rows from 0 to 1.
const rows = Array.from(info.marginalWeights.image.data, DataUtils.fromHalfFloat);
const above = rows.filter((v) => v < 1 / 4).length / height, cap = (1 - Math.SQRT1_2) / 2;
console.log('samples above 45 degrees:', above, 'part of the sphere:', cap.toFixed(3));
process.exit(above === 0.25 && rows.every((v, i) => Math.abs(v - (i + 0.5) / height) < 1e-3) ? 0 : 1);
END_OF_SCRIPT
node rows.mjs 2>log

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the offsets of SSAARenderPass average to the pixel's centre at each level, and all columns of 1/16 pixel are
# used once.
# Seen: this holds for 1, 2, 4 and 8 samples. The 16 samples of level 4 average to -1/32 pixel in both directions, the
# 32 of level 5 to (-.012, .023), in 15 of the 16 columns: pictures move by a part of a pixel with the level.
# Packages: three 0.187.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0
cat >check.mjs <<'END'
import fs from 'fs';
const text = fs.readFileSync('node_modules/three/examples/jsm/postprocessing/SSAARenderPass.js', 'utf8');
const levels = JSON.parse(text.match(/_JitterVectors = (\[[\s\S]*?\n\]);/)[1].replace(/\s/g, '').replace(/,\]/g, ']'));
const means = levels.map((l) => [0, 1].map((k) => l.reduce((sum, p) => sum + p[k], 0) / l.length / 16));
means.forEach((mean, i) => console.log(`${levels[i].length} samples: mean offset ${mean} pixels`));
const zero = means.slice(0, 4).every((m) => m[0] === 0 && m[1] === 0);
process.exit(zero && means[4][0] === -1 / 32 && means[4][1] === -1 / 32 && means[5][1] > 0.02 ? 0 : 1);
END
node check.mjs

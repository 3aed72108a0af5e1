#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the diffuse light that Babylon.js makes of an environment map (its spherical polynomial) is linear in the map's
# radiances: twice the sun gives twice its share.
# Seen: radiances are cut off at 4,096 before they are summed up: a sun of 50,000 in one texel of 6 x 64 x 64 adds .84 to
# the light from above, as one of 4,096 does, where linearity gives 10.3. A clear day's panorama loses most of its sun, and
# nothing is said; the limit is MAX_HDRI_VALUE, a static member marked as internal.
# Packages: @babylonjs/core 9.35.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts @babylonjs/core@9.35.0
cat >sun.mjs <<'END'
import { CubeMapToSphericalPolynomialTools } from '@babylonjs/core/Misc/HighDynamicRange/cubemapToSphericalPolynomial.js';
const size = 64, sun = size / 2 * (size + 1);
function fromAbove(radiance) {
    const map = { size, format: 5 /* RGBA */, type: 1 /* float */, gammaSpace: false };
    for (const face of ['right', 'left', 'up', 'down', 'front', 'back'])
        map[face] = new Float32Array(size * size * 4).fill(1);
    map.up.fill(radiance, 4 * sun, 4 * sun + 3);
    const p = CubeMapToSphericalPolynomialTools.ConvertCubeMapToSphericalPolynomial(map);
    return p.yy.x + p.y.x; // the polynomial at (0, 1, 0)
}
const sky = fromAbove(1), share = (radiance) => fromAbove(radiance) - sky;
console.log('white sky:', sky);
for (const radiance of [2000, 4000, 4096, 50000])
    console.log('a sun of', radiance, 'adds', share(radiance), 'linear', share(1000) * (radiance - 1) / 999);
const near = (a, b) => Math.abs(a / b - 1) < 1e-3;
process.exit(near(sky, 1) && near(share(4000), share(1000) * 3999 / 999) && near(share(50000), share(4096)) ? 0 : 1);
END
node sun.mjs

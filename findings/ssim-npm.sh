#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the mean SSIM of two grey pictures is one number in two packages of npm, and in the variants of one of them, up to
# .01, as they name the paper of Wang et al. (2004) and differ in speed.
# Seen: a smooth picture and the same with uniform noise of +-30 levels have .58 by the paper's window, a Gaussian (ssim.js
# "original" and "fast"), but .81 by ssim.js as it comes ("weber", whose window is a square of 11 x 11 without weights), .83
# by "bezkrovny" and .75 by image-ssim (tiles of 8 x 8). A ranking with numbers of two kinds is one of the kinds.
# Packages: ssim.js 3.5.0, image-ssim 0.2.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts ssim.js@3.5.0 image-ssim@0.2.0
cat >compare.mjs <<'END'
import imageSsim from 'image-ssim';
import ssimJs from 'ssim.js';
const width = 64, height = 64;
const picture = () => ({ width, height, channels: 4, data: new Uint8ClampedArray(4 * width * height).fill(255) });
const smooth = picture(), noisy = picture();
let state = 12345;
const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
for (let i = 0; i < width * height; i++) {
    const grey = 128 + 80 * Math.sin(i % width / 5) * Math.cos(Math.floor(i / width) / 7);
    smooth.data.fill(grey, 4 * i, 4 * i + 3);
    noisy.data.fill(grey + 60 * (random() - .5), 4 * i, 4 * i + 3);
}
const { ssim } = ssimJs;
const of = (options) => ssim(smooth, noisy, options).mssim;
const values = { default: of({}), imageSsim: imageSsim.compare(smooth, noisy).ssim };
for (const variant of ['original', 'fast', 'weber', 'bezkrovny'])
    values[variant] = of({ ssim: variant });
console.log(values);
const expected = { default: .814, imageSsim: .755, original: .577, fast: .577, weber: .814, bezkrovny: .827 };
process.exit(Object.keys(values).every((key) => Math.abs(values[key] - expected[key]) < .01) ? 0 : 1);
END
node compare.mjs

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a Sobol' generator that keeps 52 bits of each coordinate, as a double has them, stays in the unit cube for all
# numbers of points that anyone draws.
# Seen: shifts of JavaScript count modulo 32, so that 20 bits are left. The points are multiples of 2^-20, and from number
# 2^20 on the first coordinate is below -2047: a mean over 2^21 points is off by thousands.
# Packages: sobol 1.1.4 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts sobol@1.1.4
cat >check.cjs <<'END'
const { SobolSequenceGenerator } = require('sobol');
const generator = new SobolSequenceGenerator(2), first = 2 ** 20;
let fine = true, outside = -1;
for (let i = 0; i <= first; i++) {
    const x = generator.nextVector();
    fine = fine && (i === first || x.every((c) => (c * first) % 1 === 0));
    if (!x.every((c) => c >= 0 && c < 1)) outside = outside < 0 ? i : outside;
    if (i === first) console.log('point', i, x);
}
console.log('multiples of 2^-20 before it:', fine, 'first point outside the cube:', outside);
process.exit(fine && outside === first ? 0 : 1);
END
node check.cjs

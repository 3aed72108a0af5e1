#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: an RGBE pixel with mantissa 255 and exponent 129 is 255/256 of 2 or, with half a step, 255.5/256 of 2, as in
# Ward's format: below 2 in any case; EXPOSURE in the header scales it or is at least handed on.
# Seen: three and parse-hdr divide by 255 and give 2; hdrify adds half a step, divides by 255 and gives more than 2.
# With EXPOSURE=2 the pixels stay in all three; three and hdrify hand the number on, parse-hdr says 1.
# Packages: three 0.187.0, parse-hdr 1.0.0, hdrify 1.2.1 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 parse-hdr@1.0.0 hdrify@1.2.1
cat >check.mjs <<'END'
import { createRequire } from 'module';
import { FloatType } from 'three';
import { HDRLoader } from 'three/examples/jsm/loaders/HDRLoader.js';
import { readHdr } from 'hdrify';
const parse = createRequire(import.meta.url)('parse-hdr');
const head = '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 2 +X 2\n';
const file = Buffer.concat([Buffer.from(head), Buffer.alloc(16, Buffer.from([255, 255, 255, 129]))]);
const bytes = () => file.buffer.slice(file.byteOffset, file.byteOffset + file.length);
const loader = new HDRLoader();
loader.type = FloatType;
const a = loader.parse(bytes()), b = parse(Buffer.from(bytes())), c = readHdr(new Uint8Array(bytes()));
console.log('three', a.data[0], 'exposure', a.exposure);
console.log('parse-hdr', b.data[0], 'exposure', b.exposure);
console.log('hdrify', c.data[0], 'exposure', c.metadata.EXPOSURE);
const same = a.data[0] === 2 && b.data[0] === 2 && c.data[0] > 2 && a.exposure === 2 && b.exposure === 1 && c.metadata.EXPOSURE === 2;
process.exit(same ? 0 : 1);
END
node check.mjs

#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: EXRLoader and HDRLoader of three give one picture in one order of rows: code that goes over the pixels (to sum
# up a light's power by rows, to make a table to sample it) needs no case for the format.
# Seen: HDRLoader has the top row first, EXRLoader the bottom row, and so has parse-exr, which is made of it. Of the
# textures one has flipY true and one false, so that pictures look alike on the screen and the data do not.
# Packages: three 0.187.0, parse-exr 1.0.2 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 parse-exr@1.0.2
cat >rows.mjs <<'END_OF_SCRIPT'
import { FloatType } from 'three';
import { EXRLoader } from 'three/examples/jsm/loaders/EXRLoader.js';
import { HDRLoader } from 'three/examples/jsm/loaders/HDRLoader.js';
import parseExr from 'parse-exr';

const whole = (...v) => Buffer.from(Int32Array.from(v).buffer), real = (...v) => Buffer.from(Float32Array.from(v).buffer);
const attribute = (name, type, data) => Buffer.concat([Buffer.from(`${name}\0${type}\0`), whole(data.length), data]);
const slice = (b) => b.buffer.slice(b.byteOffset, b.byteOffset + b.length);

// 1 x 2 pixels, 1 above 2: an OpenEXR file of one channel Y of floats without compression, and a Radiance picture.
const box = whole(0, 0, 0, 1), none = Buffer.from([0]);
const head = Buffer.concat([whole(20000630, 2),
    attribute('channels', 'chlist', Buffer.concat([Buffer.from('Y\0'), whole(2, 0, 1, 1), none])),
    attribute('compression', 'compression', none), attribute('dataWindow', 'box2i', box),
    attribute('displayWindow', 'box2i', box), attribute('lineOrder', 'lineOrder', none),
    attribute('pixelAspectRatio', 'float', real(1)), attribute('screenWindowCenter', 'v2f', real(0, 0)),
    attribute('screenWindowWidth', 'float', real(1)), none]);
const at = head.length + 16;
const exr = Buffer.concat([head, whole(at, 0, at + 12, 0), whole(0, 4), real(1), whole(1, 4), real(2)]);
const hdr = Buffer.concat([Buffer.from('#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n'),
    Buffer.from([128, 128, 128, 129, 128, 128, 128, 130])]);

const rows = ({ data }) => [data[0], data[data.length / 2]].map((v) => Math.round(v));
const of = (Loader, file) => rows(new Loader().setDataType(FloatType).parse(slice(file)));
const parsed = rows(parseExr(slice(exr), FloatType));
const seen = { HDRLoader: of(HDRLoader, hdr), EXRLoader: of(EXRLoader, exr), 'parse-exr': parsed };
console.log('first and last rows of 1 above 2:', seen);
process.exit(JSON.stringify(Object.values(seen)) === '[[1,2],[2,1],[2,1]]' ? 0 : 1);
END_OF_SCRIPT
node rows.mjs

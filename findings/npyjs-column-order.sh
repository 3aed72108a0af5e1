#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a reader of NPY files gives an array in column order (Fortran's) either in rows, or refuses it.
# Seen: npyjs gives shape [2, 3] and the numbers as they lie in the file, 1 4 2 5 3 6, with fortranOrder true beside
# them: whoever goes by the shape alone has the coordinates of points mixed.
# Packages: numpy 2.3.5, npyjs 1.2.0 (npm)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5
venv/bin/python -c 'import numpy; numpy.save("a.npy", numpy.asfortranarray([[1.0, 2, 3], [4, 5, 6]]))'
npm install --silent --no-audit --no-fund --ignore-scripts npyjs@1.2.0
cat >check.mjs <<'END'
import fs from 'fs';
import npyjs from 'npyjs';
const bytes = fs.readFileSync('a.npy'), reader = new (npyjs.default || npyjs)();
const result = await reader.load(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
console.log('shape', result.shape, 'data', [...result.data], 'fortranOrder', result.fortranOrder);
process.exit(String([...result.data]) === '1,4,2,5,3,6' && String(result.shape) === '2,3' && result.fortranOrder ? 0 : 1);
END
node check.mjs

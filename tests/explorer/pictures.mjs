// SPDX-License-Identifier: Apache-2.0
// pictures.mjs: the explorer's pictures beside definitions.cjs. Sampled pixels are equal to the last digits, the closed forms
// agree with means over 25,600 places of each pixel, and random shifts leave no bias.
import definitions from "./definitions.cjs";
import { converged, picture, sceneNames, shiftOf, sizeFor } from "../../explorer/page/scenes.mjs";

const { errors, grid, many, pixels, scenes } = definitions;
const problems = [];
let compared = 0;
const check = (good, text) => { compared++; if (!good) problems.push(text); };
check(scenes.join() === sceneNames.join(), `scenes ${sceneNames}`);

const points = many(20);
const flat = { xs: Float64Array.from(points.flat()), n: points.length, dim: 2 };
const three = { xs: Float64Array.from(points.flatMap(([u, v]) => [v, 0.123, u])), n: points.length, dim: 3 };
const small = { width: 24, height: 16 }, large = sizeFor(16);

for (const scene of scenes) {
  const many2304 = pixels(scene, large, many(2304));
  const closed = converged(scene, small), { largest, rms_error } = errors(closed, pixels(scene, small, many(25600)));
  check(rms_error < 1e-3 && largest < 8e-3, `${scene}: converged pixels differ by ${rms_error} (RMS), ${largest} at most`);
  for (const [shifted, shift] of [[false, undefined], [true, shiftOf]]) {
    const answer = picture({ scene, size: large, points: flat, axes: [0, 1], shifted }), expected = pixels(scene, large, points, shift);
    // Where a point falls on an edge to the last bit, one sample may be on the other side.
    const off = expected.filter((value, i) => Math.abs(value - answer.values[i]) > 1e-9).length;
    check(off <= 2, `${scene}, shifted ${shifted}: ${off} pixels have other values`);
    const own = errors(answer.values, answer.converged), full = errors(expected, many2304);
    check(Math.abs(own.mean_error - answer.mean_error) < 1e-12 && Math.abs(own.rms_error - answer.rms_error) < 1e-12, `${scene}: the errors are not those of its pictures`);
    check(Math.abs(full.rms_error - answer.rms_error) < 0.02 * full.rms_error && Math.abs(full.mean_error - answer.mean_error) < 0.04 * full.mean_error,
      `${scene}, shifted ${shifted}: mean ${answer.mean_error}, RMS ${answer.rms_error}, from the definition ${full.mean_error}, ${full.rms_error}`);
    if (shifted) {
      const limit = 5 * own.rms_error / Math.sqrt(answer.values.length);
      check(Math.abs(own.bias) < limit, `${scene}: random shifts leave a bias of ${own.bias}, more than ${limit}`);
    }
    const turned = picture({ scene, size: large, points: three, axes: [2, 0], shifted });
    check(turned.values.every((value, i) => value === answer.values[i]), `${scene}: coordinates 2 and 0 of three are not those that are taken`);
  }
}

// The regular grid aliases: with equal pixels the zone plate has a false ring around 4 cycles per pixel, of which random shifts
// leave noise. Neighbouring errors are alike in the one picture and not in the other.
const regular = { xs: Float64Array.from(grid(4).flat()), n: 16, dim: 2 };
const likeness = shifted => {
  const { values, converged: reference, size: { width, height } } = picture({ scene: "zone plate", size: large, points: regular, axes: [0, 1], shifted });
  const error = (i, j) => values[j * width + i] - reference[j * width + i], i0 = Math.round(4 / 4.6 * width);
  let products = 0, squares = 0;
  for (let j = height / 2 - 4; j < height / 2 + 4; j++) {
    for (let i = i0 - 4; i < i0 + 4; i++) {
      products += error(i, j) * error(i + 1, j);
      squares += error(i, j) ** 2;
    }
  }
  return products / squares;
};
check(likeness(false) > 0.6 && Math.abs(likeness(true)) < 0.4, `likeness of neighbours: ${likeness(false)}, shifted ${likeness(true)}`);

// Shifts are uniform: each sixteenth of [0, 1) has its share within five standard deviations, and the axes are uncorrelated.
const shares = [new Array(16).fill(0), new Array(16).fill(0)], count = 6144;
let product = 0;
for (let pixel = 0; pixel < count; pixel++) {
  [0, 1].forEach(axis => { shares[axis][Math.floor(16 * shiftOf(pixel, axis))]++; });
  product += (shiftOf(pixel, 0) - 0.5) * (shiftOf(pixel, 1) - 0.5);
}
check(shares.flat().every(share => Math.abs(share - count / 16) < 5 * Math.sqrt(count / 16)), `shifts: ${shares}`);
check(Math.abs(12 * product / count) < 5 / Math.sqrt(count), `shifts of both axes are correlated: ${12 * product / count}`);

problems.forEach(text => console.log(text));
console.log(`pictures: ${compared} compared, ${problems.length} problems`);
process.exit(problems.length || compared < 20 ? 1 : 0);

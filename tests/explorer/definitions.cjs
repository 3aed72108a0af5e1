// SPDX-License-Identifier: Apache-2.0
// The scenes of the explorer's pictures from their definitions, without its code: the floor and the card are met by rays, and
// the converged pixels are means over many places. Rows from the bottom.
"use strict";

// A film place in fractions of the picture -> a floor of unit squares: depth 1.8 under the horizon at .94, spread 2.4.
function floorSquare(x, y) {
  const distance = 1.8 / (0.94 - y);
  if (y >= 0.94 || distance >= 64) return 0.5;
  return (Math.floor(2.4 * distance * (x - 0.5)) + Math.floor(distance)) % 2 === 0 ? 1 : 0;
}

// 4.6 cycles per pixel at the right edge: the phase is pi 4.6 / width r^2, r in pixels from the middle of the left edge.
const ring = (i, j, { width, height }) => (1 + Math.cos(4.6 * Math.PI / width * (i ** 2 + (j - height / 2) ** 2))) / 2;

// The ray from the floor to a place of the light against the parallelogram corner + s e + t f, 0 <= s, t <= 1.
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const corner = [0.42, 0.2, 0.02], e = [0.33, 0.26, 0], f = [-0.15, 0.28, 0.6];
function lightSeen(x, y, u, v) {
  const towards = [-0.18 + 0.4 * u - x, 0.63 + 0.4 * v - y, 1], to = [x - corner[0], y - corner[1], -corner[2]];
  const p = cross(towards, f), determinant = dot(e, p), s = dot(to, p) / determinant;
  const q = cross(to, e), t = dot(towards, q) / determinant, along = dot(f, q) / determinant;
  return along > 0 && s >= 0 && s <= 1 && t >= 0 && t <= 1 ? 0 : 1;
}

const at = {
  "checkerboard": (i, j, u, v, { width, height }) => floorSquare((i + u) / width, (j + v) / height),
  "zone plate": (i, j, u, v, size) => ring(i + u, j + v, size),
  "soft shadow": (i, j, u, v, { width, height }) => lightSeen(1.5 * (i + 0.5) / width, (j + 0.5) / height, u, v),
};

// The mean of each pixel over points [[u, v], ..]; shift(pixel, axis), if there is one, is added on the torus.
function pixels(scene, size, points, shift = null) {
  const wrapped = (x, by) => shift ? (x + by) % 1 : x;
  return Float64Array.from({ length: size.width * size.height }, (_, pixel) => {
    const i = pixel % size.width, j = Math.floor(pixel / size.width), dx = shift?.(pixel, 0), dy = shift?.(pixel, 1);
    let sum = 0;
    for (const [u, v] of points) sum += at[scene](i, j, wrapped(u, dx), wrapped(v, dy), size);
    return sum / points.length;
  });
}

// The first n points of a Kronecker sequence, along no edge of the scenes.
const many = n => Array.from({ length: n }, (_, k) => [0.5 + 0.7548776662466927 * k, 0.5 + 0.5698402909980532 * k].map(x => x % 1));

// The middles of m x m cells.
const grid = m => Array.from({ length: m * m }, (_, k) => [(k % m + 0.5) / m, (Math.floor(k / m) + 0.5) / m]);

function errors(values, reference) {
  const differences = Array.from(values, (value, i) => value - reference[i]), mean = f => differences.reduce((sum, x) => sum + f(x), 0) / values.length;
  return { mean_error: mean(Math.abs), rms_error: Math.sqrt(mean(x => x * x)), bias: mean(x => x), largest: Math.max(...differences.map(Math.abs)) };
}

module.exports = { errors, grid, many, pixels, scenes: Object.keys(at) };

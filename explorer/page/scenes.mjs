// SPDX-License-Identifier: Apache-2.0
// From points to pictures: three scenes, each pixel the mean over one set of points, and the converged pictures in closed
// form. A picture has y up, as the points; pixel (i, j) is [i, i + 1) x [j, j + 1), rows from the bottom.
//
// checkerboard  film position -> a plane of unit squares seen in perspective: Z = depth / (horizon - y), X = spread (x - 1/2) Z,
//               white where floor(X) + floor(Z) is even; grey beyond Z = far. (x and y are fractions of the picture.)
// zone plate    film position -> 1/2 + 1/2 cos(pi f r^2 / width), r in pixels from the middle of the left edge: f cycles per
//               pixel at the right edge.
// soft shadow   position on a square light -> whether it is seen from the floor at the middle of the pixel, past a card that
//               leans over the floor.

export const sceneNames = ["checkerboard", "zone plate", "soft shadow"];

const checker = { horizon: 0.94, depth: 1.8, spread: 2.4, far: 64 };
const plate = { cycles: 4.6 };
const shadow = {
  floor: [1.5, 1], light: { at: [-0.18, 0.63], side: 0.4 }, // the light is at height 1
  card: [[0.42, 0.2, 0.02], [0.75, 0.46, 0.02], [0.6, 0.74, 0.62], [0.27, 0.48, 0.62]],
};

// As many samples in each picture as take some ten milliseconds.
export function sizeFor(n) {
  const width = [96, 72, 60, 48, 36].find(w => w * w * 2 / 3 * n <= 1 << 20) || 24;
  return { width, height: width * 2 / 3 };
}

// The shift of a pixel along an axis, in [0, 1): a hash of 2 pixel + axis + 1, of the form and with the constants that are
// listed best of two rounds by https://github.com/skeeto/hash-prospector (16, 21f0aaad, 15, 735a2d97, 15).
export function shiftOf(pixel, axis) {
  let x = 2 * pixel + axis + 1;
  x = Math.imul(x ^ x >>> 16, 0x21f0aaad);
  x = Math.imul(x ^ x >>> 15, 0x735a2d97);
  return ((x ^ x >>> 15) >>> 0) / 2 ** 32;
}

// What depends on the size of a picture alone, made once.
const known = new Map();
function kept(key, make) {
  if (!known.has(key)) known.set(key, make());
  return known.get(key);
}

// ---- What one sample sees

function checkerAt(x, y) {
  const z = checker.depth / (checker.horizon - y);
  if (!(z > 0 && z < checker.far)) return 0.5;
  return (Math.floor((x - 0.5) * checker.spread * z) + Math.floor(z)) & 1 ? 0 : 1;
}

const plateAt = (x, y, { width, height }) => 0.5 + 0.5 * Math.cos(Math.PI * plate.cycles / width * (x * x + (y - height / 2) ** 2));

// The card seen from a place on the floor, in the light's own coordinates; counter-clockwise.
function cardFrom(x, y) {
  const { at, side } = shadow.light;
  const corners = shadow.card.map(([cx, cy, cz]) => [(x + (cx - x) / cz - at[0]) / side, (y + (cy - y) / cz - at[1]) / side]);
  return area(corners) < 0 ? corners.reverse() : corners;
}

const area = corners => corners.reduce((sum, [x, y], i) => {
  const [u, v] = corners[(i + 1) % corners.length];
  return sum + (x * v - u * y) / 2;
}, 0);

const floorOf = (i, j, { width, height }) => cardFrom((i + 0.5) / width * shadow.floor[0], (j + 0.5) / height * shadow.floor[1]);

// The sides of a convex polygon as { a x + b y >= c }; those that hold on the whole light are left out, and null is for one
// that holds nowhere on it.
function sidesOf(corners) {
  const sides = [];
  for (const [i, [x, y]] of corners.entries()) {
    const [u, v] = corners[(i + 1) % corners.length], a = y - v, b = u - x, c = a * x + b * y;
    if (Math.max(0, a) + Math.max(0, b) < c) return null;
    if (Math.min(0, a) + Math.min(0, b) < c) sides.push([a, b, c]);
  }
  return sides;
}

function inside(sides, x, y) {
  for (const [a, b, c] of sides) if (a * x + b * y < c) return false;
  return true;
}

// ---- Pictures

// The means over the points of each pixel; `shifted`: each pixel has the points on a torus that is shifted at random.
export function sample(scene, size, points, axes, shifted) {
  const { width, height } = size, { xs, n, dim } = points, values = new Float64Array(width * height);
  const cards = scene === "soft shadow" && kept(`sides ${width}`, () =>
    Array.from(values, (_, pixel) => sidesOf(floorOf(pixel % width, Math.floor(pixel / width), size))));
  for (let j = 0; j < height; j++) {
    for (let i = 0; i < width; i++) {
      const pixel = j * width + i, sides = scene === "soft shadow" ? cards[pixel] : [];
      if (scene === "soft shadow" && !sides?.length) { // all of the light is seen, or nothing
        values[pixel] = sides ? 0 : 1;
        continue;
      }
      const [sx, sy] = shifted ? [shiftOf(pixel, 0), shiftOf(pixel, 1)] : [0, 0];
      let sum = 0;
      for (let k = 0; k < n; k++) {
        let u = xs[k * dim + axes[0]] + sx, v = xs[k * dim + axes[1]] + sy;
        if (shifted && u >= 1) u -= 1;
        if (shifted && v >= 1) v -= 1;
        if (scene === "soft shadow") sum += inside(sides, u, v) ? 0 : 1;
        else if (scene === "checkerboard") sum += checkerAt((i + u) / width, (j + v) / height);
        else sum += plateAt(i + u, j + v, size);
      }
      values[pixel] = sum / n;
    }
  }
  return values;
}

// sq(t) = (-1)^floor(t), and its integral from 0, a triangle wave: at t, and its slope there.
const square = t => Math.floor(t) & 1 ? -1 : 1;
const triangle = t => { const u = Math.abs(t) % 2; return u < 1 ? u : 2 - u; };

// The integral over the rows from `low` to `high` and over x from the middle to t of sq(X) sq(Z): with dy = depth / Z^2 dZ it is
// that of depth / (spread Z^3) sq(Z) triangle(spread t Z), between whose kinks it is (p + q Z) / Z^3.
function checkerColumn(t, low, high) {
  if (low >= checker.horizon) return 0;
  const slope = Math.abs(checker.spread * t), from = checker.depth / (checker.horizon - low);
  const to = Math.min(high < checker.horizon ? checker.depth / (checker.horizon - high) : Infinity, checker.far);
  let z = from, sum = 0;
  while (z < to) {
    let next = Math.min(to, Math.floor(z + 1e-12) + 1);
    if (slope > 0) next = Math.min(next, (Math.floor(z * slope + 1e-12) + 1) / slope);
    const middle = (z + next) / 2, rising = square(slope * middle); // the triangle's slope in its argument
    const q = rising * slope, p = triangle(slope * middle) - q * middle;
    sum += square(middle) * (p * (1 / (z * z) - 1 / (next * next)) / 2 + q * (1 / z - 1 / next));
    z = next;
  }
  return sum * checker.depth / checker.spread;
}

function checkerConverged({ width, height }) {
  const values = new Float64Array(width * height);
  for (let j = 0; j < height; j++) {
    const columns = Array.from({ length: width + 1 }, (_, i) => checkerColumn(i / width - 0.5, j / height, (j + 1) / height));
    for (let i = 0; i < width; i++) values[j * width + i] = 0.5 + 0.5 * (columns[i + 1] - columns[i]) * width * height;
  }
  return values;
}

// The integral of exp(i pi a x^2) over [from, from + 1], by Simpson's rule.
function wave(a, from) {
  const steps = 1024, sum = [0, 0];
  for (let k = 0; k <= steps; k++) {
    const weight = (k === 0 || k === steps ? 1 : k % 2 ? 4 : 2) / (3 * steps), phase = Math.PI * a * (from + k / steps) ** 2;
    sum[0] += weight * Math.cos(phase);
    sum[1] += weight * Math.sin(phase);
  }
  return sum;
}

function plateConverged({ width, height }) {
  const a = plate.cycles / width, values = new Float64Array(width * height);
  const across = Array.from({ length: width }, (_, i) => wave(a, i)), up = Array.from({ length: height }, (_, j) => wave(a, j - height / 2));
  up.forEach(([c, s], j) => across.forEach(([d, t], i) => { values[j * width + i] = 0.5 + 0.5 * (c * d - s * t); }));
  return values;
}

// The part of a convex polygon in the unit square (Sutherland and Hodgman).
function clipped(corners) {
  for (const [axis, sign, limit] of [[0, 1, 0], [0, -1, -1], [1, 1, 0], [1, -1, -1]]) {
    const kept = [], depth = p => sign * p[axis] - limit;
    corners.forEach((p, i) => {
      const q = corners[(i + 1) % corners.length], u = depth(p), v = depth(q);
      if (u >= 0) kept.push(p);
      if ((u < 0) !== (v < 0)) kept.push([0, 1].map(k => p[k] + (q[k] - p[k]) * u / (u - v)));
    });
    corners = kept;
  }
  return corners;
}

function shadowConverged(size) {
  const { width, height } = size;
  return Float64Array.from({ length: width * height }, (_, pixel) =>
    1 - area(clipped(floorOf(pixel % width, Math.floor(pixel / width), size))));
}

const closedForms = { "checkerboard": checkerConverged, "zone plate": plateConverged, "soft shadow": shadowConverged };

export const converged = (scene, size) => kept(`${scene} ${size.width}`, () => closedForms[scene](size));

// The answer to { scene, size, points, axes, shifted }: both pictures, and the mean absolute and the root mean square error.
export function picture({ scene, size, points, axes, shifted }) {
  const reference = converged(scene, size), values = sample(scene, size, points, axes, shifted);
  let absolute = 0, squares = 0;
  values.forEach((value, i) => {
    absolute += Math.abs(value - reference[i]);
    squares += (value - reference[i]) ** 2;
  });
  return { size, values, converged: reference, mean_error: absolute / values.length, rms_error: Math.sqrt(squares / values.length) };
}

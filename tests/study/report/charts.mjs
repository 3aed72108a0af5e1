// SPDX-License-Identifier: Apache-2.0
// Charts (explorer/page/chart.mjs) without a browser: numbers along every axis, bars that say where they go on, marks,
// legends and guides. Elements of a document that keep what they are given stand in for SVG's.
import assert from "node:assert";

class Node {
  constructor(name) { Object.assign(this, { name, attributes: {}, children: [] }); }
  setAttribute(name, value) { this.attributes[name] = String(value); }
  append(...nodes) { this.children.push(...nodes); }
  replaceChildren(...nodes) { this.children = nodes; }
  all(test) { return this.children.flatMap(c => c instanceof Node ? [...(test(c) ? [c] : []), ...c.all(test)] : []); }
  count(name) { return this.all(c => c.name === name).length; }
  of(className) { return this.all(c => c.attributes.class?.split(" ").includes(className)); }
}
globalThis.document = { createElementNS: (_, name) => new Node(name), createElement: name => new Node(name) };
const { chart } = await import("../../../explorer/page/chart.mjs");

function draw(series, { log = false, width = 700, ...options } = {}) {
  const place = new Node("div");
  place.clientWidth = width;
  chart(place, { title: "t", x: { title: "x" }, y: { title: "y", log }, series, ...options });
  return place;
}
const one = (points, more = {}) => [{ label: "s", className: "s0", points, line: true, marks: 0, ...more }];

for (const [low, high] of [[0.25, 0.25 * (1 + 2 ** -52)], [0, 1e-320], [1e-12, 1e-12], [7, 7]]) {
  for (const log of [false, true]) {
    const ticks = draw(one([[1, low], [2, high]]), { log }).all(n => n.attributes["text-anchor"] === "end").length;
    assert(ticks <= 14, `${ticks} numbers on an axis from ${low} to ${high}, logarithmic: ${log}`);
  }
}
for (let high = 10.001; high < 1e5; high *= 1.17) {
  for (const log of [false, true]) {
    const ticks = draw(one([[1, 10], [2, high]]), { log }).all(n => n.attributes["text-anchor"] === "end").length;
    assert(ticks >= 3 && ticks <= 14, `${ticks} numbers on an axis to ${high}, logarithmic: ${log}`);
  }
}

// On a logarithmic axis a bar to 0 has no end. No bar leaves the picture.
for (const [low, high, arrows] of [[9, 21, 0], [0, 21, 2], [-5, 1e9, 4], [NaN, NaN, 0]]) {
  const drawn = draw(one([[1, 10, low, high], [2, 20, low, high]]), { log: true });
  const paths = drawn.of("bar").map(n => n.attributes.d).join("");
  assert.equal((paths.match(/l-?3 /g) ?? []).length, 2 * arrows, `bars from ${low} to ${high}`);
  for (const [, y] of paths.matchAll(/V([-0-9.]+)/g)) assert(y >= 14 && y <= 258, `a bar ends at ${y}`);
}

// A mark a point, of eight shapes; a point that a logarithmic axis does not have is left out.
const marks = draw([0, 1, 2, 3, 4, 5, 6, 7].map(i => ({ label: `s${i}`, className: "s", points: [[1, 1], [2, 4], [3, -1]], marks: i })), { log: true });
assert.deepEqual(["circle", "polygon"].map(name => marks.count(name)), [2, 14]);
const outlines = marks.all(n => n.name === "polygon").map(n => n.attributes.points.split(" ").map(p => p.split(",").map(Number)))
  .map(corners => corners.map((p, k) => p.map((v, i) => Math.sign(Math.round(v - (corners[k - 1] ?? p)[i])))).join(" ")); // ways of the edges
assert.equal(new Set(outlines).size, 7);
assert.equal(marks.count("title"), 16);
assert.equal(marks.of("line").length, 0);

// The legend names series with labels, beside the chart or below it, hollow ones left out; guides do not widen the axes.
const named = [...one([[1, 1], [2, 2]]), { label: "h", className: "hollow", points: [[1, 1]], marks: 0, hollow: true }];
for (const width of [700, 300]) {
  const drawn = draw(named, { legend: true, width }), [, , w, h] = drawn.children[0].attributes.viewBox.split(" ").map(Number);
  const legend = drawn.all(n => n.name === "text" && ["s", "h"].includes(n.children[0]));
  assert.deepEqual(legend.map(n => n.children[0]), ["s"]);
  assert(+legend[0].attributes.x < w && +legend[0].attributes.y < h, "the legend is outside of the picture");
  assert.equal(+legend[0].attributes.y > 300, width === 300);
}
const places = more => draw([...one([[1, 1], [2, 2]]), ...more]).count("circle") && draw([...one([[1, 1], [2, 2]]), ...more]).all(n => n.name === "circle").map(n => n.attributes.cy);
assert.deepEqual(places([]), places([{ className: "guide", points: [[1, 100]], line: true, guide: true }]));
assert.notDeepEqual(places([]), places([{ className: "s", points: [[1, 100]], line: true }]));

// Nothing that can be drawn leaves an empty picture with a text.
assert.equal(draw(one([[1, -1]]), { log: true }).children[0].attributes["aria-label"], "t");
console.log("charts: passed");

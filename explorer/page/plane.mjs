// SPDX-License-Identifier: Apache-2.0
// The picture of a set: points in the square, y up, strata and the witness of a measure below them; points can be moved.
import { svg, element, short } from "./dom.mjs";
import { countPoints, judgeStrata, strataOf } from "./strata.mjs";
import { clamp, limits } from "./state.mjs";

const side = 400, margin = 10;
const at = x => +(x * side).toFixed(3), up = y => +((1 - y) * side).toFixed(3);
const grid_step = 1e-6; // of places that a pointer or key gives: enough for any screen, and short to write down

// A set on a line is drawn half way up.
const placeOf = (points, axes, i) =>
  points.dim === 1 ? [points.xs[i], 0.5] : [points.xs[i * points.dim + axes[0]], points.xs[i * points.dim + axes[1]]];

function drawStrata(points, axes, strata) {
  const layout = points.dim > 1 && strataOf(strata, points.n, limits);
  if (!layout) return [[], ""];
  const { columns, rows, rooks } = layout;
  const cells = countPoints(layout, points, axes), { each, text } = judgeStrata(layout, cells, points.n);
  const areas = { empty: "", crowded: "" };
  cells.forEach((count, i) => {
    if (each === null || count === each) return;
    const column = rooks ? i : i % columns, row = rooks ? i - columns : Math.floor(i / columns);
    const [x, width] = rooks && i >= columns ? [0, 1] : [column / columns, 1 / columns];
    const [y, height] = rooks && i < columns ? [0, 1] : [row / rows, 1 / rows];
    areas[count < each ? "empty" : "crowded"] += `M${at(x)},${up(y)}h${at(width)}v${-at(height)}h${-at(width)}z`;
  });
  let lines = "";
  for (let i = 1; i < columns; i++) lines += `M${at(i / columns)},0v${side}`;
  for (let i = 1; i < rows; i++) lines += `M0,${up(i / rows)}h${side}`;
  return [[
    areas.empty && svg("path", { class: "empty", d: areas.empty }),
    areas.crowded && svg("path", { class: "crowded", d: areas.crowded }),
    svg("path", { class: "strata", d: lines }),
  ].filter(Boolean), text];
}

// The corners of {a x + b y <= c} in the square.
function halfPlane([a, b], [c]) {
  const corners = [[0, 0], [1, 0], [1, 1], [0, 1]], kept = [], value = ([x, y]) => a * x + b * y - c;
  corners.forEach((p, i) => {
    const q = corners[(i + 1) % 4], u = value(p), v = value(q);
    if (u <= 0) kept.push(p);
    if ((u < 0 && v > 0) || (u > 0 && v < 0)) kept.push([0, 1].map(k => p[k] + (q[k] - p[k]) * u / (u - v)));
  });
  return kept;
}

function drawWitness(witness, axes, dim) {
  if (!witness) return [];
  const { kind, lo, hi, closed } = witness, edge = closed ? "witness closed" : "witness open";
  if (kind === "box") {
    const [y0, y1] = dim === 1 ? [0, 1] : [lo[axes[1]], hi[axes[1]]];
    const box = { x: at(lo[axes[0]]), y: up(y1), width: at(hi[axes[0]] - lo[axes[0]]), height: at(y1 - y0) };
    return [svg("rect", { class: edge, ...box })];
  }
  if (kind === "half-plane") {
    if (lo.length > 2) return []; // a half-space has no outline in the plane
    return [svg("polygon", { class: edge, points: halfPlane(lo, hi).map(([x, y]) => `${at(x)},${up(y)}`).join(" ") })];
  }
  const disks = [];
  for (const i of [-1, 0, 1]) {
    for (const j of [-1, 0, 1]) disks.push(svg("circle", { class: edge, cx: at(lo[0] + i), cy: up(lo[1] + j), r: at(hi[0]) }));
  }
  return disks; // the torus' copies; the square is what is seen of them
}

// What a witness says, in words and numbers.
export function witnessText(witness, n) {
  const { kind, closed, count, volume, lo, hi } = witness;
  const where = {
    "box": () => lo.map((x, k) => `${closed || !x ? "[" : "("}${short(x, 6)}, ${short(hi[k], 6)}${closed ? "]" : ")"}`).join(" × "),
    "half-plane": () => `${lo.map((a, k) => `${short(a, 6)} ${"xyz"[k]}`).join(" + ")} ≤ ${short(hi[0], 6)}`,
    "disk": () => `about (${short(lo[0], 6)}, ${short(lo[1], 6)}) of radius ${short(hi[0], 6)}`,
  }[kind]();
  return `${count} of ${n} points in the ${closed ? "closed" : "open"} ${kind} ${where}, whose area is ${short(volume, 6)}: ` +
    `|${short(count / n, 6)} − ${short(volume, 6)}| = ${short(Math.abs(count / n - volume), 6)}`;
}

export class Plane {
  // moved(i, [x, y]) is called when the reader moves point i; chosen(i) when one is chosen.
  constructor(name, moved, chosen) {
    Object.assign(this, { name, moved, chosen, points: null, axes: [0, 1], selected: -1, dragging: false });
    this.clip = `clip-${name}`;
    this.node = svg("svg", {
      class: "plane", viewBox: `${-margin} ${-margin} ${side + 2 * margin} ${side + 2 * margin}`, tabindex: 0,
      role: "application", "aria-roledescription": "picture of points that can be moved", "aria-describedby": "plane-help",
    });
    this.node.addEventListener("pointerdown", event => this.down(event));
    // a finger on a point drags it in every direction; beside the points it scrolls the page
    this.node.addEventListener("touchstart", event => { if (this.dragging) event.preventDefault(); }, { passive: false });
    this.node.addEventListener("pointermove", event => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) this.node.addEventListener(end, () => { this.dragging = false; });
    this.node.addEventListener("keydown", event => this.key(event));
    this.strataText = element("p", { class: "note strata-text" });
  }

  draw({ points, axes, strata, witness, title }) {
    Object.assign(this, { points, axes });
    this.node.setAttribute("aria-label", title);
    const square = { x: 0, y: 0, width: side, height: side };
    const frame = svg("rect", { class: "frame", ...square });
    if (!points) {
      this.node.replaceChildren(frame);
      this.strataText.textContent = "";
      return;
    }
    if (this.selected >= points.n) this.selected = -1;
    const [cells, text] = drawStrata(points, axes, strata);
    let dots = "";
    for (let i = 0; i < points.n; i++) {
      const [x, y] = placeOf(points, axes, i);
      dots += `M${at(x)},${up(y)}h0`;
    }
    this.strataText.textContent = text;
    this.node.replaceChildren(
      svg("clipPath", { id: this.clip }, svg("rect", square)), svg("rect", { class: "paper", ...square }),
      svg("g", { "clip-path": `url(#${this.clip})` }, ...cells, ...drawWitness(witness, axes, points.dim)), frame,
      svg("path", { class: `points set-${this.name}`, d: dots, "stroke-width": this.diameter().toFixed(2), "stroke-linecap": "round" }),
      ...this.ring());
  }

  diameter() {
    return 2 * clamp(0.14 * side / Math.sqrt(this.points.n), 0.7, 4.5);
  }

  ring() {
    if (this.selected < 0) return [];
    const [x, y] = placeOf(this.points, this.axes, this.selected);
    return [svg("circle", { class: "selected", cx: at(x), cy: up(y), r: this.diameter() / 2 + 5 })];
  }

  // The place under a pointer, in the square's coordinates; it may be outside.
  under(event) {
    const box = this.node.getBoundingClientRect(), scale = (side + 2 * margin) / box.width;
    return [((event.clientX - box.left) * scale - margin) / side, 1 - ((event.clientY - box.top) * scale - margin) / side];
  }

  down(event) {
    if (!this.points || event.button !== 0) return;
    const [x, y] = this.under(event), reach = (event.pointerType === "touch" ? 24 : 12) / this.node.getBoundingClientRect().width;
    let best = -1, nearest = (reach + this.diameter() / 2 / side) ** 2;
    for (let i = 0; i < this.points.n; i++) {
      const [px, py] = placeOf(this.points, this.axes, i), distance = (px - x) ** 2 + (py - y) ** 2;
      if (distance < nearest) [best, nearest] = [i, distance];
    }
    this.choose(best);
    if (best < 0) return;
    const [px, py] = placeOf(this.points, this.axes, best);
    this.dragging = [px - x, py - y]; // the point keeps its place under the pointer
    this.node.setPointerCapture(event.pointerId);
    event.preventDefault();
    this.node.focus({ preventScroll: true });
  }

  move(event) {
    if (!this.dragging || !this.points) return;
    const [x, y] = this.under(event);
    this.put(x + this.dragging[0], y + this.dragging[1]);
  }

  put(x, y) {
    const snap = v => clamp(Math.round(v / grid_step) * grid_step, 0, 1).toFixed(6);
    this.moved(this.selected, [+snap(x), +snap(y)]);
  }

  choose(i) {
    this.selected = i;
    this.node.querySelector(".selected")?.remove();
    if (i >= 0) this.node.append(...this.ring());
    this.chosen(i);
  }

  key(event) {
    const n = this.points?.n || 0, step = event.shiftKey ? 0.1 : event.altKey ? 0.001 : 0.01;
    const steps = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    if (!n || event.ctrlKey || event.metaKey) return;
    if (event.key === "n" || event.key === "p") {
      this.choose((this.selected + (event.key === "n" ? 1 : n - 1) + (this.selected < 0 && event.key === "p" ? 1 : 0)) % n);
    } else if (event.key === "Escape") {
      this.choose(-1);
    } else if (steps[event.key] && this.selected >= 0) {
      const [x, y] = placeOf(this.points, this.axes, this.selected);
      this.put(x + steps[event.key][0], y + steps[event.key][1]);
    } else {
      return;
    }
    event.preventDefault();
  }
}

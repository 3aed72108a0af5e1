// SPDX-License-Identifier: Apache-2.0
// A chart of lines, axes linear or logarithmic.
import { svg, short } from "./dom.mjs";

const height = 300, left = 64, right = 14, top = 14, bottom = 42;

// As wide as the place that it is for, so that its letters have their size.
const widthOf = place => Math.min(Math.max(place.clientWidth, 280), 736);

// Round places in [low, high] for marks: 1, 2, 5 times a power of ten, or those powers alone.
function marks(low, high, log) {
  const found = [];
  if (log) {
    const decades = Math.log10(high / low), factors = decades < 1.5 ? [1, 2, 5] : decades < 4 ? [1, 3] : [1];
    for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); e++) {
      for (const f of factors) if (f * 10 ** e >= low * 0.999 && f * 10 ** e <= high * 1.001) found.push(+(f * 10 ** e).toPrecision(1));
    }
    return found;
  }
  const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map(f => f * power).find(s => s >= rough);
  for (let i = Math.ceil(low / step); i * step <= high * (1 + 1e-9); i++) found.push(+(i * step).toPrecision(12));
  return found;
}

// Draws into a place of the page. curves: [{ className, points: [[x, y], ..], dots, guide }]; guides do not count for the range.
export function chart(place, { title, xLabel, yLabel, log, curves, level }) {
  const width = widthOf(place);
  const usable = ([x, y]) => Number.isFinite(x) && Number.isFinite(y) && (!log || (x > 0 && y > 0));
  const counted = curves.filter(c => !c.guide).flatMap(c => c.points.filter(usable));
  const node = svg("svg", { class: "chart", viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": title });
  place.replaceChildren(node);
  if (counted.length < 2) return;
  const range = k => [Math.min(...counted.map(p => p[k])), Math.max(...counted.map(p => p[k]))];
  let [x0, x1] = range(0), [y0, y1] = range(1);
  if (log) [y0, y1] = [y0 / 1.3, y1 * 1.3];
  else [y0, y1] = [Math.min(0, y0), Math.max(y1 * 1.05, level || 0)];
  if (x1 <= x0) x1 = x0 + 1;
  const scale = (v, a, b) => log ? Math.log(v / a) / Math.log(b / a) : (v - a) / (b - a);
  const toX = x => +(left + scale(x, x0, x1) * (width - left - right)).toFixed(2);
  const toY = y => +(height - bottom - scale(y, y0, y1) * (height - top - bottom)).toFixed(2);
  for (const x of marks(x0, x1, log)) {
    node.append(svg("path", { class: "tick", d: `M${toX(x)},${top}V${height - bottom}` }),
      svg("text", { x: toX(x), y: height - bottom + 17, "text-anchor": "middle" }, short(x)));
  }
  for (const y of marks(y0, y1, log)) {
    node.append(svg("path", { class: "tick", d: `M${left},${toY(y)}H${width - right}` }),
      svg("text", { x: left - 7, y: toY(y) + 4, "text-anchor": "end" }, short(y)));
  }
  if (level !== undefined) node.append(svg("path", { class: "guide", d: `M${left},${toY(level)}H${width - right}` }));
  node.append(svg("text", { x: (left + width - right) / 2, y: height - 6, "text-anchor": "middle" }, xLabel),
    svg("text", { x: 14, y: (top + height - bottom) / 2, "text-anchor": "middle",
      transform: `rotate(-90 14 ${(top + height - bottom) / 2})` }, yLabel));
  const area = { x: left - 5, y: top - 5, width: width - left - right + 10, height: height - top - bottom + 10 };
  const inside = svg("svg", { ...area, viewBox: `${area.x} ${area.y} ${area.width} ${area.height}` }); // cuts guides off
  for (const curve of curves) {
    const places = curve.points.filter(usable).map(([x, y]) => [toX(x), toY(y)]);
    inside.append(svg("path", { class: curve.className, d: places.map(([x, y], i) => `${i ? "L" : "M"}${x},${y}`).join("") }));
    if (curve.dots) {
      inside.append(svg("path", { class: `${curve.className} dots`, d: places.map(([x, y]) => `M${x},${y}h0`).join("") }));
    }
  }
  node.append(inside);
}

// SPDX-License-Identifier: Apache-2.0
// The charts of the explorer and of a study's report (src/lab/study/report/page): series of lines and marks with bars on axes
// that are linear or logarithmic each. An axis spans its values with a margin; ticks are at 1, 2 or 5 times powers of ten,
// at least three of them. Colours are the page's: a series is <g class="series CLASS"> with .line, .bar and .dots.
import { svg, short } from "./dom.mjs";

const numbersLeft = 64, right = 14, top = 14, bottom = 42, legendWidth = 220, legendLine = 15, legendFits = 560;

// As wide as the place that it is for, so that its letters have their size.
const widthOf = (place, most) => Math.min(Math.max(place.clientWidth, 280), most);

// low and high are of the values, or of their logarithms to base 10; from and to in the picture.
function axisOf(values, { log, zero }, from, to) {
  const usable = values.filter(v => Number.isFinite(v) && (!log || v > 0)).map(v => log ? Math.log10(v) : v);
  let low = Math.min(...usable, zero ? 0 : Infinity), high = Math.max(...usable);
  // Values that are equal but for their last digits have no ticks between them.
  if (!(high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high), log ? 1 : 0))) [low, high] = Number.isFinite(low) ? [low - 0.5, low + 0.5] : [-0.5, 0.5];
  return { log, zero, low, high, from, to };
}

const fits = (axis, v) => Number.isFinite(v) && (!axis.log || v > 0);
const position = (axis, v) =>
  axis.from + (axis.to - axis.from) * ((axis.log ? Math.log10(v) : v) - axis.low) / (axis.high - axis.low);

// What bars take beyond the values: no more than these span themselves, at least a third of a decade or of the value.
function widenForBars(axis, bars) {
  const room = Math.max(axis.high - axis.low, axis.log ? 0.33 : 0.33 * Math.abs(axis.high));
  for (const v of bars) {
    if (!fits(axis, v)) continue;
    const at = axis.log ? Math.log10(v) : v;
    axis.barLow = Math.min(axis.barLow ?? axis.low, at);
    axis.barHigh = Math.max(axis.barHigh ?? axis.high, at);
  }
  axis.low = Math.max(axis.barLow ?? axis.low, axis.low - room);
  axis.high = Math.min(axis.barHigh ?? axis.high, axis.high + room);
}

function addMargin(axis) {
  const margin = 0.05 * (axis.high - axis.low);
  if (!axis.zero || axis.low < 0) axis.low -= margin;
  axis.high += margin;
}

// 1, 2 or 5 times a power of ten apart.
function evenTicks(low, high) {
  const raw = (high - low) / 5, power = 10 ** Math.floor(Math.log10(raw));
  const step = (raw / power < 1.5 ? 1 : raw / power < 3.5 ? 2 : 5) * power, found = [];
  for (let i = Math.ceil(low / step); i * step <= high; i++) found.push(+(i * step).toPrecision(12));
  return found;
}

// Decades with 2 and 5 where they fit. Of less than a decade those would be too few.
function ticks(axis) {
  const decades = axis.high - axis.low, found = [];
  if (!axis.log) return evenTicks(axis.low, axis.high);
  if (decades < 0.9) return evenTicks(10 ** axis.low, 10 ** axis.high);
  for (let e = Math.floor(axis.low); e <= Math.ceil(axis.high); e++) {
    for (const f of decades < 2.5 ? [1, 2, 5] : [1]) {
      const value = +(f * 10 ** e).toPrecision(1), at = Math.log10(value);
      if (at >= axis.low && at <= axis.high && (decades < 8 || e % 2 === 0)) found.push(value);
    }
  }
  return found;
}

const round = v => +v.toFixed(2);

// The corners of marks, those of the program's plots (draw_mark in src/lab/plot/chart.c); the first mark is a dot.
const corners = [null, [-1, -1, 1, -1, 1, 1, -1, 1], [-1.2, 1, 1.2, 1, 0, -1.2], [0, -1.5, 1.5, 0, 0, 1.5, -1.5, 0], [-1.2, -1, 1.2, -1, 0, 1.2],
  [-0.4, -1.5, 0.4, -1.5, 0.4, -0.4, 1.5, -0.4, 1.5, 0.4, 0.4, 0.4, 0.4, 1.5, -0.4, 1.5, -0.4, 0.4, -1.5, 0.4, -1.5, -0.4, -0.4, -0.4],
  [0, -1.7, 0.42, -0.58, 1.62, -0.53, 0.68, 0.22, 1, 1.38, 0, 0.72, -1, 1.38, -0.68, 0.22, -1.62, -0.53, -0.42, -0.58],
  [-0.78, -1.34, 0, -0.57, 0.78, -1.34, 1.34, -0.78, 0.57, 0, 1.34, 0.78, 0.78, 1.34, 0, 0.57, -0.78, 1.34, -1.34, 0.78, -0.57, 0, -1.34, -0.78]];

// Mark number `index`; the numbers go on from the first mark.
export function shape(index, x, y, large) {
  const r = large ? 5 : 3, at = corners[index % corners.length];
  if (!at) return svg("circle", { cx: round(x), cy: round(y), r });
  return svg("polygon", { points: at.map((v, i) => round((i % 2 ? y : x) + r * v) + (i % 2 ? " " : ",")).join("").trim() });
}

// A bar from the value to its end. One that goes on beyond the axis, as to 0 on a logarithmic one, ends in an arrowhead.
function barEnd(axis, x, value, up) {
  const at = fits(axis, value) ? position(axis, value) : up ? -Infinity : Infinity;
  if (at <= axis.from && at >= axis.to) return `V${round(at)}`;
  const end = at > axis.from ? axis.from : axis.to, back = at > axis.from ? -4 : 4;
  return `V${end}M${x} ${end}l3 ${back}M${x} ${end}l-3 ${back}M${x} ${end}`;
}

// Puts the series, and what can be named of it, into `drawn`.
function drawSeries(series, xs, ys, drawn) {
  const group = svg("g", { class: `series ${series.className}` });
  const shown = series.points.filter(([x, y]) => fits(xs, x) && fits(ys, y));
  const at = shown.map(([x, y]) => [round(position(xs, x)), round(position(ys, y))]);
  at.forEach(([x, y], i) => drawn.push({ x, y, series, group, values: shown[i] }));
  if (series.line && at.length) group.append(svg("path", { class: "line", d: at.map(([x, y], i) => `${i ? "L" : "M"}${x},${y}`).join("") }));
  shown.forEach(([, , low, high], i) => {
    const [x, y] = at[i];
    if (low < high) group.append(svg("path", { class: "bar", d: `M${x} ${y}${barEnd(ys, x, low, false)}M${x} ${y}${barEnd(ys, x, high, true)}` }));
  });
  if (series.marks === undefined) return group;
  const dots = svg("g", { class: "dots" });
  shown.forEach(([x, y], i) => {
    const mark = shape(series.marks, ...at[i], series.hollow);
    if (series.label) mark.append(svg("title", {}, `${series.label}: ${short(x, 6)}, ${short(y, 6)}`));
    dots.append(mark);
  });
  group.append(dots);
  return group;
}

function drawLegend(node, named, x, y) {
  named.forEach((series, i) => {
    const line = y + legendLine * i, group = svg("g", { class: `series ${series.className}` });
    if (series.line) group.append(svg("path", { class: "line", d: `M${x} ${line - 4}h18` }));
    if (series.marks !== undefined) group.append(svg("g", { class: "dots" }, shape(series.marks, x + 9, line - 4, false)));
    node.append(group, svg("text", { x: x + 24, y: line }, series.label));
  });
}

// Draws into a place of the page. x, y: { title, log, zero }; zero: a linear axis that begins there. series: [{ label, className, points: [[x, y] or [x, y, low, high], ..], line, marks, hollow, guide }]; marks: the number of their shape;
// guides do not count for the axes. level: a horizontal guide. legend: series with labels, hollow ones left out, are named.
// most: the largest width. Returns every point as drawn: { x, y, series, group, values }, in the units of the picture.
export function chart(place, { title, x, y, series, level, legend, height = 300, most = 736 }) {
  const width = widthOf(place, most), drawn = [], named = legend ? series.filter(s => s.label && !s.hollow) : [];
  const beside = named.length > 0 && width >= legendFits, below = named.length > 0 && !beside;
  const left = numbersLeft, rightEnd = width - (beside ? legendWidth : right), bottomEnd = height - bottom;
  const tall = Math.max(height, beside ? top + 12 + legendLine * named.length : 0) + (below ? legendLine * named.length + 8 : 0);
  const node = svg("svg", { class: "chart", viewBox: `0 0 ${width} ${tall}`, role: "img", "aria-label": title });
  place.replaceChildren(node);
  const counted = series.filter(s => !s.guide).flatMap(s => s.points).filter(([px, py]) =>
    Number.isFinite(px) && Number.isFinite(py) && (!x.log || px > 0) && (!y.log || py > 0));
  if (!counted.length) return drawn;
  const xs = axisOf(counted.map(p => p[0]), x, left, rightEnd);
  const ys = axisOf([...counted.map(p => p[1]), ...(level === undefined ? [] : [level])], y, bottomEnd, top);
  widenForBars(ys, counted.flatMap(p => p[2] < p[3] ? [p[2], p[3]] : []));
  addMargin(xs);
  addMargin(ys);
  for (const v of ticks(xs)) {
    const at = round(position(xs, v));
    node.append(svg("path", { class: "tick", d: `M${at},${top}V${bottomEnd}` }),
      svg("text", { x: at, y: bottomEnd + 17, "text-anchor": "middle" }, short(v)));
  }
  for (const v of ticks(ys)) {
    const at = round(position(ys, v));
    node.append(svg("path", { class: "tick", d: `M${left},${at}H${rightEnd}` }),
      svg("text", { x: left - 7, y: at + 4, "text-anchor": "end" }, short(v)));
  }
  if (level !== undefined) node.append(svg("path", { class: "guide", d: `M${left},${round(position(ys, level))}H${rightEnd}` }));
  node.append(svg("text", { x: (left + rightEnd) / 2, y: height - 6, "text-anchor": "middle" }, x.title),
    svg("text", { x: 14, y: (top + bottomEnd) / 2, "text-anchor": "middle",
      transform: `rotate(-90 14 ${(top + bottomEnd) / 2})` }, y.title));
  const area = { x: left - 6, y: top - 6, width: rightEnd - left + 12, height: bottomEnd - top + 12 };
  const inside = svg("svg", { ...area, viewBox: `${area.x} ${area.y} ${area.width} ${area.height}` }); // cuts guides off
  inside.append(...series.map(s => drawSeries(s, xs, ys, drawn)));
  node.append(inside);
  drawLegend(node, named, beside ? rightEnd + 8 : left, beside ? top + 12 : height + 14);
  return drawn;
}

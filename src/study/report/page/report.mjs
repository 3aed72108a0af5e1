// SPDX-License-Identifier: Apache-2.0
// Shows the data of a report (docs/report-format.md), which stand in the page's element #data: sections, tables with
// their CSV files, charts, figures and pictures.
import { chart } from "../../../../explorer/page/chart.mjs";
import { byId, element, svg } from "../../../../explorer/page/dom.mjs";

const dash = "–", colours = 8, chartSeries = 24, errorGain = 8;

// ---- Numbers and words

// As C's %.<digits>g.
function general(value, digits) {
  if (value === 0) return "0";
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e").map((part, i) => i ? +part : part);
  const trimmed = text => text.includes(".") ? text.replace(/\.?0+$/, "") : text;
  if (exponent >= -4 && exponent < digits) return trimmed(value.toFixed(digits - 1 - exponent));
  return `${trimmed(mantissa)}e${exponent < 0 ? "-" : "+"}${String(Math.abs(exponent)).padStart(2, "0")}`;
}

const shown = (value, column) =>
  column.decimals === undefined ? general(value, column.digits ?? 4) : value.toFixed(column.decimals);

const words = runs => runs.map(run => {
  if (typeof run === "string") return run;
  return run.style ? element(run.style, {}, run.text) : run.text;
});

const plain = runs => runs.map(run => run.text ?? run).join("");

const taken = new Map(); // ids, which studies of several plans may repeat
function unique(id) {
  if (!id) return null;
  const number = (taken.get(id) ?? 0) + 1;
  taken.set(id, number);
  return number === 1 ? id : `${id}-${number}`;
}

// ---- Tables

const small = text => element("span", { class: "pm" }, text);

// What stands behind a value: its interval, or its standard deviation.
function spread({ value, low, high, sd }, column) {
  const half = h => column.decimals === undefined ? general(h, 2) : h.toFixed(column.decimals);
  if (typeof sd === "number") return [" ", small(`± ${general(sd, 2)}`)];
  if (low === high && typeof low === "number") return [];
  if (typeof low !== "number" || typeof high !== "number") return column.type === "interval" ? [" ", small("± ?")] : [];
  if (Math.abs(high - value - (value - low)) < 1e-6 * (high - low)) return [" ", small(`± ${half(high - value)}`)];
  return [" ", small(`${half(low)} … ${half(high)}`)];
}

// Verdicts have a mark, and z, or the change, behind it or in its tooltip.
function verdictMark(cell, withNumber) {
  if (cell.verdict === "new" || cell.verdict === "waiting") return cell.verdict === "new" ? "new" : "not yet";
  const sign = v => v < 0 ? "" : "+";
  const number = cell.z === undefined ? `${sign(cell.change)}${(100 * cell.change).toFixed(0)} %` : `z = ${sign(cell.z)}${cell.z.toFixed(1)}`;
  const mark = cell.verdict === "explained" ? `note ${cell.note}` : cell.verdict === "unexplained" ? "✗" : "✓";
  const name = { explained: "note", unexplained: "bad" }[cell.verdict] ?? "good";
  return element("span", { class: name, title: number }, withNumber ? `${mark} ${number}` : mark);
}

// What a cell shows: a text, a number, [value, low, high], or an object with more than that.
function cellContent(cell, column) {
  if (typeof cell === "string") return [cell];
  if (typeof cell === "number") return [shown(cell, column)];
  const data = Array.isArray(cell) ? { value: cell[0], low: cell[1], high: cell[2] } : cell ?? {};
  if (column.type === "verdict") return [verdictMark(data, true)];
  const content = [];
  if (data.text !== undefined) content.push(data.text);
  else if (typeof data.value === "number") content.push(shown(data.value, column), ...spread(data, column));
  else content.push(dash);
  if (data.sets) content.push(" ", small(`(${data.sets} set${data.sets > 1 ? "s" : ""})`));
  if (data.verdict) content.push(" ", verdictMark(data, false));
  else if (data.note) content.push(element("sup", { class: "note" }, data.note));
  return content;
}

// How many rows from this one on have the same cell in a merged column; 0: the one above stands for it.
function span(rows, row, column) {
  const same = i => rows[i] && rows[i][column] === rows[row][column];
  if (same(row - 1)) return 0;
  let n = 1;
  while (same(row + n)) n++;
  return n;
}

function groupHeads(columns) {
  const heads = [];
  for (const { group = "" } of columns) {
    if (heads.length && group && heads.at(-1).group === group) heads.at(-1).n++;
    else heads.push({ group, n: 1 });
  }
  return element("tr", {}, ...heads.map(({ group, n }) => element("th", { colspan: n > 1 ? n : null, scope: group ? "colgroup" : null }, group)));
}

// A column of the file for each number of a column of the table.
function csvParts(column) {
  const numbers = { interval: ["", " low", " high"], spread: ["", " SD"], verdict: ["", " z", " change"] }[column.type] ?? [""];
  const keys = { interval: ["value", "low", "high"], spread: ["value", "sd"], verdict: ["verdict", "z", "change"] }[column.type] ?? ["value"];
  return keys.map((key, i) => ({
    name: column.name + numbers[i],
    of: cell => Array.isArray(cell) ? cell[i] : cell !== null && typeof cell === "object" ? cell[key] : i === 0 ? cell : null,
  }));
}

// RFC 4180.
function csvOf({ columns, rows }) {
  const parts = columns.map(csvParts), quote = v => typeof v === "string" ? `"${v.replaceAll('"', '""')}"` : v ?? "";
  const lines = [parts.flat().map(p => quote(p.name))];
  for (const row of rows) lines.push(columns.flatMap((_, c) => parts[c].map(p => row[c] === undefined ? "" : quote(p.of(row[c])))));
  return lines.map(line => `${line.join(",")}\r\n`).join("");
}

function table(block) {
  const visible = block.columns.map((column, c) => ({ ...column, c })).filter(column => !column.hidden);
  const heads = visible.map(column => element("th", { scope: "col", class: column.type === "text" ? "name" : null }, column.title ?? column.name));
  const body = block.rows.map((row, r) => element("tr", {}, ...visible.map(column => {
    if (row[column.c] === undefined) return null;
    const rows = column.merged ? span(block.rows, r, column.c) : 1;
    if (!rows) return null;
    const name = { class: column.type === "text" ? "name" : null };
    return column.merged ? element("th", { scope: "rowgroup", rowspan: rows, class: "name" }, row[column.c])
      : element("td", name, ...cellContent(row[column.c], column));
  })));
  const grouped = visible.some(column => column.group);
  const node = element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `table ${block.name}` },
    element("table", {}, element("thead", {}, grouped ? groupHeads(visible) : null, element("tr", {}, ...heads)), element("tbody", {}, ...body)));
  const link = element("a", { download: `${block.name}.csv`, href: `data:text/csv;charset=utf-8,${encodeURIComponent(csvOf(block))}` }, `${block.name}.csv`);
  return [node, element("p", { class: "csv" }, link)];
}

// ---- Charts

const drawn = []; // again when the window has another width

function chartFigure(block) {
  const shownSeries = block.series.slice(0, chartSeries), left = block.series.length - shownSeries.length, styles = new Map();
  const series = shownSeries.map(({ label, style, points }) => {
    if (!styles.has(label)) styles.set(label, styles.size);
    const index = styles.get(label), theory = style === "theory", hollow = style === "hollow";
    return {
      label: hollow ? `${label}, printed` : label, points: points.map(p => p.map(v => v ?? NaN)), hollow,
      className: theory ? "theory" : `${hollow ? "hollow " : ""}s${index % colours}`,
      line: style === "line" || theory, marks: theory ? undefined : index,
    };
  });
  const place = element("div", { class: "plot" });
  drawn.push(() => chart(place, { title: block.title, x: block.x, y: block.y, series, legend: true, height: 380 }));
  const caption = left ? `${block.title}. ${left} more are not in this picture.` : block.title;
  return element("figure", { class: "chart-figure" }, place, element("figcaption", {}, caption));
}

// ---- Figures

function drawing({ width, height, alt, view, shapes }) {
  const [x0, y0, x1, y1] = view, margin = 6;
  const x = v => (margin + (width - 2 * margin) * (v - x0) / (x1 - x0)).toFixed(2);
  const y = v => (height - margin - (height - 2 * margin) * (v - y0) / (y1 - y0)).toFixed(2);
  return svg("svg", { class: "drawing", viewBox: `0 0 ${width} ${height}`, width, role: "img", "aria-label": alt },
    ...shapes.map(s => s.length === 2 ? svg("circle", { cx: x(s[0]), cy: y(s[1]), r: 1.8 })
      : svg("path", { d: `M${x(s[0])} ${y(s[1])}L${x(s[2])} ${y(s[3])}` })));
}

const image = ({ type, width, height, alt, data }) =>
  element("img", { width, height, alt, src: `data:${type};base64,${data}` });

function figure(block) {
  const images = block.images.map(i => i.type === "drawing" ? drawing(i) : image(i));
  return element("figure", { id: unique(block.id) }, images.length > 1 ? element("div", { class: "spaces" }, ...images) : images[0] ?? null,
    element("figcaption", {}, ...words(block.caption)));
}

// ---- Pictures

const srgb = v => Math.round(255 * (v <= 0.0031308 ? 12.92 * Math.max(v, 0) : Math.min(1, 1.055 * v ** (1 / 2.4) - 0.055)));

function decode({ name, channels, pixels }) {
  const bytes = Uint8Array.from(atob(pixels), c => c.charCodeAt(0)), view = new DataView(bytes.buffer);
  return { name, channels, pixels: Float32Array.from({ length: bytes.length / 4 }, (_, i) => view.getFloat32(4 * i, true)) };
}

const luminance = (p, i) => p.channels === 1 ? p.pixels[i]
  : 0.2126 * p.pixels[3 * i] + 0.7152 * p.pixels[3 * i + 1] + 0.0722 * p.pixels[3 * i + 2];
const channel = (p, i, c) => p.pixels[p.channels === 1 ? i : 3 * i + c];
const errorAt = (a, b, i) => errorGain * Math.abs(luminance(a, i) - luminance(b, i));

// value(i, x, c): of channel c of pixel i, which is in column x.
function paint(canvas, width, height, value) {
  const data = new ImageData(width, height);
  for (let i = 0; i < width * height; i++) {
    for (let c = 0; c < 3; c++) data.data[4 * i + c] = srgb(value(i, i % width, c));
    data.data[4 * i + 3] = 255;
  }
  Object.assign(canvas, { width, height });
  canvas.getContext("2d").putImageData(data, 0, 0);
}

function thumbnail({ scene, width, height }, picture, reference) {
  const scale = width <= 96 ? 2 : 1, size = { style: `width: ${width * scale}px`, role: "img" };
  const canvas = element("canvas", { ...size, "aria-label": `${scene}, ${picture.name}` });
  paint(canvas, width, height, (i, x, c) => channel(picture, i, c));
  if (picture === reference) return element("figure", {}, canvas, element("figcaption", {}, picture.name));
  const map = element("canvas", { ...size, "aria-label": `absolute error of ${scene}, ${picture.name}, ${errorGain} times as bright` });
  paint(map, width, height, i => errorAt(picture, reference, i));
  return element("figure", {}, canvas, map, element("figcaption", {}, picture.name));
}

// Two pictures flipped, split or subtracted, zoomed, with the values of a pixel.
function comparer({ scene, width, height }, pictures) {
  const menu = (text, items, index) => {
    const select = element("select", {}, ...items.map((name, i) => element("option", { value: i, selected: i === index }, name)));
    return { select, label: element("label", {}, text + " ", select) };
  };
  const names = pictures.map(p => p.name), modes = ["flip", "split", "error"], zooms = [1, 2, 4, 8, 16];
  const left = menu("left (A)", names, Math.min(1, pictures.length - 1)), right = menu("right (B)", names, 0);
  const mode = menu("mode", modes, 0), zoom = menu("zoom", zooms, width <= 160 ? 2 : 1);
  const swap = element("button", { type: "button" }, "flip (space)");
  const canvas = element("canvas", { tabindex: 0, role: "img", "aria-label": `comparer of ${scene}: space flips, s, f and e choose the mode, plus and minus zoom, arrows move the pixel` });
  const output = element("output", {}, "space flips, s f e: mode, + -: zoom, arrows or mouse: a pixel's values");
  let flipped = false, at = [width >> 1, height >> 1], edge = 0.5;
  const is = name => modes[mode.select.value] === name;
  const choose = name => { mode.select.value = modes.indexOf(name); };
  const draw = () => {
    const a = pictures[left.select.value], b = pictures[right.select.value], z = zooms[zoom.select.value];
    paint(canvas, width, height, (i, x, c) => is("error") ? errorAt(a, b, i)
      : channel((is("flip") ? flipped : x >= edge * width) ? b : a, i, c));
    canvas.style.width = `${width * z}px`;
    canvas.style.maxWidth = z > 1 ? "none" : "100%";
  };
  const show = () => {
    const i = at[1] * width + at[0], a = luminance(pictures[left.select.value], i), b = luminance(pictures[right.select.value], i);
    output.textContent = `(${at[0]}, ${at[1]}): A ${a.toPrecision(5)}, B ${b.toPrecision(5)}, A - B ${(a - b).toPrecision(3)}` +
      (is("flip") ? `; shown: ${flipped ? "B" : "A"}` : "");
  };
  const change = () => { draw(); show(); };
  const move = (x, y) => {
    at = [Math.min(width - 1, Math.max(0, x)), Math.min(height - 1, Math.max(0, y))];
    if (is("split")) edge = at[0] / width;
  };
  const flip = () => { flipped = !flipped; choose("flip"); change(); };
  for (const { select } of [left, right, mode, zoom]) select.addEventListener("change", change);
  swap.addEventListener("click", flip);
  canvas.addEventListener("mousemove", event => {
    const r = canvas.getBoundingClientRect();
    move(Math.floor((event.clientX - r.left) / r.width * width), Math.floor((event.clientY - r.top) / r.height * height));
    if (is("split")) draw();
    show();
  });
  canvas.addEventListener("keydown", event => {
    const moves = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    const letter = { f: "flip", s: "split", e: "error" }[event.key], larger = { "+": 1, "-": -1 }[event.key];
    if (moves) move(at[0] + moves[0], at[1] + moves[1]);
    else if (letter) choose(letter);
    else if (larger) zoom.select.selectedIndex = Math.min(zooms.length - 1, Math.max(0, zoom.select.selectedIndex + larger));
    else if (event.key !== " ") return;
    event.preventDefault();
    if (event.key === " ") flip();
    else change();
  });
  draw();
  const bar = element("div", { class: "bar" }, left.label, right.label, mode.label, zoom.label, swap);
  return element("div", { class: "comparer" }, bar, element("div", { class: "scroll" }, canvas), output);
}

function pictures(block) {
  const decoded = block.images.map(decode);
  return [element("div", { class: "figures" }, ...decoded.map(p => thumbnail(block, p, decoded[0]))), comparer(block, decoded)];
}

// ---- Blocks

function section(block, level) {
  const heading = element(`h${Math.min(level, 6)}`, { id: unique(block.id) }, ...words(block.heading));
  if (!block.collapsed) return [heading, ...blocks(block.content, level + 1)];
  return element("details", {}, element("summary", {}, plain(block.heading)), ...blocks(block.content, level));
}

const list = block => element(block.numbered ? "ol" : "ul", { id: unique(block.id), class: block.numbered ? "notes note" : null },
  ...block.items.map(item => element("li", {}, ...words(item))));

// Command lines, with a button that copies them all.
function commands({ lines }) {
  const text = lines.join("\n"), output = element("output"), button = element("button", { type: "button" }, "copy");
  button.addEventListener("click", () => navigator.clipboard.writeText(text).then(() => { output.textContent = " copied"; }, () => { output.textContent = " select the lines and copy them"; }));
  const summary = element("summary", {}, lines.length > 1 ? `${lines.length} commands that give these numbers` : "the command that gives these numbers");
  return element("details", { class: "commands" }, summary, element("pre", { tabindex: 0 }, text), element("p", {}, button, output));
}

const kinds = {
  section, table, list, figure, pictures, commands,
  paragraph: block => element("p", {}, ...words(block.text)),
  chart: chartFigure,
};

// Neighbouring figures, and charts, stand side by side where they fit.
function blocks(content, level) {
  const nodes = [];
  content.forEach((block, i) => {
    const flows = block.kind === "figure" || block.kind === "chart";
    const made = [kinds[block.kind](block, level)].flat();
    if (flows && content[i - 1]?.kind === block.kind) nodes.at(-1).append(...made);
    else if (flows) nodes.push(element("div", { class: "figures" }, ...made));
    else nodes.push(...made);
  });
  return nodes;
}

const report = JSON.parse(byId("data").textContent);
document.title = report.title;
byId("report").replaceChildren(element("h1", {}, report.title), report.about ? element("p", {}, report.about) : "", ...blocks(report.content, 2));
const redraw = () => drawn.forEach(draw => draw());
redraw();
let drawnFor = innerWidth;
addEventListener("resize", () => {
  if (innerWidth !== drawnFor) redraw();
  drawnFor = innerWidth;
});
if (location.hash) document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView();

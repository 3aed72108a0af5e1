// SPDX-License-Identifier: Apache-2.0
// Shows the data of a report (docs/report-format.md), which are in the page's element #data: first the answers and contents
// (overview.mjs), then sections, tables (tables.mjs), charts (charts.mjs), figures and pictures.
import { byId, element, svg } from "../../../../explorer/page/dom.mjs";
import { chartFigure, redraw } from "./charts.mjs";
import { addAnchors, overview } from "./overview.mjs";
import { plain, table, unique, words } from "./tables.mjs";

const errorGain = 8;

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

// Fills a canvas. value(i, x, c) returns channel c of pixel i, which is in column x.
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

// Compares two pictures: flips between them, splits or subtracts them, zooms, and shows the values of a pixel.
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
  const output = element("output", {}, matchMedia("(pointer: coarse)").matches ? "touch: a pixel's values" : "space flips, s f e: mode, + -: zoom, arrows or mouse: a pixel's values");
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
  const heading = element(`h${Math.min(level, 6)}`, { id: block.anchor }, ...words(block.heading));
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
  paragraph: block => element("p", { class: block.answer ?? (block.warning ? "warning" : null) }, ...words(block.text)),
  chart: chartFigure,
};

// Makes the nodes of blocks. Neighbouring figures, and neighbouring charts, are side by side if they fit.
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
addAnchors(report.content);
byId("report").replaceChildren(overview(report), element("div", { id: "evidence" }, ...blocks(report.content, 2)));
redraw();
let drawnFor = innerWidth;
addEventListener("resize", () => {
  if (innerWidth !== drawnFor) redraw();
  drawnFor = innerWidth;
});
// Opens all collapsed sections for printing, and draws charts about as wide as a sheet of A4, so that their letters keep their size.
const folded = [];
addEventListener("beforeprint", () => redraw(680));
addEventListener("afterprint", () => redraw());
addEventListener("beforeprint", () => document.querySelectorAll("#evidence details:not([open], .choice)").forEach(node => { folded.push(node); node.open = true; }));
addEventListener("afterprint", () => folded.splice(0).forEach(node => { node.open = false; }));
if (location.hash) document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView();

// SPDX-License-Identifier: Apache-2.0
// Charts of a report. A chart is as wide as the page and shows at most eight lines at once, which the reader chooses. If the data
// say which values are better, it first shows the eight lines that are best at the right end. A label names the point under the
// mouse, or the point chosen by arrow keys, with its values. Series of marks without lines, such as those of a scatter plot, are
// all shown. The lines that are shown have different colours and marks.
import { chart, shape } from "../../../../explorer/page/chart.mjs";
import { element, short, svg } from "../../../../explorer/page/dom.mjs";

const lines = 8, near = 40, widest = 1400; // as many lines as the palette has colours
const drawn = []; // the functions that draw the charts, called again when the width of the window changes

export function redraw(most = widest) {
  drawn.forEach(draw => draw(most));
}

// A key of the legend: a line that is as long as one period of every dash pattern, with the mark of the series.
const swatch = (className, mark, line) => svg("svg", { class: "swatch", width: 46, height: 12, "aria-hidden": "true" },
  svg("g", { class: `series ${className}` }, line ? svg("path", { class: "line", d: "M1 6h44" }) : null,
    mark === undefined ? null : svg("g", { class: "dots" }, shape(mark, 23, 6))));

// The label of a point: its series, values and axes.
function tell({ x, y }, { label, hollow }, [px, py, low, high]) {
  const range = low < high ? ` (${short(low)} to ${short(high)})` : "";
  return `${label}${hollow ? ", printed" : ""}: ${short(py, 5)}${range} at ${short(px, 6)}; ${y.title} against ${x.title}`;
}

// Marks and labels the point at the mouse, or the point chosen by arrow keys, among the points that chart() drew last.
function inspect(stage, tip, block, points) {
  let at = null;
  const mark = index => {
    at = index;
    const all = points(), point = all[index];
    stage.classList.toggle("hot", Boolean(point));
    all.forEach(p => p.group.classList.toggle("hot", p.group === point?.group));
    tip.textContent = point ? tell(block, point.series, point.values) : "";
    tip.hidden = !point;
  };
  stage.addEventListener("pointermove", event => {
    const picture = stage.querySelector("svg"), box = picture.getBoundingClientRect(), scale = picture.viewBox.baseVal.width / box.width;
    const x = (event.clientX - box.left) * scale, y = (event.clientY - box.top) * scale;
    const distances = points().map(p => Math.hypot(p.x - x, p.y - y)), least = Math.min(...distances);
    mark(least < near ? distances.indexOf(least) : null);
  });
  stage.addEventListener("pointerleave", () => mark(null));
  stage.addEventListener("blur", () => mark(null));
  stage.addEventListener("focus", () => { if (at === null && points().length) mark(0); });
  stage.addEventListener("keydown", event => {
    const all = points(), step = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (event.key === "Escape") mark(null);
    if (!step || !all.length) return;
    event.preventDefault();
    const now = all[at ?? 0], along = event.key === "ArrowLeft" || event.key === "ArrowRight";
    const groups = [...new Set(all.map(p => p.group))], group = along ? now.group : groups.at((groups.indexOf(now.group) + step) % groups.length);
    const mine = all.filter(p => p.group === group);
    const next = along ? mine[Math.min(mine.length - 1, Math.max(0, mine.indexOf(now) + step))]
      : mine.reduce((best, p) => Math.abs(p.x - now.x) < Math.abs(best.x - now.x) ? p : best);
    mark(all.indexOf(next));
  });
}

// The labels whose lines a chart begins with, in the order of the data.
function opening(block, named, labels) {
  const end = new Map(named.filter(s => s.style === "line").map(s => [s.label, s.points.at(-1)])), sign = block.y.better === "larger" ? -1 : 1;
  const best = !block.y.better ? labels : [...labels].sort((a, b) => end.get(b)[0] - end.get(a)[0] || sign * (end.get(a)[1] - end.get(b)[1]));
  return labels.filter(label => best.indexOf(label) < lines);
}

export function chartFigure(block) {
  const named = block.series.filter(s => s.style !== "theory" && s.points.length), labels = [...new Set(named.map(s => s.label))];
  const limited = named.some(s => s.style === "line"), looks = new Map(); // from a shown label to the number of its look
  const plot = element("div", { class: "plot" }), tip = element("output", { class: "tip", hidden: true }), legend = element("ul", { class: "legend" });
  const stage = element("div", { class: "stage", tabindex: 0, role: "group", "aria-label": `${block.title}: arrow keys name its points` }, plot, tip);
  const choice = element("div", { class: "boxes" }), count = element("summary", {}), boxes = new Map();
  // A look is a number that stands for a colour, a dash and a mark, as in koksma_plot_colours. The first series of a family of
  // patterns that is shown has the family's look, each other series the next look that is free, and keeps it while it is shown.
  const family = new Map(named.filter(s => s.style !== "hollow").map(s => [s.label, s.colour]));
  const take = label => {
    const taken = new Set(looks.values()), own = family.get(label) ?? 0;
    let i = 0;
    const number = () => (own + i) % lines + i - i % lines;
    while (taken.has(number())) i++;
    looks.set(label, number());
  };
  const first = limited ? opening(block, named, labels) : labels;
  const leads = first.filter((label, i) => first.findIndex(other => family.get(other) === family.get(label)) === i);
  [...leads, ...first.filter(label => !leads.includes(label))].forEach(take);
  const classOf = look => `c${look % lines} d${Math.floor(look / lines) % 4}`, markOf = look => look + Math.floor(look / lines);
  let points = [];
  const draw = (most = widest) => {
    const series = block.series.filter(s => s.style === "theory" || looks.has(s.label)).map(({ label, style, points: values }) => {
      const theory = style === "theory", hollow = style === "hollow", look = looks.get(label);
      return { label, hollow, points: values.map(p => p.map(v => v ?? NaN)), className: theory ? "theory" : `${hollow ? "hollow " : ""}${classOf(look)}`,
        line: style === "line" || theory, marks: theory ? undefined : markOf(look) };
    });
    points = chart(plot, { title: block.title, x: block.x, y: block.y, series, height: 400, most });
    legend.replaceChildren(...series.filter(s => !s.hollow).map(s => element("li", {}, swatch(s.className, s.marks, s.line), s.label)));
    count.textContent = `Choose lines: ${looks.size} of ${labels.length} are shown, ${lines} at most${block.y.better && labels.length > lines ? "; the best at the right end to begin with" : ""}`;
    boxes.forEach((box, label) => { box.disabled = !looks.has(label) && looks.size >= lines; });
  };
  for (const label of limited ? labels : []) {
    const box = element("input", { type: "checkbox", checked: looks.has(label) });
    box.addEventListener("change", () => {
      if (box.checked) take(label);
      else looks.delete(label);
      draw();
    });
    boxes.set(label, box);
    choice.append(element("label", {}, box, " ", label));
  }
  inspect(stage, tip, block, () => points);
  drawn.push(draw);
  return element("figure", { class: "chart-figure" }, element("figcaption", {}, block.title), stage, legend,
    labels.length > 1 && limited ? element("details", { class: "choice" }, count, choice) : null);
}

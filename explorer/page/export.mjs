// SPDX-License-Identifier: Apache-2.0
// What leaves the page: pictures, points, and the program's command lines that give the same.
import { sourceOf } from "./state.mjs";

const painted = ["fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-dasharray", "stroke-linecap",
  "font-family", "font-size", "opacity"];

// An SVG picture as it looks now, as a file of its own.
export function svgFile(node, title) {
  const copy = node.cloneNode(true), from = [node, ...node.querySelectorAll("*")], to = [copy, ...copy.querySelectorAll("*")];
  from.forEach((original, i) => {
    const style = getComputedStyle(original);
    if (i > 0) for (const name of painted) if (style.getPropertyValue(name)) to[i].setAttribute(name, style.getPropertyValue(name));
    to[i].removeAttribute("class");
    to[i].removeAttribute("tabindex");
  });
  const [x, y, width, height] = node.getAttribute("viewBox").split(" ");
  for (const name of [...copy.getAttributeNames()].filter(n => n.startsWith("aria") || n === "role")) copy.removeAttribute(name);
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", width);
  copy.setAttribute("height", height);
  const behind = document.createElementNS("http://www.w3.org/2000/svg", "rect");
  Object.entries({ x, y, width, height, fill: getComputedStyle(document.body).backgroundColor }).forEach(([k, v]) => behind.setAttribute(k, v));
  const name = document.createElementNS("http://www.w3.org/2000/svg", "title");
  name.textContent = title;
  copy.prepend(name, behind);
  return new XMLSerializer().serializeToString(copy) + "\n";
}

export function save(name, type, content) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

// For a POSIX shell.
const quote = word => /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
const command = (...words) => ["koksma", ...words].map(quote).join(" ");

// file: the name under which the points of a set with moved points are saved, by the reader or by the search. layout: the strata that are drawn, or null.
export function commands({ set, file, measures, witness, axes, layout, decay, sizes }) {
  const edited = set.edits.size > 0, source = edited ? file : `pattern:${sourceOf(set)}`;
  const patternSeed = set.seed === "0" ? [] : ["--seed", set.seed], seed = edited ? [] : patternSeed, lines = [];
  if (edited && set.search) lines.push(command("optimise", set.search.measure, "--from", sourceOf(set), ...patternSeed, "--steps", set.search.steps, "-o", file));
  if (!edited) lines.push(command("generate", set.spec, "-n", set.n, ...(set.dim === 2 ? [] : ["-d", set.dim]), ...seed, "-o", file));
  if (measures.length) lines.push(command("measure", source, ...seed, "-m", measures.join(",")));
  if (set.dim === 2 && axes[0] === 0 && axes[1] === 1) { // the program's are no other coordinates
    const drawn = layout?.rooks ? ["--rooks"] : layout ? ["--grid", `${layout.columns}x${layout.rows}`] : [];
    lines.push(command("plot", source, ...seed, ...drawn, ...(witness ? ["--witness", witness] : []), "-o", file.replace(".csv", ".svg")));
    lines.push(command("curve", "rings", source, ...seed));
  }
  if (sizes.length && decay.of === "prefixes") {
    lines.push(command("measure", source, ...seed, "-m", decay.spec, "--prefixes", sizes.join(",")));
  } else if (sizes.length) {
    // Fresh sets of the pattern, wherever the points of this one were moved.
    const { spec, dim } = set, fresh = sizes.map(n => `pattern:${sourceOf({ spec, n, dim })}`);
    lines.push(command("measure", ...fresh, ...patternSeed, "-m", decay.spec));
  }
  return lines;
}

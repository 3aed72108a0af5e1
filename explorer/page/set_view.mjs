// SPDX-License-Identifier: Apache-2.0
// One set on the page: its controls, its picture, what is known about its pattern, and what can be taken away.
import { element } from "./dom.mjs";
import { Plane } from "./plane.mjs";
import { Search } from "./search.mjs";
import { paramControls, parseSpec } from "./specs.mjs";
import { limits, parseSeed } from "./state.mjs";

const field = (label, id, input, ...more) => element("div", { class: "field" }, element("label", { for: id }, label), input, ...more);
const button = (text, title, click) => {
  const node = element("button", { type: "button", title }, text);
  node.onclick = click;
  return node;
};

export class SetView {
  // events: search: { start(measure), stop() }, changed(), moved(i, place), unmoved(), saveSvg(), saveCsv(), copy(text), removed() for a set that can go
  constructor(name, patterns, measures, references, events) {
    Object.assign(this, { name, patterns, references, events, docs: document.querySelector("meta[name=docs]").content, label: name.toUpperCase() });
    this.plane = new Plane(name, (i, place) => events.moved(i, place), () => this.showPoint());
    const id = part => `${name}-${part}`;
    this.pattern = element("select", { id: id("pattern") },
      ...patterns.map(p => element("option", { value: p.name }, p.name)));
    this.n = element("input", { id: id("n"), type: "number", min: 1, max: limits.n, step: 1, list: "sizes", required: true });
    this.dim = element("input", { id: id("dim"), type: "number", min: 1, max: limits.dim, step: 1, required: true });
    this.seed = element("input", { id: id("seed"), type: "text", inputmode: "numeric", pattern: "[0-9]{1,20}", required: true });
    this.next = button("Next", `Set ${this.label}: the next seed`, () => {
      this.seed.value = String((BigInt(this.set.seed) + 1n) % (1n << 64n));
      this.take();
    });
    this.params = element("div", { class: "params" });
    this.problem = element("p", { class: "problem", role: "alert" });
    this.sentence = element("p", { class: "note sentence" });
    Object.assign(this, { points: null, waiting: false });
    this.about = element("details", { class: "about" });
    this.search = new Search(name, this.label, measures, events.search);
    this.makePointFields(id);
    this.makeExports(id);
    for (const input of [this.pattern, this.n, this.dim, this.seed]) input.onchange = () => this.take();
    this.node = element("section", { class: `set set-${name}`, "aria-labelledby": id("title") },
      element("div", { class: "head" }, element("h2", { id: id("title") }, `Set ${this.label}`),
        events.removed ? button("Remove", `Remove set ${this.label}`, events.removed) : null),
      element("div", { class: "controls" }, field("Pattern", this.pattern.id, this.pattern), field("Points", this.n.id, this.n),
        field("Dimensions", this.dim.id, this.dim), field("Seed", this.seed.id, this.seed, this.next), this.params),
      this.problem, this.plane.node, this.plane.strataText, this.sentence, this.point, this.search.node, this.about, this.exports);
  }

  makePointFields(id) {
    const numbers = (part, title) => element("input", { id: id(part), type: "number", min: 0, max: 1, step: "any", title });
    this.index = element("input", { id: id("point"), type: "number", min: 1, step: 1, title: "Which point is chosen" });
    this.x = numbers("x", "Its place across");
    this.y = numbers("y", "Its place upwards");
    this.undo = button("Undo moves", `Set ${this.label}: all points back to their places`, () => this.events.unmoved());
    this.index.onchange = () => {
      const i = +this.index.value - 1, n = this.plane.points?.n || 0;
      this.plane.choose(Number.isInteger(i) && i >= 0 && i < n ? i : -1);
    };
    for (const input of [this.x, this.y]) {
      input.onchange = () => {
        if (this.plane.selected >= 0 && this.x.value && this.y.value && this.x.checkValidity() && this.y.checkValidity()) {
          this.events.moved(this.plane.selected, [+this.x.value, +this.y.value]);
        }
      };
    }
    this.lost = element("p", { class: "note lost", role: "status" });
    this.point = element("div", { class: "point", role: "group", "aria-label": `Set ${this.label}: the chosen point` },
      field("Point", this.index.id, this.index), field("x", this.x.id, this.x), field("y", this.y.id, this.y), this.undo, this.lost);
  }

  makeExports(id) {
    this.lines = element("pre", { id: id("commands"), tabindex: 0, "aria-label": `Set ${this.label}: the program's commands` });
    this.takeaways = [
      button("Save SVG", `Set ${this.label}: save the picture`, () => this.events.saveSvg()),
      button("Save CSV", `Set ${this.label}: save the points`, () => this.events.saveCsv()),
      button("Copy commands", `Set ${this.label}: copy the program's commands`, () => this.events.copy(this.lines.textContent))];
    this.linesTitle = element("h3", {});
    this.exports = element("div", { class: "exports" }, element("div", { class: "buttons" }, ...this.takeaways), this.linesTitle, this.lines);
  }

  // The points of the set that the controls show; null: there are none, or not yet, and those of the picture are another's.
  get current() {
    return this.waiting ? null : this.points;
  }

  // New points are on their way, or here.
  wait(waiting) {
    this.waiting = waiting;
    this.node.setAttribute("aria-busy", waiting);
    for (const node of this.takeaways) node.disabled = !this.current;
  }

  // The command lines; file: the file of points that has to be saved before, or "".
  showCommands(text, file) {
    this.linesTitle.textContent = `The same from the program${file ? `, where the points are saved as ${file}` : ""}`;
    this.lines.textContent = text;
  }

  // Whether the address has no room for the moved points.
  showLost(lost) {
    this.lost.textContent = lost ? "So many moved points are too long for the address of this page: it has the set without its moves. " +
      "Save CSV keeps them." : "";
  }

  get member() {
    return this.patterns.find(p => p.name === parseSpec(this.set.spec).name);
  }

  // The controls as the reader left them, into the set.
  take() {
    const seed = parseSeed(this.seed.value);
    this.seed.setCustomValidity(seed === null ? "a whole number below 2^64" : "");
    for (const input of [this.n, this.dim, this.seed]) {
      if (!input.checkValidity()) return void input.reportValidity();
    }
    const member = this.patterns.find(p => p.name === this.pattern.value), changed = member !== this.member;
    let dim = +this.dim.value;
    if (changed) dim = Math.min(Math.max(dim, member.min_dim), member.max_dim);
    Object.assign(this.set, { n: +this.n.value, dim, seed });
    if (changed) this.set.spec = member.name;
    this.change();
  }

  change() {
    this.set.edits.clear();
    this.set.search = null;
    this.plane.selected = -1;
    this.show(this.set);
    this.events.changed();
  }

  // The set into the controls.
  show(set) {
    this.set = set;
    this.pattern.value = parseSpec(set.spec).name;
    Object.assign(this.n, { value: set.n });
    Object.assign(this.dim, { value: set.dim });
    this.seed.value = set.seed;
    const member = this.member;
    this.params.replaceChildren();
    this.about.replaceChildren(element("summary", {}, "About this pattern"));
    if (!member) return;
    this.dim.min = member.min_dim;
    this.dim.max = Math.min(member.max_dim, limits.dim);
    paramControls(this.params, `${this.name}-param`, member, set.spec, spec => { set.spec = spec; this.change(); }, true);
    this.describe(member);
    this.showPoint();
  }

  describe(member) {
    const cites = member.cite.split(" ").filter(key => key !== "-");
    this.about.append(
      element("p", {}, `${member.title[0].toUpperCase()}${member.title.slice(1)}. Dimensions ${member.min_dim} to ${member.max_dim}.`),
      element("ul", { class: "claims", "aria-label": "What the pattern claims" },
        ...member.claims.map(([word, text]) => element("li", {}, element("b", {}, word), " ", text))),
      ...(member.params.length ? [element("ul", { "aria-label": "Parameters" },
        ...member.params.map(p => element("li", {}, element("b", {}, p.name), " ", p.help)))] : []),
      ...(cites.length ? [element("ul", { class: "cites", "aria-label": "Sources" },
        ...cites.map(key => element("li", {}, this.references[key] || key)))] : []),
      element("p", {}, element("a", { href: `${this.docs}patterns/${member.name}.html` }, `${member.name} in the documents`),
        ": its definition, spectrum, measured values and tested claims"));
  }

  fail(text) {
    this.problem.textContent = text;
  }

  showPoint() {
    const { points, selected, axes } = this.plane, none = !points || selected < 0;
    this.index.max = points?.n || 1;
    this.index.value = none ? "" : selected + 1;
    for (const [input, k] of [[this.x, 0], [this.y, 1]]) {
      const gone = none || (k === 1 && points.dim === 1);
      input.value = gone ? "" : points.xs[selected * points.dim + axes[k]];
      input.disabled = gone;
    }
    this.undo.disabled = !this.set?.edits.size || !this.current;
  }
}

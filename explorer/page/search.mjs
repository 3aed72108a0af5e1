// SPDX-License-Identifier: Apache-2.0
// The search for better points of one set: its controls, the value so far as a text and as a falling line. The library's
// koksma_optimise, or short steps of its simplest methods, several a second, run in a worker until the reader stops them;
// what they find are moved points of the set.
import { chart } from "./chart.mjs";
import { element, short } from "./dom.mjs";

export const search_s = 60; // a search ends after so long: what is found by then gets better slowly
const idle_steps = 40; // short steps without a gain, after which no more come

export class Search {
  // events: start(measure), stop()
  constructor(name, label, measures, events) {
    Object.assign(this, { name, events, running: false, gains: [], measures });
    const id = part => `${name}-search-${part}`;
    this.measure = element("select", { id: id("measure") });
    this.steps = element("select", { id: id("steps") }, element("option", { value: "short" }, "short, to watch"),
      element("option", { value: "long" }, "long, as koksma optimise"));
    this.button = element("button", { type: "button", id: id("button") }, "Optimise");
    this.button.onclick = () => this.running ? events.stop() : events.start(this.measure.value, this.steps.value === "short");
    this.text = element("p", { class: "note search-text" });
    this.status = element("p", { class: "note search-end", role: "status" });
    this.line = element("div", { class: "wide" });
    this.node = element("div", { class: "search", role: "group", "aria-label": `Set ${label}: search for better points` },
      element("div", { class: "fields" }, element("div", { class: "field" },
        element("label", { for: this.measure.id }, "Optimise the points for"), this.measure),
        element("div", { class: "field" }, element("label", { for: this.steps.id }, "Steps"), this.steps), this.button),
      this.text, this.line, this.status);
  }

  // The measures that a search can have in so many dimensions; the chosen one of the page first.
  serve(dim, chosen) {
    const served = this.measures.filter(m => m.exact && dim >= m.min_dim && dim <= m.max_dim).map(m => m.name);
    const wanted = [this.measure.value, chosen, "star"].find(name => served.includes(name));
    this.measure.replaceChildren(...served.map(name => element("option", { value: name }, name)));
    this.measure.value = wanted;
  }

  // why: no search is possible.
  enable(can, why = "") {
    this.button.disabled = !can;
    if (why) this.status.textContent = why;
  }

  begin(measure, brief) {
    Object.assign(this, { running: true, gains: [], spec: measure, brief, stuck: false, started: performance.now() });
    this.button.textContent = "Stop";
    this.measure.disabled = this.steps.disabled = true;
    this.status.textContent = this.text.textContent = "";
  }

  // A step of the search, or of the first set. True: it has found better points.
  step({ value, lower, steps, last_gain, method }) {
    this.stuck = this.brief && steps - last_gain >= idle_steps;
    const gain = !this.gains.length || this.gains[this.gains.length - 1][1] !== value;
    if (gain) this.gains.push([steps, value]);
    this.text.textContent = `${this.spec} ${short(this.gains[0][1])} → ${short(value)} in ${steps} ${steps === 1 ? "step" : "steps"} (method ${method})` +
      (lower === null ? "" : `; no points have less than ${short(lower)}`);
    chart(this.line, {
      title: `${this.spec} against the steps of the search`, height: 190,
      x: { title: "step" }, y: { title: this.spec }, series: [{ className: `set-${this.name}`, line: true, points: this.corners(steps) }],
    });
    return gain && steps > 0;
  }

  // A value stays until the step that has the next.
  corners(steps) {
    const corners = this.gains.flatMap(([at, value], i) => i ? [[at, this.gains[i - 1][1]], [at, value]] : [[at, value]]);
    return [...corners, [steps, this.gains[this.gains.length - 1][1]]];
  }

  get late() {
    return performance.now() - this.started > 1000 * search_s;
  }

  end(text) {
    this.running = false;
    this.button.textContent = "Optimise";
    this.measure.disabled = this.steps.disabled = false;
    this.status.textContent = text;
  }

  // Another set is shown.
  clear() {
    this.end("");
    this.text.textContent = "";
    this.line.replaceChildren();
  }
}

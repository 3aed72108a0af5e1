// SPDX-License-Identifier: Apache-2.0
// Koksma's inequality: errors of functions of known variation, beside V(f) D*.
import { byId, element, short } from "./dom.mjs";

// What a bound says: nothing where it is infinite, or above the largest error that there can be.
const boundText = f => f.bound === null ? "none" : f.bound > f.range ? `${short(f.bound, 3)}, says nothing` : short(f.bound, 3);

export class Inequality {
  constructor() {
    this.answers = {};
  }

  // answer: null for a set that is gone
  show(name, answer) {
    this.answers[name] = answer?.error ? null : answer;
    this.draw();
  }

  draw() {
    const sets = ["a", "b"].filter(name => this.answers[name]);
    const first = sets.map(name => this.answers[name].functions).sort((p, q) => q.length - p.length)[0] || [];
    byId("inequality-heads").replaceChildren(
      element("th", { scope: "col" }, "Function"), element("th", { scope: "col", class: "value" }, "V(f)"),
      ...sets.flatMap(name => ["error", "V(f) D*"].map(text =>
        element("th", { scope: "col", class: "value" }, sets.length > 1 ? `${name.toUpperCase()}: ${text}` : text))));
    byId("inequality").replaceChildren(...first.map((f, i) => element("tr", {},
      element("th", { scope: "row" }, f.title),
      element("td", { class: "value" }, f.variation === null ? "infinite" : short(f.variation, 3)),
      ...sets.flatMap(name => {
        const of = this.answers[name].functions[i];
        return of ? [element("td", { class: "value", title: String(of.error) }, short(of.error, 3)),
          element("td", { class: "value", title: String(of.bound) }, boundText(of))] : [element("td"), element("td")];
      }))));
  }
}

// SPDX-License-Identifier: Apache-2.0
// Estimates of an integral by independent sets of a pattern: each of them, their mean and median, and 95 % intervals.
import { chart } from "./chart.mjs";
import { byId, element, short } from "./dom.mjs";

// Where the mean and the median of set number `k` of the page stand, right of its estimates.
const beside = (count, k, row) => count + 2 + 2.4 * row + 0.8 * k;

export class Replicates {
  constructor() {
    this.answers = {};
  }

  // answer: { truth, values, estimates: [{ estimator, interval, value, low, high }, ..] }, or null for a set that is gone
  show(name, answer) {
    this.answers[name] = answer;
    this.draw();
  }

  draw() {
    const sets = ["a", "b"].filter(name => this.answers[name]), good = sets.filter(name => !this.answers[name].error);
    const label = name => sets.length > 1 ? `${name.toUpperCase()}: ` : "", series = [], rows = [];
    for (const [k, name] of good.entries()) {
      const { values, estimates, truth } = this.answers[name];
      series.push({ className: `set-${name}`, label: `${label(name)}sets`, marks: 0, hollow: false,
        points: values.map((value, i) => [i + 1 + 0.3 * k, value]) });
      estimates.forEach(({ estimator, interval, value, low, high }, row) => {
        series.push({ className: `set-${name}`, label: `${label(name)}${estimator}, ${interval}`, marks: 1 + 2 * row, hollow: false,
          points: [[beside(values.length, k, row), value, low, high]] });
        rows.push(element("tr", {}, element("th", { scope: "row" }, `${label(name)}${estimator}`),
          ...[value, low, high].map(x => element("td", { class: "value", title: String(x) }, short(x, 6))),
          element("td", { class: "value" }, short(value - truth, 2)), element("td", {}, low <= truth && truth <= high ? "yes" : "no")));
      });
    }
    chart(byId("replicates-chart"), {
      title: "Estimates of the integral by independent sets, their mean and median with 95 % intervals, and the integral as a line",
      x: { title: "set; right of them mean and median" }, y: { title: "estimate" }, series, legend: true, level: good.length ? this.answers[good[0]].truth : undefined,
    });
    byId("replicates").replaceChildren(...rows);
    byId("replicates-why").textContent = sets.filter(name => this.answers[name].error).map(name => label(name) + this.answers[name].error).join(" ");
  }
}

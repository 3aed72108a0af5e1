// SPDX-License-Identifier: Apache-2.0
// The table of measures: values of the sets side by side, which witness is drawn, parameters.
import { element, short } from "./dom.mjs";
import { paramControls } from "./specs.mjs";
import { witnessText } from "./plane.mjs";

// Rough work of each measure, least first: what is asked for first when all are wanted at once.
const slow = ["t-value", "edge-sampled", "extreme", "edge", "l2-edge", "l2-disk", "disk-sampled", "star-lower", "disk"];

// What is shown unless all is: a box, the mean over boxes, slanted edges, distances.
const first = ["star", "l2-star", "edge", "min-distance"];
const computing = "…";

export class Measures {
  // chosen(name): the witness to draw; changed(name, spec): a measure has other parameters now.
  constructor(body, members, chosen, changed) {
    Object.assign(this, { rows: new Map(), digits: 4 });
    for (const member of members) {
      const row = { member, answers: {}, cells: {}, waits: {} };
      const id = `witness-${member.name}`;
      row.radio = element("input", { type: "radio", name: "witness", id, value: member.name });
      row.radio.onchange = () => chosen(member.name);
      row.name = element("label", { for: id, title: member.title }, member.name);
      row.what = element("p", { class: "note" }, member.title);
      row.cells = { a: element("td", { class: "value" }), b: element("td", { class: "value other" }), ratio: element("td", { class: "value other" }) };
      row.params = element("div", { class: "params" });
      const more = member.params.length
        ? element("details", {}, element("summary", { "aria-label": `Parameters of ${member.name}` }, "parameters"), row.params) : null;
      row.head = element("th", { scope: "row" },
        element("div", {}, element("div", { class: "name" }, row.radio, row.name), row.what, more));
      row.node = element("tr", { "data-measure": member.name }, row.head, row.cells.a, row.cells.b, row.cells.ratio);
      row.setSpec = spec => paramControls(row.params, `measure-${member.name}`, member, spec, s => { row.setSpec(s); changed(member.name, s); });
      row.setSpec(member.name);
      this.rows.set(member.name, row);
      body.append(row.node);
    }
  }

  // Small ranks are asked for first.
  rank(name, wanted) {
    return name === wanted ? 1 : 10 + slow.indexOf(name);
  }

  // Whether a measure can take sets of so many dimensions at all.
  serves(name, dim) {
    const { min_dim, max_dim } = this.rows.get(name).member;
    return dim >= min_dim && dim <= max_dim;
  }

  // Which rows and digits are shown: the rows that are, by name.
  choose({ all, chosen, digits }) {
    this.digits = digits;
    for (const [name, row] of this.rows) {
      row.node.hidden = !(all || first.includes(name) || name === chosen);
      if (row.node.hidden) row.answers = {}; // a value of points that may be gone
      for (const which of ["a", "b"]) this.draw(row, which);
    }
    return [...this.rows.keys()].filter(name => !this.rows.get(name).node.hidden);
  }

  // The value is being computed: what is known is of other points.
  wait(name, which) {
    const row = this.rows.get(name);
    row.answers[which] = null;
    row.waits[which] = true;
    this.draw(row, which);
  }

  clear(which) {
    for (const name of this.rows.keys()) this.show(name, which, null);
  }

  // answer: null for nothing to say.
  show(name, which, answer) {
    const row = this.rows.get(name);
    row.answers[which] = answer;
    row.waits[which] = false;
    this.draw(row, which);
  }

  // A value as it is shown: four digits, or all that the program prints.
  text(name, which) {
    const row = this.rows.get(name), answer = row?.answers[which];
    if (!answer) return row?.waits[which] ? computing : "";
    return answer.error ? "–" : this.digits < 9 && Number.isFinite(answer.value) ? short(answer.value, this.digits) : answer.value_text;
  }

  draw(row, which) {
    const cell = row.cells[which], answer = row.answers[which];
    cell.classList.toggle("waiting", Boolean(row.waits[which]));
    cell.title = answer && !answer.error ? String(answer.value) : "";
    if (answer?.error) cell.replaceChildren(element("span", { class: "why" }, answer.error));
    else cell.textContent = this.text(row.member.name, which);
    const a = row.answers.a?.value, b = row.answers.b?.value;
    row.cells.ratio.textContent = Number.isFinite(a) && Number.isFinite(b) && a !== 0 ? short(b / a) : "";
    const both = Object.values(row.answers).filter(Boolean);
    row.radio.disabled = both.length > 0 && both.every(x => !x.witness) && !row.radio.checked;
    row.node.classList.toggle("off", both.length > 0 && both.every(x => x.error));
  }

  witness(name, which) {
    return this.rows.get(name)?.answers[which]?.witness || null;
  }

  // A sentence about the witness that is drawn.
  sentence(name, which, n) {
    const answer = this.rows.get(name)?.answers[which];
    if (!answer || answer.error) return answer ? "" : `${name} = ${this.text(name, which)}`;
    const value = `${name} = ${this.text(name, which)}`;
    return answer.witness ? `${value}: ${witnessText(answer.witness, n)}` : `${value} has no single region as its witness.`;
  }

  values(which) {
    return [...this.rows.values()].filter(row => row.answers[which] && !row.answers[which].error)
      .map(row => ({ measure: row.answers[which].measure, value: row.answers[which].value }));
  }
}

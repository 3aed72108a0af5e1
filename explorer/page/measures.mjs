// SPDX-License-Identifier: Apache-2.0
// The table of measures: values of the sets side by side, which witness is drawn, parameters.
import { element, short } from "./dom.mjs";
import { paramControls } from "./specs.mjs";
import { witnessText } from "./plane.mjs";

// Rough work of each measure, least first: what is asked for first when all are wanted at once.
const slow = ["t-value", "edge-sampled", "extreme", "edge", "l2-edge", "l2-disk", "disk-sampled", "star-lower", "disk"];

export class Measures {
  // chosen(name): the witness to draw; changed(name, spec): a measure has other parameters now.
  constructor(body, members, chosen, changed) {
    this.rows = new Map();
    for (const member of members) {
      const row = { member, answers: {}, cells: {} };
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

  wait(which) {
    for (const row of this.rows.values()) row.cells[which].classList.add("waiting");
  }

  // The set is another one: what its witnesses were means nothing any more.
  forget(which) {
    for (const row of this.rows.values()) row.answers[which] = null;
  }

  clear(which) {
    for (const name of this.rows.keys()) this.show(name, which, null);
  }

  // answer: null for nothing to say.
  show(name, which, answer) {
    const row = this.rows.get(name), cell = row.cells[which];
    row.answers[which] = answer;
    cell.classList.remove("waiting");
    cell.title = answer && !answer.error ? String(answer.value) : "";
    if (answer?.error) cell.replaceChildren(element("span", { class: "why" }, answer.error));
    else cell.textContent = answer ? answer.value_text : "";
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
    if (!answer || answer.error) return "";
    return answer.witness ? `${name} = ${answer.value_text}: ${witnessText(answer.witness, n)}` : `${name} = ${answer.value_text} has no single region as its witness.`;
  }

  values(which) {
    return [...this.rows.values()].filter(row => row.answers[which] && !row.answers[which].error)
      .map(row => ({ measure: row.answers[which].measure, text: row.answers[which].value_text }));
  }
}

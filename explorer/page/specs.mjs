// SPDX-License-Identifier: Apache-2.0
// The members of the tables: specs and the controls for their parameters, claims in words, sources.
import { element } from "./dom.mjs";

// In the order of the bits of KOKSMA_CLAIM_..: the program's word, and what it means.
export const claims = [
  ["deterministic", "The seed does not matter, unless the points are scrambled or shifted."],
  ["sequence", "The first k of n points are the set of k points."],
  ["any-n", "Any number of points."],
  ["stratified", "One point in each cell of a grid."],
  ["latin", "One point in each of n strata of each coordinate."],
  ["unbiased", "A mean over seeds has no bias: each set is uniform in the mean."],
  ["exchangeable", "The order of the points is random already."],
  ["min-distance", "No two points are closer than d."],
  ["centred", "Each point in the middle half of its cell."],
  ["grid", "n = m²: one point in each of the m × m cells, in any order."],
  ["net2", "n = 2ᵐ: a (0,m,2)-net, one point in each elementary interval in base 2."],
  ["net2-prefixes", "The first 2ᵐ points are a (0,m,2)-net in base 2, for every m."],
  ["net-prefixes", "The first bᵐ points are a (0,m,d)-net in the smallest prime base b ≥ d."],
  ["oa2", "n = s²: each projection on two coordinates has one point in each of s × s cells."],
  ["oa3", "n = s³ with strength 3: each projection on three coordinates likewise."],
  ["fraction", "On the torus no two points are closer than f times the densest packing's distance."],
  ["maximal", "No point can be added without coming closer than the smallest distance."],
  ["lattice", "The differences of the points are a group on the torus."],
  ["blue", "From 4 points, of a sequence 64: the smallest distance is above half of the densest packing's."],
  ["latin-prefixes", "The first bᵐ points are Latin in coordinate k, b being the k-th prime."],
  ["independent", "The points are random and independent of each other."],
];

export const claimsOf = pattern => claims.filter((claim, bit) => pattern.claims >>> bit & 1);

// Whether the first k points are a set of the pattern, for all k: of sequences, and of independent points without cells.
export function prefixesAreSets(pattern) {
  const words = claimsOf(pattern).map(([word]) => word), has = word => words.includes(word);
  return has("sequence") || (has("independent") && !has("stratified"));
}

// "name:key=value,.." as { name, values: { key: text } }.
export function parseSpec(spec) {
  const at = spec.indexOf(":"), name = at < 0 ? spec : spec.slice(0, at), values = {};
  for (const item of at < 0 ? [] : spec.slice(at + 1).split(",")) {
    const [key, value] = item.split("=");
    if (key && value !== undefined) values[key] = value;
  }
  return { name, values };
}

export function formatSpec(name, values) {
  const items = Object.entries(values).map(([key, value]) => `${key}=${value}`);
  return items.length ? `${name}:${items.join(",")}` : name;
}

// Controls for the parameters of a member: labelled inputs in `parent`, whose changes call changed(spec).
export function paramControls(parent, id, member, spec, changed, shift) {
  const { values } = parseSpec(spec);
  const params = [...member.params];
  if (shift) params.push({ name: "shift", help: "1: shifted on the torus by one random vector", fallback: 0, min: 0, max: 1, whole: true });
  parent.replaceChildren(...params.map(param => {
    const fallback = param.choices ? param.choices[param.fallback] : String(param.fallback);
    const value = values[param.name] ?? fallback, inputId = `${id}-${param.name}`;
    const change = text => {
      if (text === fallback || text === "") delete values[param.name];
      else values[param.name] = text;
      changed(formatSpec(member.name, values));
    };
    const label = element("label", { for: inputId, title: param.help }, param.name);
    if (param.choices) {
      const select = element("select", { id: inputId, title: param.help },
        ...param.choices.map(choice => element("option", { value: choice, selected: choice === value }, choice)));
      select.onchange = () => change(select.value);
      return element("div", { class: "field" }, label, select);
    }
    if (param.whole && param.min === 0 && param.max === 1) {
      const box = element("input", { id: inputId, type: "checkbox", title: param.help, checked: +value === 1 });
      box.onchange = () => change(box.checked ? "1" : "0");
      return element("div", { class: "field tick" }, box, label);
    }
    const input = element("input", {
      id: inputId, type: "number", value, min: param.min, max: param.max, step: param.whole ? 1 : "any", title: param.help,
    });
    input.onchange = () => {
      if (input.checkValidity()) change(input.value === "" ? fallback : String(+input.value));
      else input.reportValidity();
    };
    return element("div", { class: "field" }, label, input);
  }));
}

// SPDX-License-Identifier: Apache-2.0
// The members of the tables: specs, and the controls for their parameters.
import { element } from "./dom.mjs";

// Whether the first k points are a set of the pattern, for all k: of sequences, and of independent points without cells.
export function prefixesAreSets(pattern) {
  const has = word => pattern.claims.some(([claim]) => claim === word);
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

// SPDX-License-Identifier: Apache-2.0
// Elements of the page and of SVG pictures.

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === null || value === undefined) continue;
    if (name === "checked" || name === "selected" || name === "disabled" || name === "value") node[name] = value;
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.filter(child => child !== null && child !== undefined));
  return node;
}

export const element = (name, attributes = {}, ...children) => fill(document.createElement(name), attributes, children);

export const svg = (name, attributes = {}, ...children) =>
  fill(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);

export const byId = id => document.getElementById(id);

// A number for reading, not a result: n digits at most.
export const short = (x, digits = 4) => Number.isFinite(x) ? String(+x.toPrecision(digits)) : "–";

// SPDX-License-Identifier: Apache-2.0
// What the page shows, and its text after the # of the address, so that a view can be kept and shared.

export const limits = { n: 16384, dim: 8, spectrum_n: 16384, rooks_n: 512, answer_s: 20, moves_text: 15000 };

export const strataKinds = ["none", "grid", "rooks", "elementary"];

export const newSet = (spec = "n-rooks") => ({ spec, n: 16, dim: 2, seed: "0", edits: new Map(), search: null }); // search: that gave the edits

export const newState = () => ({
  a: newSet(), b: null,
  strata: { kind: "grid", columns: 0, rows: 0, base: 2, split: 1 }, // 0: as many as go with the points
  witness: "star", axes: [0, 1],
  measures: {}, // { name: spec } where its parameters are not the defaults
  shifted: true, // whether each pixel of the pictures has the points shifted at random
  all: { measures: false, digits: false }, // what is shown of the table
  decay: { measure: "l2-star", of: "sets" },
  integrand: "exp", // of the estimates by independent sets
});

// A set as the program writes it, SPEC@N@DIM, with @DIM left out for 2.
export const sourceOf = set => `${set.spec}@${set.n}${set.dim === 2 ? "" : "@" + set.dim}`;

function parseSource(text) {
  const match = /^(.+?)@(\d{1,9})(?:@(\d{1,4}))?$/.exec(text);
  return match && { ...newSet(match[1]), n: clamp(+match[2], 1, limits.n), dim: clamp(+(match[3] || 2), 1, limits.dim) };
}

export const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

// Whole, without sign, below 2^64; else null.
export function parseSeed(text) {
  return /^\d{1,20}$/.test(text) && BigInt(text) < 1n << 64n ? String(BigInt(text)) : null;
}

const editsText = edits => [...edits].map(([i, xs]) => `${i}:${xs.join(",")}`).join(";");

function parseEdits(text, set) {
  for (const item of text.split(";")) {
    const match = /^(\d+):([\d.,e-]+)$/.exec(item), xs = match ? match[2].split(",").map(Number) : [];
    if (match && +match[1] < set.n && xs.length === set.dim && xs.every(x => x >= 0 && x <= 1)) set.edits.set(+match[1], xs);
  }
}

// Of two sets they are an address of 32 kB at most, which browsers show and copy whole; a move in the plane is some 20 letters.
export const movesFit = set => editsText(set.edits).length <= limits.moves_text;

export function toHash(state) {
  const query = new URLSearchParams();
  for (const name of ["a", "b"]) {
    const set = state[name];
    if (!set) continue;
    query.set(name, sourceOf(set));
    query.set(`${name}.seed`, set.seed);
    if (set.edits.size > 0 && movesFit(set)) query.set(`${name}.moved`, editsText(set.edits));
  }
  const s = state.strata;
  query.set("strata", { grid: `grid:${s.columns}x${s.rows}`, elementary: `elementary:${s.base},${s.split}` }[s.kind] || s.kind);
  query.set("witness", state.witness || "none");
  if (String(state.axes) !== "0,1") query.set("axes", state.axes.join(","));
  query.set("decay", `${state.decay.measure}:${state.decay.of}`);
  if (state.integrand !== "exp") query.set("integrand", state.integrand);
  if (!state.shifted) query.set("pixels", "equal");
  const all = Object.keys(state.all).filter(what => state.all[what]);
  if (all.length) query.set("all", all.join(","));
  const changed = Object.values(state.measures);
  if (changed.length) query.set("measures", changed.join("|"));
  return String(query).replace(/%(3A|3B|40|2C|3D|7C)/g, decodeURIComponent);
}

// The state of a hash; what it lacks or has wrong is as in a new one.
// What a page without an address of its own opens with: the two sets of README's picture.
const opening = "a=random@16&a.seed=3&b=sobol:scramble%3Dowen@16&strata=none&witness=star";

export function fromHash(text) {
  const query = new URLSearchParams(text.replace(/^#/, "") || opening), state = newState();
  for (const name of ["a", "b"]) {
    const set = parseSource(query.get(name) || "");
    if (!set) continue;
    set.seed = parseSeed(query.get(`${name}.seed`) || "") || "0";
    parseEdits(query.get(`${name}.moved`) || "", set);
    state[name] = set;
  }
  const strata = /^(\w+)(?::(\d+)[x,](\d+))?$/.exec(query.get("strata") || "");
  if (strata && strataKinds.includes(strata[1])) {
    state.strata.kind = strata[1];
    const [first, second] = [clamp(+(strata[2] || 0), 0, limits.n), clamp(+(strata[3] || 0), 0, limits.n)];
    if (strata[1] === "grid") Object.assign(state.strata, { columns: first, rows: second });
    if (strata[1] === "elementary") Object.assign(state.strata, { base: clamp(first, 2, 7), split: second });
  }
  const witness = query.get("witness");
  if (witness) state.witness = witness === "none" ? "" : witness;
  const axes = (query.get("axes") || "0,1").split(",").map(Number);
  if (axes.length === 2 && axes.every(k => Number.isInteger(k) && k >= 0 && k < limits.dim)) state.axes = axes;
  const decay = /^([a-z0-9-]+):(sets|prefixes)$/.exec(query.get("decay") || "");
  if (decay) state.decay = { measure: decay[1], of: decay[2] };
  state.integrand = query.get("integrand") || state.integrand;
  state.shifted = query.get("pixels") !== "equal";
  for (const what of (query.get("all") || "").split(",")) if (what in state.all) state.all[what] = true;
  for (const spec of (query.get("measures") || "").split("|").filter(Boolean)) state.measures[spec.split(":")[0]] = spec;
  return state;
}

// SPDX-License-Identifier: Apache-2.0
// A measure against the number of points: sets of each size, or prefixes of the set that is shown.
import { chart } from "./chart.mjs";
import { byId, element, short } from "./dom.mjs";

// Sizes that some pattern is at home in: powers of two, squares (of primes, too), Fibonacci numbers, cubes.
const sizeFamilies = [
  [...Array(11).keys()].map(m => 2 << m),
  [2, 3, 4, 5, 7, 8, 11, 13, 17, 19, 23, 29, 32, 37, 43].map(s => s * s),
  [5, 8, 13, 21, 34, 55, 89, 144, 233, 377, 610, 987, 1597],
  [2, 3, 4, 5, 7, 8, 9, 11, 12].map(s => s ** 3),
];
const largest = 2048; // of the sizes

// The first k points for powers of two and all n.
function prefixSizes(n) {
  return [...sizeFamilies[0].filter(k => k < Math.min(n, largest)), Math.min(n, largest)];
}

// sets: [{ name, label, samples: [[n, value], ..], line }]
function decayChart(place, measure, sets) {
  const series = [];
  for (const set of sets) {
    const sorted = [...set.samples].sort((p, q) => p[0] - q[0]);
    series.push({ className: `set-${set.name}`, points: sorted, line: true, marks: 0 });
    const slope = set.line?.theory ?? set.line?.best, first = sorted.find(p => p[1] > 0);
    if (slope !== null && slope !== undefined && first && sorted.length > 1) {
      const end = sorted[sorted.length - 1][0];
      series.push({ className: `guide set-${set.name}`, guide: true, line: true, points: [first, [end, first[1] * (end / first[0]) ** slope]] });
    }
  }
  chart(place, {
    title: `${measure} against the number of points, logarithmic axes: ${sets.map(s => s.label).join("; ")}`,
    x: { title: "number of points", log: true }, y: { title: measure, log: true }, series,
  });
}

// "slope −0.98 ± 0.02; theory −1, .."
function lineText(label, line) {
  if (!line || line.slope === null) return `${label}: fewer than three values, no slope`;
  const exponents = [];
  if (line.theory !== null) exponents.push(`theory has ${short(line.theory)} for the pattern`);
  if (line.best !== null) exponents.push(`the best that any points can have is ${short(line.best)}`);
  return `${label}: slope ${short(line.slope)} (± ${short(line.slope_error, 2)})` +
    (exponents.length ? `; powers of logarithms left out, ${exponents.join(", ")}` : "");
}

// Who asks for the values, and keeps them: one chart for the sets that are shown.
export class Decay {
  // state(), points(name): what is shown now; spec(measure): with its parameters; isSequence(spec): whether the first
  // points are a set of the pattern; changed(): sizes are others now
  constructor(jobs, rank, state, points, spec, isSequence, changed) {
    Object.assign(this, { jobs, rank, state, points, spec, isSequence, changed, sets: {} });
  }

  sizes(name) {
    return (this.sets[name]?.samples || []).map(sample => sample[0]).sort((a, b) => a - b);
  }

  forget(name) {
    this.jobs.drop(`${name}/decay`);
    delete this.sets[name];
    this.draw();
  }

  askAll() {
    for (const name of ["a", "b"]) if (this.state()[name] && this.points(name)) this.ask(name);
  }

  ask(name) {
    const state = this.state(), { spec, n, dim, seed } = state[name], measure = this.spec(state.decay.measure);
    const prefixes = state.decay.of === "prefixes";
    this.jobs.drop(`${name}/decay`);
    const set = this.sets[name] = { name, samples: [], line: null, waiting: 0, why: "" };
    set.label = `${spec}${prefixes ? `, first points of ${n}` : ""}`;
    if (prefixes && state[name].edits.size === 0 && !this.isSequence(spec)) {
      set.why = "The pattern is no sequence, so its first points are no set of the pattern: choose sets of each size.";
      this.draw();
      return;
    }
    const family = k => {
      const sizes = prefixes ? prefixSizes(n) : sizeFamilies[k].filter(size => size <= largest);
      set.waiting = sizes.length;
      sizes.forEach((size, i) => {
        const request = prefixes ? { kind: "prefix", points: this.points(name), n: size, measure }
          : { kind: "sample", spec, n: size, dim, seed: BigInt(seed), measure };
        this.jobs.ask(`${name}/decay/${k}/${size}`, this.rank + i / 100, request, answer => {
          if (this.sets[name] !== set) return;
          if (answer.error) set.why = answer.error;
          else if (!set.samples.some(sample => sample[0] === size)) set.samples.push([size, answer.value]);
          if (--set.waiting === 0) {
            if (set.samples.length < 4 && !prefixes && k + 1 < sizeFamilies.length) family(k + 1);
            else this.finish(set, measure, spec, dim);
          }
          this.draw();
        });
      });
    };
    family(0);
  }

  finish(set, measure, pattern, dim) {
    this.changed();
    if (set.samples.length === 0) return;
    const request = { kind: "line", pairs: [...set.samples].sort((p, q) => p[0] - q[0]), measure, pattern, dim };
    this.jobs.ask(`${set.name}/decay/line`, this.rank, request, line => {
      if (this.sets[set.name] !== set || line.error) return;
      set.line = line;
      this.draw();
    });
  }

  draw() {
    const sets = ["a", "b"].map(name => this.sets[name]).filter(Boolean), { measure } = this.state().decay;
    decayChart(byId("decay-chart"), this.spec(measure), sets);
    byId("decay-text").replaceChildren(...sets.map(set => {
      const label = `${set.name.toUpperCase()}, ${set.label}`;
      const text = set.waiting ? `${label}: ${set.samples.length} values so far` : set.samples.length
        ? lineText(label, set.line) : `${label}: no values. ${set.why}`;
      return element("p", { class: `note set-${set.name}` }, text);
    }));
  }
}

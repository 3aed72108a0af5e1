// SPDX-License-Identifier: Apache-2.0
// numbers.mjs PROGRAM WASM: what the explorer's module gives beside what the program prints. Points are equal to the last bit,
// errors to the last letter, values to the last digit that the program shows.
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { execFileSync } from "node:child_process";
import { openKoksma } from "../../explorer/page/module.mjs";

const [program, wasm] = process.argv.slice(2);
const koksma = await openKoksma(new WebAssembly.Module(fs.readFileSync(wasm)));
const problems = [], folder = fs.mkdtempSync(path.join(os.tmpdir(), "koksma-numbers-"));
let compared = 0;
const check = (good, text) => { compared++; if (!good) problems.push(text); };

function run(...words) {
  try {
    return { out: execFileSync(program, words.map(String), { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"], maxBuffer: 1 << 26 }) };
  } catch (error) {
    return { error: error.stderr.trim() };
  }
}
const attempt = call => { try { return call(); } catch (error) { return { error: error.message }; } };
const nine = value => value === null ? "-" : String(+value.toPrecision(9)).replace(/e-(\d)$/, "e-0$1"); // C's %.9g
const jsonLines = text => text.trim().split("\n").map(line => JSON.parse(line));

// The tables: every member, and the words for claims.
const tables = koksma.tables();
const listed = kind => jsonLines(run("list", kind, "--json").out);
check(tables.patterns.map(p => p.name).join() === listed("patterns").map(p => p.pattern).join(), "patterns");
check(tables.measures.map(m => m.name).join() === listed("measures").map(m => m.measure).join(), "measures");
listed("patterns").forEach((row, i) => {
  const words = tables.patterns[i].claims.map(([word]) => word).join(",") || "-";
  check(words === row.claims, `${row.pattern} claims ${row.claims}, not ${words}`);
});

// Points: every pattern, with each of its choices.
const specs = tables.patterns.filter(p => !p.takes_path && !p.alias_of).flatMap(p => [p.name,
  ...p.params.flatMap(q => q.choices ? q.choices.slice(1).map(choice => `${p.name}:${q.name}=${choice}`) : [])]);
specs.push("random:shift=1", "gaussian-jittered:sigma=2", "poisson-disk:d=0.06,torus=1", "sobol:scramble=hash-owen,shuffle=1", "mask-offset:width=4");
for (const spec of specs) {
  for (const [n, dim, seed] of [[16, 2, 7n], [64, 3, 0n], [100, 2, 12345678901234567890n], [55, 2, 1n]]) {
    const theirs = run("generate", spec, "-n", n, "-d", dim, "--seed", seed, "-q"), what = `${spec} n=${n} dim=${dim} seed=${seed}`;
    const ours = attempt(() => koksma.generate({ spec, n, dim, seed }));
    if (theirs.error || ours.error) {
      check(ours.error && theirs.error?.endsWith(ours.error), `${what}: "${ours.error}", not "${theirs.error}"`);
      continue;
    }
    const xs = theirs.out.split("\n").filter(line => line && line[0] !== "#").flatMap(line => line.split(" ").map(Number));
    check(xs.length === n * dim && xs.every((x, i) => Object.is(x, ours.points.xs[i])), `${what}: other points`);
  }
}

// Measures with their witnesses, and spectra.
for (const [spec, n, dim, seed] of [["random", 16, 2, 3n], ["sobol", 64, 2, 0n], ["n-rooks", 100, 2, 5n], ["fibonacci", 55, 2, 0n],
  ["regular", 16, 2, 0n], ["random", 1, 2, 0n], ["jittered", 27, 3, 2n], ["halton", 20, 4, 0n], ["random", 30, 1, 8n]]) {
  const { points } = koksma.generate({ spec, n, dim, seed }), source = `pattern:${spec}@${n}@${dim}`, args = [source, "--seed", seed];
  const records = jsonLines(run("measure", ...args, "-m", "all", "--json").out);
  const served = new Set(records.map(r => r.measure));
  for (const measure of tables.measures) {
    if (!served.has(measure.name)) check(attempt(() => koksma.measure({ points, measure: measure.name })).error, `${source} ${measure.name} is served`);
  }
  for (const record of records) {
    const ours = koksma.measure({ points, measure: record.measure });
    check(ours.value_text === nine(record.value), `${source} ${record.measure}: ${ours.value_text}, not ${nine(record.value)}`);
    check(Math.abs(ours.value - record.value) <= 1e-13 * Math.abs(record.value), `${source} ${record.measure}: ${ours.value}, not ${record.value}`);
    check(JSON.stringify(ours.witness) === JSON.stringify(record.witness), `${source} ${record.measure}: another witness`);
  }
  if (dim !== 2 || n < 2) continue;
  const { rings } = koksma.spectrum({ points, half: Math.ceil(2 * Math.sqrt(n)), axes: [0, 1] });
  for (const [i, { value }] of jsonLines(run("curve", "rings", ...args, "--json").out).entries()) {
    check(Math.abs(rings[i].power - value) <= 1e-8 * (1 + rings[i].power), `${source} ring ${i}: ${rings[i].power}, not ${value}`);
  }
}
const rescaled = koksma.measure({ points: koksma.generate({ spec: "random", n: 40, dim: 2, seed: 1n }).points, measure: "disk:r=0.1" });
check(rescaled.value_text === nine(jsonLines(run("measure", "pattern:random@40", "--seed", 1, "-m", "disk:r=0.1", "--json").out)[0].value), "disk:r=0.1");
check(attempt(() => koksma.measure({ points: { xs: [0.5, 2], n: 1, dim: 2 }, measure: "star" })).error, "a point outside of the square");
check(attempt(() => koksma.generate({ spec: "x".repeat(600), n: 4, dim: 2, seed: 0n })).error, "a spec of 600 letters");

// Koksma's inequality: errors from the functions' definitions, bounds from the measure, of the axes that are asked for.
const definitions = {
  "x": [x => x, 1 / 2, 1], "exp(x + y)": [(x, y) => Math.exp(x + y), (Math.E - 1) ** 2, (Math.E - 1) * (3 * Math.E - 1)],
  "1 in the box [0, .6) x [0, .7)": [(x, y) => +(x < 0.6 && y < 0.7), 0.42, 1],
  "a checkerboard of 8 x 8 squares": [(x, y) => (Math.floor(8 * x) + Math.floor(8 * y)) % 2, 1 / 2, 112],
  "1 in the disk of radius .4": [(x, y) => +((x - 0.5) ** 2 + (y - 0.5) ** 2 < 0.16), 0.16 * Math.PI, null],
};
for (const [spec, n, dim, axes] of [["random", 64, 2, [0, 1]], ["halton", 50, 3, [2, 0]], ["random", 30, 1, [0, 0]]]) {
  const { points } = koksma.generate({ spec, n, dim, seed: 4n }), { functions } = koksma.inequality({ points, axes });
  const at = (i, k) => points.xs[i * dim + axes[k]], of = Math.min(dim, 2);
  check(functions.length === (dim === 1 ? 5 : 17), `${spec}: ${functions.length} functions`);
  for (const f of functions.filter(g => definitions[g.title])) {
    const [value, integral, variation] = definitions[f.title], over = f.dim === 1 ? 1 : of;
    const xs = Float64Array.from({ length: n * over }, (_, i) => at(Math.floor(i / over), i % over));
    const star = koksma.measure({ points: { xs, n, dim: over }, measure: "star" }).value;
    let sum = 0;
    for (let i = 0; i < n; i++) sum += value(at(i, 0), at(i, 1));
    check(Math.abs(f.error - Math.abs(sum / n - integral)) < 1e-14, `${spec}, ${f.title}: error ${f.error}`);
    check(variation === null ? f.variation === null && f.bound === null : Math.abs(f.bound - variation * star) < 1e-12 && f.error <= f.bound,
      `${spec}, ${f.title}: bound ${f.bound}`);
  }
}

// Estimates by independent sets: the program's.
for (const [integrand, spec, n, dim] of [["exp", "sobol:scramble=lms", 64, 2], ["disk", "n-rooks", 30, 3]]) {
  const { truth, values, estimates } = koksma.replicates({ integrand, spec, n, dim, seed: 5n });
  check(values.length === 15 && values.every(Number.isFinite), `${integrand}: ${values}`);
  for (const { estimator, interval, value, low, high } of estimates) {
    const [said] = jsonLines(run("integrate", integrand, "-p", spec, "-n", n, "-d", dim, "--seed", 5, "--estimator", estimator, "--json").out);
    check(said.interval === interval && [[value, said.estimate], [low, said.low], [high, said.high], [truth, said.integral]]
      .every(([ours, theirs]) => Math.abs(ours - theirs) < 1e-13), `${integrand}, ${estimator}: ${[value, low, high]}, not ${JSON.stringify(said)}`);
  }
}
check(koksma.replicates({ integrand: "exp", spec: "hammersley", n: 8, dim: 2, seed: 0n }).error?.includes("one set"), "an interval of one set");

// Searches: the program's steps, with its values and points.
for (const [measure, n, dim, steps] of [["star", 16, 2, 2], ["l2-star", 24, 3, 2], ["edge", 12, 2, 4], ["min-distance", 32, 2, 30], ["diaphony", 16, 1, 2]]) {
  const { points } = koksma.generate({ spec: "n-rooks", n, dim, seed: 7n }), seen = [], file = path.join(folder, "best.csv");
  koksma.optimise({ points, measure, steps, seed: 7n }, step => { seen.push(step); return true; });
  const { out } = run("optimise", measure, "--from", `n-rooks@${n}@${dim}`, "--seed", 7, "--steps", steps, "-o", file, "--json", "-q");
  const theirs = JSON.parse(out), best = seen[seen.length - 1], what = `optimise ${measure} ${n} ${dim}`;
  const xs = fs.readFileSync(file, "utf8").trim().split("\n").slice(1).flatMap(line => line.split(",").map(Number));
  check(seen.map(step => step.steps).join() === Array.from({ length: steps + 1 }, (_, i) => i).join(), `${what}: steps ${seen.map(step => step.steps)}`);
  check(nine(best.value) === nine(theirs.value) && best.last_gain === theirs.last_gain && best.method === theirs.method && best.lower === theirs.lower,
    `${what}: ${best.value} ${best.last_gain} ${best.method} ${best.lower}, not ${out}`);
  check(xs.every((x, i) => Math.abs(x - best.points.xs[i]) < 1e-9), `${what}: other points`);
  check(koksma.measure({ points: best.points, measure }).value === best.value, `${what}: the points have another value`);
}
// Short steps: each is better than the one before or the same, in every family of measures; the points have the value.
for (const [measure, n, dim] of [["star", 64, 2], ["l2-star", 64, 2], ["l2-star", 24, 3], ["edge", 12, 2], ["min-distance", 32, 2], ["t-value", 16, 2]]) {
  const { points } = koksma.generate({ spec: "random", n, dim, seed: 7n }), seen = [], sign = measure === "min-distance" ? -1 : 1;
  koksma.optimise({ points, measure, steps: 6, seed: 7n, brief: true }, step => { seen.push(step); return true; });
  check(seen.length === 7 && seen.every((step, i) => i === 0 || sign * step.value <= sign * seen[i - 1].value), `short steps of ${measure}: ${seen.map(step => step.value)}`);
  check(measure === "t-value" || sign * seen[6].value < sign * seen[0].value, `short steps of ${measure} gain nothing`);
  check(koksma.measure({ points: seen[6].points, measure }).value === seen[6].value, `short steps of ${measure}: the points have another value`);
}
let calls = 0;
koksma.optimise({ points: koksma.generate({ spec: "random", n: 8, dim: 2, seed: 1n }).points, measure: "min-distance", seed: 1n }, () => ++calls < 4);
check(calls === 4, `a search without end went on for ${calls} steps`);
check(attempt(() => koksma.optimise({ points: { xs: [0.5, 0.5], n: 1, dim: 2 }, measure: "edge-sampled", seed: 0n }, () => true)).error?.includes("exact"), "a search for an estimate");

fs.rmSync(folder, { recursive: true });
problems.forEach(text => console.log(text));
console.log(`numbers: ${compared} compared, ${problems.length} problems`);
process.exit(problems.length || compared < 300 ? 1 : 0);

// SPDX-License-Identifier: Apache-2.0
// The page: its state, who is asked for what when it changes, and where the answers go.
import { byId, element } from "./dom.mjs";
import { Decay } from "./decay.mjs";
import { commands, save, svgFile } from "./export.mjs";
import { Inequality } from "./inequality.mjs";
import { Jobs } from "./jobs.mjs";
import { Measures } from "./measures.mjs";
import { Pictures } from "./pictures.mjs";
import { Replicates } from "./replicates.mjs";
import { sizeFor } from "./scenes.mjs";
import { search_s } from "./search.mjs";
import { SetView } from "./set_view.mjs";
import { parseSpec, prefixesAreSets } from "./specs.mjs";
import { halfOf, halfOfQuality, radialChart, Spectrum } from "./spectrum.mjs";
import { fromHash, limits, movesFit, newSet, sourceOf, toHash } from "./state.mjs";
import { exponent, strataOf } from "./strata.mjs";
import { Tour } from "./tour.mjs";

const ranks = { points: 0, search: 1.5, picture: 2, spectrum: 12, inequality: 22, replicates: 23, quality: 25, decay: 30 };
const names = ["a", "b"];
const inequality = new Inequality(), replicates = new Replicates();
let state = fromHash(location.hash), tables, jobs, measures, decay, pictures, tour, shown = [], hashTimer = 0;
const views = {}, spectra = {}, frames = new Set();

const shownNames = () => names.filter(name => state[name]);
const axesOf = set => set.dim === 1 ? [0, 0] : state.axes.map(k => Math.min(k, set.dim - 1));
const titleOf = name => {
  const set = state[name], moved = set.edits.size ? `, ${set.edits.size} moved` : "";
  return `${sourceOf(set)} seed ${set.seed}${moved}`;
};
const fileOf = name => `koksma-${name}.csv`;

// Draws once a frame, however often it is asked for.
function soon(what) {
  if (frames.has(what)) return;
  frames.add(what);
  requestAnimationFrame(() => {
    frames.delete(what);
    what();
  });
}

// ---- What is shown

function drawSets() {
  for (const name of shownNames()) {
    const set = state[name], view = views[name];
    const witness = measures.witness(state.witness, name);
    view.plane.draw({
      points: view.points, axes: axesOf(set), strata: state.strata, witness,
      title: `Set ${view.label}: ${titleOf(name)}${witness ? `, with the witness of ${state.witness}` : ""}`,
    });
    view.sentence.textContent = view.points && state.witness ? measures.sentence(state.witness, name, view.points.n) : "";
    view.showPoint();
    if (!view.waiting) view.showCommands(commandLines(name), view.points && set.edits.size && !set.search ? fileOf(name) : "");
  }
  showChosen();
}

// The chosen measure beside the points, where the table is far from them.
function showChosen() {
  byId("chosen").value = state.witness;
  byId("chosen-values").replaceChildren(...(state.witness ? shownNames() : []).map(name =>
    element("output", { class: `set-${name}` }, (state.b ? `${name.toUpperCase()} ` : "") + measures.text(state.witness, name))));
  tour.showValues();
}

// Another choice of rows, digits, or of the measure whose witness is drawn.
function chooseRows() {
  const before = shown;
  shown = measures.choose({ all: state.all.measures, chosen: state.witness, digits: state.all.digits ? 9 : 4 });
  for (const name of shownNames()) {
    if (!views[name].current) continue;
    for (const measure of measures.rows.keys()) {
      if (!shown.includes(measure)) jobs.drop(`${name}/measure/${measure}/`);
      else if (!before.includes(measure)) measureOne(name, measure, true);
    }
  }
  byId("all-measures").checked = state.all.measures;
  byId("all-digits").checked = state.all.digits;
  for (const row of measures.rows.values()) row.radio.checked = row.member.name === state.witness;
  byId("witness-none").checked = !state.witness;
  soon(drawSets);
  keepHash();
}

function drawSpectra() {
  radialChart(byId("radial"), shownNames().map(name => spectra[name]));
}

function commandLines(name) {
  const set = state[name], view = views[name];
  if (!view.points) return "";
  const asked = measures.values(name).map(answer => answer.measure);
  return commands({
    set, file: fileOf(name), measures: asked, witness: measures.witness(state.witness, name) ? measures.spec(state.witness) : "",
    axes: axesOf(set), layout: strataOf(state.strata, set.n, limits),
    decay: { spec: measures.spec(state.decay.measure), of: state.decay.of }, sizes: decay.sizes(name),
  }).join("\n");
}

function showStrataControls() {
  const { kind, columns, rows, base, split } = state.strata;
  byId("strata").value = kind;
  for (const node of document.querySelectorAll("[data-strata]")) node.hidden = node.dataset.strata !== kind;
  Object.assign(byId("columns"), { value: columns || "" });
  Object.assign(byId("rows"), { value: rows || "" });
  byId("base").value = base;
  const most = Math.max(...shownNames().map(name => exponent(state[name].n, base)));
  byId("split").max = most;
  byId("split").value = Math.min(split, most);
  byId("split-text").textContent = `Split: ${base ** Math.min(split, most)} columns`;
}

function showAxes() {
  const dims = Math.max(...shownNames().map(name => state[name].dim));
  byId("axes").hidden = dims < 3;
  ["across", "upwards"].forEach((id, k) => {
    byId(id).replaceChildren(...Array.from({ length: dims }, (_, i) => element("option", { value: i }, String(i))));
    byId(id).value = Math.min(state.axes[k], dims - 1);
  });
}

function keepHash() {
  clearTimeout(hashTimer);
  hashTimer = setTimeout(() => {
    history.replaceState(null, "", "#" + toHash(state));
    for (const name of shownNames()) views[name].showLost(!movesFit(state[name]));
  }, 150);
}

// ---- What is asked for

// fresh: the set is another one, and not the same with a point moved: nothing known stays until the answers come.
function measureAll(name, fresh = false) {
  const set = state[name], points = views[name].points;
  for (const measure of shown) measureOne(name, measure, fresh);
  const late = () => inequality.show(name, null);
  if (fresh) late();
  jobs.ask(`${name}/inequality`, ranks.inequality, { kind: "inequality", points, axes: axesOf(set) },
    answer => inequality.show(name, answer), { late });
  drawPictures(name, fresh);
  const reason = Spectrum.reason(set);
  if (reason) {
    jobs.drop(`${name}/spectrum`);
    spectra[name].say(reason);
    soon(drawSpectra);
    return;
  }
  const wait = () => { spectra[name].wait(titleOf(name)); soon(drawSpectra); };
  if (fresh) wait();
  const ask = (key, rank, half, done) =>
    jobs.ask(`${name}/spectrum/${key}`, rank, { kind: "spectrum", points, half, axes: axesOf(set) }, done, { late: key === "power" ? wait : null });
  ask("power", ranks.spectrum, halfOf(set.n), answer => {
    spectra[name].show(titleOf(name), answer);
    soon(drawSpectra);
    ask("quality", ranks.quality, halfOfQuality(set.n), rest => spectra[name].showQuality(rest));
  });
}

// The pictures of a set; both sets have them in one size.
function drawPictures(name, fresh) {
  const set = state[name];
  jobs.drop(set.dim < 2 ? `${name}/picture` : "none");
  if (set.dim < 2 || !views[name].points) return;
  const size = sizeFor(Math.max(...shownNames().map(other => state[other].n)));
  pictures.names.forEach((scene, i) => {
    const late = () => pictures.show(scene, name, null);
    if (fresh) late();
    jobs.ask(`${name}/picture/${scene}`, ranks.picture + i / 10,
      { kind: "picture", scene, size, points: views[name].points, axes: axesOf(set), shifted: state.shifted },
      answer => pictures.show(scene, name, answer), { late });
  });
}

function choosePictures() {
  const names = shownNames().filter(name => state[name].dim > 1);
  byId("picture-shift").checked = state.shifted;
  pictures.choose(names, names.length ? "" : "Pictures take two coordinates.");
}

// The integral from sets of the pattern; points that were moved have no part in it.
function integrate(name) {
  const { spec, n, dim, seed } = state[name];
  jobs.drop(dim < 2 ? `${name}/replicates` : "none");
  if (dim < 2) {
    replicates.show(name, { error: "The functions take two coordinates." });
    return;
  }
  jobs.ask(`${name}/replicates`, ranks.replicates, { kind: "replicates", integrand: state.integrand, spec, n, dim, seed: BigInt(seed) },
    answer => replicates.show(name, answer));
}

function measureOne(name, measure, fresh = false) {
  const key = `${name}/measure/${measure}/`, { min_dim, max_dim } = measures.rows.get(measure).member;
  if (!measures.serves(measure, state[name].dim)) {
    jobs.drop(key);
    measures.show(measure, name, { error: min_dim === max_dim ? `takes ${min_dim} dimensions` : `takes ${min_dim} to ${max_dim} dimensions` });
    return;
  }
  const request = { kind: "measure", points: views[name].points, measure: measures.spec(measure) };
  const late = () => { measures.wait(measure, name); soon(drawSets); };
  if (fresh) late();
  jobs.ask(key, measures.rank(measure, state.witness), request, answer => {
    measures.show(measure, name, answer);
    soon(drawSets);
  }, { late });
}

// A set has another pattern, number, seed: everything anew.
function refresh(name) {
  const { spec, n, dim, seed } = state[name], view = views[name];
  jobs.drop(`${name}/`);
  view.search.clear();
  view.search.serve(dim, state.witness);
  view.search.enable(false);
  view.wait(true);
  for (const measure of shown) measures.wait(measure, name);
  for (const scene of pictures.names) pictures.show(scene, name, null);
  inequality.show(name, null);
  replicates.show(name, null);
  spectra[name].wait(titleOf(name));
  choosePictures();
  jobs.ask(`${name}/points`, ranks.points, { kind: "generate", spec, n, dim, seed: BigInt(seed) }, answer => {
    view.fail(answer.error || "");
    view.points = answer.points || null;
    view.original = answer.points ? answer.points.xs.slice() : null;
    view.wait(false);
    if (answer.error) {
      measures.clear(name);
      spectra[name].say("");
      decay.forget(name);
      soon(drawSpectra);
    } else {
      for (const [i, xs] of state[name].edits) view.points.xs.set(xs, i * dim);
      measureAll(name, true);
      decay.ask(name);
      integrate(name);
      view.search.enable(!jobs.inPage, jobs.inPage ? "A search needs workers, which this browser gives the page none of." : "");
      const other = name === "a" ? "b" : "a"; // its pictures may have another size now
      if (state[other] && views[other].current) drawPictures(other, false);
    }
    soon(drawSets);
  });
  showColours();
  soon(drawSets);
  showStrataControls();
  showAxes();
  keepHash();
}

// A pattern has the colour of its family, as in all plots. Beside a set A of the same colour, set B has the next of the palette.
function showColours() {
  const { palette } = tables, colourOf = ({ spec }) => Math.max(0, palette.findIndex(({ patterns }) => patterns.includes(parseSpec(spec).name)));
  const a = colourOf(state.a), b = state.b ? colourOf(state.b) : a;
  for (const [name, number] of [["a", a], ["b", b === a ? (b + 1) % palette.length : b]]) {
    document.body.style.setProperty(`--${name}`, `light-dark(${palette[number].light}, ${palette[number].dark})`);
  }
}

function moved(name, i, place) {
  if (!views[name].current) return; // the picture shows a set that is about to go
  stopSearch(name);
  const set = state[name], { points } = views[name], at = i * points.dim;
  axesOf(set).slice(0, Math.min(points.dim, 2)).forEach((axis, k) => { points.xs[at + axis] = place[k]; });
  set.edits.set(i, [...points.xs.subarray(at, at + points.dim)]);
  set.search = null;
  soon(drawSets);
  soon(views[name].remeasure);
  keepHash();
}

function unmoved(name) {
  stopSearch(name);
  views[name].search.clear();
  state[name].edits.clear();
  state[name].search = null;
  views[name].points.xs.set(views[name].original);
  views[name].remeasure();
  soon(drawSets);
  keepHash();
}

// ---- The search for better points, of one set at a time: the other workers are for what is shown

function startSearch(name, measure, brief) {
  const view = views[name], set = state[name], spec = measures.spec(measure), seed = BigInt(set.seed);
  if (!view.current) return;
  names.forEach(stopSearch);
  const reproducible = !brief && set.edits.size === 0; // a command can start where this search starts
  view.search.begin(spec, brief);
  const progress = step => {
    if (view.search.step(step)) {
      const { xs, dim } = step.points;
      set.search = reproducible ? { measure: spec, steps: step.last_gain } : null;
      view.points.xs.set(xs);
      for (let i = 0; i < set.n; i++) {
        const place = xs.slice(i * dim, (i + 1) * dim);
        if (place.some((x, k) => x !== view.original[i * dim + k])) set.edits.set(i, [...place]);
        else set.edits.delete(i);
      }
      soon(drawSets);
      soon(view.remeasure);
    }
    if (step.value === step.lower) stopSearch(name, "No points are better.");
    else if (view.search.stuck) stopSearch(name, "Short steps help no more; long ones may.");
    else if (view.search.late) stopSearch(name, `Ended after ${search_s} seconds. Optimise goes on from here.`);
  };
  jobs.ask(`${name}/search`, ranks.search, { kind: "optimise", points: view.points, measure: spec, seed, brief },
    answer => view.search.end(answer.error), { limited: false, progress });
}

function stopSearch(name, why = "Stopped. Optimise goes on from here.") {
  if (!views[name]?.search.running) return;
  jobs.drop(`${name}/search`);
  views[name].search.end(why);
  keepHash();
}

// ---- Wiring

function openSet(name) {
  const view = views[name] = new SetView(name, tables.patterns.filter(p => !p.takes_path && !p.alias_of), tables.measures, tables.references, {
    changed: () => refresh(name),
    moved: (i, place) => moved(name, i, place),
    unmoved: () => unmoved(name),
    search: { start: (measure, brief) => startSearch(name, measure, brief), stop: () => stopSearch(name) },
    saveSvg: () => save(fileOf(name).replace("csv", "svg"), "image/svg+xml", svgFile(view.plane.node, titleOf(name))),
    saveCsv: () => jobs.ask(`${name}/csv`, 0, { kind: "csv", points: view.points }, answer => {
      if (answer.error) tell(answer.error);
      else save(fileOf(name), "text/csv", answer.csv);
    }),
    copy: text => navigator.clipboard.writeText(text).then(() => tell("Copied."), () => tell("The browser does not let this page copy; the commands can be selected.")),
    removed: name === "b" ? () => setOther(null) : null,
  });
  view.remeasure = () => {
    if (!view.points || !state[name]) return;
    measureAll(name);
    if (state.decay.of === "prefixes") decay.ask(name);
  };
  spectra[name] = new Spectrum(name, view.label);
  byId("sets").append(view.node);
  byId("spectra").append(spectra[name].node);
}

function tell(text) {
  byId("told").textContent = text;
}

function setOther(set) {
  state.b = set;
  showAll();
}

// The whole state, after the address or the number of sets changed.
function showAll() {
  document.body.classList.toggle("single", !state.b);
  byId("compare").hidden = !!state.b;
  for (const name of names) {
    views[name].node.hidden = spectra[name].node.hidden = !state[name];
    if (state[name]) {
      views[name].show(state[name]);
      refresh(name);
    } else {
      jobs.drop(`${name}/`);
      views[name].points = null;
      measures.clear(name);
      inequality.show(name, null);
      replicates.show(name, null);
      spectra[name].say("");
      decay.forget(name);
    }
  }
  choosePictures();
  chooseRows();
  byId("integrand").value = state.integrand;
  byId("decay-measure").value = state.decay.measure;
  byId("decay-of").value = state.decay.of;
  soon(drawSpectra);
  keepHash();
}

function wire() {
  byId("compare").onclick = () => {
    setOther({ ...newSet(state.a.spec === "sobol" ? "jittered" : "sobol"), n: state.a.n });
    views.b.pattern.focus();
  };
  byId("strata").onchange = event => { state.strata.kind = event.target.value; shownStrata(); };
  const whole = (id, key) => {
    byId(id).onchange = byId(id).oninput = event => {
      if (!event.target.checkValidity()) return void event.target.reportValidity();
      state.strata[key] = +event.target.value;
      shownStrata();
    };
  };
  const shownStrata = () => { showStrataControls(); soon(drawSets); keepHash(); };
  whole("columns", "columns");
  whole("rows", "rows");
  whole("base", "base");
  whole("split", "split");
  ["across", "upwards"].forEach((id, k) => {
    byId(id).onchange = event => {
      state.axes[k] = +event.target.value;
      for (const name of shownNames()) views[name].remeasure();
      soon(drawSets);
      keepHash();
    };
  });
  const choose = name => { state.witness = name; chooseRows(); };
  byId("witness-none").onchange = () => choose("");
  byId("chosen").onchange = event => choose(event.target.value);
  for (const what of ["measures", "digits"]) {
    byId(`all-${what}`).onchange = event => { state.all[what] = event.target.checked; chooseRows(); };
  }
  byId("picture-shift").onchange = event => {
    state.shifted = event.target.checked;
    for (const name of shownNames()) drawPictures(name, true);
    keepHash();
  };
  byId("integrand").onchange = event => {
    state.integrand = event.target.value;
    for (const name of shownNames()) if (views[name].points) integrate(name);
    keepHash();
  };
  byId("decay-measure").onchange = event => { state.decay.measure = event.target.value; decay.askAll(); keepHash(); };
  byId("decay-of").onchange = event => { state.decay.of = event.target.value; decay.askAll(); keepHash(); };
  addEventListener("resize", () => { soon(drawSpectra); decay.draw(); replicates.draw(); });
  addEventListener("hashchange", event => {
    const { hash } = new URL(event.newURL); // keepHash may have put an older one into the address since
    if (hash.slice(1) !== toHash(state)) go(hash);
  });
}

function go(hash) {
  state = fromHash(hash);
  takeMeasures();
  showAll();
}

// The parameters of measures that the address has; those of names that are unknown are left out.
function takeMeasures() {
  for (const name of Object.keys(state.measures)) if (!measures.rows.has(name)) delete state.measures[name];
  if (state.witness && !measures.rows.has(state.witness)) state.witness = "star";
  if (!tables.integrands.some(f => f.name === state.integrand)) state.integrand = "exp";
  if (!measures.rows.has(state.decay.measure)) state.decay.measure = "l2-star";
  for (const [name, row] of measures.rows) row.setSpec(state.measures[name] || name);
}

async function start() {
  const text = atob(byId("wasm").textContent.trim()), bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i); // Uint8Array.from takes half a second for this
  jobs = new Jobs(await WebAssembly.compile(bytes), byId("worker").textContent, limits.answer_s);
  byId("in-page").hidden = !jobs.inPage;
  tables = await new Promise(done => jobs.ask("tables", 0, { kind: "tables" }, done, { limited: false }));
  if (tables.error) throw new Error(tables.error);
  tables.references = JSON.parse(byId("references").textContent);
  tables.palette = JSON.parse(byId("palette").textContent);
  measures = new Measures(byId("measures"), tables.measures, name => {
    state.witness = name;
    chooseRows();
  }, (name, spec) => {
    if (spec === name) delete state.measures[name];
    else state.measures[name] = spec;
    for (const which of shownNames()) if (views[which].points && shown.includes(name)) measureOne(which, name, true);
    if (name === state.decay.measure) decay.askAll();
    keepHash();
  });
  measures.spec = name => state.measures[name] || name;
  const isSequence = spec => {
    const pattern = tables.patterns.find(p => p.name === parseSpec(spec).name);
    return !pattern || prefixesAreSets(pattern); // an unknown one has an error of its own
  };
  decay = new Decay(jobs, ranks.decay, () => state, name => views[name].points, measures.spec, isSequence, () => soon(drawSets));
  names.forEach(openSet);
  pictures = new Pictures();
  tour = new Tour(go, (measure, name) => state[name] ? measures.text(measure, name) : "");
  const options = () => tables.measures.map(m => element("option", { value: m.name }, m.name));
  byId("decay-measure").replaceChildren(...options());
  byId("integrand").replaceChildren(...tables.integrands.map(f => element("option", { value: f.name }, f.title)));
  byId("chosen").replaceChildren(element("option", { value: "" }, "no witness"), ...options());
  byId("version").textContent = tables.version;
  takeMeasures();
  wire();
  showAll();
  document.body.classList.remove("starting");
}

// The tests wait for this, and ask it for values in full.
globalThis.koksmaExplorer = {
  busy: () => !jobs || jobs.busy || frames.size > 0, hash: () => toHash(state), limit: seconds => jobs.setLimit(seconds),
  values: name => measures.values(name), pictures: () => pictures.results(),
};

start().catch(error => {
  document.body.classList.remove("starting");
  tell(`The explorer could not start: ${error.message}`);
});

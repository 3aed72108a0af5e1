// SPDX-License-Identifier: Apache-2.0
// page.cjs PROGRAM PAGE [SCREENSHOTS]: the explorer in headless Chromium, every control used, every number beside the program's.
// Exit code 77: skipped.
"use strict";
const definitions = require("./definitions.cjs");
const fs = require("fs");
const path = require("path");
const {
  accessibility, check, choose, chromium, commandLines, commandsAgree, compare, folder, idle, jsonLines, open,
  playwright, records, refusal, report, rounded, run, saved, screenshots, set, shell, unfold, until, values, visit,
} = require("./harness.cjs");

// A script that is not the page's does not run: the policy would say so on the console, too.
async function policy(browser) {
  const page = await open(browser);
  page.removeAllListeners("console");
  check(!(await page.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "globalThis.plantedRan = true";
    document.body.append(script);
    return Boolean(globalThis.plantedRan);
  })), "a planted script ran: the Content-Security-Policy does nothing");
  await page.close();
}

async function controls(page) {
  check((await page.locator("#a-pattern").inputValue()) === "n-rooks", "the pattern at the start");
  await compare(page, "a", "pattern:n-rooks@16");
  await choose(page, "#a-pattern", "poisson-disk");
  await set(page, "#a-n", 20);
  await set(page, "#a-param-d", 0.12);
  await page.locator("#a-param-torus").check();
  await set(page, "#a-seed", "12345678901234567890");
  await compare(page, "a", "pattern:poisson-disk:d=0.12,torus=1@20", "--seed", "12345678901234567890");
  check((await page.locator(".set-a .cites").textContent()).includes("Stochastic Sampling"), "the source is not cited");
  check((await page.locator(".set-a .claims").textContent()).includes("min-distance"), "the claims are not shown");
  check((await page.locator(".set-a .about a").getAttribute("href")) === "../docs/patterns/poisson-disk.html", "the pattern does not lead to its document");
  await page.locator(".set-a button", { hasText: "Next" }).click();
  await idle(page);
  check((await page.locator("#a-seed").inputValue()) === "12345678901234567891", "the next seed");
  await choose(page, "#a-pattern", "sobol");
  await set(page, "#a-n", 64);
  await choose(page, "#a-param-scramble", "owen");
  await page.locator("#a-param-shift").check();
  await set(page, "#a-seed", 3);
  await compare(page, "a", "pattern:sobol:scramble=owen,shift=1@64", "--seed", 3);
  // What the library refuses is said in its words, and nothing of another set stays.
  await choose(page, "#a-pattern", "jittered");
  await set(page, "#a-n", 17);
  const words = refusal("generate", "jittered", "-n", 17), said = await page.locator(".set-a .problem").textContent();
  check(said && words.endsWith(said), `17 jittered points: "${said}", the program "${words}"`);
  check(!Object.values(await values(page, "a")).some(v => v), "values of no points");
  check(await page.locator(".set-a .buttons button:disabled").count() === 3, "no points can be saved");
  // What the page refuses leaves the set as it is.
  await page.locator("#a-n").fill("20000");
  await page.locator("#a-n").press("Tab");
  check((await page.evaluate(() => koksmaExplorer.hash())).includes("a=jittered@17"), "20,000 points are taken");
  await set(page, "#a-n", 16);
  check(!(await page.locator(".set-a .problem").textContent()), "the problem stays");
  check(await page.locator(".set-a .buttons button:enabled").count() === 3, "16 points can't be saved");
  // Three dimensions.
  await choose(page, "#a-pattern", "halton");
  await set(page, "#a-dim", 3);
  await compare(page, "a", "pattern:halton@16@3", "--seed", 3);
  await choose(page, "#upwards", "2");
  check((await page.evaluate(() => koksmaExplorer.hash())).includes("axes=0,2"), "the axes are not in the address");
  await set(page, "#a-dim", 1);
  await compare(page, "a", "pattern:halton@16@1", "--seed", 3);
}

async function strataAndWitness(page) {
  await visit(page, "#a=sobol@16&strata=grid:4x4");
  const text = () => page.locator(".set-a .strata-text").textContent();
  check((await text()) === "16 of 16 cells of 4 × 4 hold one point", "strata: " + await text());
  await set(page, "#columns", 2);
  await set(page, "#rows", 3);
  check((await text()) === "2 × 3 cells for 16 points", "strata: " + await text());
  await choose(page, "#strata", "elementary");
  for (let split = 0; split <= 4; split++) {
    await page.locator("#split").fill(String(split));
    await idle(page);
    check((await text()) === `16 of 16 cells of ${2 ** split} × ${16 / 2 ** split} hold one point`, "elementary intervals: " + await text());
  }
  await choose(page, "#strata", "rooks");
  check((await text()) === "32 of 32 columns and rows hold one point", "rooks: " + await text());
  await set(page, "#a-n", 15);
  await choose(page, "#strata", "grid");
  await set(page, "#columns", "");
  await set(page, "#rows", "");
  check(/ of 15 cells of 5 × 3 /.test(await text()), "strata: " + await text());
  // The witness in the picture is where the program has it.
  await unfold(page);
  const side = 400;
  for (const [measure, shape] of [["star", "rect"], ["extreme", "rect"], ["edge", "polygon"], ["disk", "circle"]]) {
    await page.locator(`#witness-${measure}`).check();
    await idle(page);
    const { witness } = JSON.parse(run("measure", "pattern:sobol@15", "-m", measure, "--json"));
    const drawn = await page.locator(`.set-a svg.plane ${shape}.witness`).evaluateAll(nodes =>
      nodes.map(n => Object.fromEntries(["x", "y", "width", "height", "cx", "cy", "r", "points"].map(k => [k, n.getAttribute(k)]))));
    const near = (a, b) => Math.abs(a - b) < 0.01;
    if (shape === "rect") {
      const d = drawn[0];
      check(near(d.x, side * witness.lo[0]) && near(d.width, side * (witness.hi[0] - witness.lo[0])) &&
        near(d.y, side * (1 - witness.hi[1])) && near(d.height, side * (witness.hi[1] - witness.lo[1])), `${measure}: the box is elsewhere`);
    } else if (shape === "circle") {
      check(drawn.length === 9 && drawn.some(d => near(d.cx, side * witness.lo[0]) && near(d.cy, side * (1 - witness.lo[1])) && near(d.r, side * witness.hi[0])), "the disk is elsewhere");
    } else {
      // The area of the polygon is the half-plane's in the square.
      const corners = drawn[0].points.split(" ").map(p => p.split(",").map(Number));
      const area = Math.abs(corners.reduce((sum, [x, y], i) => { const [u, v] = corners[(i + 1) % corners.length]; return sum + x * v - u * y; }, 0)) / 2 / side ** 2;
      check(Math.abs(area - witness.volume) < 1e-4, `edge: a polygon of area ${area}, the witness has ${witness.volume}`);
    }
    const sentence = await page.locator(".set-a .sentence").textContent();
    check(sentence.includes(`${witness.count} of 15 points in the ${witness.closed ? "closed" : "open"} ${witness.kind}`), `${measure}: ${sentence}`);
  }
  await page.locator("#witness-none").check();
  await idle(page);
  check(await page.locator("svg.plane .witness").count() === 0, "a witness that was not asked for");
  // A measure with another parameter.
  await page.locator('[data-measure="disk"] summary').click();
  await set(page, "#measure-disk-r", 0.1);
  check((await values(page, "a")).disk === rounded(records("measure", "pattern:sobol@15", "-m", "disk:r=0.1")[0].value, 9), "disk:r=0.1");
}

async function moving(page) {
  await visit(page, "#a=n-rooks@16&a.seed=7&strata=rooks&decay=l2-star:prefixes");
  const before = await compare(page, "a", "pattern:n-rooks@16", "--seed", 7);
  const untouched = await saved(page, "a", "Save CSV");
  run("generate", "n-rooks", "-n", 16, "--seed", 7, "-o", "theirs.csv");
  check(fs.readFileSync(untouched).equals(fs.readFileSync(path.join(folder, "theirs.csv"))), "the saved points are other bytes than the program's");
  const points = fs.readFileSync(untouched, "utf8").trim().split("\n").slice(1).map(line => line.split(",").map(Number));
  await page.locator(".set-a svg.plane").scrollIntoViewIfNeeded();
  const box = await page.locator(".set-a svg.plane").boundingBox(), scale = box.width / 420;
  const at = ([x, y]) => [box.x + (10 + x * 400) * scale, box.y + (10 + (1 - y) * 400) * scale];
  await page.mouse.move(...at(points[4]));
  await page.mouse.down();
  for (let i = 1; i <= 10; i++) await page.mouse.move(...at([points[4][0] + (0.05 - points[4][0]) * i / 10, points[4][1] + (0.1 - points[4][1]) * i / 10]));
  check((await page.locator("#a-point").inputValue()) === "5", "the point that is dragged is not the one under the pointer");
  await page.mouse.up();
  await idle(page);
  const csv = await saved(page, "a", "Save CSV");
  const moved = fs.readFileSync(csv, "utf8").trim().split("\n").slice(1).map(line => line.split(",").map(Number));
  check(moved.every((p, i) => i === 4 ? Math.abs(p[0] - 0.05) < 0.01 && Math.abs(p[1] - 0.1) < 0.01 : p.join() === points[i].join()), "other points were moved");
  const after = await compare(page, "a", csv);
  check(after.star !== before.star, "the star discrepancy did not change");
  // The commands of a set with moved points are of its file; all run, and the last gives the slope that the page shows.
  const lines = await commandLines(page, "a");
  check(lines.length === 4 && lines.every(line => line.includes("koksma-a.csv")), "commands: " + lines);
  lines.slice(0, 3).forEach(shell);
  const slope = jsonLines(shell(lines[3] + " --json")).find(row => row.measure.startsWith("slope"));
  check((await page.locator("#decay-text").textContent()).includes(`slope ${rounded(slope.value, 4)} (± `), `the slope ${slope.value} is not on the page`);
  // Its address gives the same again.
  await page.waitForTimeout(300);
  const again = await open(page.context().browser(), { hash: "#" + await page.evaluate(() => koksmaExplorer.hash()) });
  check(JSON.stringify(await values(again, "a")) === JSON.stringify(after), "the address does not bring the moved point back");
  await again.context().close();
  // By keyboard, and by numbers.
  await page.locator(".set-a svg.plane").focus();
  await page.keyboard.press("Escape");
  for (const key of ["n", "n", "p", "ArrowRight", "Shift+ArrowUp"]) await page.keyboard.press(key);
  await idle(page);
  const places = await Promise.all(["#a-point", "#a-x", "#a-y"].map(id => page.locator(id).inputValue().then(Number)));
  check(places[0] === 1 && Math.abs(places[1] - points[0][0] - 0.01) < 1e-6 && Math.abs(places[2] - Math.min(points[0][1] + 0.1, 1)) < 1e-6, "keys: " + places);
  await set(page, "#a-point", 2);
  await set(page, "#a-x", 0.5);
  await set(page, "#a-y", 0.25);
  await compare(page, "a", await saved(page, "a", "Save CSV"));
  check(fs.readFileSync(csv, "utf8").split("\n")[2] === "0.5,0.25", "the place that was typed in");
  await page.locator(".set-a button", { hasText: "Undo moves" }).click();
  await idle(page);
  check(JSON.stringify(await values(page, "a")) === JSON.stringify(before), "undo does not bring the values back");
}

async function comparing(page) {
  await visit(page, "#a=jittered@64&a.seed=2");
  await page.locator("#compare").click();
  await idle(page);
  await choose(page, "#b-pattern", "dart-throwing");
  await set(page, "#b-seed", 9);
  const a = await compare(page, "a", "pattern:jittered@64", "--seed", 2), b = await compare(page, "b", "pattern:dart-throwing@64", "--seed", 9);
  const ratio = await page.locator('[data-measure="star"] td').nth(2).textContent();
  check(Math.abs(ratio - b.star / a.star) < 1e-3 * ratio, `B / A is ${ratio}`);
  check(await page.locator(".set-b svg.plane .points").count() === 1, "set B is not drawn");
  for (const which of ["a", "b"]) {
    const source = which === "a" ? ["pattern:jittered@64", "--seed", 2] : ["pattern:dart-throwing@64", "--seed", 9];
    const caption = await page.locator("#spectra figcaption").nth(which === "a" ? 0 : 1).textContent();
    const [nyquist, relative, oscillation] = ["effective_nyquist", "relative_nyquist", "oscillation"].map(key => rounded(records("curve", "quality", ...source)[0][key], 4));
    check(caption.includes(`effective Nyquist frequency ${nyquist}; over √n/2 ${relative}` + (oscillation === null ? "" : `; oscillation ${oscillation}`)), `quality ${nyquist} ${relative} ${oscillation}; the page: ${caption}`);
    (await commandLines(page, which)).forEach(line => { try { shell(line); } catch (error) { check(false, `${line}: ${error.stderr}`); } });
    const svg = fs.readFileSync(await saved(page, which, "Save SVG"), "utf8");
    const parts = await page.evaluate(text => {
      const root = new DOMParser().parseFromString(text, "image/svg+xml");
      const dots = root.querySelector("path[stroke-linecap=round]");
      return { broken: !!root.querySelector("parsererror"), dots: (dots?.getAttribute("d").match(/M/g) || []).length, title: root.querySelector("title")?.textContent, stroke: dots?.getAttribute("stroke") };
    }, svg);
    check(!parts.broken && parts.dots === 64 && parts.title.includes("@64") && /^rgb/.test(parts.stroke), "the saved SVG: " + JSON.stringify(parts));
  }
  await page.locator('[data-measure="star"] input[type=radio]').check();
  await choose(page, "#decay-measure", "star");
  check(/A, jittered: slope -?[\d.]+ .*B, dart-throwing: slope -?[\d.]+/s.test(await page.locator("#decay-text").innerText()), "slopes: " + await page.locator("#decay-text").innerText());
  check(await page.locator("#decay-chart .dots").count() === 2, "two curves are not drawn");
  // Koksma's inequality: a row a function, an error and a bound a set; the slanted edge has no bound.
  const inequality = await page.locator("#inequality tr").evaluateAll(rows => rows.map(row => [...row.cells].map(cell => cell.innerText)));
  check(inequality.length === 17 && inequality.every(row => row.length === 6), "the inequality has other rows: " + JSON.stringify(inequality));
  check(inequality.filter(row => row[1] === "infinite" && row[3] === "none" && row[5] === "none").length === 5, "bounds of infinite variation");
  // Estimates by independent sets: the program's, and a mark with its bar for each.
  await choose(page, "#integrand", "disk");
  const [median] = records("integrate", "disk", "-p", "jittered", "-n", 64, "--seed", 2, "--estimator", "median");
  const rows = await page.locator("#replicates tr").evaluateAll(lines => lines.map(line => [...line.cells].map(cell => cell.title || cell.innerText)));
  check(rows[1]?.[0] === "A: median" && +rows[1][1] === median.estimate && +rows[1][2] === median.low && +rows[1][3] === median.high,
    `estimates: ${JSON.stringify(rows)}, not ${JSON.stringify(median)}`);
  check(await page.locator("#replicates-chart .bar").count() === rows.length, "the intervals are not drawn");
  await page.locator(".set-b button", { hasText: "Remove" }).click();
  await idle(page);
  check(!(await page.evaluate(() => koksmaExplorer.hash())).includes("&b="), "set B is not removed");
}

async function guards(browser) {
  // Addresses with nonsense open a page that works.
  for (const hash of ["#a=nonsense@16", "#a=sobol@99999999&strata=elementary:9,99&axes=7,7&witness=none&measures=x:y|disk:r=9", "#%%%", "#a=sobol@16@3&b=sobol@16@2&decay=edge:prefixes"]) {
    const page = await open(browser, { hash, limit_s: hash.includes("99999999") ? 3 : 60 }); // of 16384 points some measures take longer than any limit
    const a = await values(page, "a");
    if (hash.includes("nonsense")) check((await page.locator(".set-a .problem").textContent()).includes("nonsense"), "an unknown pattern is not named");
    else check(typeof a["l2-star"] === "number", hash + ": no values");
    await page.context().close();
  }
  // What takes longer than the limit is stopped and says so; the rest goes on.
  const page = await open(browser);
  await page.evaluate(() => { location.hash = "#a=random@8192&witness=edge"; });
  await until(page, () => document.querySelector(".set-a svg.plane .points")?.getAttribute("d").length > 8192 * 4);
  await page.evaluate(() => koksmaExplorer.limit(0.5));
  await until(page, () => document.querySelector('[data-measure="edge"] td').textContent.includes("stopped after"));
  await page.evaluate(() => { koksmaExplorer.limit(60); location.hash = "#a=random@32"; });
  await until(page, () => koksmaExplorer.hash().includes("random@32"));
  await idle(page);
  await compare(page, "a", "pattern:random@32");
  await page.context().close();
  // Without workers the page itself computes, and says so.
  const alone = await open(browser, { before: () => { delete globalThis.Worker; } });
  check(await alone.locator("#in-page").isVisible(), "nothing is said about missing workers");
  await compare(alone, "a", "pattern:n-rooks@16");
  await alone.context().close();
}

const pointsOf = csv => fs.readFileSync(csv, "utf8").trim().split("\n").slice(1).map(line => line.split(",").map(Number));

// The errors under the pictures, of points as they are shown and moved, are those of the definitions.
async function pictures(browser) {
  const page = await open(browser, { hash: "#a=n-rooks@16&a.seed=7&b=regular@9&pixels=equal" }), references = new Map();
  const converged = (scene, size) => {
    const key = JSON.stringify([scene, size]);
    if (!references.has(key)) references.set(key, definitions.pixels(scene, size, definitions.many(1024)));
    return references.get(key);
  };
  const agree = async (what, ...names) => {
    const results = await page.evaluate(() => Object.fromEntries(Object.entries(koksmaExplorer.pictures()).map(([scene, sets]) =>
      [scene, Object.fromEntries(Object.entries(sets).map(([name, { size, mean_error, rms_error }]) => [name, { size, mean_error, rms_error }]))])));
    check(Object.keys(results).join() === definitions.scenes.join(), `${what}: pictures of ${Object.keys(results)}`);
    for (const name of names) {
      const points = pointsOf(await saved(page, name, "Save CSV"));
      for (const [i, scene] of definitions.scenes.entries()) {
        const { size, mean_error, rms_error } = results[scene][name];
        const expected = definitions.errors(definitions.pixels(scene, size, points), converged(scene, size));
        check(Math.abs(rms_error - expected.rms_error) < 0.03 * expected.rms_error && Math.abs(mean_error - expected.mean_error) < 0.06 * expected.mean_error,
          `${what}, ${scene} ${name}: mean ${mean_error}, RMS ${rms_error}; from the definition ${expected.mean_error}, ${expected.rms_error}`);
        const shown = await page.locator(".scene").nth(i).locator(".numbers").nth(name === "a" ? 0 : 1).textContent();
        check(shown === `mean ${rounded(mean_error, 3)}, RMS ${rounded(rms_error, 3)}`, `${what}, ${scene} ${name}: "${shown}" is not ${mean_error}, ${rms_error}`);
      }
    }
    return results;
  };
  const before = await agree("two sets", "a", "b");
  check(before["zone plate"].a.size.width === before["zone plate"].b.size.width, "the pictures of two sets have other sizes");
  await page.locator(".set-a svg.plane").focus();
  for (const key of ["n", "Shift+ArrowRight", "Shift+ArrowUp"]) await page.keyboard.press(key);
  await idle(page);
  const after = await agree("a moved point", "a");
  check(definitions.scenes.every(scene => after[scene].a.rms_error !== before[scene].a.rms_error), "a moved point does not change the errors");
  check(definitions.scenes.every(scene => after[scene].b.rms_error === before[scene].b.rms_error), "a moved point of A changes the errors of B");
  await page.locator("#picture-shift").check();
  await idle(page);
  const noise = await page.evaluate(() => koksmaExplorer.pictures()["zone plate"].b.rms_error);
  check(noise !== before["zone plate"].b.rms_error && !(await page.evaluate(() => koksmaExplorer.hash())).includes("pixels"), "shifting the pixels changes nothing");
  await set(page, "#a-n", 4096);
  check(await page.evaluate(() => { const { size } = koksmaExplorer.pictures()["zone plate"].b; return size.width * size.height * 4096 < 2e6; }), "the pictures of 4,096 points are as large as those of few");
  await set(page, "#a-dim", 1);
  check(await page.locator(".set-a .problem").textContent() || await page.locator("#pictures").isVisible(), "set B has lost its pictures");
  await page.context().close();
}

// A search by keyboard: points and measure change while it runs, Stop ends it, its command gives the same, undo takes it back.
async function searching(browser) {
  for (const [width, colorScheme, hash, measure] of [
    [1280, "dark", "#a=n-rooks@16&a.seed=7&witness=edge", "edge"], [400, "light", "#a=jittered@25&a.seed=2&b=sobol@16&witness=min-distance", "min-distance"]]) {
    const page = await open(browser, { hash, width, colorScheme, limit_s: 60 }), text = page.locator(".set-a .search-text"), button = page.locator("#a-search-button");
    const before = await values(page, "a"), path0 = await page.locator(".set-a svg.plane .points").getAttribute("d");
    check(await page.locator("#a-search-measure").inputValue() === measure, "the search is not for the chosen measure");
    await page.locator("#a-search-steps").selectOption("long");
    await button.focus();
    await page.keyboard.press("Enter");
    await until(page, () => /in (?:[3-9]|\d\d+) steps/.test(document.querySelector(".set-a .search-text").textContent));
    check(await button.textContent() === "Stop" && await button.evaluate(node => node === document.activeElement), "the button does not become Stop");
    (await page.evaluate(accessibility)).forEach(found => check(false, `search, ${width} px: ${found}`));
    if (screenshots) await page.locator("section.set-a").screenshot({ path: `${screenshots}/search-${width}.png` });
    await page.keyboard.press("Enter");
    await idle(page);
    const [, from, to, steps] = /^\S+ ([\d.]+) → ([\d.]+) in (\d+) steps \(/.exec(await text.textContent()) || [];
    const after = await values(page, "a");
    check(+from === rounded(before[measure], 4) && +to === rounded(after[measure], 4), `${await text.textContent()}; the table ${before[measure]}, then ${after[measure]}`);
    check(measure === "edge" ? +to < +from : +to > +from, `after ${steps} steps ${measure} went from ${from} to ${to}`);
    check(await page.locator(".set-a svg.plane .points").getAttribute("d") !== path0, "the points stay in the picture");
    check(await page.locator(".set-a .search .chart .line").count() > 0, "the values are not drawn");
    check((await commandLines(page, "a"))[0].startsWith(`koksma optimise ${measure} --from`), "the command: " + await commandLines(page, "a"));
    await commandsAgree(page, "a", `search for ${measure}`);
    await page.waitForTimeout(300);
    const again = await open(page.context().browser(), { hash: "#" + await page.evaluate(() => koksmaExplorer.hash()) });
    check((await values(again, "a"))[measure] === after[measure], "the address does not bring the points back");
    await again.context().close();
    // It goes on from here; a set that is changed ends it.
    await button.click();
    await until(page, () => /in [1-9]\d* steps?/.test(document.querySelector(".set-a .search-text").textContent));
    await page.locator(".set-a button", { hasText: "Next" }).click();
    await idle(page);
    check(await button.textContent() === "Optimise" && !await text.textContent(), "a search for another set goes on");
    await page.context().close();
  }
  // Short steps let the value fall before one's eyes: it has at least four values on the way, each less than the one before.
  const live = await open(browser, { hash: "#a=random@64&a.seed=3&witness=star", limit_s: 60 }), falling = [];
  await live.locator("#a-search-button").click();
  for (const start = Date.now(); falling.length < 5 && Date.now() - start < 300000; await live.waitForTimeout(30)) {
    const [, value] = / → ([\d.]+) in \d+ steps? \(method (?:witness|perturb)\)/.exec(await live.locator(".set-a .search-text").textContent()) || [];
    if (value && falling[falling.length - 1] !== +value) falling.push(+value);
  }
  check(falling.length === 5 && falling.every((value, i) => i === 0 || value < falling[i - 1]), `short steps: ${falling}`);
  await live.locator("#a-search-button").click();
  await idle(live);
  check(!(await commandLines(live, "a")).some(line => line.startsWith("koksma optimise")), "a command for steps that none repeats");
  await live.context().close();
  const page = await open(browser, { hash: "#a=n-rooks@16&a.seed=7&b=random@16" }), before = await values(page, "a");
  await page.locator("#a-search-button").click();
  await until(page, () => /in [1-9]/.test(document.querySelector(".set-a .search-text").textContent));
  await page.locator("#b-search-button").click();
  await until(page, () => /in [1-9]/.test(document.querySelector(".set-b .search-text").textContent));
  check(await page.locator("#a-search-button").textContent() === "Optimise", "two searches at once");
  await page.locator("#b-search-button").click();
  await page.locator(".set-a button", { hasText: "Undo moves" }).click();
  await idle(page);
  check(JSON.stringify(await values(page, "a")) === JSON.stringify(before), "undo does not bring the set back");
  await page.context().close();
}

// A value that is not known yet is shown as "…", and no old number stays beside it.
async function waiting(browser) {
  const page = await open(browser, { hash: "#a=random@64&witness=edge", limit_s: 60 });
  const cells = () => page.locator("#measures tr:not([hidden]) td:nth-of-type(1)").allTextContents();
  const known = await cells();
  check(known.length === 4 && known.every(text => /^\d/.test(text)), "four measures at the start: " + known);
  await page.evaluate(() => { location.hash = "#a=random@4096&witness=edge"; });
  await until(page, () => koksmaExplorer.hash().includes("4096"));
  const meanwhile = await cells();
  check(meanwhile.includes("…") && !meanwhile.some(text => known.includes(text)), "values of 64 points beside 4096: " + meanwhile);
  check((await page.locator("#chosen-values").textContent()) === meanwhile[2] || (await cells())[2] !== "…", "the chosen value is another one than the table's");
  check(await page.locator("svg.plane .witness").count() === 0, "the witness of other points is drawn");
  await page.context().close();
}

// On a narrow screen the points and the chosen value are seen together, and change together.
async function narrow(browser) {
  const page = await open(browser, { hash: "#a=random@16&witness=l2-star", width: 400 });
  await page.setViewportSize({ width: 400, height: 700 });
  await page.locator(".set-a svg.plane").scrollIntoViewIfNeeded();
  const whole = id => page.locator(id).evaluate(node => { const box = node.getBoundingClientRect(); return box.top >= 0 && box.bottom <= innerHeight && box.right <= innerWidth; });
  check(await whole(".set-a svg.plane") && await whole("#chosen-values"), "at 400 px the points and the value are not seen together");
  const value = () => page.locator("#chosen-values").textContent(), before = await value();
  await page.locator(".set-a svg.plane").focus();
  for (const key of ["n", "Shift+ArrowLeft", "Shift+ArrowUp", "n", "Shift+ArrowRight"]) await page.keyboard.press(key);
  await idle(page);
  check(await value() !== before && /^0\.\d+$/.test(await value()), `the value beside the points: ${before}, then ${await value()}`);
  await page.evaluate(() => { location.hash += "&b=sobol@16"; });
  await page.waitForFunction(() => document.querySelectorAll("svg.plane .points").length === 2);
  await idle(page);
  const bar = await page.locator("#chosen-bar").boundingBox();
  check(bar.height < 64 && await page.locator("#chosen-values output").count() === 2, `two values beside the points take ${bar.height} px`);
  await page.locator(".set-b button", { hasText: "Remove" }).click();
  await choose(page, "#chosen", "min-distance");
  check(Number(await value()) === rounded((await values(page, "a"))["min-distance"], 4), "the chosen value is not the table's");
  await page.context().close();
}

// The page opens with random points beside Sobol's; the first control is that of the pattern; on a phone points are seen at once.
async function opening(browser) {
  const page = await open(browser, { hash: "", width: 390 });
  await page.setViewportSize({ width: 390, height: 844 });
  const hash = await page.evaluate(() => koksmaExplorer.hash());
  check(hash.includes("a=random@16") && hash.includes("b=sobol"), "the opening is " + hash);
  check(await page.evaluate(() => document.querySelector("main select:not(#chosen)").id) === "a-pattern", "the first control is not the pattern's");
  const bottom = await page.locator(".set-a svg.plane").evaluate(node => node.getBoundingClientRect().bottom);
  check(bottom <= 844, `at 390 px the points end at ${bottom} of 844`);
  await page.context().close();
}

// The ten steps by keyboard alone: each sets the state, points at something that is seen, and can be left.
async function tour(browser) {
  for (const [width, colorScheme] of [[1280, "dark"], [400, "light"]]) {
    const page = await open(browser, { width, colorScheme });
    for (let i = 0; i < 5 && !await page.evaluate(() => document.activeElement.id === "start-tour"); i++) await page.keyboard.press("Tab");
    await page.keyboard.press("Enter");
    const states = new Set();
    for (let step = 1; step <= 10; step++) {
      await idle(page);
      check((await page.locator("#tour-title").textContent()).startsWith(`${step} of 10: `), `step ${step}: ${await page.locator("#tour-title").textContent()}`);
      check(await page.evaluate(() => document.activeElement.id === "tour-title"), `step ${step}: the focus is elsewhere`);
      const seen = await page.evaluate(() => {
        const box = document.querySelector(".pointed")?.getBoundingClientRect(), card = document.getElementById("tour").getBoundingClientRect();
        return box && box.top < innerHeight && box.bottom > 0 && card.bottom <= innerHeight + 1 && card.top >= 0;
      });
      // Steps 6 and 8 are about set B, which is seen above the text.
      const ofB = { 6: "#inequality-heads > :last-child", 8: "#spectra > :nth-child(2) canvas" }[step];
      const seenB = !ofB || await page.evaluate(selector => {
        const box = document.querySelector(selector).getBoundingClientRect();
        return box.top >= 0 && box.top < document.getElementById("tour").getBoundingClientRect().top && box.left >= 0 && box.right <= innerWidth + 1;
      }, ofB);
      check(width > 700 || seenB, `${width} px, step ${step}: set B is not seen`);
      check(seen, `${width} px, step ${step}: what it points at, or its text, is not seen`);
      // What a step asks to choose or to move is on top at its place in the window, and the text says what came of it.
      const asked = { 4: "#strata", 5: "#split" }[step];
      const reached = selector => page.evaluate(selector => {
        const { left, top, width, height } = document.querySelector(selector).getBoundingClientRect();
        return Boolean(document.elementFromPoint(left + width / 2, top + height / 2)?.closest(selector));
      }, selector);
      const says = () => page.locator("#tour p").allTextContents();
      if (asked) {
        check(await reached(asked), `${width} px, step ${step}: ${asked} can't be reached`);
        check((await says())[2].includes(step === 4 ? "16 of 16 cells of 4 × 4" : "B, Sobol’: 16 of 16 cells"), `${width} px, step ${step} says ${await says()}`);
        if (step === 4) await choose(page, asked, "rooks");
        else await page.locator(asked).fill("4").then(() => idle(page));
        check((await says())[2].includes(step === 4 ? "of 32 columns and rows" : "B, Sobol’: 16 of 16 cells of 16 × 1"), `${width} px, step ${step} says, after a change, ${await says()}`);
        await page.locator("#tour-title").focus();
      }
      states.add(await page.evaluate(() => koksmaExplorer.hash()));
      check(!(await page.locator(".problem").allTextContents()).join(""), `step ${step}: ${await page.locator(".problem").allTextContents()}`);
      (await page.evaluate(accessibility)).forEach(text => check(false, `tour, step ${step}, ${width} px: ${text}`));
      if (screenshots) await page.screenshot({ path: `${screenshots}/tour-${width}-${step}.png` });
      if (step === 10) break;
      for (let i = 0; i < 3 && !await page.evaluate(() => document.activeElement.textContent === "Next"); i++) await page.keyboard.press("Tab");
      await page.keyboard.press("Enter");
    }
    check(states.size >= 9, `ten steps show ${states.size} states`);
    await page.keyboard.press("Escape");
    check(!await page.locator("#tour").isVisible() && await page.evaluate(() => document.activeElement.id === "start-tour"), "Escape does not leave the tour");
    check(await page.locator(".pointed").count() === 0, "something is still pointed at");
    await page.context().close();
  }
  // What the steps say is so: the inequality holds in the Sobol's bounds are the smaller ones.
  const page = await open(browser, { hash: "#a=random@16&a.seed=3&b=sobol:scramble=owen@16" });
  const rows = await page.locator("#inequality tr").evaluateAll(lines => lines.map(line => [...line.cells].map(cell => parseFloat(cell.innerText))));
  const bounded = rows.filter(row => Number.isFinite(row[3]));
  check(bounded.length >= 8 && bounded.every(row => row[2] <= row[3] && row[4] <= row[5] && row[5] < row[3]), "the tour's inequality does not hold: " + rows);
  check(bounded.filter(row => row[4] < row[2]).length > bounded.length / 2, "set B does not have mostly the smaller errors: " + rows);
  // The three other ways in.
  for (const link of await page.locator("header nav a").all()) {
    await link.focus();
    await page.keyboard.press("Enter");
    await until(page, () => document.querySelectorAll("svg.plane .points").length === 2);
    await idle(page);
    check(!(await page.locator(".problem").allTextContents()).join("") && await page.locator(".set-b svg.plane .points").isVisible(), `${await link.textContent()} shows no two sets`);
  }
  await page.context().close();
}

async function looks(browser) {
  const hash = "#a=pmj02@64&a.seed=1&b=random@64&b.seed=4&strata=elementary:2,3&witness=edge&decay=star:sets";
  const page = await open(browser);
  // At the start everything that can be used is reached by Tab. Of a pattern without parameters one row holds all controls.
  const tops = await page.locator(".set-a .controls input, .set-a .controls select, .set-a .controls button").evaluateAll(nodes => nodes.map(node => node.getBoundingClientRect().bottom));
  check(Math.max(...tops) - Math.min(...tops) < 16, "the controls at 1280 px stand in rows: " + tops);
  const reached = new Set();
  for (let i = 0; i < 120; i++) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement?.id || document.activeElement?.textContent || ""));
  }
  for (const name of ["start-tour", "all-measures", "all-digits", "picture-shift", "strata", "compare", "a-pattern", "a-n", "a-seed", "a-param-shift", "a-point", "a-search-measure", "a-search-steps", "a-search-button", "Save SVG", "Save CSV", "a-commands", "decay-measure"]) {
    check(reached.has(name) || [...reached].some(text => text.startsWith(name)), `Tab does not reach ${name}`);
  }
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    for (const [width, view] of [[1280, ""], [1280, hash], [400, hash], [400, "#a=poisson-disk@16&all=measures,digits"]]) {
      await page.setViewportSize({ width, height: 900 });
      await visit(page, view);
      await page.locator("details").evaluateAll(nodes => nodes.forEach(n => { n.open = true; }));
      (await page.evaluate(accessibility)).forEach(text => check(false, `${colorScheme}, ${width}: ${text}`));
      await page.locator("details").evaluateAll(nodes => nodes.forEach(n => { n.open = false; }));
      if (screenshots) await page.screenshot({ path: `${screenshots}/${colorScheme}-${width}${view === hash ? "-two" : ""}.png`, fullPage: true });
    }
  }
  await page.context().close();
}

(async () => {
  const browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  try {
    const page = await open(browser);
    await controls(page);
    await strataAndWitness(page);
    await moving(page);
    await comparing(page);
    await page.context().close();
    await policy(browser);
    await guards(browser);
    await pictures(browser);
    await waiting(browser);
    await searching(browser);
    await narrow(browser);
    await opening(browser);
    await tour(browser);
    await looks(browser);
  } catch (error) {
    check(false, error.stack);
  }
  await browser.close();
  report();
})();

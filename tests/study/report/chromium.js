// SPDX-License-Identifier: Apache-2.0
// chromium.js REPORT [SCREENSHOTS]: opens a report or a datasheet in headless Chromium: no console error, every picture loads, no network,
// the comparer works by keyboard, all pictures have texts, text has contrast, in light and dark; answers, contents, search,
// tables, charts and commands work by the keyboard alone; printed, nothing is folded. No table of a datasheet scrolls sideways. Exit code 77: skipped.
"use strict";
const fs = require("fs");
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(p => fs.existsSync(p));
let playwright;
try { playwright = require(require.resolve("playwright-core", { paths: [process.env.KOKSMA_NODE || ".", "."] })); } catch { playwright = null; }
if (!chromium || !playwright) {
  console.log("skipped: " + (chromium ? "playwright-core" : "Chromium") + " is not installed (scripts/setup browser)");
  process.exit(77);
}
const [report, screenshots] = process.argv.slice(2);
const problems = [];
let longTables = 0;
const check = (good, text) => { if (!good) problems.push(text); };

// What the data have of each kind.
const data = JSON.parse(/id="data">\n(.*?)<\/script>/s.exec(fs.readFileSync(report, "utf8"))[1]);
const blocksOf = content => content.flatMap(b => [b, ...blocksOf(b.content ?? [])]);
const all = blocksOf(data.content), of = kind => all.filter(b => b.kind === kind), sum = list => list.reduce((a, b) => a + b, 0);
const lineLabels = b => [...new Set(b.series.filter(s => s.style !== "theory" && s.points.length).map(s => s.label))];
const limited = b => b.series.some(s => s.style === "line" && s.points.length);
// A chart of patterns against n begins with the eight that are best at the largest n: larger is better of distances alone.
const atEnd = (b, label) => b.series.find(s => s.label === label && s.style === "line").points.at(-1);
const best = b => lineLabels(b).sort((p, q) => atEnd(b, q)[0] - atEnd(b, p)[0] || (b.y.title === "min-distance" ? -1 : 1) * (atEnd(b, p)[1] - atEnd(b, q)[1]));
const opening = b => !limited(b) ? lineLabels(b) : lineLabels(b).length > 8 && / against N$/.test(b.title) ? best(b).slice(0, 8) : lineLabels(b).slice(0, 8);
const shownSeries = b => b.series.filter(s => s.style !== "theory" && opening(b).includes(s.label));
const expected = {
  headings: of("section").filter(b => !b.collapsed).length, details: of("section").filter(b => b.collapsed).length + of("commands").length,
  paragraphs: of("paragraph").length + of("commands").length, tables: of("table").length,
  rows: sum(of("table").map(b => b.rows.length)), charts: of("chart").length, lines: sum(of("list").map(b => b.items.length)),
  marks: sum(of("chart").flatMap(b => shownSeries(b).map(s =>
    s.points.filter(([x, y]) => x !== null && y !== null && (!b.x.log || x > 0) && (!b.y.log || y > 0)).length))),
  figures: of("figure").length, images: sum(of("figure").map(b => b.images.filter(i => i.type !== "drawing").length)),
  canvases: sum(of("pictures").map(b => 2 * b.images.length)), comparers: of("pictures").length,
};

// Puts a script into the page, as a hostile text might; returns whether it ran.
const plantScript = () => {
  const script = document.createElement("script");
  script.textContent = "globalThis.plantedRan = true";
  document.body.append(script);
  return Boolean(globalThis.plantedRan);
};

// Text against what is behind it, as WCAG 2.1 counts it.
const contrasts = () => {
  const parse = c => (c.match(/[\d.]+/g) || []).map(Number);
  const light = ([r, g, b]) => [r, g, b].map(v => v / 255).map(v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const behind = e => { for (; e; e = e.parentElement) { const c = parse(getComputedStyle(e).backgroundColor); if (c.length === 3 || c[3] > 0) return c; } return [255, 255, 255]; };
  const bad = new Set();
  for (const e of document.querySelectorAll("main *")) {
    if (![...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim()) || !e.getClientRects().length) continue;
    const style = getComputedStyle(e), ink = light(parse(e instanceof SVGElement ? style.fill : style.color)), paper = light(behind(e));
    const ratio = (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
    if (ratio < 4.5) bad.add(`${e.tagName} ${e.className.baseVal ?? e.className}: contrast ${ratio.toFixed(2)}`);
  }
  return [...bad];
};

// With all sections open: words of tables that are broken within, letters or digits on two lines; and what scrolls sideways.
const cramped = scrolls => {
  document.querySelectorAll("details").forEach(d => { d.open = true; });
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), broken = new Set();
  while (texts.nextNode()) {
    const text = texts.currentNode, range = document.createRange();
    if (!text.parentElement.closest("td, th")) continue;
    for (const { 0: word, index } of text.data.matchAll(/[\p{L}\p{N}]+/gu)) {
      range.setStart(text, index), range.setEnd(text, index + word.length);
      if (new Set([...range.getClientRects()].map(box => Math.round(box.top))).size > 1) broken.add(word);
    }
  }
  return [...broken, ...[document.documentElement, ...document.querySelectorAll(scrolls)].filter(e => e.scrollWidth > e.clientWidth + 1)
    .map(e => `${e.getAttribute("aria-label") ?? "the page"} ${e.scrollWidth} > ${e.clientWidth}`)];
};

// Presses Tab until the focus is on what `test` finds in the page.
async function tabTo(page, selector, most = 400) {
  for (let i = 0; i < most; i++) {
    await page.keyboard.press("Tab");
    if (await page.evaluate(s => document.activeElement.matches(s), selector)) return true;
  }
  check(false, `Tab does not reach ${selector}`);
  return false;
}

const has = (page, selector) => page.evaluate(s => Boolean(document.querySelector(s)), selector);

async function byKeyboard(page) {
  const start = () => page.evaluate(() => { document.activeElement.blur(); document.querySelector("h1").tabIndex = -1; document.querySelector("h1").focus(); });
  const answers = all.filter(b => b.answer).length, shown = await page.evaluate(() => document.querySelectorAll("#verdict dd > .mark").length);
  check(answers ? shown > 0 && shown <= answers : !await has(page, "section#verdict"), `${shown} answers at the top of ${answers}`);
  if (answers && await tabTo(page, "#verdict dt a")) {
    await page.keyboard.press("Enter");
    check(await page.evaluate(() => Boolean(document.getElementById(decodeURIComponent(location.hash.slice(1)))?.matches("#evidence *"))), "a question leads nowhere");
    await start();
  }
  const links = await page.evaluate(() => [...document.querySelectorAll("nav a")].filter(a => !document.getElementById(decodeURIComponent(a.hash.slice(1)))).length);
  check(links === 0, `${links} entries of the contents lead nowhere`);
  // The first table that can be sorted: by each way of its last column of intervals, against the data.
  const folded = blocksOf(of("section").filter(s => s.collapsed).flatMap(s => s.content));
  const sortable = of("table").find(t => t.rows.length > 8 && !folded.includes(t) && t.columns.some(c => c.type === "interval" && !c.hidden) && !t.columns.some(c => c.merged));
  if (sortable) {
    const number = of("table").indexOf(sortable), visible = sortable.columns.filter(c => !c.hidden);
    const at = visible.findLastIndex(c => c.type === "interval"), c = sortable.columns.indexOf(visible[at]);
    await page.evaluate(([t, i]) => document.querySelectorAll("#evidence table")[t].querySelectorAll("thead tr:last-child th button")[i].classList.add("tried"), [number, at]);
    const texts = () => page.evaluate(t => [...document.querySelectorAll("#evidence table")[t].querySelectorAll("tbody tr > :first-child")].map(e => e.textContent), number);
    const order = key => [...sortable.rows].sort((a, b) => { const [x, y] = [key(a[c] ?? [null, null, null]), key(b[c] ?? [null, null, null])]; return x === null || y === null ? (x === null) - (y === null) : x - y; }).map(r => r[0]);
    const ways = { ascending: v => v[0], descending: v => v[0] === null ? null : -v[0], none: () => 0 };
    const step = sortable.sort?.column !== visible[at].name ? "none" : sortable.sort.descending ? "descending" : "ascending";
    const turn = Object.keys(ways), from = turn.indexOf(step);
    if (await tabTo(page, ".tried")) {
      for (let i = 1; i <= 3; i++) {
        const way = turn[(from + i) % 3];
        await page.keyboard.press("Enter");
        const state = await page.evaluate(() => document.activeElement.closest("th").getAttribute("aria-sort") ?? "none");
        check(state === way, `sorted ${state}, not ${way}`);
        check(JSON.stringify(await texts()) === JSON.stringify(order(ways[way])), `the order of rows by ${way} of ${visible[at].name}`);
      }
    }
    await start();
    const word = String(sortable.rows[3][0]);
    await tabTo(page, ".search input");
    await page.keyboard.type(word);
    check((await texts()).every(text => text.includes(word)) && (await texts()).length > 0, `the search for ${word} leaves ${await texts()}`);
    for (let i = 0; i < word.length; i++) await page.keyboard.press("Backspace");
    check((await texts()).length === sortable.rows.length, "rows are lost after a search");
    await tabTo(page, ".tools input");
    await page.keyboard.type("no such pattern");
    await page.keyboard.press("Escape"); // empties a search field
    await start();
  }
  if (of("commands").length && await tabTo(page, ".commands summary")) {
    const focused = () => page.evaluate(() => document.activeElement.textContent);
    await page.keyboard.press("Enter");
    await page.keyboard.press("Tab");
    check((await focused()).startsWith("koksma "), "Tab does not lead to the commands");
    await page.keyboard.press("Tab");
    check(await focused() === "copy", "Tab does not lead to the button that copies");
    await start();
  }
  const drawnChart = of("chart").findIndex(b => shownSeries(b).some(s => s.points.length > 1));
  if (drawnChart >= 0 && await tabTo(page, ".stage")) {
    const tip = () => page.evaluate(() => document.activeElement.querySelector(".tip").textContent);
    const first = await tip(), block = of("chart")[0];
    check(first.startsWith(shownSeries(block)[0].label + ":"), `the focus on a chart names ${first}`);
    await page.keyboard.press("ArrowRight");
    check(await tip() !== first || shownSeries(block)[0].points.length < 2, "an arrow key names no other point");
    await page.keyboard.press("Escape");
    check(await tip() === "", "Escape leaves a point named");
  }
  const long = of("chart").find(b => limited(b) && lineLabels(b).length > 8);
  if (long) {
    await start();
    await tabTo(page, `.choice summary`);
    while (!await page.evaluate(n => document.activeElement.textContent.includes(`of ${n} are`), lineLabels(long).length)) await tabTo(page, ".choice summary");
    await page.keyboard.press("Enter");
    const figure = () => page.evaluate(() => { const f = document.activeElement.closest("figure"); return { lines: f.querySelectorAll(".chart .series:not(.theory) .line").length, legend: [...f.querySelectorAll(".legend li")].map(li => li.textContent), free: f.querySelectorAll(".choice input:not(:checked):disabled").length }; });
    const eight = await figure();
    check(eight.lines === 8 && eight.free === lineLabels(long).length - 8, `${eight.lines} lines at first, ${eight.free} more that can't be chosen`);
    const shown = lineLabels(long).filter(label => opening(long).includes(label)), absent = lineLabels(long).findLast(label => !shown.includes(label));
    check(shown.every(label => eight.legend.includes(label)), `${long.title} begins with ${eight.legend}, not with ${shown}`);
    // What a reader can tell lines by, as painted: up to eight lines differ in colour, and in the shape of the mark.
    const alike = () => page.evaluate(() => [...document.querySelectorAll(".chart-figure")].flatMap(f => {
      const colour = g => getComputedStyle(g.querySelector(".line") ?? g.querySelector(".dots"))[g.querySelector(".line") ? "stroke" : "fill"];
      const shape = g => {
        const corners = (g.querySelector(".dots > polygon")?.getAttribute("points") ?? "0,0").split(" ").map(p => p.split(",").map(Number));
        return corners.map((p, k) => p.map((v, i) => Math.sign(Math.round(v - (corners[k - 1] ?? p)[i])))).join(" "); // ways of the edges
      };
      const all = [...f.querySelectorAll(".legend .series:not(.theory)")], inChart = [...f.querySelectorAll(".chart .series:not(.theory)")];
      const looks = inChart.map(g => colour(g) + shape(g)), n = all.length;
      const few = n > 8 || [colour, shape].every(of => new Set(all.map(of)).size === n);
      return [...(few ? [] : [`${f.querySelector("figcaption").textContent}: ${n} lines, ${all.map(colour)}`]), ...all.map(g => colour(g) + shape(g)).filter(one => !looks.includes(one))];
    }));
    check(!(await alike()).length, `lines look alike, or the legend has other marks than the chart: ${await alike()}`);
    await tabTo(page, ".choice input");
    await page.keyboard.press("Space");
    check((await figure()).lines === 7 && !(await figure()).legend.includes(shown[0]), "a line stays that was chosen away");
    await page.evaluate(label => { [...document.activeElement.closest("figure").querySelectorAll(".choice label")].find(l => l.textContent.trim() === label).firstChild.classList.add("last"); }, absent);
    await tabTo(page, ".last");
    await page.keyboard.press("Space");
    check((await figure()).lines === 8 && (await figure()).legend.includes(absent), "a line that was chosen is not drawn");
    check(!(await alike()).length, `with a line that was chosen, lines look alike: ${await alike()}`);
  }
}

(async () => {
  const browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  for (const colorScheme of ["light", "dark"]) {
    const page = await (await browser.newContext({ colorScheme, viewport: { width: 1280, height: 900 } })).newPage();
    let planted = false;
    page.on("console", m => check(m.type() !== "error" || planted && /Content Security Policy/.test(m.text()), "console: " + m.text()));
    page.on("pageerror", e => check(false, "error: " + e.message));
    page.on("request", r => check(/^(file|data|blob):/.test(r.url()), "network: " + r.url()));
    await page.goto("file://" + fs.realpathSync(report));
    const facts = await page.evaluate(() => ({
      broken: [...document.images].filter(i => !i.complete || !i.naturalWidth).length,
      nameless: [...document.images].filter(i => !i.alt).length +
        [...document.querySelectorAll("svg:not(svg svg), canvas")].filter(s => !s.getAttribute("aria-label") && !s.getAttribute("aria-hidden")).length,
      unlabelled: [...document.querySelectorAll("select, button")].filter(s => !(s.labels?.length || s.textContent.trim())).length,
      ids: [...document.querySelectorAll("[id]")].map(e => e.id).filter((id, i, all) => all.indexOf(id) !== i),
      wide: document.documentElement.scrollWidth > innerWidth,
      language: document.documentElement.lang, title: document.title,
    }));
    const shown = await page.evaluate(() => {
      const count = selector => document.querySelectorAll(selector).length;
      return {
        headings: count("#evidence :is(h2, h3, h4, h5, h6)"), details: count("#evidence details:not(.choice)"), paragraphs: count("#evidence p"),
        tables: count("main table"), rows: count("main tbody tr"), charts: count(".plot > svg.chart"), lines: count("#evidence li:not(.legend li)"),
        marks: count(".chart svg .dots > *"), figures: count("figure:has(> figcaption):not(.chart-figure):not(:has(canvas))"),
        images: count("main img"), canvases: count("main canvas"), comparers: count(".comparer canvas"),
      };
    });
    for (const [name, n] of Object.entries(expected)) check(shown[name] === n, `${shown[name]} ${name}, and report.json has ${n}`);
    check(facts.broken === 0, `${facts.broken} broken pictures`);
    check(facts.nameless === 0, `${facts.nameless} pictures without a text`);
    check(facts.unlabelled === 0, `${facts.unlabelled} controls without a label`);
    check(facts.ids.length === 0, "ids twice: " + facts.ids);
    check(!facts.wide, "the page is wider than the window");
    check(facts.language && facts.title === data.title, "no language or title");
    // A number never goes on in the next line; a table of many rows scrolls below its head, which stays.
    const split = await page.evaluate(() => [...document.querySelectorAll("wbr")].filter(w => /\.$/.test(w.previousSibling?.data) && /^\d/.test(w.nextSibling?.data)).map(w => w.parentElement.textContent));
    check(split.length === 0, `${split.length} numbers may break at the point, first ${split[0]}`);
    const heads = await page.evaluate(() => [...document.querySelectorAll("#evidence .scroll")].filter(e => e.checkVisibility() && e.querySelectorAll("tbody tr").length > 40).map(e => {
      e.scrollTop = e.scrollHeight;
      const [box, head, last] = [e, e.querySelector("thead"), e.querySelector("tbody tr:last-child")].map(n => n.getBoundingClientRect());
      return box.height <= innerHeight && Math.abs(head.top - box.top) < 2 && last.bottom <= box.bottom + 2 ? "" : e.getAttribute("aria-label");
    }));
    check(heads.every(text => !text), `long tables without a head that stays: ${heads.filter(Boolean)}`);
    longTables += heads.length;
    (await page.evaluate(contrasts)).forEach(text => check(false, colorScheme + ": " + text));
    await byKeyboard(page);
    if (expected.comparers) {
      const canvas = page.locator(".comparer canvas").first(), output = page.locator(".comparer output").first();
      const picture = () => canvas.evaluate(c => c.toDataURL());
      await canvas.focus();
      const before = await picture();
      await page.keyboard.press("Space");
      check(await picture() !== before, "the comparer doesn't flip");
      await page.keyboard.press("ArrowRight");
      const value = await output.textContent();
      check(/^\(\d+, \d+\): A [\d.e-]+, B [\d.e-]+/.test(value), "no values of a pixel: " + value);
      for (const [key, mode] of [["s", "split"], ["e", "error"], ["f", "flip"]]) {
        await page.keyboard.press(key);
        check(await page.locator(".comparer select").nth(2).evaluate(e => e.selectedOptions[0].textContent) === mode, "mode " + mode);
      }
      const width = () => canvas.evaluate(c => c.getBoundingClientRect().width);
      const narrow = await width();
      await page.keyboard.press("+");
      check(await width() > narrow, "the comparer doesn't zoom");
    }
    planted = true;
    check(!(await page.evaluate(plantScript)), "a script that is not the page's runs: its Content-Security-Policy does nothing");
    planted = false;
    await page.setViewportSize({ width: 400, height: 800 });
    const sides = await page.evaluate(() => [document.documentElement.scrollWidth, document.body.scrollWidth, innerWidth]);
    check(sides[0] <= sides[2] && sides[1] <= sides[2], `at 400 pixels the page is ${sides} wide`);
    const broken = await page.evaluate(() => [...document.querySelectorAll(".name:first-child")].filter(e => e.checkVisibility() && e.textContent.length > 5 && e.clientWidth < 60).map(e => e.textContent));
    check(broken.length === 0, `at 400 pixels ${broken.length} names have a few letters a line, first ${broken[0]}`);
    const cut = await page.evaluate(() => [...document.querySelectorAll("sup, .pm")].filter(e => e.getClientRects().length > 1).map(e => e.textContent));
    check(cut.length === 0, `at 400 pixels ${cut.length} numbers go on in the next line, first ${cut[0]}`);
    // The page hears of its new width some frames later.
    const wide = () => [...document.querySelectorAll(".plot > svg")].filter(s => s.viewBox.baseVal.width > 400).length;
    let small = await page.evaluate(wide); // playwright's own waiting needs eval, which the page's policy forbids
    for (let waits = 0; small && waits < 600; waits++) {
      await new Promise(resolve => setTimeout(resolve, 100));
      small = await page.evaluate(wide);
    }
    check(small === 0, `${small} charts are not drawn again for a narrow window`);
    if (screenshots) await page.screenshot({ path: `${screenshots}/${colorScheme}-400.png`, fullPage: true });
    const sheet = data.format === "koksma-datasheet", folds = await page.evaluate(() => [...document.querySelectorAll("details")].map(d => d.open));
    for (const width of sheet ? [400, 1280] : []) {
      await page.setViewportSize({ width, height: 900 });
      const found = await page.evaluate(cramped, ".scroll");
      check(!found.length, `at ${width} pixels broken or too wide: ${found.join("; ")}`);
    }
    await page.evaluate(open => document.querySelectorAll("details").forEach((d, i) => { d.open = open[i]; }), folds);
    await page.setViewportSize({ width: 1280, height: 900 });
    // The charts of the whole width are drawn again some frames later: wait until the widest has more than a narrow window's width.
    const drawn = () => { const charts = [...document.querySelectorAll(".chart")].map(c => c.viewBox.baseVal.width); return !charts.length || Math.max(...charts) > 400; };
    let again = await page.evaluate(drawn);
    for (let waits = 0; !again && waits < 600; waits++) {
      await new Promise(resolve => setTimeout(resolve, 100));
      again = await page.evaluate(drawn);
    }
    check(again, "charts are not drawn again for a wide window");
    if (screenshots) await page.screenshot({ path: `${screenshots}/${colorScheme}.png`, fullPage: true });
    if (colorScheme === "light") { // printed, nothing is folded, and nothing is cut off at the side of a page
      await page.emulateMedia({ media: "print" });
      const wide = await page.evaluate(() => { // a window's chart on paper would have letters of half their size
        const most = () => Math.max(0, ...[...document.querySelectorAll(".chart")].map(chart => chart.viewBox.baseVal.width)), before = most();
        dispatchEvent(new Event("beforeprint"));
        const printed = most();
        dispatchEvent(new Event("afterprint"));
        return [before, printed, most(), [...document.querySelectorAll(".commands button")].filter(b => b.checkVisibility()).length];
      });
      check(wide[1] <= 700 && wide[0] === wide[2] && !wide[3], `charts are ${wide[1]} wide on paper, ${wide[0]} before and ${wide[2]} after; ${wide[3]} buttons`);
      await page.setViewportSize({ width: 718, height: 1000 }); // A4 without its margins
      const cut = await page.evaluate(() => {
        dispatchEvent(new Event("beforeprint"));
        const found = [document.querySelectorAll("#evidence details:not([open], .choice)").length,
          [...document.querySelectorAll("#evidence table.many, #evidence .stage")].filter(e => e.getBoundingClientRect().right > innerWidth + 1).length,
          [...document.querySelectorAll("#evidence thead th")].filter(th => th.textContent && (th.firstElementChild?.checkVisibility() || // a button is printed once
            (th.firstElementChild ? getComputedStyle(th, "::before").content !== JSON.stringify(th.textContent) : false))).length];
        dispatchEvent(new Event("afterprint"));
        return found;
      });
      check(cut[0] === 0 && cut[1] === 0 && cut[2] === 0, `printed, ${cut[0]} parts are folded, ${cut[1]} are cut off, and ${cut[2]} heads of columns are not repeated`);
      await page.emulateMedia({ media: "screen" });
    }
    if (screenshots && colorScheme === "light") await page.pdf({ path: `${screenshots}/print.pdf` });
  }
  const plain = await (await browser.newContext({ javaScriptEnabled: false })).newPage();
  await plain.goto("file://" + fs.realpathSync(report));
  check(/needs JavaScript.*in this file/.test(await plain.locator("body").innerText()), "nothing is said without JavaScript");
  await browser.close();
  problems.forEach(p => console.log(p));
  console.log(`${longTables / 2} long tables, ${problems.length} problems`);
  process.exit(problems.length ? 1 : 0);
})();

// SPDX-License-Identifier: Apache-2.0
// chromium.js REPORT [SCREENSHOTS]: opens a report in headless Chromium: no console error, every picture loads, no network,
// the comparer works by keyboard, all pictures have texts, text has contrast, in light and dark. Exit code 77: skipped.
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
const check = (good, text) => { if (!good) problems.push(text); };

// What report.json has of each kind.
const data = JSON.parse(fs.readFileSync(report.replace(/html$/, "json"), "utf8"));
const blocksOf = content => content.flatMap(b => [b, ...blocksOf(b.content ?? [])]);
const all = blocksOf(data.content), of = kind => all.filter(b => b.kind === kind), sum = list => list.reduce((a, b) => a + b, 0);
const expected = {
  headings: of("section").filter(b => !b.collapsed).length, details: of("section").filter(b => b.collapsed).length,
  paragraphs: of("paragraph").length + (data.about ? 1 : 0) + of("table").length, tables: of("table").length,
  rows: sum(of("table").map(b => b.rows.length)), charts: of("chart").length, lines: sum(of("list").map(b => b.items.length)),
  marks: sum(of("chart").flatMap(b => b.series.slice(0, 24).filter(s => s.style !== "theory").map(s =>
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
        [...document.querySelectorAll("svg:not(svg svg), canvas")].filter(s => !s.getAttribute("aria-label")).length,
      unlabelled: [...document.querySelectorAll("select, button")].filter(s => !(s.labels?.length || s.textContent.trim())).length,
      ids: [...document.querySelectorAll("[id]")].map(e => e.id).filter((id, i, all) => all.indexOf(id) !== i),
      wide: document.documentElement.scrollWidth > innerWidth,
      language: document.documentElement.lang, title: document.title,
      csv: [...document.querySelectorAll("a[download]")].map(a => ({ name: a.download, text: a.href })),
    }));
    const shown = await page.evaluate(() => {
      const count = selector => document.querySelectorAll(selector).length;
      return {
        headings: count("main h2, main h3, main h4, main h5, main h6"), details: count("details"), paragraphs: count("main p"),
        tables: count("main table"), rows: count("main tbody tr"), charts: count(".plot > svg.chart"), lines: count("main li"),
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
    const cells = line => line.replace(/"([^"]|"")*"/g, "").split(",").length;
    facts.csv.forEach(({ name, text }, i) => {
      const table = of("table")[i], lines = decodeURIComponent(text.replace(/^[^,]*,/, "")).split("\r\n");
      check(name === table.name + ".csv" && lines.length === table.rows.length + 2, `${name} has ${lines.length - 2} rows`);
      check(lines[0].startsWith(`"${table.columns[0].name}"`) && lines.slice(1, -1).every(l => cells(l) === cells(lines[0])), `${name}: ${lines.slice(0, 2)}`);
    });
    check(facts.csv.length === expected.tables, `${facts.csv.length} CSV files`);
    (await page.evaluate(contrasts)).forEach(text => check(false, colorScheme + ": " + text));
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
    // The page hears of its new width some frames later.
    const wide = () => [...document.querySelectorAll(".plot > svg")].filter(s => s.viewBox.baseVal.width > 400).length;
    let small = await page.evaluate(wide); // playwright's own waiting needs eval, which the page's policy forbids
    for (let waits = 0; small && waits < 600; waits++) {
      await new Promise(resolve => setTimeout(resolve, 100));
      small = await page.evaluate(wide);
    }
    check(small === 0, `${small} charts are not drawn again for a narrow window`);
    if (screenshots) await page.screenshot({ path: `${screenshots}/${colorScheme}-400.png`, fullPage: true });
    await page.setViewportSize({ width: 1280, height: 900 });
    if (screenshots) await page.screenshot({ path: `${screenshots}/${colorScheme}.png`, fullPage: true });
    if (screenshots && colorScheme === "light") await page.pdf({ path: `${screenshots}/print.pdf` });
  }
  const plain = await (await browser.newContext({ javaScriptEnabled: false })).newPage();
  await plain.goto("file://" + fs.realpathSync(report));
  check(/needs JavaScript.*report\.json/.test(await plain.locator("body").innerText()), "nothing is said without JavaScript");
  await browser.close();
  problems.forEach(p => console.log(p));
  console.log(`${problems.length} problems`);
  process.exit(problems.length ? 1 : 0);
})();

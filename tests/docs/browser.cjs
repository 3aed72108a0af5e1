// SPDX-License-Identifier: Apache-2.0
// browser.cjs SITE: every page of make docs in headless Chromium, opened from disk: none is wider than a window of 400 px, in
// dark mode text can be read (WCAG 2.1: 4.5 to 1), and the search finds by keyboard. Exit code 77: no browser.
"use strict";
const fs = require("fs");
const path = require("path");
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(p => fs.existsSync(p));
let playwright;
try { playwright = require(require.resolve("playwright-core", { paths: [process.env.KOKSMA_NODE || "."] })); } catch { playwright = null; }
if (!chromium || !playwright) process.exit(77);
const site = fs.realpathSync(process.argv[2]), problems = [];
const pages = fs.readdirSync(site, { recursive: true }).filter(file => file.endsWith(".html") && file !== "explorer.html");

const contrasts = () => {
  const parse = c => (c.match(/[\d.]+/g) || []).map(Number), found = new Set();
  const light = rgb => rgb.slice(0, 3).map(v => v / 255).map(v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const papers = new Map(); // what is behind an element, of each once
  const behind = e => {
    if (!e) return [255, 255, 255];
    if (!papers.has(e)) { const c = parse(getComputedStyle(e).backgroundColor); papers.set(e, c.length === 3 || c[3] > 0 ? c : behind(e.parentElement)); }
    return papers.get(e);
  };
  for (const e of document.querySelectorAll("body *")) {
    if (![...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim()) || !e.checkVisibility()) continue;
    const [ink, paper] = [light(parse(getComputedStyle(e).color)), light(behind(e))];
    const ratio = (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
    if (ratio < 4.5) found.add(`${e.tagName} "${e.textContent.slice(0, 20)}": contrast ${ratio.toFixed(2)}`);
  }
  return [...found];
};

(async () => {
  const browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  const page = await (await browser.newContext({ viewport: { width: 400, height: 800 }, colorScheme: "dark" })).newPage();
  page.on("pageerror", e => problems.push("error: " + e.stack));
  page.on("request", r => { if (!r.url().startsWith("file:")) problems.push("network: " + r.url()); });
  for (const file of pages) {
    await page.goto("file://" + path.join(site, file), { waitUntil: "domcontentloaded" });
    const width = await page.evaluate(() => { document.querySelectorAll("details").forEach(node => { node.open = true; }); return document.documentElement.scrollWidth; });
    if (width > 400) problems.push(`${file}: ${width} px wide in a window of 400`);
    (await page.evaluate(contrasts)).forEach(text => problems.push(`${file}: ${text}`));
  }
  // Printed from a dark browser, a page has dark letters and nothing folded.
  const printed = await (await browser.newContext({ colorScheme: "dark", viewport: { width: 718, height: 1000 } })).newPage();
  await printed.goto("file://" + path.join(site, "patterns/n-rooks.html"));
  await printed.emulateMedia({ media: "print", colorScheme: "dark" });
  const [ink, folded] = await printed.evaluate(() => {
    dispatchEvent(new Event("beforeprint"));
    return [getComputedStyle(document.querySelector("main p")).color, document.querySelectorAll("main details:not([open])").length];
  });
  if (Math.max(...ink.match(/\d+/g).slice(0, 3)) > 120) problems.push(`printed from a dark browser, letters are ${ink}`);
  if (folded) problems.push(`${folded} parts are printed folded`);
  await printed.close();
  // From a page in a folder, by keyboard: the first of what is found is the page of that name.
  for (const [query, wanted] of [["l2-star", "measures/l2-star.html"], ["koksma rank", "commands/rank.html"], ["koksma_generate", "c/koksma.html#koksma_generate"],
    ["spectrum python", "python/index.html#spectrum"], ["lens_radius", "guide/scenes.html"], ["how do I rank my scene", "guide/tutorial.html#4-the-ranked-list"]]) {
    await page.goto("file://" + path.join(site, "patterns/n-rooks.html"));
    for (let i = 0; i < 20 && !await page.evaluate(() => document.activeElement.type === "search"); i++) await page.keyboard.press("Tab");
    await page.keyboard.type(query);
    await page.waitForSelector("#found a");
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    if (width > 400) problems.push(`the search for ${query} makes the page ${width} px wide`);
    await page.keyboard.press("Enter");
    await page.waitForFunction(from => location.href !== from, "file://" + path.join(site, "patterns/n-rooks.html"));
    const at = decodeURI(page.url()).replace(`file://${site}/`, "");
    if (!at.startsWith(wanted)) problems.push(`the search for "${query}" leads to ${at}, not ${wanted}`);
  }
  // The key / goes to the search from anywhere; one wrong letter is answered with the word, which Enter then searches for, and
  // nothing is said before the index, here a slow one, is there. A name with a space for its hyphen is the name.
  for (const [query, wanted] of [["sobl", "sobol"], ["jitterd", "jittered"]]) {
    await page.goto("file://" + path.join(site, "index.html"));
    await page.keyboard.press("/");
    await page.evaluate(() => { // the script of the index waits for `arrive`
      const { head } = document;
      head.append = node => { globalThis.arrive = () => Element.prototype.append.call(head, node); };
    });
    await page.keyboard.type(query);
    if (await page.locator("#found li").count()) problems.push(`the search for ${query} answers before its index is there`);
    await page.evaluate(() => globalThis.arrive());
    await page.waitForSelector("#found li");
    if (!(await page.locator("#found").textContent()).includes(`did you mean ${wanted}?`)) problems.push(`the search for ${query} does not suggest ${wanted}`);
    else {
      await page.keyboard.press("Enter");
      if (await page.locator("#search input").inputValue() !== wanted || !await page.locator("#found a").count()) problems.push(`the suggestion ${wanted} is not searched for`);
    }
  }
  await page.goto("file://" + path.join(site, "index.html"));
  await page.keyboard.press("/");
  await page.keyboard.type("min distance");
  await page.waitForSelector("#found a");
  if (!(await page.locator("#found a").first().getAttribute("href")).endsWith("measures/min-distance.html")) problems.push("the search for min distance does not begin with its page");
  // The pictures of a scene are side by side: two in a row of 400 px, all five in one of 1280. A scene whose files are in a
  // Debian package that is not installed has that as the reason in place of each picture.
  await page.goto("file://" + path.join(site, "gallery/index.html"));
  for (const [width, wanted] of [[400, 2], [1280, 5]]) {
    await page.setViewportSize({ width, height: 800 });
    const rows = await page.evaluate(() => [...document.querySelectorAll(".gallery")].filter(scene => scene.querySelector("img")).map(scene => {
      const tops = [...scene.querySelectorAll("img")].map(image => image.getBoundingClientRect().top);
      return tops.filter(top => top === tops[0]).length;
    }));
    if (!rows.length || rows.some(n => n !== wanted)) problems.push(`gallery at ${width} px: ${rows} pictures in the first rows, not ${wanted}`);
  }
  const missing = await page.evaluate(() => [...document.querySelectorAll(".gallery .none")].map(reason => reason.textContent));
  problems.push(...missing.filter(reason => !/the Debian package \S+ contains it$/.test(reason)).map(reason => `gallery: ${reason}`));
  await page.setViewportSize({ width: 400, height: 800 });
  await page.goto("file://" + path.join(site, "index.html"));
  await page.locator("#search input").fill("zzxxqq");
  await page.waitForSelector("#found li");
  if (!(await page.locator("#found").textContent()).startsWith("Nothing has")) problems.push("nonsense is found");
  await browser.close();
  problems.forEach(text => console.log(text));
  process.exit(problems.length ? 1 : 0);
})();

// SPDX-License-Identifier: Apache-2.0
// first_hour.cjs OUT PAGE...: pages in headless Chromium at 400 and 1280 px, light and dark, with a picture of each in OUT: none
// scrolls sideways, text can be read (WCAG 2.1: 4.5 to 1), dark pages are dark, no script fails, and the Tab key reaches every
// kind of control, all of which show that they have the focus. Exit code 77: no browser.
"use strict";
const fs = require("fs");
const path = require("path");
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(p => fs.existsSync(p));
let playwright;
try { playwright = require(require.resolve("playwright-core", { paths: [process.env.KOKSMA_NODE || "."] })); } catch { playwright = null; }
if (!chromium || !playwright) {
  console.log("skipped: " + (chromium ? "playwright-core" : "Chromium") + " is not installed (scripts/setup browser)");
  process.exit(77);
}
const [out, ...files] = process.argv.slice(2), problems = [];

const look = () => {
  const parse = c => (c.match(/[\d.]+/g) || []).map(Number), dim = new Set();
  const light = rgb => rgb.slice(0, 3).map(v => v / 255).map(v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4).reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const behind = e => { for (; e; e = e.parentElement) { const c = parse(getComputedStyle(e).backgroundColor); if (c.length === 3 || c[3] > 0) return c; } return [255, 255, 255]; };
  for (const e of document.querySelectorAll("body *")) {
    if (![...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim()) || !e.checkVisibility() || e.closest("svg, :disabled")) continue;
    const [ink, paper] = [light(parse(getComputedStyle(e).color)), light(behind(e))];
    if ((Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05) < 4.5) dim.add(`${e.tagName} "${e.textContent.slice(0, 20)}"`);
  }
  return { width: document.documentElement.scrollWidth, window: innerWidth, paper: light(behind(document.body)), dim: [...dim] };
};

// What has the focus: its kind, and whether that shows.
const focus = () => {
  const e = document.activeElement, style = getComputedStyle(e);
  return { kind: e.localName, id: [...document.querySelectorAll("*")].indexOf(e), seen: style.outlineStyle !== "none" || style.boxShadow !== "none" };
};

(async () => {
  const browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  for (const file of files) for (const width of [400, 1280]) for (const colorScheme of ["light", "dark"]) {
    const name = path.basename(file, ".html"), label = `${name} at ${width} px, ${colorScheme}`;
    const page = await (await browser.newContext({ colorScheme, viewport: { width, height: 900 } })).newPage();
    page.setDefaultTimeout(600000); // a busy machine takes more than the usual 30 s for a page
    page.on("pageerror", e => problems.push(`${label}: ${e.message}`));
    await page.goto("file://" + path.resolve(file));
    await page.waitForSelector("body:not(.starting)"); // the explorer loads the library first
    const seen = await page.evaluate(look);
    if (seen.width > seen.window) problems.push(`${label}: ${seen.width} px wide`);
    if (colorScheme === "dark" ? seen.paper > 0.1 : seen.paper < 0.8) problems.push(`${label}: the page is not ${colorScheme}`);
    seen.dim.forEach(text => problems.push(`${label}: too little contrast: ${text}`));
    await page.screenshot({ path: `${out}/${name}-${width}-${colorScheme}.png` });
    const kinds = await page.evaluate(() => [...new Set([...document.querySelectorAll("a[href], button, input, select, summary, [tabindex='0']")].filter(e => e.checkVisibility() && !e.disabled).map(e => e.localName))]);
    const reached = new Map();
    for (let i = 0; i < 1000 && kinds.some(kind => !reached.has(kind)); i++) {
      await page.keyboard.press("Tab");
      const at = await page.evaluate(focus);
      if (!at.seen && at.kind !== "body") problems.push(`${label}: ${at.kind} does not show the focus`);
      reached.set(at.kind, at.id);
    }
    kinds.filter(kind => !reached.has(kind)).forEach(kind => problems.push(`${label}: Tab reaches no ${kind}`));
    console.log(`${label}: ${kinds.join(", ")}`);
    await page.close();
  }
  await browser.close();
  [...new Set(problems)].forEach(text => console.log(text));
  console.log(`${problems.length} problems`);
  process.exit(problems.length ? 1 : 0);
})();

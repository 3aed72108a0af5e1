// SPDX-License-Identifier: Apache-2.0
// chromium.js SHEET.html: the page of a datasheet shows all sections, verdict first, without errors, without a sideways scroll
// of page or tables at 400 pixels, and without a word of a table on two lines, in both colour schemes; the keyboard alone
// opens the commands. Exit code 77: no Chromium.
"use strict";
const path = require("path");
const fs = require("fs");
const chromium = "/usr/bin/chromium";
let playwright;
try {
  playwright = require(require.resolve("playwright-core", { paths: [process.env.KOKSMA_NODE] }));
} catch {
  console.log("skipped: no playwright-core (scripts/setup browser)");
  process.exit(77);
}
if (!fs.existsSync(chromium)) {
  console.log("skipped: no chromium (scripts/setup browser)");
  process.exit(77);
}
// Words of tables that are broken within: letters or digits on two lines.
const brokenWords = () => {
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), broken = new Set();
  while (texts.nextNode()) {
    const text = texts.currentNode, range = document.createRange();
    if (!text.parentElement.closest("td, th")) continue;
    for (const { 0: word, index } of text.data.matchAll(/[\p{L}\p{N}]+/gu)) {
      range.setStart(text, index), range.setEnd(text, index + word.length);
      if (new Set([...range.getClientRects()].map(box => Math.round(box.top))).size > 1) broken.add(word);
    }
  }
  return [...broken];
};

let problems = 0;
const expect = (holds, text) => {
  if (!holds) problems++, console.log(text);
};

async function look(browser, width, colorScheme) {
  const page = await browser.newPage({ viewport: { width, height: 900 }, colorScheme }), at = `${width} px, ${colorScheme}`;
  page.on("pageerror", error => expect(false, `${at}: ${error}`));
  page.on("console", message => expect(message.type() !== "error", `${at}: ${message.text()}`));
  await page.goto("file://" + path.resolve(process.argv[2]));
  const heads = await page.locator("h2").allTextContents();
  const wanted = ["Verdict", "Points", "Errors in scenes", "Discrepancies and distances", "Errors of integration", "Spectra and distances", "Verified properties", "How this was made"];
  expect(heads.filter(h => wanted.includes(h)).join() === wanted.join(), `${at}: sections ${heads}`);
  // One at a time, by the keyboard: the focus goes to a list of commands, Enter opens it.
  await page.locator(".commands summary").first().focus();
  await page.keyboard.press("Enter");
  expect(await page.locator(".commands pre").first().isVisible(), `${at}: Enter opens no commands`);
  await page.keyboard.press("Tab");
  expect((await page.evaluate(() => document.activeElement.textContent)).startsWith("koksma "), `${at}: Tab does not lead to the commands`);
  await page.keyboard.press("Tab");
  expect(await page.evaluate(() => document.activeElement.textContent) === "copy", `${at}: Tab does not lead to the button that copies`);
  await page.evaluate(() => document.querySelectorAll("details").forEach(d => { d.open = true; }));
  const wide = await page.evaluate(() => [document.documentElement, ...document.querySelectorAll(".scroll")]
    .filter(e => e.scrollWidth > e.clientWidth + 1).map(e => `${e.getAttribute("aria-label") ?? "the page"} ${e.scrollWidth} > ${e.clientWidth}`));
  expect(!wide.length, `${at}: scrolls sideways: ${wide.join("; ")}`);
  const broken = await page.evaluate(brokenWords);
  expect(!broken.length, `${at}: words on two lines: ${broken.join(" ")}`);
  const charts = await page.locator("svg.chart").count();
  expect(charts >= 12, `${at}: ${charts} charts`);
  const [ink, paper] = await page.evaluate(() => [getComputedStyle(document.body).color, getComputedStyle(document.body).backgroundColor]
    .map(c => c.match(/\d+/g).slice(0, 3).reduce((sum, v) => sum + +v, 0)));
  expect(colorScheme === "dark" ? ink > paper + 300 : paper > ink + 300, `${at}: ink ${ink}, paper ${paper}`);
  await page.close();
}

(async () => {
  const browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  for (const width of [400, 1280]) for (const scheme of ["light", "dark"]) await look(browser, width, scheme);
  await browser.close();
  process.exit(problems ? 1 : 0);
})();

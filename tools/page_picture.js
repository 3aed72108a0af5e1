// SPDX-License-Identifier: Apache-2.0
// page_picture.js FILE[#HASH] PICTURE.png WIDTHxHEIGHT: a page in headless Chromium as a picture, once it has not
// changed for two seconds. playwright-core is taken from build/node (scripts/setup browser).
"use strict";
const path = require("path");
const playwright = require(require.resolve("playwright-core", { paths: [path.join(__dirname, "../build/node")] }));
const [file, picture, size] = process.argv.slice(2), [width, height] = size.split("x").map(Number);

(async () => {
  const browser = await playwright.chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
  const page = await browser.newPage({ viewport: { width, height } });
  await page.goto("file://" + path.resolve(file));
  let before = "", now = await page.content();
  while (now !== before) {
    await page.waitForTimeout(2000);
    [before, now] = [now, await page.content()];
  }
  await page.screenshot({ path: picture });
  await browser.close();
})();

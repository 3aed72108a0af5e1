// SPDX-License-Identifier: Apache-2.0
// chromium.js FOLDER: prints the pages of an atlas that, or whose tables, are wider than a window of 400 pixels. playwright-core is
// in $KOKSMA_NODE (scripts/setup browser).
"use strict";
const fs = require("fs");
const path = require("path");
const playwright = require(require.resolve("playwright-core", { paths: [process.env.KOKSMA_NODE] }));

(async () => {
  const browser = await playwright.chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
  const page = await browser.newPage({ viewport: { width: 400, height: 800 }, isMobile: true });
  for (const name of fs.readdirSync(process.argv[2], { recursive: true }).filter(n => n.endsWith(".html") && !n.startsWith("sheets"))) {
    await page.goto("file://" + path.resolve(process.argv[2], name));
    const wide = await page.evaluate(() => [document.scrollingElement, ...document.querySelectorAll(".scroll")]
      .filter(e => e.scrollWidth > Math.min(e.clientWidth, 400)).map(e => e.scrollWidth));
    if (wide.length) console.log(`${name}: ${wide} pixels wide`);
  }
  await browser.close();
})();

// SPDX-License-Identifier: Apache-2.0
// path_tracer.cjs PORTS FOLDER [PICTURE]: PORTS/glsl/path_tracer.html in Chromium (WebGL 2). From pictures of two seeds, whose
// difference has twice the variance of one: the error of random numbers falls as N^-1/2, that of Sobol' samples faster and is
// less; both pictures have one mean; samples added in steps are those of one pass. By keyboard, another seed makes another
// picture; nothing scrolls sideways at 400 px. PICTURE receives a screenshot. Exit code 77: Chromium, playwright-core (in
// FOLDER) or WebGL 2 is not there.
const fs = require("fs");
const [ports, modules, picture] = process.argv.slice(2);
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(p => fs.existsSync(p));
let playwright;
try { playwright = require(require.resolve("playwright-core", { paths: [modules] })); } catch { playwright = null; }
const skip = why => { console.log("skipped: " + why); process.exit(77); };
if (!chromium || !playwright) skip((chromium ? "playwright-core" : "Chromium") + " is not installed (scripts/setup browser)");

const SIZE = 40, problems = [];
const mean = xs => xs.reduce((sum, x) => sum + x, 0) / xs.length;

// The halves of a picture, random and Sobol', as means of the samples: numbers of three channels each.
function halves(sums) {
  const of = [[], []];
  for (let p = 0; p < 2 * SIZE * SIZE; p++) {
    for (let c = 0; c < 3; c++) of[p % (2 * SIZE) < SIZE ? 0 : 1].push(sums[4 * p + c] / sums[4 * p + 3]);
  }
  return of;
}

// The RMS error of a picture, without the few pixels that see the light, whose edges would be most of it.
let light = [];
const error = (a, b) => Math.sqrt(mean(a.map((x, k) => (x - b[k]) ** 2).filter((_, k) => light[k] < 1)) / 2);
const check = (holds, text) => { console.log(text); if (!holds) problems.push(text); };

(async () => {
  const browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader"] });
  const page = await browser.newPage({ viewport: { width: 400, height: 800 } });
  page.on("pageerror", e => problems.push(e.message));
  await page.route("https://koksma.invalid/*", route => route.fulfill({
    contentType: "text/html", body: fs.readFileSync(`${ports}/glsl/${new URL(route.request().url()).pathname}`, "utf8") }));
  const open = async (samples, seed, step, size = SIZE) => {
    await page.goto(`https://koksma.invalid/path_tracer.html?size=${size}&samples=${samples}&seed=${seed}&step=${step}`);
    const missing = await page.waitForFunction(() => document.body.dataset.done || document.getElementById("said").textContent.startsWith("This browser"), null, { timeout: 200000 });
    if ((await missing.jsonValue()).toString() === "true") { await browser.close(); skip("no WebGL 2 with float textures"); }
    return Array.from(await page.evaluate(() => globalThis.sums()));
  };
  const rows = {};
  for (const n of [256, 16]) {
    const [a, b] = [halves(await open(n, 1, 16)), halves(await open(n, 2, 16))];
    if (n === 256) light = a[1];
    rows[n] = [0, 1].map(k => ({ error: error(a[k], b[k]), mean: (mean(a[k]) + mean(b[k])) / 2 }));
    console.log(`${n} samples: error ${rows[n].map(r => r.error.toFixed(5)).join(" and ")}, mean ${rows[n].map(r => r.mean.toFixed(5)).join(" and ")}`);
  }
  const falls = [0, 1].map(k => rows[16][k].error / rows[256][k].error);
  check(Math.abs(falls[0] / 4 - 1) < 0.1, `random: the error of 16 times the samples falls by ${falls[0].toFixed(2)}, expected 4`);
  check(falls[1] > 4.4, `Sobol': it falls by ${falls[1].toFixed(2)}, more than 4.4`);
  check(rows[256][1].error < 0.7 * rows[256][0].error, `Sobol' has ${(rows[256][1].error / rows[256][0].error).toFixed(2)} of the error of random at 256 samples`);
  // The mean over 2 pictures of SIZE^2 pixels of equal error; channels of a pixel are one sample.
  const noise = Math.hypot(rows[256][0].error, rows[256][1].error) / Math.sqrt(2 * SIZE * SIZE);
  check(Math.abs(rows[256][0].mean - rows[256][1].mean) < 5 * noise, `the means differ by ${((rows[256][0].mean - rows[256][1].mean) / noise).toFixed(1)} standard errors`);
  const [whole, steps] = [await open(16, 1, 16), await open(16, 1, 3)];
  const apart = Math.max(...whole.map((x, k) => Math.abs(x - steps[k]) / (1 + Math.abs(x))));
  check(apart < 1e-5, `16 samples at once and in steps of 3 differ by ${apart.toExponential(1)} at most`);
  for (let i = 0; i < 5 && !await page.evaluate(() => document.activeElement.id === "again"); i++) await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.body.dataset.done === "2", null, { timeout: 200000 });
  const other = halves(Array.from(await page.evaluate(() => globalThis.sums()))), known = halves(steps);
  check(error(other[1], known[1]) > 0.5 * rows[16][1].error, "another seed, by keyboard, makes another picture");
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  check(width <= 400, `${width} px wide in a window of 400`);
  if (picture) {
    await page.setViewportSize({ width: 1000, height: 720 });
    await open(16, 7, 4, 240);
    await page.screenshot({ path: picture });
  }
  await browser.close();
  problems.forEach(text => console.log("wrong: " + text));
  process.exit(problems.length ? 1 : 0);
})();

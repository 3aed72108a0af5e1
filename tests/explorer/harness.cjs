// SPDX-License-Identifier: Apache-2.0
// What the checks of the page share: the browser, the program, and the comparison of the two. Arguments and exit code are page.cjs's.
"use strict";
const fs = require("fs");
const os = require("os");
const path = require("path");
const { execFileSync, execSync } = require("child_process");
const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(p => fs.existsSync(p));
let playwright;
try { playwright = require(require.resolve("playwright-core", { paths: [process.env.KOKSMA_NODE || ".", "."] })); } catch { playwright = null; }
if (!chromium || !playwright) {
  console.log("skipped: " + (chromium ? "playwright-core" : "Chromium") + " is not installed (scripts/setup browser)");
  process.exit(77);
}
const [program, html, screenshots] = process.argv.slice(2).map(p => fs.realpathSync(p));
const address = "file://" + html;
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "koksma-explorer-"));
fs.mkdirSync(path.join(folder, "bin"));
fs.symlinkSync(program, path.join(folder, "bin/koksma"));
const problems = [];
let checks = 0;
const check = (good, text) => { checks++; if (!good) problems.push(text); };
const run = (...words) => execFileSync(program, words.map(String), { encoding: "utf8", stdio: ["ignore", "pipe", "pipe"], cwd: folder });
const refusal = (...words) => { try { run(...words); return ""; } catch (error) { return error.stderr.trim(); } };
const jsonLines = text => text.trim().split("\n").map(line => JSON.parse(line));
const records = (...words) => jsonLines(run(...words, "--json"));
const rounded = (value, digits) => value === null ? null : +value.toPrecision(digits);

// Text against what is behind it, as WCAG 2.1 counts it; names of pictures and controls; ids.
const accessibility = () => {
  const found = [], parse = c => (c.match(/[\d.]+/g) || []).map(Number);
  const light = ([r, g, b]) => [r, g, b].map(v => v / 255).map(v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const behind = e => { for (; e; e = e.parentElement) { const c = parse(getComputedStyle(e).backgroundColor); if (c.length === 3 || c[3] > 0) return c; } return [255, 255, 255]; };
  for (const e of document.querySelectorAll("body *")) {
    if (![...e.childNodes].some(n => n.nodeType === 3 && n.textContent.trim()) || !e.checkVisibility() || e.disabled) continue;
    const style = getComputedStyle(e), ink = light(parse(e instanceof SVGElement ? style.fill : style.color)), paper = light(behind(e));
    const ratio = (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
    if (ratio < 4.5) found.push(`${e.tagName} "${e.textContent.slice(0, 20)}": contrast ${ratio.toFixed(2)}`);
  }
  for (const e of document.querySelectorAll("canvas, img, body > svg, :not(svg, g) > svg")) if (e.checkVisibility() && !e.getAttribute("aria-label") && !e.alt) found.push(`${e.outerHTML.slice(0, 60)}: no name`);
  for (const e of document.querySelectorAll("input, select, button, textarea")) if (!e.labels?.length && !e.textContent.trim()) found.push(`${e.outerHTML.slice(0, 60)}: no label`);
  const ids = [...document.querySelectorAll("[id]")].map(e => e.id);
  ids.filter((id, i) => ids.indexOf(id) !== i).forEach(id => found.push(`id ${id} twice`));
  for (const e of document.querySelectorAll("[aria-labelledby], [aria-describedby]")) {
    for (const id of `${e.getAttribute("aria-labelledby") || ""} ${e.getAttribute("aria-describedby") || ""}`.trim().split(" ")) if (!document.getElementById(id)) found.push(`no id ${id}`);
  }
  if (document.documentElement.scrollWidth > innerWidth) found.push(`the page is ${document.documentElement.scrollWidth} wide, the window ${innerWidth}`);
  if (!document.documentElement.lang || !document.title || document.querySelectorAll("h1").length !== 1) found.push("language, title or h1");
  return [...new Set(found)];
};

// Waits for a condition in the page. Playwright's own waiting needs eval, which the page's Content-Security-Policy forbids.
async function until(page, condition) {
  for (let waits = 0; !(await page.evaluate(condition)); waits++) {
    if (waits === 4800) throw new Error(`not reached: ${condition}`);
    await new Promise(resolve => setTimeout(resolve, 50));
  }
}

async function open(browser, { hash = "#a=n-rooks@16", colorScheme = "light", width = 1280, before, limit_s } = {}) {
  const context = await browser.newContext({ colorScheme, viewport: { width, height: 900 }, acceptDownloads: true });
  const page = await context.newPage();
  page.on("console", m => check(!["error", "warning"].includes(m.type()), "console: " + m.text()));
  page.on("pageerror", e => check(false, "error: " + e.stack));
  page.on("request", r => check(/^(file|data|blob):/.test(r.url()), "network: " + r.url()));
  if (before) await page.addInitScript(before);
  await page.goto(address + hash);
  if (limit_s) {
    await until(page, () => globalThis.koksmaExplorer && !document.body.classList.contains("starting"));
    await page.evaluate(seconds => koksmaExplorer.limit(seconds), limit_s);
  }
  await idle(page);
  return page;
}
// Another address in the same page, which takes it as it takes the one that it is opened with (go() in main.mjs), but for less
// time: a new page compiles the module again.
const visit = async (page, hash) => {
  await page.evaluate(wanted => { location.hash = wanted; }, hash);
  await idle(page);
};
const idle = page => until(page, () => globalThis.koksmaExplorer && !document.body.classList.contains("starting") && !koksmaExplorer.busy());
const set = async (page, selector, value) => {
  await page.locator(selector).fill(String(value));
  await page.locator(selector).press("Tab");
  await idle(page);
};
const choose = async (page, selector, value) => { await page.locator(selector).selectOption(value); await idle(page); };
// The page's values to nine digits; { why } for a reason, "" for none, "…" for one that is being computed.
const values = async (page, which) => {
  const shown = await page.evaluate(([column, name]) => {
    const full = Object.fromEntries(koksmaExplorer.values(name).map(answer => [answer.measure.split(":")[0], answer.value]));
    return [...document.querySelectorAll("#measures tr")].map(row => ({ name: row.dataset.measure, text: row.cells[column].textContent,
      why: Boolean(row.cells[column].querySelector(".why")), value: full[row.dataset.measure], all: document.getElementById("all-digits").checked }));
  }, [which === "b" ? 2 : 1, which]);
  return Object.fromEntries(shown.map(({ name, text, why, value, all }) => {
    if (value === undefined) return [name, why ? { why: text } : text];
    if (value !== null) check(Number(text) === rounded(value, all ? 9 : 4), `${name} is shown as ${text}, ${value} in full`);
    return [name, rounded(value, 9)];
  }));
};
const unfold = async page => {
  await page.locator("#all-measures").check();
  await idle(page);
};
const saved = async (page, which, button) => {
  const [file] = await Promise.all([page.waitForEvent("download"), page.locator(`.set-${which} button`, { hasText: button }).click()]);
  await file.saveAs(path.join(folder, file.suggestedFilename()));
  return path.join(folder, file.suggestedFilename());
};
const commandLines = async (page, which) => (await page.locator(`#${which}-commands`).textContent()).split("\n");
const shell = line => execSync(line, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"], env: { ...process.env, PATH: `${folder}/bin:${process.env.PATH}` } });

// All values of a set of the page, beside the program's for source.
async function compare(page, which, source, ...args) {
  await unfold(page);
  const ours = await values(page, which), theirs = records("measure", source, "-m", "all", ...args);
  for (const { measure, value } of theirs) {
    check(ours[measure.split(":")[0]] === rounded(value, 9), `${source} ${measure}: page ${JSON.stringify(ours[measure])}, program ${value}`);
  }
  const served = theirs.map(record => record.measure);
  for (const [name, value] of Object.entries(ours)) if (!served.includes(name)) check(value.why, `${source} ${name}: the program doesn't serve it, the page says ${value}`);
  return ours;
}

// The slope of ln y over ln x by least squares.
const slopeOf = pairs => {
  const logs = pairs.map(p => p.map(Math.log)), mean = k => logs.reduce((sum, p) => sum + p[k], 0) / logs.length;
  const [x, y] = [mean(0), mean(1)], moment = f => logs.reduce((sum, [u, v]) => sum + f(u - x, v - y), 0);
  return moment((u, v) => u * v) / moment(u => u * u);
};

// Every command that the page gives for a set runs and says what the page says.
async function commandsAgree(page, which, what) {
  const shown = await values(page, which), slopes = await page.locator(`#decay-text .set-${which}`).innerText();
  if (await page.locator(`.set-${which} button`, { hasText: "Undo moves" }).isEnabled()) await saved(page, which, "Save CSV");
  const kinds = [];
  for (const line of (await commandLines(page, which)).filter(Boolean)) {
    let out = "";
    try { out = shell(/^koksma (plot|generate)/.test(line) ? line : line + " --json"); } catch (error) { check(false, `${what}: ${line}: ${error.stderr}`); continue; }
    const kind = (/--prefixes/.exec(line) || /^koksma \w+/.exec(line))[0], again = kinds.includes(kind);
    kinds.push(again ? "sets" : kind);
    if (kind === "--prefixes" || again) {
      const rows = jsonLines(out), given = rows.find(row => row.measure.startsWith("slope"));
      const slope = given ? given.value : slopeOf(rows.map(row => [row.n, row.value]));
      check(Math.abs(slope - Number((/slope (\S+)/.exec(slopes) || [])[1])) < 2e-3 * Math.abs(slope), `${what}: ${line} has the slope ${slope}; the page: ${slopes}`);
    } else if (kind === "koksma measure") {
      for (const { measure, value } of jsonLines(out)) check(shown[measure.split(":")[0]] === rounded(value, 9), `${what}: ${line}: ${measure} ${value}`);
    }
  }
  return kinds.map(kind => kind.replace("koksma ", "")).join(" ");
}

// All pages closed: what was found, and the exit code.
function report() {
  fs.rmSync(folder, { recursive: true });
  problems.forEach(text => console.log(text));
  console.log(`page: ${checks} checks, ${problems.length} problems`);
  process.exit(problems.length ? 1 : 0);
}

module.exports = {
  accessibility, address, check, choose, chromium, commandLines, commandsAgree, compare, folder, idle, jsonLines, open,
  playwright, records, refusal, report, rounded, run, saved, screenshots, set, shell, unfold, until, values, visit,
};

// SPDX-License-Identifier: Apache-2.0
// package.cjs PROGRAM TGZ: the npm package, installed, beside the program, in Node and in a worker of headless Chromium; samples
// equal those of the patterns that koksma/sampler.h names. Without a browser only Node is tried.
"use strict";
const fs = require("fs");
const http = require("http");
const os = require("os");
const path = require("path");
const { execFileSync } = require("child_process");
const { pathToFileURL } = require("url");
const [program, tgz] = process.argv.slice(2).map(p => fs.realpathSync(p));
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "koksma-npm-"));
const problems = [];
let checks = 0;
const check = (good, text) => { checks++; if (!good) problems.push(text); };
const run = (...words) => execFileSync(program, words.map(String), { encoding: "utf8" });
const jsonLines = text => text.trim().split("\n").map(line => JSON.parse(line));

// What a user does, in a folder of its own.
function install() {
  fs.writeFileSync(path.join(folder, "package.json"), "{}");
  execFileSync("npm", ["install", "--offline", "--no-audit", "--no-fund", "--silent", tgz], { cwd: folder, stdio: "pipe" });
  check(fs.statSync(tgz).size < 2 << 20, "over 2 MiB");
  const code = 'import("@koksma/koksma").then(async ({ koksma }) => { const k = await koksma();' +
    ' console.log(k.measure(k.generate("sobol", { n: 100, seed: 3 }), "star").value_text); })';
  const printed = execFileSync("node", ["-e", code], { cwd: folder, encoding: "utf8" }).trim();
  const [record] = jsonLines(run("measure", "pattern:sobol@100", "--seed", 3, "-m", "star", "--json"));
  check(+printed === +record.value.toPrecision(9), `star: ${printed}, not ${record.value}`);
}

const throws = call => { try { call(); return ""; } catch (error) { return error.constructor.name === "KoksmaError" ? error.message : ""; } };

async function inNode() {
  const k = await (await import(pathToFileURL(path.join(folder, "node_modules/@koksma/koksma/index.mjs")))).open();
  for (const dim of [1, 2, 3, 4]) {
    for (const seed of [0n, 5n, 12345678901234567890n]) {
      const ours = k.samples("sobol", seed, { count: 64, dim });
      const theirs = k.generate("sobol:scramble=hash-owen,shuffle=1", { n: 64, dim, seed }).xs;
      check(ours.every((x, i) => Object.is(x, theirs[i])), `sobol, ${dim} dimensions, key ${seed}`);
    }
  }
  const late = k.samples("pmj02", 9, { first: 32, count: 32 }), all = k.generate("pmj02:shuffle=1", { n: 64, seed: 9 }).xs;
  check(late.every((x, i) => Object.is(x, all[64 + i])), "pmj02");
  check(k.samples("white", k.domainOfUse(k.domainOfPixel(1, 2, 3), 4), { count: 1000, dim: 4 }).every(x => x >= 0 && x < 1), "white");
  check(k.domainOfPixel(1, 2, 3) !== k.domainOfPixel(1, 3, 2) && k.seedOfFrame(1, 2) !== k.seedOfFrame(1, 3) &&
    k.domainOfSample(1, 2) !== k.domainOfSample(1, 3), "domains are equal");
  const mask = k.mask(16, { seed: 2 }), sorted = Uint32Array.from(mask).sort();
  check(sorted.every((rank, i) => rank === i), "the mask is no permutation");
  check(String(mask) !== String(k.mask(16, { seed: 3 })), "masks of two seeds are equal");
  const points = k.generate("sobol", { n: 64, seed: 1 }), file = path.join(folder, "p.csv");
  fs.writeFileSync(file, k.csv(points));
  const theirs = jsonLines(run("verify", file, "--json")), ours = k.verify(points);
  check(ours.length === theirs.length && ours.every((f, i) => f.property === theirs[i].property && f.subject === theirs[i].subject &&
    f.holds === theirs[i].holds), "verify");
  for (const [call, word] of [[() => k.generate("sobl", { n: 4 }), "sobol"], [() => k.generate("sobol", { n: 0 }), "n = 0"],
    [() => k.generate("sobol", { n: 4, seed: -1 }), "seed"], [() => k.samples("pmj02", 1, { count: 4, dim: 3 }), "dim"],
    [() => k.measure({ xs: [1], n: 1, dim: 2 }, "star"), "xs"], [() => k.mask(3), "size"], [() => k.samples("x", 1, { count: 1 }), "pmj02"]])
    check(throws(call).includes(word), `no error with "${word}": ${throws(call)}`);
  return k.measure(points, "star").value;
}

async function inWorker(expected) {
  const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(p => fs.existsSync(p));
  let playwright = null;
  try { playwright = require(require.resolve("playwright-core", { paths: [process.env.KOKSMA_NODE || ".", "."] })); } catch { /* none */ }
  if (!chromium || !playwright) return "without a browser";
  const files = path.join(folder, "node_modules/@koksma/koksma");
  const server = http.createServer((request, answer) => {
    const name = path.basename(request.url), types = { ".mjs": "text/javascript", ".wasm": "application/wasm" };
    if (name === "worker.mjs") {
      answer.setHeader("content-type", "text/javascript");
      answer.end('import { koksma } from "./index.mjs"; const k = await koksma();' +
        ' postMessage(k.measure(k.generate("sobol", { n: 64, seed: 1 }), "star").value);');
    } else if (fs.existsSync(path.join(files, name)) && types[path.extname(name)]) {
      answer.setHeader("content-type", types[path.extname(name)]);
      answer.end(fs.readFileSync(path.join(files, name)));
    } else {
      answer.setHeader("content-type", "text/html");
      answer.end("<!doctype html><title>Koksma</title>");
    }
  });
  await new Promise(resolve => server.listen(0, "127.0.0.1", resolve));
  const browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  const page = await browser.newPage();
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  const value = await page.evaluate(() => new Promise((resolve, reject) => {
    const worker = new Worker("/worker.mjs", { type: "module" });
    worker.onmessage = event => resolve(event.data);
    worker.onerror = event => reject(new Error(event.message || "the worker failed"));
  }));
  check(value === expected, `in a worker: ${value}, not ${expected}`);
  await browser.close();
  server.close();
  return "in a worker of Chromium, too";
}

(async () => {
  install();
  const where = await inWorker(await inNode());
  problems.forEach(text => console.log(text));
  console.log(`${checks} checks, ${where}, ${problems.length} problems`);
  fs.rmSync(folder, { recursive: true });
  process.exitCode = problems.length || checks < 28 ? 1 : 0;
})().catch(error => { console.error(error); process.exit(1); });

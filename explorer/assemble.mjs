// SPDX-License-Identifier: Apache-2.0
// assemble.mjs WASM OUT: puts page/, the WebAssembly file, the sources and the palette together into one HTML file. The modules are put one after the
// other in the order of their imports; as all their names then stand in one scope, a name that two of them give is an error.
import crypto from "node:crypto";
import fs from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const page = path.join(here, "page");
const [wasm, out] = process.argv.slice(2);

// The text of a module with those that it imports before it, each once.
function bundle(entry) {
  const seen = new Set(), names = new Map(), parts = [];
  const visit = name => {
    if (seen.has(name)) return;
    seen.add(name);
    const text = fs.readFileSync(path.join(page, name), "utf8");
    for (const [, imported] of text.matchAll(/^import \{[^}]*\} from "\.\/([^"]+)";$/gm)) visit(imported);
    const rest = text.replace(/^import \{[^}]*\} from "\.\/[^"]+";\n/gm, "").replace(/^export /gm, "");
    if (/^(import|export)\b/m.test(rest)) throw new Error(`${name}: an import or export of another form`);
    for (const [, declared] of rest.matchAll(/^(?:async )?(?:function\*?|const|let|class) (\w+)/gm)) {
      if (names.has(declared)) throw new Error(`${declared} is in ${names.get(declared)} and in ${name}`);
      names.set(declared, name);
    }
    parts.push(`// ---- ${name}\n${rest}`);
  };
  visit(entry);
  return parts.join("\n");
}

// docs/references.bib as { key: "Authors, Title, where, year" }.
function references() {
  const found = {};
  const bib = fs.readFileSync(path.join(here, "../docs/references.bib"), "utf8");
  for (const [, key, body] of bib.matchAll(/^@\w+\{([^,]+),\n((?:  .*\n?)+)/gm)) {
    const field = name => (body.match(new RegExp(`\\b${name} = \\{((?:[^{}]|\\{[^}]*\\})*)\\}`)) || [])[1]
      ?.replace(/[{}]/g, "").replace(/\\['"`^~=.]?/g, "").replace(/\s+/g, " ").replace(/--/g, "–");
    const authors = (field("author") || "").split(" and ");
    const who = authors.length > 3 ? authors[0] + " et al." : authors.join(", ").replace(/, ([^,]*)$/, " and $1");
    const where = field("journal") || field("booktitle") || field("school") || field("publisher") || field("howpublished");
    found[key] = [who, field("title"), where, field("year")].filter(Boolean).join(", ");
  }
  return found;
}

// The colours of the plots: [{ light, dark, patterns: [name, ..] }, ..]
function palette() {
  const text = fs.readFileSync(path.join(here, "../src/lab/plot/palette.def"), "utf8");
  return [...text.matchAll(/^COLOUR\(0x(\w{6}), 0x(\w{6}), ([^)]*)\)/gm)].map(([, light, dark, names]) =>
    ({ light: `#${light}`, dark: `#${dark}`, patterns: names.match(/[\w-]+/g) }));
}

const safe = script => script.replace(/<\/(script)/gi, "<\\/$1").replace(/<!--/g, "<\\!--");
const fill = {
  style: fs.readFileSync(path.join(page, "style.css"), "utf8"),
  main: safe(bundle("main.mjs")),
  worker: safe(bundle("worker.mjs")),
  references: safe(JSON.stringify(references())),
  palette: safe(JSON.stringify(palette())),
  wasm: fs.readFileSync(wasm).toString("base64"),
};
// The page's Content-Security-Policy lets no other script run: this is the hash of the element's text.
fill.hash = crypto.createHash("sha256").update(`\n${fill.main}\n`).digest("base64");
const html = fs.readFileSync(path.join(page, "page.html"), "utf8").replace(/\{\{(\w+)\}\}/g, (whole, name) => {
  if (!(name in fill)) throw new Error(`page.html wants ${name}`);
  return fill[name];
});
fs.writeFileSync(out, html);
console.log(`${out}: ${(html.length / 1024).toFixed(0)} KiB`);

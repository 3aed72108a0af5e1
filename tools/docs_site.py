# SPDX-License-Identifier: Apache-2.0
"""For tools/make_docs.py: the program, the frame of a page, and what pages share."""
import concurrent.futures
import html
import json
import os
import re
import subprocess
from pathlib import Path

import docs_text as text

ROOT = Path(__file__).resolve().parent.parent
STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; color: #222 }
a { color: #0b5394; text-decoration: none } a:hover { text-decoration: underline }
h1 { margin-bottom: 0 } h1 + p { margin-top: .2rem; color: #555; font-size: 1.15rem } h2 { margin-top: 2.2rem }
pre, code { font: 14px/1.55 ui-monospace, monospace } pre { background: #f4f4f1; padding: .7rem 1rem; white-space: pre-wrap }
sub, sup { line-height: 0; font-size: .75em } .formula { font-size: 15px }
table { border-collapse: collapse; margin: 1rem 0 } th { text-align: left; font-weight: 600 }
td, th { padding: .2rem .9rem .2rem 0; border-bottom: 1px solid #ddd; vertical-align: top }
td.number { font-variant-numeric: tabular-nums; white-space: nowrap } small { color: #666 }
figure { margin: 0 } figure img { max-width: 100%; height: auto; image-rendering: auto } figcaption { color: #666; font-size: 13px }
.row { display: flex; flex-wrap: wrap; gap: 1.5rem; align-items: flex-start } .row figure { flex: 0 1 auto; max-width: 30rem }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(9.5rem, 1fr)); gap: 1.2rem }
.cards a { color: inherit } .cards img { width: 100% } .cards small { display: block; line-height: 1.3 }
.none { color: #666; font-style: italic } nav, footer { color: #666; font-size: 14px } footer { margin-top: 3rem }
"""


class Program:
    """The program, run in the folder of the pictures; every picture and number keeps its command."""

    def __init__(self, path, folder, quick):
        self.path, self.folder, self.quick = path, folder, quick
        self.pool = concurrent.futures.ThreadPoolExecutor(os.cpu_count())

    def try_run(self, *arguments):
        """(stdout, None), or (None, the error's line)."""
        done = subprocess.run([self.path, *arguments], cwd=self.folder, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1):
            lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
            return None, re.sub(r"^koksma [a-z]+: ", "", lines[-1])
        return done.stdout, None

    def rows(self, *arguments):
        """The JSON rows of a command that must succeed, and the command."""
        out, error = self.try_run(*arguments, "--json", *([] if arguments[0] == "list" else ["-q", "--threads", "1"]))
        if error:
            raise SystemExit(f"koksma {' '.join(arguments)}: {error}")
        return [json.loads(line) for line in out.splitlines()], "koksma " + " ".join(arguments)

    def picture(self, name, *arguments, alt):
        """A figure with its command, or the reason why there is none."""
        _, error = self.try_run(*arguments, "-q", "--threads", "1", "-o", name)
        command = html.escape("koksma " + " ".join(arguments + ("-o", name)))
        if error:
            return f"<p class='none'>No picture: {html.escape(error)}</p>"
        return (f"<figure><img src='../pictures/{name}' alt='{html.escape(alt, quote=True)}'>"
                f"<figcaption><code>{command}</code></figcaption></figure>")


def page(title, what, body, up="../"):
    """A whole page."""
    return (f"<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>{html.escape(title)} - Koksma</title>"
            f"<meta name='viewport' content='width=device-width'><link rel='stylesheet' href='{up}style.css'></head><body>\n"
            f"<nav><a href='{up}index.html'>Koksma</a></nav>\n<h1>{html.escape(title)}</h1><p>{text.formula(what)}</p>\n"
            f"{body}\n<footer>Made by <code>make docs</code> from the table, the source and the program.</footer></body></html>\n")


def table(head, rows):
    """A table of HTML cells; cells after the first are numbers where they begin with a digit."""
    def cell(c):
        return f"<td class='number'>{c}</td>" if re.match(r"[\d.-]+(\s|$)", c) else f"<td>{c}</td>"
    lines = ["<tr>" + "".join(f"<th>{h}</th>" for h in head) + "</tr>"] if head else []
    return "<table>" + "".join(lines + ["<tr>" + "".join(cell(c) for c in r) + "</tr>" for r in rows]) + "</table>"


class Site:
    """Everything that pages share: the tables, the references, who cites what."""

    def __init__(self, program, out):
        self.program, self.out = program, out
        self.references = text.references(ROOT / "docs/references.bib")
        self.cited = {}
        self.lists = {}
        for kind in ("patterns", "measures", "scenes", "integrators", "filters", "adaptive", "warps", "uses", "parameters"):
            self.lists[kind], _ = program.rows("list", kind)
        table = (ROOT / "include/koksma/claims.def").read_text(encoding="utf-8")
        self.claims = {name: "".join(re.findall('"([^"]*)"', meaning)) for name, meaning in
                       re.findall(r'^KOKSMA_CLAIM\(\w+, \d+, "([\w-]+)",((?:\s*"[^"]*")+)\)', table, re.M)}

    def cite(self, keys, name, kind):
        """The references of a member as links, entered into the index of references."""
        links = []
        for key in keys.split() if keys not in ("-", "") else []:
            if key not in self.references:
                raise SystemExit(f"{name} cites {key}, which is not in docs/references.bib")
            self.cited.setdefault(key, []).append((kind, name))
            links.append(f"<a href='../references.html#{key}'>{html.escape(text.short_reference(self.references[key]))}</a>")
        return ", ".join(links) or "-"

    def comment(self, path, name):
        """The comment of a member in its source file, or in a folder of its table, with a line that says where it is from."""
        lines = text.head_comment(ROOT / path) if (ROOT / path).is_file() else None
        if lines is None:
            file, lines = text.member_comment(ROOT / path, name)
            path = file.relative_to(ROOT)
        return text.comment_html(lines, name) + f"<p><small>The text is a comment of <code>{path}</code>.</small></p>"

    def parameters(self, name):
        """The parameters of a member, with their ranges."""
        rows = [[f"<code>{r['parameter']}</code>", html.escape(r["what"]), f"{r['default']}", html.escape(r["range"])]
                for r in self.lists["parameters"] if r["of"] == name]
        return table(["parameter", "what", "default", "range"], rows) if rows else ""

    def write(self, path, content):
        """A page of the site."""
        target = self.out / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(content, encoding="utf-8")

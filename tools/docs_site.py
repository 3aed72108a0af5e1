# SPDX-License-Identifier: Apache-2.0
"""For tools/make_docs.py: the program, the frame of a page, the index of the search, and what pages share. Style and script of
the pages are in tools/site."""
import concurrent.futures
import html
import json
import os
import re
import shutil
import subprocess
import sys
import threading
from pathlib import Path

import docs_text as text

ROOT = Path(__file__).resolve().parent.parent
# The parts of the site in the head of every page: (title, address, the folder of its pages).
PARTS = (("Koksma", "index.html", ""), ("Tutorial", "guide/tutorial.html", ""), ("Guide", "guide/index.html", "guide"),
         ("Commands", "commands/index.html", "commands"), ("Patterns", "patterns/index.html", "patterns"),
         ("Measures", "measures/index.html", "measures"), ("Scenes", "scenes/index.html", "scenes"), ("C", "c/index.html", "c"),
         ("Python", "python/index.html", "python"), ("Findings", "findings/index.html", "findings"))


def permitted(arguments):
    """A command line that may run the samplers of the examples, where it names one."""
    return [*arguments, "--allow-exec"] if re.search(r"\b(exec|plugin):", " ".join(arguments)) else list(arguments)


class Program:
    """The program, run in the folder of the pictures; every picture and number keeps its command."""

    def __init__(self, path, folder, quick):
        self.path, self.folder, self.quick = path, folder, quick
        self.pool = concurrent.futures.ThreadPoolExecutor(os.cpu_count())

    def try_run(self, *arguments):
        """(stdout, None), or (None, the error's line)."""
        done = subprocess.run([self.path, *permitted(arguments)], cwd=self.folder, capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1):
            lines = done.stderr.strip().splitlines() or [f"exit code {done.returncode}"]
            return None, re.sub(r"^koksma [a-z]+: ", "", lines[-1])
        return done.stdout, None

    def rows(self, *arguments):
        """The JSON rows of a command that must succeed, and the command."""
        out, error = self.try_run(*arguments, "--json", *([] if arguments[0] == "list" else ["-q", "--threads", "1"]))
        if error:
            raise SystemExit(f"koksma {' '.join(arguments)}: {error}")
        return [json.loads(line) for line in out.splitlines()], "koksma " + " ".join(permitted(arguments))

    def picture(self, name, *arguments, alt, label=""):
        """A figure with its label and command, or the reason why there is none."""
        _, error = self.try_run(*arguments, "-q", "--threads", "1", "-o", name)
        command = html.escape("koksma " + " ".join(permitted(arguments + ("-o", name))))
        if error:
            return f"<p class='none'>No picture: {html.escape(error)}</p>"
        return (f"<figure><img src='../pictures/{name}' alt='{html.escape(alt, quote=True)}'>"
                f"<figcaption>{label and f'<b>{html.escape(label)}</b> '}<code>{command}</code></figcaption></figure>")


def slug(text):
    """The id of a heading."""
    return re.sub(r"[^a-z0-9]+", "-", html.unescape(re.sub(r"<[^>]*>", "", text)).lower()).strip("-") or "part"


def plain(markup):
    """HTML as text for the index of the search; numbers in tables and pictures' commands are left out."""
    markup = re.sub(r"<td class='number'>.*?</td>|<figcaption>.*?</figcaption>", " ", markup, flags=re.S)
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]*>", " ", markup))).strip()


class Progress:
    """A line on a terminal that says how far it is."""

    def __init__(self):
        self.done, self.all, self.lock, self.shown = 0, 0, threading.Lock(), sys.stderr.isatty()

    def of(self, function, items):
        """The function of each item; each is a step."""
        def step(item):
            result = function(item)
            with self.lock:
                self.done += 1
                if self.shown:
                    sys.stderr.write(f"\rmake docs: {self.done} of {self.all} parts")
                    sys.stderr.flush()
            return result
        self.all += len(items)
        return [lambda item=item: step(item) for item in items]

    def end(self):
        """Takes the line away."""
        if self.shown:
            sys.stderr.write("\r\x1b[K")


def table(head, rows):
    """A table of HTML cells; cells after the first are numbers where they begin with a digit."""
    def cell(c):
        return f"<td class='number'>{c}</td>" if re.match(r"[\d.-]+(\s|$)", c) else f"<td>{c}</td>"
    lines = ["<thead><tr>" + "".join(f"<th>{h}</th>" for h in head) + "</tr></thead>"] if head else []
    return "<table>" + "".join(lines + ["<tr>" + "".join(cell(c) for c in r) + "</tr>" for r in rows]) + "</table>"


def contents(headings):
    """The contents of a page with more than two headings: [(level, id, markup), ..]."""
    if sum(level == 2 for level, _, _ in headings) < 3:
        return ""
    shown = [h for h in headings if h[0] == 2 or len(headings) <= 40]
    items = "".join(f"<li>{'&nbsp;&nbsp;' if level == 3 else ''}<a href='#{name}'>{re.sub('</?a[^>]*>', '', markup)}</a></li>" for level, name, markup in shown)
    return f"<details class='toc' open><summary>On this page</summary><ul>{items}</ul></details>"


class Site:
    """Everything that pages share: the tables, the references, who cites what."""

    def __init__(self, program, out):
        self.program, self.out, self.progress = program, out, Progress()
        self.sections = {}  # {address: [[address#id, title, heading, text], ..]} for the search
        self.references = text.references(ROOT / "docs/references.bib")
        self.cited = {}
        self.lists = {}
        for kind in ("patterns", "measures", "scenes", "integrators", "filters", "adaptive", "warps", "integrands", "uses", "parameters"):
            self.lists[kind], _ = program.rows("list", kind)
        known, _ = program.try_run("--help")
        self.commands = dict(re.findall(r"^  ([a-z]+)  +(\S.*)$", known, re.M))
        self.explorer = self.put_explorer()
        table = (ROOT / "include/koksma/claims.def").read_text(encoding="utf-8")
        self.claims = {name: "".join(re.findall('"([^"]*)"', meaning)) for name, meaning in
                       re.findall(r'^KOKSMA_CLAIM\(\w+, \d+, "([\w-]+)",((?:\s*"[^"]*")+)\)', table, re.M)}

    def put_explorer(self):
        """Copies the explorer where it is built, its links to this site; whether it is there."""
        built = ROOT / "build/explorer/koksma-explorer.html"
        if not built.is_file():
            return False
        page = built.read_text(encoding="utf-8")
        (self.out / "explorer.html").write_text(page.replace('<meta name="docs" content="../docs/">', '<meta name="docs" content="">', 1), encoding="utf-8")
        return True

    def explorer_link(self, row):
        """A pattern in the explorer, which has no files."""
        name = row["pattern"]
        return f"<p><a href='../explorer.html#a={name}@16'>Try {name} in the explorer</a></p>" if self.explorer and row["reads"] == "-" else ""

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

    def write(self, path, kind, title, what, body):
        """A page of the site: its kind in one word or two is part of its title; headings get ids, tables boxes that scroll."""
        up, headings, ids = "../" * path.count("/"), [], set(re.findall(r"\bid='([^']*)'", body))

        def anchor(found):
            level, name, markup = int(found[1]), found[2], found[3]
            if not name:
                name = base = slug(markup)
                for i in range(2, 99):
                    if name not in ids:
                        break
                    name = f"{base}-{i}"
                ids.add(name)
            headings.append((level, name, markup))
            return f"<h{level} id='{name}'>{markup}</h{level}>"

        body = re.sub(r"<h([23])(?: id=['\"]([^'\"]*)['\"])?>(.*?)</h\1>", anchor, body, flags=re.S)
        body = body.replace("<table>", "<div class='scroll' tabindex='0'><table>").replace("</table>", "</table></div>")
        links = "".join(f"<a href='{up}{address}'{' aria-current=page' if path == address else ''}>{name}</a>" for name, address, _ in PARTS)
        target = self.out / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(
            f"<!DOCTYPE html>\n<html lang='en' data-up='{up}'><head><meta charset='utf-8'><title>{html.escape(title)}{': ' if kind else ''}{kind} - Koksma</title>"
            f"<meta name='viewport' content='width=device-width, initial-scale=1'><link rel='stylesheet' href='{up}style.css'></head><body>\n"
            f"<header><nav aria-label='Parts of the site'>{links}</nav><form id='search' role='search' hidden><input type='search' "
            f"aria-label='Search all pages' placeholder='Search ( / )' autocomplete='off'><ul id='found' aria-live='polite' hidden></ul></form></header>\n"
            f"<main><h1>{html.escape(title)}</h1><p>{what}</p>\n{contents(headings)}{body}\n"
            f"<footer>Made by <code>make docs</code> from the tables, the source, the documents and the program.</footer></main>"
            f"<script src='{up}search.js'></script></body></html>\n", encoding="utf-8")
        cuts = re.split(r"<h[23] id='([^']*)'>(.*?)</h[23]>", body, flags=re.S)
        self.sections[path] = [[path, title, "", plain(what + " " + cuts[0])[:3000]]] + [
            [f"{path}#{cuts[i]}", title, plain(cuts[i + 1]), plain(cuts[i + 2])[:3000]] for i in range(1, len(cuts), 3)]

    def finish(self):
        """What all pages share, and the index of the search."""
        for name in ("style.css", "search.js"):
            shutil.copyfile(ROOT / "tools/site" / name, self.out / name)
        lines = ",\n".join(json.dumps(line, ensure_ascii=False) for path in sorted(self.sections) for line in self.sections[path])
        (self.out / "search-index.js").write_text(f"globalThis.koksmaSections = [\n{lines}\n];\n", encoding="utf-8")

# SPDX-License-Identifier: Apache-2.0
"""For tools/make_docs.py: the documents, docs/*.md and CONTRIBUTING.md, as pages. Links and paths between backticks that name
a document lead to its page; those that name another file of the source are text."""
import html
import os
import re
import shutil
import sys

from docs_site import ROOT

try:
    import markdown
except ImportError:
    sys.exit("make_docs: Python has no module markdown; on Debian: apt-get install python3-markdown")

# The documents for users, in their order; all others follow.
FIRST = ("README", "tutorial", "install", "commands", "scenes", "scaling", "report-format", "abi", "hardening", "contributing", "architecture", "conventions", "decisions")
FOLDERS = (("guide", "Guide", "documents for users and for those who work on Koksma"), ("findings", "Findings", "studies with their numbers, and the commands that give them"))


def documents():
    """{path in the source: address of the page}."""
    found = {"CONTRIBUTING.md": "guide/contributing.html"}
    for path in sorted((ROOT / "docs").rglob("*.md")):
        inside = path.relative_to(ROOT / "docs")
        folder = inside.parent.as_posix() if inside.parent.name else "guide"
        found[path.relative_to(ROOT).as_posix()] = f"{folder}/{inside.stem}.html"
    return found


class Linker:
    """Links of one document, seen from its page."""

    def __init__(self, site, pages, source):
        self.site, self.pages, self.source = site, pages, source
        self.here = os.path.dirname(pages[source])

    def target(self, path):
        """The address of a document or a picture; None for other files of the source."""
        if path in self.pages:
            return os.path.relpath(self.pages[path], self.here)
        if path.endswith((".jpg", ".png", ".svg")) and (ROOT / path).is_file():
            copy = self.site.out / "files" / os.path.basename(path)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / path, copy)
            return os.path.relpath(f"files/{copy.name}", self.here)
        return None

    def attribute(self, found):
        """href and src of Markdown's links."""
        name, link = found[1], html.unescape(found[2])
        if "://" in link or link.startswith("#"):
            return found[0]
        path, _, anchor = link.partition("#")
        to = self.target(os.path.normpath(os.path.join(os.path.dirname(self.source), path)))
        return f'{name}="{to}{"#" + anchor if anchor else ""}"' if to else f'data-source="{html.escape(link)}"'

    def code(self, found):
        """A document or a command between backticks becomes a link."""
        name = found[1]
        command = re.fullmatch(r"koksma ([a-z]+)(?: --help)?", name)
        if command and command[1] in self.site.commands:
            return f"<a href='../commands/{command[1]}.html'>{found[0]}</a>"
        for path in (name, "docs/" + name, os.path.normpath(os.path.join(os.path.dirname(self.source), name))):
            if path in self.pages and path != self.source:
                return f"<a href='{self.target(path)}'>{found[0]}</a>"
        return found[0]

    def page(self):
        """(title, its first sentence, the body) of the document."""
        text = (ROOT / self.source).read_text(encoding="utf-8")
        body = markdown.markdown(text, extensions=["tables", "fenced_code", "sane_lists"])
        body = re.sub(r'\b(href|src)="([^"]*)"', self.attribute, body)
        body = re.sub(r'<a data-source="[^"]*"[^>]*>(.*?)</a>', r"\1", body, flags=re.S)
        body = re.sub(r"(?<!>)<code>([^<>]*)</code>(?!</a>)", self.code, body)
        body = re.sub(r"<(img [^>]*?) ?/>", r"<\1>", re.sub(r"<(br|hr) ?/>", r"<\1>", body))
        title = re.search(r"<h1>(.*?)</h1>", body, re.S)
        if not title:
            raise SystemExit(f"{self.source}: it has no title")
        return html.unescape(re.sub(r"<[^>]*>", "", title[1])), body[: title.start()] + body[title.end() :]


def guide(site):
    """A page for each document, and one with the list of each folder."""
    pages, titles = documents(), {}
    for source, address in pages.items():
        title, body = Linker(site, pages, source).page()
        titles[address] = title
        site.write(address, "" if address.startswith("guide/") else address.split("/")[0].rstrip("s"), title, "", body)
    for folder, title, what in FOLDERS:
        of = [a for a in titles if a.startswith(folder + "/")]
        of.sort(key=lambda a: FIRST.index(a[6:-5]) if folder == "guide" and a[6:-5] in FIRST else len(FIRST))
        items = "".join(f"<li><a href='{a.split('/')[1]}'>{html.escape(titles[a])}</a></li>" for a in of)
        more = ("<h2>More</h2><ul class='links'>" + "".join(f"<li><a href='../{f}/index.html'>{t}</a>: {w}</li>" for f, t, w in FOLDERS[1:]) +
                "</ul>") if folder == "guide" else ""
        site.write(f"{folder}/index.html", "", title, what, f"<ul class='links'>{items}</ul>{more}")

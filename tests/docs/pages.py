#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""pages.py PROGRAM: tools/make_docs.py makes a page for every member of every table, and no link in them is dead."""
import html.parser
import json
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
VOID = {"meta", "link", "img", "br"}
failures = []


def check(good, what):
    """Notes a failure."""
    if not good:
        failures.append(what)


class Page(html.parser.HTMLParser):
    """Links, anchors and text of a page whose tags must be closed in order."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors, self.words, self.open, self.path = [], set(), [], [], path
        self.feed(path.read_text(encoding="utf-8"))
        check(not self.open, f"{path}: not closed: {self.open}")

    def handle_starttag(self, tag, attrs):
        for key, value in attrs:
            if key in ("href", "src"):
                self.links.append(value)
            if key == "id":
                check(value not in self.anchors, f"{self.path}: two anchors {value}")
                self.anchors.add(value)
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        check(self.open and self.open[-1] == tag, f"{self.path}: </{tag}> after {self.open[-1:]}")
        if self.open:
            self.open.pop()

    def handle_data(self, data):
        self.words.append(data)


def names(program, kind, column):
    """The members of a table."""
    out = subprocess.run([program, "list", kind, "--json"], check=True, capture_output=True, text=True).stdout
    return [json.loads(line)[column] for line in out.splitlines()]


with tempfile.TemporaryDirectory() as folder:
    site = Path(folder)
    PROGRAM = str(Path(sys.argv[1]).resolve())
    subprocess.run([ROOT / "tools/make_docs.py", PROGRAM, site, "--quick"], check=True, stdout=subprocess.DEVNULL)
    pages = {path: Page(path) for path in site.rglob("*.html")}
    for path, found in pages.items():
        for link in found.links:
            if "://" in link:
                continue
            target, _, anchor = link.partition("#")
            file = (path.parent / target).resolve() if target else path
            check(file.is_file(), f"{path.relative_to(site)}: dead link {link}")
            check(not anchor or file not in pages or anchor in pages[file].anchors, f"{path.relative_to(site)}: no anchor {link}")
        check("None" not in " ".join(found.words), f"{path.relative_to(site)}: None")
    for kind, column in (("patterns", "pattern"), ("measures", "measure")):
        for name in names(PROGRAM, kind, column):
            found = pages.get(site / kind / f"{name}.html")
            check(found, f"no page for {name}")
            words = " ".join(found.words) if found else ""
            check(f"comment of  src/{kind}/" in words, f"{name}: the page lacks the comment")
            check(name in ("file", "latin-hypercube") or "Source" in words, f"{name}: no source in the head comment")
            check("koksma " in words, f"{name}: no command")
            check(found and any("pictures/" in link for link in found.links), f"{name}: no picture")
    for kind, column in (("scenes", "scene"), ("integrators", "integrator"), ("filters", "filter"), ("adaptive", "method"),
                         ("warps", "warp"), ("uses", "use")):
        for name in names(PROGRAM, kind, column):
            check(name in pages[site / kind / "index.html"].anchors, f"{kind}/index.html lacks {name}")

print("\n".join(failures) or f"{len(pages)} pages")
sys.exit(bool(failures))

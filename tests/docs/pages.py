#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""pages.py PROGRAM [NODE_MODULES]: tools/make_docs.py makes a page for every member of every table, command, header, name of the
Python package and document; every link leads somewhere, every page is reached from the first, and no two have one title. With
NODE_MODULES, where playwright-core is, browser.cjs then looks at all of them in Chromium."""
import ast
import html.parser
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "tools")]
from pseudo_terminal import shown  # pylint: disable=wrong-import-position

VOID = {"meta", "link", "img", "br", "hr", "input"}
failures = []


def check(good, what):
    """Notes a failure."""
    if not good:
        failures.append(what)


class Page(html.parser.HTMLParser):
    """Links, anchors and text of a page whose tags must be closed in order."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors, self.words, self.open, self.path, self.title = [], set(), [], [], path, ""
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
        self.title += data if self.open[-1:] == ["title"] else ""
        self.words.append(data)


def names(program, kind, column):
    """The members of a table."""
    out = subprocess.run([program, "list", kind, "--json"], check=True, capture_output=True, text=True).stdout
    return [json.loads(line)[column] for line in out.splitlines()]


if subprocess.run(["/usr/bin/python3", "-c", "import markdown"], capture_output=True, check=False).returncode:
    print("skipped: Python's module markdown is not installed (scripts/setup docs)")
    sys.exit(77)
PROGRAM = str(Path(sys.argv[1]).resolve())
sys.dont_write_bytecode = True
from make_docs import fast  # pylint: disable=wrong-import-position
# Numbers that take minutes stay out: extreme and edge of 3D points grow as n^5 and n^4, disk as n^3.
costs = {row["measure"]: row for row in map(json.loads, subprocess.run([PROGRAM, "list", "measures", "--json"], check=True, capture_output=True, text=True).stdout.splitlines())}
for name, n, dim, quick in (("extreme", 256, 2, True), ("extreme", 16, 3, True), ("extreme", 64, 3, False), ("edge", 4096, 2, True), ("edge", 16, 3, True),
                            ("edge", 256, 3, False), ("disk", 64, 2, True), ("disk", 256, 2, False), ("l2-star", 4096, 2, True), ("star", 256, 3, True)):
    check(fast(costs[name], n, dim) == quick, f"make_docs.py takes {name} of {n} points in {dim}D for {'slow' if quick else 'fast'}")
with tempfile.TemporaryDirectory() as folder:
    site = Path(folder)
    bar, code = shown([ROOT / "tools/make_docs.py", PROGRAM, site, "--quick"], stdout=subprocess.DEVNULL)
    check(code == 0, f"make_docs.py ends with {code}: {bar}")
    parts = [(int(a), int(b)) for a, b in re.findall(r"make docs: (\d+) of (\d+) parts", bar)]
    check(len(parts) > 80 and parts[-1][0] == parts[-1][1] == len(parts) and bar.endswith("\r\x1b[K"), f"the progress: {bar[-200:]!r}")
    pages = {path: Page(path) for path in site.rglob("*.html") if path.name != "explorer.html"}
    reached, left = set(), [site / "index.html"]
    while left:
        here = left.pop()
        reached.add(here)
        to = [(here.parent / link.partition("#")[0]).resolve() for link in pages[here].links if "://" not in link and not link.startswith("#")]
        left += [path for path in to if path in pages and path not in reached]
    titles = {}
    for path, found in pages.items():
        name = path.relative_to(site)
        check(path in reached, f"{name}: no link leads from the first page to it")
        check(found.title not in titles, f"{name}: its title is that of {titles.get(found.title)}: {found.title}")
        titles[found.title] = name
        check(len(found.title) > len("x - Koksma") and not found.title.startswith("Koksma -"), f"{name}: the title says nothing: {found.title}")
    for path, found in pages.items():
        for link in found.links:
            if "://" in link:
                continue
            target, _, anchor = link.partition("#")
            file = (path.parent / target).resolve() if target else path
            check(file.is_file(), f"{path.relative_to(site)}: dead link {link}")
            check(not anchor or file not in pages or anchor in pages[file].anchors, f"{path.relative_to(site)}: no anchor {link}")
        if path.parent.name not in ("python", "findings", "guide"):
            check("None" not in " ".join(found.words), f"{path.relative_to(site)}: None")
    for kind, column in (("patterns", "pattern"), ("measures", "measure")):
        for name in names(PROGRAM, kind, column):
            found = pages.get(site / kind / f"{name}.html")
            check(found, f"no page for {name}")
            words = " ".join(found.words) if found else ""
            check(f"comment of  src/engine/{kind}/" in words, f"{name}: the page lacks the comment")
            check(name in ("file", "latin-hypercube", "exec", "plugin") or "Source" in words, f"{name}: no source in the head comment")
            check("koksma " in words, f"{name}: no command")
            check(found and any("pictures/" in link for link in found.links), f"{name}: no picture")
    if (site / "explorer.html").is_file():  # where it is built
        check('<meta name="docs" content="">' in (site / "explorer.html").read_text(encoding="utf-8"), "the explorer's patterns lead out of the site")

    def words_of(path):
        """The text of a page."""
        return " ".join(pages[site / path].words) if site / path in pages else ""
    overview = subprocess.run([PROGRAM, "--help"], check=True, capture_output=True, text=True).stdout
    for name in re.findall(r"^  ([a-z]+)  ", overview, re.M):
        text = words_of(f"commands/{name}.html").replace("\xad", "")
        for option in re.findall(r"^ +(?:-\w, )?(--[a-z-]+)", subprocess.run([PROGRAM, name, "--help"], check=True, capture_output=True, text=True).stdout, re.M):
            check(option in text, f"commands/{name}.html lacks {option}")
        check(f"koksma {name}" in text, f"no page for koksma {name}")
    for header in sorted((ROOT / "include/koksma").glob("*.h")):
        here, declared = site / f"c/{header.stem}.html", re.sub(r"/\*.*?\*/", "", header.read_text(encoding="utf-8"), flags=re.S)
        declared = re.findall(r"^(?:KOKSMA_API|KOKSMA_INLINE)\s[^;{]*?\b(koksma_\w+)\(", declared, re.M) + re.findall(r"^\} (koksma_\w+);", declared, re.M)
        check(here in pages and declared, f"no page for {header.name}")
        for name in declared if here in pages else []:
            check(name in pages[here].anchors, f"c/{header.stem}.html lacks {name}")
    package = ast.parse((ROOT / "python/koksma/__init__.py").read_text(encoding="utf-8"))
    for name in next(ast.literal_eval(n.value) for n in package.body if isinstance(n, ast.Assign)):
        check(name in pages[site / "python/index.html"].anchors, f"python/index.html lacks {name}")
    for document in list((ROOT / "docs").rglob("*.md")):
        folder = document.parent.name if document.parent.name != "docs" else "guide"
        title = re.sub(r"[`*]", "", document.read_text(encoding="utf-8").splitlines()[0].lstrip("# "))
        check(title in words_of(f"{folder}/{document.stem}.html"), f"no page for {document.name}")
    for kind, column in (("scenes", "scene"), ("integrators", "integrator"), ("filters", "filter"), ("adaptive", "method"),
                         ("warps", "warp"), ("integrands", "integrand"), ("uses", "use")):
        for name in names(PROGRAM, kind, column):
            check(name in pages[site / kind / "index.html"].anchors, f"{kind}/index.html lacks {name}")

    if len(sys.argv) > 2:
        seen = subprocess.run(["node", ROOT / "tests/docs/browser.cjs", site], env=dict(os.environ, KOKSMA_NODE=sys.argv[2]), check=False,
                              capture_output=True, text=True)
        check(seen.returncode in (0, 77), seen.stdout + seen.stderr)

print("\n".join(failures) or f"{len(pages)} pages")
sys.exit(bool(failures))

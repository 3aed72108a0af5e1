#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""make_docs.py PROGRAM FOLDER [--quick]: the documents as one site of HTML pages in FOLDER, which needs no server.

Documents are docs/*.md, commands are PROGRAM's manual pages, references are the comments of the public headers and the
docstrings of the Python package. A page of a pattern or measure has the head comment of its source file, what `koksma list`
prints, and pictures and numbers that PROGRAM makes with the commands beside them. --quick makes fewer and
smaller ones. The explorer is put in where make explorer has built it.
"""
import argparse
import html
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
import docs_text as text
from docs_guide import guide
from docs_reference import c_reference, commands, python_reference
from docs_site import ROOT, Program, Site, permitted, table
from docs_tables import small_tables

PLAIN = ("star", "l2-star", "extreme", "edge", "l2-periodic", "relative-radius")  # the columns of a pattern's page
FILES = {  # what each pattern that reads a file (`koksma list patterns`) is shown with; file has points
    "file": ("from-elsewhere.csv", None),
    "lattice-file": ("vector.txt", "# lattice\n2 # dimensions\n1048576 # points\n1\n182667\n"),
    "lattice-vector": ("1:182667", None),
    "exec": ("./stratified.py", None),
    "plugin": ("./rank1.so", None),
    "mask-file": ("mask.npy", None),
    "net-file": ("net.txt", "d s a m_i\n2 1 0 1\n"),
}
COMPARED = ("random", "jittered", "n-rooks", "sobol:scramble=owen")  # the curves of a chart


def spec_at(row, n):
    """A pattern's spec for n points: a distance that is given for 16 points (d=0.1) shrinks with n."""
    d = re.search(r"\bd=([\d.]+)", row["parameters"])
    if d and float(d[1]) > 0 and n > 16:
        return f"{row['pattern']}:d={float(d[1]) * 4 / n**0.5:.3g}"
    return row["pattern"] + (":" + FILES[row["pattern"]][0] if row["pattern"] in FILES else "")


def source_at(program, row, n, dim=""):
    """pattern:SPEC@N for the n nearest to the wish that the pattern takes, as its own error tells; None without one."""
    spec = spec_at(row, n)
    _, error = program.try_run("generate", spec, "-n", str(n), *(["--dim", dim[1:]] if dim else []), "-q", "-o", "-")
    said = re.search(r"n = (\d+)(?: or (\d+))? would do", error or "")
    if said:
        n = min((int(s) for s in said.groups() if s), key=lambda m: abs(m - n))
    elif error:
        return None, error
    return f"pattern:{spec}@{n}{dim}", None


def fast(measure_row, n, dim=2):
    """Whether a measure of n points takes milliseconds: its cost, as the table states it for that many dimensions, is at most
    n^2, or below 2^24 steps."""
    parts = re.split("[,;]", measure_row["cost"])
    power = re.search(r"n\^([\d.]+)", next((part for part in parts if f"in {dim}D" in part), parts[0]))
    return not power or float(power[1]) <= 2 or n ** float(power[1]) < 2**24


def sets_of(site, row, n):
    """How many sets the means of a page are taken over: two where more would be equal, or take seconds."""
    return "2" if site.program.quick or "deterministic" in row["claims"].split(",") or n > 1024 else "10"


def measured(site, row):
    """{n: {measure: row}} of a pattern in its lowest dimension (2 if it can), and the commands."""
    low, _, high = row["dim"].partition("-")
    dim = "" if int(low) <= 2 <= int(high or low) else f"@{low}"
    values, commands = {}, []
    for n in (16,) if site.program.quick else (16, 64, 256):
        source, error = source_at(site.program, row, n, dim)
        if not source:
            commands.append(f"# n = {n}: {error}")
            continue
        size = int(source[len("pattern:"):].split("@")[1])
        if size in values:  # the pattern has no set nearer to this wish
            continue
        names = [m["measure"] for m in site.lists["measures"] if (m["measure"] != "t-value" or size & (size - 1) == 0) and
                 fast(m, size, int(dim[1:] or 2))]
        rows, command = taken(site, source, sets_of(site, row, size), names if not dim else [m for m in names if fits(site, m, int(dim[1:]))])
        commands.append(command)
        values[size] = {r["measure"]: r for r in rows}
    return {"values": values, "commands": commands, "dim": dim[1:] or "2"}


def taken(site, source, trials, names):
    """The rows of those measures that take such points: one that refuses says so, and is left out."""
    while True:
        arguments = ["measure", source, "--trials", trials, "-m", ",".join(names)]
        out, error = site.program.try_run(*arguments, "--json", "-q", "--threads", "1")
        if not error:
            return [json.loads(line) for line in out.splitlines()], "koksma " + " ".join(permitted(arguments))
        if error.partition(":")[0] not in names:
            raise SystemExit(f"koksma {' '.join(arguments)}: {error}")
        names = [m for m in names if m != error.partition(":")[0]]


def fits(site, measure, dim):
    """Whether the measure is there in that many dimensions."""
    low, _, high = next(m["dim"] for m in site.lists["measures"] if m["measure"] == measure).partition("-")
    return int(low) <= dim <= int(high or low)


def number(row):
    """A mean with its standard error, or a bound of it."""
    if row is None or row["value"] is None:
        return "-"
    error = row["standard_error"]
    bound = "≥ " if row["exact"] is not None and row["exact"] < row["trials"] else ""
    return bound + f"{row['value']:.4g}" + (f" <small>± {error:.1g}</small>" if error > 1e-9 * abs(row["value"]) else "")


def projections(site, row, n):
    """A scatter matrix of points that are not plane."""
    name, dim = row["pattern"], row["dim"]
    return "<div class='row'>" + site.program.picture(f"{name}.svg", "plot", f"pattern:{name}@{n}@{dim}", "--size", "560",
                                                      alt=f"the projections of {n} points of {dim} dimensions") + "</div>"


def pattern_pictures(site, row):
    """Few points in their strata, many points, the spectrum and its radial mean."""
    program, name, claims = site.program, row["pattern"], row["claims"].split(",")
    few, _ = source_at(program, row, 16)
    many, error = source_at(program, row, 16 if program.quick else 256)
    if not few or not many:
        return projections(site, row, 256) if error and "no 2-dimensional form" in error else f"<p class='none'>{error}</p>"
    n = int(few.split("@")[1])
    grid = ["--rooks"] if {"latin", "net2"} & set(claims) else ["--grid", f"{round(n**0.5)}"] if round(n**0.5) ** 2 == n else []
    trials = sets_of(site, row, int(many.split("@")[1]))
    deterministic = "deterministic" in claims or name in FILES
    figures = [
        program.picture(f"{name}-few.svg", "plot", few, *grid, "--size", "280", alt=f"{n} points"),
        program.picture(f"{name}.svg", "plot", many, "--size", "280", alt=f"{many.split('@')[1]} points"),
        program.picture(f"{name}-power.png", "plot", "--curve", "power", many, *([] if deterministic else ["--trials", trials]),
                        "--size", "280", alt="power spectrum"),
        program.picture(f"{name}-radial.svg", "plot", "--curve", "radial", many, *([] if deterministic else ["--trials", trials]),
                        alt="radial mean of the power spectrum"),
    ]
    return "<div class='row'>" + "".join(figures) + "</div>"


def verified(site, row, n):
    """What `koksma verify` finds."""
    source, error = source_at(site.program, row, n, "" if row["dim"] != "3" else "@3")
    if not source:
        return f"<p class='none'>{html.escape(error)}</p>"
    rows, command = site.program.rows("verify", source)
    cells = [[r["property"], html.escape(r["subject"]), "yes" if r["holds"] else "no", f"{r['value']:.4g}",
              html.escape(r["detail"])] for r in rows]
    return (f"<details><summary>{sum(r['holds'] for r in rows)} of {len(rows)} properties hold</summary>"
            f"{table(['property', 'of', 'holds', 'value', ''], cells)}</details><pre>{html.escape(command)}</pre>")


def pattern_page(site, row, numbers):
    """The page of a pattern."""
    name = row["pattern"]
    path = f"src/engine/patterns/{name.replace('-', '_')}.c"
    claims = [] if row["claims"] == "-" else row["claims"].split(",")
    entry = table([], [["dimensions", row["dim"]], ["source", site.cite(row["source"], name, "patterns")]])
    entry += site.parameters(name)
    promised = table([], [[c, text.formula(site.claims[c])] for c in claims]) if claims else "<p>It claims nothing.</p>"
    shown = [m for m in PLAIN if any(m in v for v in numbers["values"].values())]
    rows = [[str(n)] + [number(v.get(m)) for m in shown] for n, v in numbers["values"].items()]
    commands = html.escape("\n".join(numbers["commands"]))
    head = ["n"] + [f"<a href='../measures/{m}.html'>{m}</a>" for m in shown]
    body = (site.comment(path, name) + entry + pattern_pictures(site, row) +
            "<h2>What it promises</h2><p>Each line is a test.</p>" + promised +
            f"<h2>Measured</h2><p>Means and standard errors over the sets of the seeds 0, 1, ..; {numbers['dim']} dimensions.</p>" +
            table(head, rows) + f"<pre>{commands}</pre><h2>Verified</h2>" + verified(site, row, 16 if site.program.quick else 256))
    site.write(f"patterns/{name}.html", "pattern", name, text.formula(row["what"]), site.explorer_link(row) + body)


def ranking(site, name, numbers):
    """All patterns of the plane by the value of a measure, and what it was computed from."""
    larger = name in ("min-distance", "relative-radius")
    wished = sorted({n for of in numbers.values() for n in of["values"]})
    sizes = [n for n in wished if n in (16, 64, 256)]
    lines = []
    for row in site.lists["patterns"]:
        values = numbers[row["pattern"]]["values"]
        if numbers[row["pattern"]]["dim"] != "2" or "another name" in row["what"] or row["pattern"] in FILES:
            continue
        near = [next((v.get(name) for k, v in values.items() if abs(k - n) <= n // 5 + 1), None) for n in sizes]
        where = [next((k for k in values if abs(k - n) <= n // 5 + 1), n) for n in sizes]
        cells = [number(v) + (f" <small>n = {k}</small>" if v and k != n else "") for v, k, n in zip(near, where, sizes)]
        keys = [v["value"] for v in near if v and v["value"] is not None]
        if keys:
            lines.append((keys[-1] if not larger else -keys[-1], len(keys), [f"<a href='../patterns/{row['pattern']}.html'>{row['pattern']}</a>"] + cells))
    full = max((n for _, n, _ in lines), default=0)
    lines.sort(key=lambda line: (full - line[1], line[0]))
    columns = [i for i, n in enumerate(sizes) if any(line[2][1 + i] != "-" for line in lines)]
    return table(["pattern"] + [f"n = {sizes[i]}" for i in columns], [[line[2][0]] + [line[2][1 + i] for i in columns] for line in lines])


def measure_page(site, row, numbers):
    """The page of a measure."""
    name, program = row["measure"], site.program
    sizes = "4,16" if program.quick else "16,64,256" if fast(row, 256) else "4,16,64"
    last, trials = sizes.split(",")[-1], "2" if program.quick else "10"
    sources = [f"pattern:{p}@{last}" for p in COMPARED]
    entry = table([], [["dimensions", row["dim"]], ["cost", text.formula(row["cost"])],
                       ["source", site.cite(row["source"], name, "measures")]]) + site.parameters(name)
    witness = program.picture(f"{name}-witness.svg", "plot", "pattern:jittered@16", "--witness", name, "--size", "280",
                              alt=f"16 jittered points and where {name} is reached")
    chart = program.picture(f"{name}-n.svg", "plot", "--curve", "convergence", "-m", name, "--sizes", sizes, "--trials", trials,
                            *sources, alt=f"{name} against n")
    body = (site.comment("src/engine/measures", name) + entry + f"<div class='row'>{witness}{chart}</div>" +
            f"<h2>Patterns ranked by {name}</h2><p>Means over sets with standard errors, as on the pages of the patterns, which have the "
            "commands; the best first by the last column.</p>" + ranking(site, name, numbers))
    site.write(f"measures/{name}.html", "measure", name, text.formula(row["what"]), body)


def references_page(site):
    """All references, with the pages that cite them."""
    places = {"patterns": "patterns/{}.html", "measures": "measures/{}.html"}
    body = ""
    for key, fields in sorted(site.references.items(), key=lambda item: (item[1]["author"].split(" and ")[0].split()[-1], item[1]["year"])):
        links = ", ".join(f"<a href='{places.get(kind, kind + '/index.html#{}').format(name)}'>{name}</a>"
                          for kind, name in sorted(site.cited.get(key, [])))
        body += f"<p id='{key}'>{text.long_reference(fields)}" + (f"<br><small>For {links}</small>" if links else "") + "</p>\n"
    site.write("references.html", "", "References", "what patterns, measures and the other tables cite", body)


def index_pages(site):
    """Thumbnails of the patterns, the table of the measures, and the first page with everything by name."""
    cards = "".join(f"<a href='{r['pattern']}.html'><img src='../pictures/{r['pattern']}.svg' alt=''>{r['pattern']}"
                    f"<small>{html.escape(r['what'])}</small></a>" for r in site.lists["patterns"])
    site.write("patterns/index.html", "", "Patterns", "rules that make a set of points", f"<div class='cards'>{cards}</div>")
    measures = table(["measure", "what", "cost"], [[f"<a href='{r['measure']}.html'>{r['measure']}</a>", html.escape(r["what"]), text.formula(r["cost"])]
                                                   for r in site.lists["measures"]])
    site.write("measures/index.html", "", "Measures", "numbers for how uneven points are", measures)

    def links(items):
        return "<ul class='links'>" + "".join(f"<li><a href='{address}'>{name}</a>{': ' if what else ''}{what}</li>" for name, address, what in items) + "</ul>"
    shown = (("star", "the largest error over boxes"), ("l2-star", "the mean square error over boxes"), ("edge", "over slanted edges"))
    body = (
        "<h2>Begin</h2>" + links([
            ("Tutorial", "guide/tutorial.html", "from two commands to a study and your own sampler"),
            ("Install", "guide/install.html", "what it needs, and the ways to build it"),
            *([("Explorer", "explorer.html", "points, measures, pictures and spectra in the browser, with a tour of ten steps")] if site.explorer else []),
            ("Guide", "guide/index.html", "every document, also for those who work on Koksma")]) +
        "<h2>Look up</h2>" + links([
            ("Commands", "commands/index.html", "options and examples of each"), ("C", "c/index.html", "the public headers"),
            ("Python", "python/index.html", "the package koksma"), ("Scene files", "guide/scenes.html", "every field")]) +
        "<h2>What there is</h2>" + links([
            (f"{len(site.lists['patterns'])} patterns", "patterns/index.html", "each with its definition, spectrum, values and tested claims"),
            (f"{len(site.lists['measures'])} measures", "measures/index.html",
             ", ".join(f"<a href='measures/{name}.html'>{name}</a> {what}" for name, what in shown) + " ..."),
            ("Scenes", "scenes/index.html", ""), ("Gallery", "gallery/index.html", "every scene by five patterns"), ("Figures", "figures/index.html", "with their commands"), ("Integrators", "integrators/index.html", ""), ("Pixel filters", "filters/index.html", ""),
            ("Adaptive sampling", "adaptive/index.html", ""), ("Warps", "warps/index.html", ""), ("Integrands", "integrands/index.html", ""), ("Materials", "materials/index.html", ""),
            ("Lights", "lights/index.html", ""), ("Uses of a sample", "uses/index.html", ""), ("References", "references.html", "")]) +
        "<h2>What was found</h2>" + links([("Findings", "findings/index.html", "studies with their numbers")]))
    site.write("index.html", "", "Koksma documents", "sampling patterns, exact measures, and the error of the images", body)


def main():
    """Parses the command line and writes the site."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--quick", action="store_true", help="fewer and smaller pictures and numbers")
    arguments = parser.parse_args()
    pictures = arguments.folder / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    program = Program(str(Path(arguments.program).resolve()), pictures, arguments.quick)
    program.try_run("generate", "r-sequence", "-n", "256", "-q", "-o", FILES["file"][0])
    program.try_run("mask", "--size", "4x4", "-q", "-o", FILES["mask-file"][0])
    examples = ROOT / "examples/samplers"
    shutil.copy(examples / FILES["exec"][0], pictures)
    subprocess.run(["cc", "-shared", "-fPIC", "-I", ROOT / "include", "-o", pictures / FILES["plugin"][0], examples / "rank1.c"], check=True)
    for path, content in FILES.values():
        if content:
            (program.folder / path).write_text(content, encoding="utf-8")
    site = Site(program, arguments.folder)
    patterns, progress, numbers = site.lists["patterns"], site.progress, {}
    if {row["pattern"] for row in patterns if row["reads"] != "-"} != set(FILES):
        raise SystemExit("FILES of tools/make_docs.py has not a file for each pattern that reads one")

    def run(steps):
        return list(program.pool.map(lambda step: step(), steps))

    texts = progress.of(lambda make: make(site), [guide, c_reference, python_reference, commands])
    sets = progress.of(lambda row: measured(site, row), patterns)
    pattern_pages = progress.of(lambda row: pattern_page(site, row, numbers[row["pattern"]]), patterns)
    measure_pages = progress.of(lambda row: measure_page(site, row, numbers), site.lists["measures"])
    tables = progress.of(lambda make: make(), small_tables(site))
    run(texts)
    numbers.update(zip([row["pattern"] for row in patterns], run(sets)))
    run(pattern_pages + measure_pages + tables)
    references_page(site)
    index_pages(site)
    site.finish()
    progress.end()
    print(f"{arguments.folder}/index.html: {len(site.sections)} pages, {len(patterns)} patterns, {len(site.lists['measures'])} measures, "
          f"{len(site.references)} references" + ("" if site.explorer else "; without the explorer (make explorer)"))


if __name__ == "__main__":
    main()

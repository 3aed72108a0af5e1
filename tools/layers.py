#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The layers of src/ and cli/, drawn and checked from the code.

    tools/layers.py check [BUILD]     list all that breaks a rule; exit code 1 if there is any
    tools/layers.py draw FILE.svg     write the drawing of the directories
    tools/layers.py arrows            list every arrow between directories with one use of it

Rules: a directory includes and uses only those named in MAY_USE; that relation has no cycle, and neither has that of
files (a header and its .c file count as one). A wing of src/ uses no wing above it (WINGS). A shared function (koksma__) is declared in the header of the file
that defines it. No type name is defined twice. No header holds code for a single file.

How: comments and strings are removed; an include names a file; a name koksma_... that occurs in one file and that
another file defines (a function or a variable at the start of a line) is a use. The public headers are no way around
this: who calls koksma_evaluate uses the file that defines it. With BUILD, a build folder, the uses are checked against
the undefined symbols of the object files, by nm: what the text shows must contain all that the linker sees.
"""
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# What a directory may use beside itself. The public headers are data types to all.
MAY_USE = {
    "core": "",
    "kernels": "core",
    "warps": "core",
    "json": "core",
    "stats": "core",
    "patterns": "core kernels stats",
    "measures": "core kernels stats warps",
    "masks": "core kernels patterns warps",
    "api": "core patterns measures warps",
    "integrands": "core stats patterns masks api verify",
    "verify": "core patterns measures api",
    "identify": "core patterns api verify",
    "optimise": "core kernels patterns measures api",
    "modules": "core",
    "image": "core kernels stats modules",
    "meshes": "core json image",
    "maskfiles": "core json masks image",
    "plot": "core patterns measures image api modules",
    "render": "core modules json kernels stats masks patterns warps image meshes api",
    "scene": "core json image meshes warps render",
    "study/plan": "core json patterns measures warps integrands image scene render api",
    "study/store": "core study/plan",
    "study/run": "core modules stats patterns measures warps integrands image scene render study/plan study/store api",
    "study/ranking": "core stats optimise patterns measures image scene render study/plan study/run api",
    "study/report": "core stats patterns measures warps integrands image plot render study/plan study/store study/run "
                    "api",
    "study/sheet": "core stats patterns measures integrands verify api image masks maskfiles scene render study/plan study/run study/ranking "
                   "study/report",
    "study/atlas": "core json patterns measures warps integrands image optimise api study/plan study/run study/report study/sheet",
    "cli": "core kernels stats masks maskfiles patterns measures warps integrands api verify identify optimise image scene plot render "
           "study/plan study/run study/ranking study/report study/sheet study/atlas",
}


# Headers that declare what several files of their directory define, and why; so do headers that have their directory's name,
# if no .c file has it (measures/star/star.h).
INTERNAL = {
    "src/engine/identify/sample.h": "the points under test and the sequences that the tests compare them with",
    "src/engine/optimise/search.h": "what the methods of a search share, a section a file",
    "src/render/scene/import.h": "what the readers of other renderers' scenes share, in one file a subject",
    "src/render/scene/mitsuba_reader.h": "the parts of the reader of Mitsuba's scenes",
    "src/render/scene/pbrt.h": "the parts of the reader of pbrt's scenes",
    "src/lab/study/plan/plan.h": "the data of a plan, which plan.c and the parsers of its sections fill",
    "src/render/one_image.h": "one image: the frame, groups of pixels, the film; and the renderer's few other functions",
    "src/render/integrators/integrators.h": "the flags of an integrator, and the hooks of those that have an algorithm",
    "src/render/pipelines/pipelines.h": "the pipelines, and what the files of the wavefront tracer share",
    "src/lab/study/store/store.h": "the interface of the store, whose files are parts of one object",
    "src/lab/study/store/store_internal.h": "the store's object, for its own files only",
    "src/engine/core/files.h": "files that are read and files that are written",
    "src/engine/core/point_files.h": "files of points, one .c file a format",
    "src/engine/core/points.h": "checks of points, and what several measures ask of them",
    "src/engine/core/spec.h": "specs and the modifiers at their end",
    "src/engine/core/lookup.h": "tables of names, and the name that was meant",
    "src/engine/core/hash.h": "short and long hashes",
    "src/engine/core/random.h": "random numbers and permutations",
    "src/engine/core/capacity.h": "memory: arrays that grow",
    "src/engine/core/clock.h": "clocks",
    "src/files/image/formats.h": "image files, one .c file a format",
    "src/files/image/coherence.h": "spectra of pictures and of their errors",
    "src/files/meshes/readers.h": "the readers of mesh files, one .c file a format",
    "src/files/meshes/mesh_file.h": "mesh files and their readers' common parts",
    "src/files/meshes/mesh.h": "triangle meshes and their subdivision",
    "src/files/meshes/gltf.h": "the reader of glTF, in several files",
    "src/lab/study/plan/plan_read.h": "the parsers of a plan's sections, one file each, for plan_read.c",
    "src/lab/study/run/tasks.h": "tasks, which tasks.c lists and jobs.c does",
}


def is_internal(path):
    parts = path.split("/")
    alone = parts[-1] == parts[-2] + ".h" and not os.path.exists(os.path.join(ROOT, path[:-1] + "c"))
    return path in INTERNAL or alone


# From below to above: a wing of src/ uses itself and those before it.
WINGS = ["engine", "files", "render", "lab", "cli"]


def wing(path):
    parts = path.split("/")
    return parts[0] if parts[0] == "cli" else parts[1]


def directory(path):
    """src/lab/study/run/queue.c -> study/run; src/engine/core/dft.c -> core; src/render/lights/sphere.c -> render."""
    parts = path.split("/")
    if wing(path) in ("cli", "render"):
        return "scene" if parts[2:3] == ["scene"] else wing(path)
    if len(parts) < 4:
        return path
    return "/".join(parts[2:4]) if parts[2] == "study" else parts[2]


def unit(path):
    """A header and its .c file are one; an internal header stands for itself."""
    return path if is_internal(path) else path.rsplit(".", 1)[0]


ROOTS = ("src/engine/", "src/files/", "src/", "src/render/", "src/lab/")  # CMakeLists.txt, KOKSMA_ROOTS


def read_sources():
    """{path: text without comments and strings} and {path: [included paths]}."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "src/*.[ch]", "src/*.def", "cli/*.[ch]"],
                            cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    listed = [p for p in listed if os.path.exists(os.path.join(ROOT, p))]
    code, includes = {}, {}
    for path in sorted(set(listed)):
        text = open(os.path.join(ROOT, path), encoding="utf-8").read()
        folder = os.path.dirname(path)
        named = re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.M)
        includes[path] = [p for n in named for p in [r + n for r in ROOTS] + [folder + "/" + n] if p in listed]
        code[path] = re.sub(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'',
                            lambda m: "\n" * m.group().count("\n") or " ", text, flags=re.S)
    return code, includes


def definitions(text):
    """Names koksma_... of external functions and variables that this text defines: at the start of a line, not static."""
    found = set()
    for m in re.finditer(r"^(?!static|typedef|extern|#|KOKSMA)[A-Za-z_][\w \t*]*?\b(koksma_\w+)[ \t]*(\(|\[[^;=]*\] = |= )",
                         text, re.M):
        at = m.end()
        if m.group(2) == "(":
            depth = 1
            while depth and at < len(text):
                depth += {"(": 1, ")": -1}.get(text[at], 0)
                at += 1
            if not re.match(r"\s*\{", text[at:at + 200]):
                continue
        found.add(m.group(1))
    for prefix in re.findall(r"^KOKSMA__LOOKUP\((\w+),", text, re.M):  # core/lookup.h
        found |= {prefix + "_find", prefix + "_count", prefix + "_at"}
    return found


# A function that is declared and not defined, or a variable that another file has.
PROTOTYPE = re.compile(r"^(?:extern [^;]*|[A-Za-z_][\w \t*]*?\bkoksma_\w+[ \t]*\([^;{}]*\)[^;{}]*);", re.M)


def declarations(text):
    """Shared functions that this header declares or defines inline."""
    return set(re.findall(r"\b(koksma__\w+)\s*\(", text))


class Tree:
    def __init__(self):
        self.code, self.includes = read_sources()
        self.defined = {}  # name -> the file that defines it
        for path, text in self.code.items():
            if path.endswith(".c"):
                for name in definitions(text):
                    self.defined.setdefault(name, path)
        self.uses = {}  # path -> {other path: a name}
        for path, text in self.code.items():
            self.uses[path] = {}
            body = PROTOTYPE.sub("", text)
            for name in sorted(set(re.findall(r"\bkoksma_\w+", body))):
                owner = self.defined.get(name)
                if owner and unit(owner) != unit(path):
                    self.uses[path].setdefault(owner, name)

    def directory_arrows(self):
        """{(from, to): (file, what)}: each arrow with a use or an include as its example; calls before includes."""
        arrows = {}
        for path in self.code:
            here = directory(path)
            for other, name in sorted(self.uses[path].items()):
                if directory(other) != here:
                    arrows.setdefault((here, directory(other)), []).append((path, name + " of " + other))
            for other in self.includes[path]:
                if directory(other) != here:
                    arrows.setdefault((here, directory(other)), []).append((path, "includes " + other))
        return arrows


def strong_components(graph):
    """Tarjan's algorithm; components of more than one node, sorted."""
    index, low, stack, on, out, work = {}, {}, [], set(), [], []
    for root in sorted(graph):
        if root in index:
            continue
        work.append((root, iter(sorted(graph[root]))))
        index[root] = low[root] = len(index)
        stack.append(root)
        on.add(root)
        while work:
            node, children = work[-1]
            for child in children:
                if child not in index:
                    index[child] = low[child] = len(index)
                    stack.append(child)
                    on.add(child)
                    work.append((child, iter(sorted(graph.get(child, ())))))
                    break
                if child in on:
                    low[node] = min(low[node], index[child])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    component = []
                    while not component or component[-1] != node:
                        component.append(stack.pop())
                        on.discard(component[-1])
                    if len(component) > 1:
                        out.append(sorted(component))
    return sorted(out)


def check_directories(tree):
    may = {d: set(names.split()) for d, names in MAY_USE.items()}
    for d in sorted({directory(p) for p in tree.code}):
        if d not in may:
            yield "layers", "src/" + d, "no line in MAY_USE of tools/layers.py"
    for component in strong_components(may):
        yield "layers", "MAY_USE of tools/layers.py", "a cycle: " + " ".join(component)
    for (here, there), examples in sorted(tree.directory_arrows().items()):
        if there not in may.get(here, ()):
            for path, what in sorted(set(examples)):
                yield "layers", path, "%s may not use %s: %s" % (here, there, what)
    for path in sorted(tree.code):
        for other in sorted({*tree.uses[path], *tree.includes[path]}):
            if WINGS.index(wing(other)) > WINGS.index(wing(path)):
                yield "wings", path, "%s may not use %s: %s" % (wing(path), wing(other), other)
        for other in tree.includes[path]:
            if path.startswith("cli/") and not other.startswith("cli/"):
                yield "layers", path, "cli includes include/koksma only: " + other


def check_cycles(tree):
    graph = {}
    for path in tree.code:
        to = {unit(p) for p in list(tree.uses[path]) + tree.includes[path]} - {unit(path)}
        graph.setdefault(unit(path), set()).update(to)
    for component in strong_components(graph):
        for member in component:
            yield "cycles", member, "in a cycle with " + " ".join(c for c in component if c != member)


def check_headers(tree):
    headers = {p: declarations(t) for p, t in tree.code.items() if p.endswith(".h")}
    for header in sorted(INTERNAL):
        if header not in headers:
            yield "headers", header, "INTERNAL of tools/layers.py has it, and it is not there"
    for name, path in sorted(tree.defined.items()):
        if name.startswith("koksma__") and name not in headers.get(unit(path) + ".h", ()):
            elsewhere = sorted(h for h, names in headers.items() if name in names)
            if elsewhere and not (is_internal(elsewhere[0]) and directory(elsewhere[0]) == directory(path)):
                yield "headers", path, "%s is declared in %s" % (name, elsewhere[0])
    types = {}
    for path, text in sorted(tree.code.items()):
        for name in re.findall(r"^(?:typedef )?(?:struct|union|enum) (koksma_\w+) \{", text, re.M):
            types.setdefault(name, []).append(path)
    for name, paths in sorted(types.items()):
        for path in paths[1:]:
            yield "types", path, "%s is defined in %s too" % (name, paths[0])
    for header in sorted(headers):
        users = [p for p in tree.code if header in tree.includes[p]]
        holds_code = re.search(r"^static [^;=]*\)\s*\{", tree.code[header], re.M)
        if holds_code and len(users) == 1 and users[0].endswith(".c"):
            yield "fragments", header, "code for one file, " + users[0]


def object_uses(build):
    """{(source, source that defines, symbol)} by nm over the objects of the libraries and the program."""
    source_of = {}
    for folder, _, names in os.walk(build):
        m = re.search(r"(?:^|/)(src|cli)/CMakeFiles/[^/]+\.dir(?:/(.*))?$", os.path.relpath(folder, build))
        for n in names if m else ():
            source = "/".join(filter(None, (m.group(1), m.group(2), n[:-2])))
            if n.endswith(".c.o") and os.path.exists(os.path.join(ROOT, source)):
                source_of[os.path.join(folder, n)] = source
    if not source_of:
        sys.exit("layers.py: %s: no object files; build the libraries and the program there" % build)
    listing = subprocess.run(["nm", "-A", "-P"] + sorted(source_of), capture_output=True, text=True, check=True).stdout
    owner, undefined = {}, []
    for line in listing.splitlines():
        head, name, kind = re.match(r"(.*): (\S+) (\S)", line).groups()
        if name.startswith("koksma_"):
            if kind == "U":
                undefined.append((source_of[head], name))
            elif kind.isupper():
                owner[name] = source_of[head]
    return {(path, owner[name], name) for path, name in undefined if name in owner and owner[name] != path}


def check_objects(tree, build):
    """What the linker sees and the text does not show, which would make the checks above blind."""
    for path, other, name in sorted(object_uses(build)):
        seen = {path} | {p for p in tree.code if p.endswith((".h", ".def"))}
        if directory(path) != directory(other) and not any(other in tree.uses[p] for p in seen):
            yield "unseen", path, "uses %s of %s, which the text does not show" % (name, other)


def problems(build):
    tree = Tree()
    found = list(check_directories(tree)) + list(check_cycles(tree)) + list(check_headers(tree))
    return found + (list(check_objects(tree, build)) if build else [])


def check(build):
    found = problems(build)
    for problem in sorted(found):
        print("%s: %s: %s" % problem)
    print("%d problems" % len(found))
    return 1 if found else 0


# ---- The drawing ---------------------------------------------------------------------------------------------

ABOUT = {
    "modules": "loads Cairo, OpenEXR, Embree, MPI",
    "core": "points, status, random numbers, threads, files, writers",
    "kernels": "fast loops per instruction set",
    "warps": "maps of the square to a domain", "json": "JSON reader with line numbers",
    "stats": "statistics", "patterns": "one file a pattern", "measures": "one file a measure",
    "api": "generate, evaluate", "verify": "proved properties", "identify": "whose points",
    "masks": "masks for a filter", "maskfiles": "files of masks",
    "integrands": "functions, errors", "optimise": "searches for points", "image": "images, formats, spectra",
    "meshes": "mesh readers", "scene": "scene files", "plot": "plots of points, charts", "render": "the renderer",
    "study/plan": "what to run", "study/store": "results (SQLite)", "study/run": "jobs, threads, MPI",
    "study/ranking": "order of patterns", "study/report": "the report", "study/sheet": "the datasheet", "study/atlas": "the atlas, entries",
    "cli": "the program, one file a command; uses all by the public headers",
}


def levels(graph):
    found = {}

    def level(d):
        if d not in found:
            found[d] = 1 + max((level(e) for e in graph[d]), default=-1)
        return found[d]
    for d in graph:
        level(d)
    return found


def draw(out):
    tree = Tree()
    present = {directory(p) for p in tree.code}
    may = {d: set(MAY_USE[d].split()) for d in present}
    graph = {d: set() for d in present}
    for here, there in tree.directory_arrows():
        if there in may[here]:
            graph[here].add(there)
    depth = levels(graph)

    def reaches(a, b, seen):
        return any(c == b or (c not in seen and (seen.add(c) or reaches(c, b, seen))) for c in graph[a])
    shown = {d: [e for e in graph[d] if not any(reaches(c, e, set()) for c in graph[d] if c != e)] for d in graph}
    # An arrow over several rows passes a lane in each of them, so that no arrow crosses a box.
    top, height, row_height = max(depth.values()), 46, 92
    rows, paths = {r: [] for r in range(top + 1)}, []
    for d in sorted(graph):
        rows[depth[d]].append(d)
    for d in sorted(graph):
        for e in sorted(shown[d]):
            lanes = [(d, e, r) for r in range(depth[d] - 1, depth[e], -1)]
            paths.append([d] + lanes + [e])
            for lane in lanes:
                rows[lane[2]].append(lane)
    above = {}
    for path in paths:
        for here, there in zip(path, path[1:]):
            above.setdefault(there, []).append(here)

    def width(item):
        return max(120, 8.5 * len(item), 5.3 * len(ABOUT[item]) + 12) if isinstance(item, str) else 24
    place = {}
    for row in range(top, -1, -1):
        def mean(item):
            return sum(place[a][0] for a in above.get(item, ())) / len(above[item]) if item in above else 500
        items = sorted(rows[row], key=lambda item: (mean(item), str(item)))
        gap = min(60, (1000 - sum(map(width, items))) / (len(items) + 1))
        x = (1000 - sum(map(width, items)) - gap * (len(items) - 1)) / 2
        for item in items:
            place[item] = (x + width(item) / 2, 20 + (top - row) * row_height)
            x += width(item) + gap
    total = 20 + top * row_height + height + 34
    svg = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1000 %d" width="1000" height="%d" '
           'font-family="Helvetica, Arial, sans-serif">' % (total, total),
           '<!-- SPDX-License-Identifier: Apache-2.0; made by tools/layers.py from the code -->',
           '<title>The directories of src/ and cli/, each above those that it uses</title>',
           '<style>rect{fill:#fff;stroke:#345}.a{fill:none;stroke:#789;stroke-width:1.2}text{text-anchor:middle}'
           '.n{font-size:14px;font-weight:bold;fill:#123}.t{font-size:10px;fill:#456}</style>',
           '<defs><marker id="tip" markerWidth="8" markerHeight="8" refX="7" refY="4" orient="auto">'
           '<path d="M0,0L8,4L0,8z" fill="#789"/></marker></defs>',
           '<rect x="0" y="0" width="1000" height="%d" style="stroke:none"/>' % total]
    for path in paths:
        x, y = place[path[0]]
        line = "M%.0f,%.0f" % (x, y + height)
        y += height
        for item in path[1:]:
            ex, ey = place[item]
            bend = (ey - y) / 2
            line += "C%.0f,%.0f %.0f,%.0f %.0f,%.0f" % (x, y + bend, ex, ey - bend, ex, ey)
            x, y = ex, ey
            if not isinstance(item, str):
                y += height
                line += "V%.0f" % y
        svg.append('<path class="a" marker-end="url(#tip)" d="%s"/>' % line)
    for d in sorted(graph):
        x, y = place[d]
        about = ABOUT[d]
        wide = width(d)
        svg.append('<g><title>%s uses %s</title><rect x="%.0f" y="%.0f" width="%.0f" height="%d" rx="5"/>'
                   '<text class="n" x="%.0f" y="%.0f">%s</text><text class="t" x="%.0f" y="%.0f">%s</text></g>' %
                   (d, ", ".join(sorted(graph[d])) or "nothing", x - wide / 2, y, wide, height, x, y + 19, d,
                    x, y + 36, about))
    svg.append('<text class="t" x="500" y="%d">Each directory uses those that its arrows lead to, and what these reach; '
               'the text of a box (hover) lists all.</text></svg>' % (total - 12))
    text = "\n".join(svg) + "\n"
    if out == "-":
        sys.stdout.write(text)
    else:
        with open(out, "w", encoding="utf-8") as f:
            f.write(text)
    return 0


def arrows():
    for (here, there), examples in sorted(Tree().directory_arrows().items()):
        print("%-14s -> %-14s %3d  %s: %s" % (here, there, len(examples), *examples[0]))
    return 0


def main():
    arguments = sys.argv[1:]
    if arguments[:1] == ["check"] and len(arguments) <= 2:
        return check(arguments[1] if len(arguments) > 1 else None)
    if arguments[:1] == ["draw"] and len(arguments) == 2:
        return draw(arguments[1])
    if arguments == ["arrows"]:
        return arrows()
    sys.exit(__doc__)


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: Apache-2.0
"""For tools/make_docs.py: scenes, integrators, filters and the other tables with a page for all members."""
import html
import re

from docs_site import ROOT, slug

GALLERY = ("random", "jittered", "n-rooks", "multi-jittered", "sobol:scramble=owen")  # the patterns of the page `gallery`
FIGURES = (  # of the page `figures`: the title, and the command without its output
    ("The samples of a pixel, and their worst box", "plot pattern:random@16 pattern:sobol:scramble=owen@16 -s 3 --witness star"),
    ("One point in each row and column, or not", "plot pattern:jittered@16 pattern:n-rooks@16 pattern:multi-jittered@16 --rooks"),
    ("Where too many points lie, and too few", "plot pattern:random@64 pattern:hammersley@64 --local-discrepancy"),
    ("White noise beside blue noise", "plot pattern:random@256 pattern:gaussian-blue-noise@256"),
    ("Power spectra", "plot --curve power pattern:random@1024 pattern:poisson-disk-maximal@1024 --trials 4"),
    ("Power by rings of frequencies", "plot --curve rings pattern:random@256 pattern:jittered@256 pattern:sample-elimination@256 --trials 10"),
    ("Distances between points", "plot --curve pairs pattern:poisson-disk-maximal@256 pattern:jittered@256 --trials 10"),
    ("How fast a discrepancy falls", "plot --curve convergence pattern:random@1024 pattern:jittered@1024 pattern:sobol:scramble=owen@1024 --trials 10"),
    ("Sets side by side, for a paper", "plot --compare pattern:random@64 pattern:halton:scramble=owen@64 pattern:pmj02@64"),
    ("Points on a disk", "plot pattern:sobol:scramble=owen@256 --warp concentric-disk"),
)
PATH_TRACED = ("mirror-block", "cornell", "cornell-glossy", "veach-plates", "ajar", "fog")  # scenes made for the integrator `path`

def sections(site, kind, title, what, members):
    """One page for the members of a small table: (name, line, source keys, path, picture or "")."""
    body = ""
    for name, line, keys, path, picture in members:
        at = slug(name) if " " in name else name
        body += f"<h2 id='{at}'>{name}</h2><p>{html.escape(line)}</p>"
        body += site.comment(path, name) if path else ""
        body += f"<p><b>Source.</b> {site.cite(keys, name, kind)}</p>" if keys not in ("", "-") else ""
        body += site.parameters(name) + picture
    site.write(f"{kind}/index.html", "", title, what, body)


def integrator_source(name):
    """The file with an integrator's algorithm; "" for those that are a row of flags."""
    path = f"src/render/integrators/{name.replace('-', '_')}.c"
    return path if (ROOT / path).exists() else ""


def small_tables(site):
    """A step for each page: scenes, integrators, filters, adaptive methods, warps, integrands, materials, lights, uses."""
    program, size = site.program, ["--size", "48x36" if site.program.quick else "160x120"]
    spp = ["-n", "1" if program.quick else "16"]

    def render(name, scene, *options):
        return program.picture(f"{name}.png", "render", scene, *spp, *size, *options, alt=f"{scene} rendered")

    def gallery(scene):
        """A scene by five patterns at 16 samples a pixel."""
        size = ["--size", "24x18" if program.quick else "96x72"]
        return "<div class='gallery'>" + "".join(
            program.picture(f"gallery-{scene}-{pattern.split(':')[0]}.png", "render", scene, "-p", pattern, *spp, *size,
                            *(["--integrator", "path"] if scene in PATH_TRACED else []), alt=f"{scene} by {pattern}", label=pattern)
            for pattern in GALLERY) + "</div>"

    def of(kind, key):
        return [(r, r[key]) for r in site.lists[kind]]

    steps = []

    def add(kind, title, what, members):
        steps.append(lambda: sections(site, kind, title, what, members()))

    add("scenes", "Scenes", "those that ship; <a href='../guide/scenes.html'>scene files</a> says how to write one",
        lambda: [(n, r["what"], "", "", render(f"scene-{n}", n)) for r, n in of("scenes", "scene")])
    add("gallery", "Gallery", "every scene by five patterns at 16 samples a pixel",
        lambda: [(n, r["what"], "", "", gallery(n)) for r, n in of("scenes", "scene")])
    add("figures", "Figures", "and the commands that draw them",
        lambda: [(title, "", "", "", program.picture(f"figure-{i}.svg", *command.split(), alt=title)) for i, (title, command) in enumerate(FIGURES)])
    add("integrators", "Integrators", "how light is followed: <code>koksma render --integrator</code>",
        lambda: [(n, r["what"], r["source"], integrator_source(n),
          render(f"integrator-{n}", "cornell", "--integrator", n)) for r, n in of("integrators", "integrator")])
    add("filters", "Pixel filters", "<code>koksma render --filter</code>",
        lambda: [(n, f"{r['what']}; radius {r['radius']}", r["source"], "src/render/filters",
          render(f"filter-{n}", "checker", "--filter", n)) for r, n in of("filters", "filter")])
    add("adaptive", "Adaptive sampling", "where more samples go: <code>koksma render --adaptive</code>",
        lambda: [(n, r["what"], r["source"], f"src/render/samples/adaptive/adapt_{method_of[n.replace('-', '_')]}.c",
          counts(program, n, size)) for r, n in of("adaptive", "method")])
    add("warps", "Warps", "from the square to a lens, a triangle, a hemisphere, a sphere: <code>koksma measure --warp</code>",
        lambda: [(n, r["what"], r["source"], "src/engine/warps", "") for r, n in of("warps", "warp")])
    def files_of(table, macro):
        """{member: the name of its file} of a table whose rows name their files."""
        rows = re.findall(rf"^{macro}(?:_OF)?\((\w+)(?:, (\w+))?\)", (ROOT / "src" / table).read_text(encoding="utf-8"), re.M)
        return {name: file or name for name, file in rows}
    file_of, method_of = files_of("engine/integrands/integrands.def", "INTEGRAND"), files_of("render/samples/adaptive/adaptive.def", "ADAPTIVE")
    add("integrands", "Integrands", "functions with known integrals: <code>koksma integrate</code>",
        lambda: [(n, f"{r['what']}; integral: {r['integral']}", r["source"], f"src/engine/integrands/{file_of[n.replace('-', '_')]}.c", "")
                 for r, n in of("integrands", "integrand")])
    for kind, macro, prefix in (("materials", "MATERIAL", "bsdf_"), ("lights", "LIGHT", "light_")):
        members = [(n.replace("_", "-"), "", "", f"src/render/{kind}/{prefix}{f}.c", "") for n, f in files_of(f"render/{kind}/{kind}.def", macro).items()]
        add(kind, kind.capitalize(), "of scene files", lambda members=members: members)
    add("uses", "Uses of a sample", "each may have a pattern of its own: <code>koksma render -p USE=PATTERN</code>",
        lambda: [(r["use"], f"{r['what']}; dimensions: {r['dim']}", "", "", "") for r in site.lists["uses"]])
    return steps


def counts(program, method, size):
    """Where an adaptive method spends its samples."""
    out = f"adaptive-{method}.png"
    arguments = ["render", "glossy", "--adaptive", method, "-n", "4", "--budget", "32", *size, "--counts", out]
    _, error = program.try_run(*arguments, "-q", "--threads", "1", "-o", f"adaptive-{method}-image.png")
    if error:
        raise SystemExit(f"koksma {' '.join(arguments)}: {error}")
    command = html.escape("koksma " + " ".join(arguments) + f" -o adaptive-{method}-image.png")
    images = "".join(f"<figure><img src='../pictures/{f}' alt='{alt}'></figure>"
                     for f, alt in ((f"adaptive-{method}-image.png", "the picture"), (out, "samples of each pixel, white is most")))
    return f"<div class='row'>{images}</div><p><small><code>{command}</code></small></p>"

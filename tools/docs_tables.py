# SPDX-License-Identifier: Apache-2.0
"""For tools/make_docs.py: scenes, integrators, filters and the other tables with a page for all members."""
import html
import re

from docs_site import ROOT, page


def sections(site, kind, title, what, members):
    """One page for the members of a small table: (name, line, source keys, path, picture or "")."""
    body = "<p>" + " · ".join(f"<a href='#{m[0]}'>{m[0]}</a>" for m in members) + "</p>"
    for name, line, keys, path, picture in members:
        body += f"<h2 id='{name}'>{name}</h2><p>{html.escape(line)}</p>"
        body += site.comment(path, name) if path else ""
        body += f"<p><b>Source.</b> {site.cite(keys, name, kind)}</p>" if keys not in ("", "-") else ""
        body += site.parameters(name) + picture
    site.write(f"{kind}/index.html", page(title, what, body))


def small_tables(site):
    """Scenes, integrators, filters, adaptive methods, warps, materials, uses."""
    program, size = site.program, ["--size", "48x36" if site.program.quick else "160x120"]
    spp = ["-n", "1" if program.quick else "16"]

    def render(name, scene, *options):
        return program.picture(f"{name}.png", "render", scene, *spp, *size, *options, alt=f"{scene} rendered")

    def of(kind, key):
        return [(r, r[key]) for r in site.lists[kind]]

    sections(site, "scenes", "Scenes", "those that ship; docs/scenes.md says how to write one",
             [(n, r["what"], "", "", render(f"scene-{n}", n)) for r, n in of("scenes", "scene")])
    sections(site, "integrators", "Integrators", "how light is followed: koksma render --integrator",
             [(n, r["what"], r["source"], f"src/render/integrators/integrate_{n.replace('-', '_')}.c",
               render(f"integrator-{n}", "cornell", "--integrator", n)) for r, n in of("integrators", "integrator")])
    sections(site, "filters", "Pixel filters", "koksma render --filter",
             [(n, f"{r['what']}; radius {r['radius']}", r["source"], f"src/render/filters/filter_{n.replace('-', '_')}.c",
               render(f"filter-{n}", "checker", "--filter", n)) for r, n in of("filters", "filter")])
    sections(site, "adaptive", "Adaptive sampling", "where more samples go: koksma render --adaptive",
             [(n, r["what"], r["source"], f"src/render/samples/adaptive/adapt_{n.replace('-', '_')}.c",
               counts(program, n, size)) for r, n in of("adaptive", "method")])
    sections(site, "warps", "Warps", "from the square to a lens, a triangle, a hemisphere: koksma measure --warp",
             [(n, r["what"], r["source"], f"src/warps/{n.replace('-', '_')}.c", "") for r, n in of("warps", "warp")])
    names = re.findall(r"^MATERIAL\((\w+)\)", (ROOT / "src/render/materials/materials.def").read_text(encoding="utf-8"), re.M)
    sections(site, "materials", "Materials", "of scene files",
             [(n, "", "", f"src/render/materials/bsdf_{n}.c", "") for n in names])
    sections(site, "uses", "Uses of a sample", "each may have a pattern of its own: koksma render -p USE=PATTERN",
             [(r["use"], f"{r['what']}; dimensions: {r['dim']}", "", "", "") for r in site.lists["uses"]])


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

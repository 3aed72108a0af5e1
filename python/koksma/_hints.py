# SPDX-License-Identifier: Apache-2.0
"""What to say of a name that the module does not have: the spelling that it has, or the call that does what was meant."""
from __future__ import annotations

from difflib import get_close_matches
from typing import Sequence

_CALLS = {  # names of others, chiefly of scipy.stats.qmc
    "discrepancy": 'measure(points, "CD") is the value of scipy.stats.qmc.discrepancy, its names "WD", "MD" and "L2-star" are known, too',
    "Sobol": 'generate("sobol:scramble=owen", n, d) or Engine("sobol:scramble=owen", d) scrambles it, as scipy does',
    "Halton": 'generate("halton", n, d) or Engine("halton", d)',
    "LatinHypercube": 'generate("latin-hypercube", n, d) or Engine("latin-hypercube", d)',
    "PoissonDisk": 'generate("poisson-disk-maximal:d=0.1") or generate("poisson-disk:d=0.1", n)',
    "QMCEngine": "Engine has its interface",
    "sample": 'generate("sobol:scramble=owen", n)', "points": 'generate("sobol:scramble=owen", n)',
    "scale": "scipy.stats.qmc.scale takes the points of generate; domain= makes some patterns in a rectangle",
    "integral": "integrate(function, pattern, n)", "load": "read(path)", "save": "write(path, points)",
    "seed": "generate(pattern, n, seed=7): each call takes its seed", "warp": 'warp_points(points, "concentric-disk"); warps() names them',
    "curve": "spectrum(points), pair_correlation(points) and convergence(pattern, measure)",
    "draw": "plot(points)", "show": "plot(points)", "scrambled": 'generate("sobol:scramble=owen", n)', "owen": 'generate("sobol:scramble=owen", n)',
}


def hint(name: str, known: Sequence[str]) -> str:
    """The end of a message on a name that koksma lacks: "" or "; " and what to use."""
    from ._points import measures, patterns

    words = name.lower().replace("_", "-")
    british = name.lower().replace("optimiz", "optimis")
    calls = {call.lower(): said for call, said in _CALLS.items()}
    if british in known:
        return f"; did you mean koksma.{british}?"
    if name in ("CD", "WD", "MD", "L2_star"):
        return f'; koksma.measure(points, "{name.replace("_", "-")}") is scipy\'s value'
    if words in calls:
        return f"; koksma.{calls[words]}"
    if words in (p.name for p in patterns()):
        return f'; koksma.generate("{words}", n) makes its points'
    if words in (m.name for m in measures()):
        return f'; koksma.measure(points, "{words}") computes it'
    near = get_close_matches(british.replace("list_", ""), [k for k in known if k.islower() or not name.islower()], 1)
    return f"; did you mean koksma.{near[0]}?" if near else "; help(koksma) names all that there is"

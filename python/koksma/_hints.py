# SPDX-License-Identifier: Apache-2.0
"""What to say of a name that the module, or an argument that a function does not have: the spelling that it has, or what does
what was meant."""
from __future__ import annotations

import inspect
import re
from typing import Any, Callable, Sequence

from ._library import closest

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
    "scramble": 'generate("sobol:scramble=owen", n)', "sampler": "Engine has the interface of scipy.stats.qmc, generate(pattern, n) makes points",
    "qmc": "Engine has the interface of scipy.stats.qmc", "study": "Study",
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
    of_measure = words.replace("-discrepancy", "")
    if of_measure in (m.name for m in measures()):
        return f'; koksma.measure(points, "{of_measure}") computes it'
    near = closest(british.replace("list_", ""), [k for k in known if k.islower() or not name.islower()])
    return f"; did you mean koksma.{near}?" if near else "; help(koksma) names all that there is"


_MEANT = {  # what others call an argument, and what functions of this package call it, the likeliest first
    "dim": "dims dimension dimensions ndim ndims n_dim d dim", "n": "n_samples num_samples nsamples n_points num_points npoints samples points count num size spp n",
    "spp": "samples n_samples num_samples samples_per_pixel n spp", "seed": "rng random_state seeds rand key scramble_seed seed",
    "threads": "n_jobs jobs workers num_threads nthreads n_threads cores threads", "time_limit": "timeout limit time max_time seconds budget time_limit",
    "size": "resolution res shape width height dimensions size", "measures": "measure metric metrics method methods measures",
    "measure": "measures metric method measure", "metrics": "metric measure metrics", "metric": "metrics measure error metric",
    "patterns": "pattern sampler samplers spec specs patterns", "pattern": "patterns sampler spec name engine pattern",
    "path": "file filename fname out output path", "out": "output result buffer out", "trials": "repeats replicates n_trials runs n_seeds trials",
    "reference": "ref truth ground_truth reference", "a": "image test first a", "b": "reference image second b",
    "sizes": "n ns n_list counts", "depth": "max_depth maxdepth bounces max_bounces", "tolerance": "epsabs epsrel atol rtol tol eps error abs_tol rel_tol",
    "first": "start skip offset fast_forward first", "scene": "file path filename scene",
    "warp": "domain mapping", "function": "f fun func integrand function", "steps": "iterations n_iter niter max_iter iters steps",
}
_PARTS = {  # what is no argument here, but a part of a spec
    "scramble": 'is a part of the pattern: "NAME:scramble=owen"', "shift": 'is a part of the pattern: "korobov,shift=1"',
    "trials": "is of koksma.trials(pattern, n, measure)", "optimise.method": "is chosen by the measure",
    "radius": 'is a part of the pattern: "poisson-disk:d=0.1"', "r": 'is a part of the pattern: "poisson-disk:d=0.1"',
    "plot.n": "is of generate: plot(generate(pattern, n))", "rank.target_error": "is of koksma.rank_to_error", "rank_to_error.spp": "is what it finds",
    "sigma": 'is a part of the filter: "gaussian:sigma=1"',
    "optimization": "is koksma.optimise(measure, n, d)", "dtype": "is that of points.astype(dtype)",
    **dict.fromkeys(("l_bounds", "u_bounds", "bounds", "low", "high"), "is of scipy.stats.qmc.scale(points, l_bounds, u_bounds)"),
}


def hint_of_argument(name: str, function: "Callable[..., Any]") -> str:
    """The end of a message on an argument that a function lacks."""
    own = f"{function.__name__}.{name}"
    word = own if own in _PARTS else name.lower()
    known = [p for p in inspect.signature(function).parameters if p not in ("self", "cls")]
    meant = [k for k, others in _MEANT.items() if k in known and word in others.split()]
    near = meant[0] if meant else closest(word, known)
    if word in ("output", "path", "out", "file") and not meant and function.__name__ in ("render", "datasheet", "plot"):
        return "; write_image(path, image) writes it" if function.__name__ == "render" else "; the method save(path) of its result writes it"
    return (f"; {name} {_PARTS[word]}" if word in _PARTS and not meant else f"; did you mean {near}?" if near
            else f"; it takes {', '.join(known)}")


_REMEDIES = (  # what functions ("": any) say, with FIRST for the name of its first argument, and what would work
    ("integrate", r"real numbers, not <U", "call it for each pattern"),
    ("", r"points must be real numbers, not (\[\('|\(numpy.record)", "numpy.lib.recfunctions.structured_to_unstructured makes columns of fields"),
    ("", r"points must be real numbers, not complex", "np.column_stack((z.real, z.imag)) has the plane"),
    ("", r"points must be real numbers, not <U", "points.astype(float) reads numbers"),
    ("", r"points must be an array of real numbers, not \{['\"]", "np.column_stack(list(points.values())) joins columns"),
    ("", r"points must be an array of real numbers, not (\{|<generator|<map|<zip)", "np.array(list(points)) is one"),
    ("", r"points must be an array of real numbers, not Engine", "engine.random(n) draws them"),
    ("", r"numbers, not tensor\(", "x.detach().cpu().numpy() is an array"),
    ("", r"points must not have masked", "points[~points.mask.any(axis=1)] leaves out what has a masked one"),
    ("", r"its column counts the rows", "its column counts the rows: points[:, 1:] has the others"),
    ("integrate", r"^bounds must have low < high", "one (low, high) for each coordinate: list(zip(lower, upper))"),
    ("", r"coordinate -?(nan|inf) is outside", "a value is missing, or was divided by 0"),
    ("", r"coordinate -.* is outside \[0,1\]", "points of [-0.5,0.5] are x + 0.5 here, those of [-1,1] (x + 1) / 2"),
    ("", r"is outside \[0,1\]", "points lie in the unit cube: divide by the largest coordinate there can be"),
    ("", r"^\w+ must be an int, not \d+\.0$", "int(x) makes one"),
    ("", r"^an image must be .*, not \([13], \d+, \d+\)", "image.transpose(1, 2, 0) has this order"),
    ("", r"^an image must be .*, not \(\d+, \d+, 4\)", "image[..., :3] leaves out alpha"),
    ("", r"^an image must be .*, not \(\d+,\)", "image.reshape(height, width) has rows"),
    ("", r"not Layers\(", "the image of layers is their .image"),
    ("", r"^size must be \(width, height\), not \(\d+, \d+, \d\)", "of an array it is (shape[1], shape[0])"),
    ("rank rank_to_error", r"^a pattern as reference", "an image is an array, reference=koksma.read_image(path)"),
    ("rank rank_to_error render", r"^scene must be a str, not [\[(]", "it comes first, and is one"),
    ("rank_to_error", r"^patterns must be a sequence", "the order is rank_to_error(scene, target_error, patterns)"),
    ("render", r"^pattern must be a str, not \d", "the order is render(scene, pattern, spp)"),
    ("mask", r"not of shape \(2,\)", "the order is mask(filter, size)"),
    ("mask_quality", r"array of numbers, not '[a-z-]+:", "the order is mask_quality(mask, filter)"),
    ("write_mask", r"array of numbers, not '", "the order is write_mask(path, mask)"),
    ("datasheet", r"^sampler must be a str, not array", "a set of one's own is a file, 'file:PATH'"),
    ("datasheet", r"^sampler must be a str, not [\[(]", "beside= takes others"),
    ("plot_convergence", r"^results must be", "those of a list are plot_convergence(*results)"),
    ("", r"^threads must be 0 to .*, not -1$", "0 takes all processors"),
    ("", r"^seed must be an int, not ", "or a Generator, as numpy.random.default_rng(1), or None for other numbers each time"),
    ("generate warp_points measure", r"no warp 'disk'", "concentric-disk and polar-disk map to it"),
    ("integrate", r"pattern must be a str, not -?\d", "integrate(function, dim, tolerance=1e-4, bounds=[(low, high)] * dim) takes a box"),
    ("integrate", r"pattern must be a str, not <function", "the order is integrate(function, pattern, n)"),
    ("integrate", r"n must be an int, not [\[(]", "with a tolerance it is the number of points of the first step"),
    ("integrate", r"^bounds must be .*\binf\b", "a map of the unit interval, as x / (1 - x), reaches infinity, with its derivative as a factor"),
    ("optimise", r"^n, the number of points, is missing", "optimise(measure, start=points) improves points"),
    ("convergence trials", r"measure must be a str, not \[", "call it for each measure"),
    ("trials", r"n must be an int, not [\[(]", "convergence(pattern, measure, sizes) takes several"),
    ("verify identify", r"at least 1, not \(\d+, \d+, \d+\)", "it takes one set of a stack, as points[0]"),
    ("generate", r"n must be an int, not (array|\[)", "call it for each number"),
    ("generate", r"n must be an int, not \(", "the dimension is an argument of its own: generate(pattern, n, dim)"),
    ("generate", r"pattern must be a str, not [\[(]", "call it for each pattern"),
    ("measure", r"measure must be a sequence, not Member", "its name is one"),
    ("measure", r"measure must be a list of texts, not (array|\[\[)|dim of at least 1, not \(\d+, \d+, \d+\)", "several sets are one array, np.stack(sets)"),
    ("measure", r"real numbers, not \[array", "sets of different sizes take a call each"),
    ("verify_sets", r"not the text", "sets are [generate(pattern, n, seed=seed) for seed in range(100)]"),
    ("local_discrepancy", r"at least 1, not \(\d+,\)", "the order is local_discrepancy(points, corner)"),
    ("", r"scene must be a str, not <", "give its path"),
    ("", r"scene must be a str, not {", "a scene of one's own is a JSON file"),
    ("verify", r"takes 1 positional argument", "it tests all properties: [f for f in verify(points) if f.property == ...]"),
    ("verify_sets", r"shape", "it takes several sets, verify(points) takes one"),
    ("integrate", r"returned the shape", "the points are rows: x[:, 0] * x[:, 1], and a sum takes axis=1"),
    ("integrate", r"^FIRST\(\) missing \d+ required positional", "it takes one array of shape (n, dim): x[:, 0], x[:, 1]"),
    ("integrate", r"bounds of the integrand's values", "they are value_range=(low, high)"),
    ("integrate", r"no integrand", "koksma.integrands() names them; a function of one's own is one of Python"),
    ("mask_quality", r"number -.*; those of scalar are", "a mask has numbers of 0 to 1, each equally often, as koksma.mask makes it"),
    ("mask_quality", r"those of scalar are 0 to 1", "divide values of 0 to 255 by 255"),
    ("mask_quality", r"those of vector3 are", "a picture is no mask; (height, width, 3) are the numbers of vector3"),
    ("generate", r"dim must be an int, not 0\.", 'a radius is a part of the pattern: "poisson-disk:d=0.1"'),
    ("__init__", r"^d must be", 'a radius is a part of the pattern: "poisson-disk:d=0.1"'),
    ("mask_quality", r"must be an array of numbers, not '", "read_mask(path) reads a file"),
    ("rank", r"spp must be an int, not \[", "call it for each number"),
    ("rank", r"patterns must be a list of texts, not 'all'", "[p.name for p in koksma.patterns()] is one of all"),
    ("", r"must be a list of texts, not '[^']+'$", "a list of one is ['name']"),
    ("plot_compare", r"pattern must be a str, not \d", "numbers have names: n=256, size=640"),
    ("plot_compare", r"pattern must be a str, not [\[(]['\"]", "plot_compare(*patterns) takes those of a list"),
    ("plot_compare", r"pattern must be a str, not ", "plot(a, b) draws several sets"),
    ("plot", r"dim of at least 1, not \(\)", "numbers have names: columns=16, size=640"),
    ("", r"^(?:patterns|measures|integrands|metrics|warps|scenes)\(\) takes 0 positional", "it lists all; each has a name"),
)


_TEXTS = ("pattern", "measure", "warp", "measures", "path", "scene", "metrics", "sampler")
_NO_TEXTS = ("d", "points", "image", "a", "b", "x", "sets", "n", "dim", "spp")


def hint_of_values(message: str, function: "Callable[..., Any]", values: Sequence[Any]) -> str:
    """The end of a message on arguments in the wrong order, or on a name that is something else."""
    from ._points import measures, patterns
    from ._render import scenes

    known = list(inspect.signature(function).parameters)
    given = list(zip(known, values))
    if known[:1] == ["self"]:
        known = known[1:]
    no_text = [] if function.__name__.startswith("plot") else [name for name, value in given if name in _TEXTS and not isinstance(value, (str, list, tuple))]
    if no_text and any(name in _NO_TEXTS and isinstance(value, str) for name, value in given):
        return f"; the order is {function.__qualname__.replace('.__init__', '')}({', '.join(known[:2])})"
    for word in [value for value in values if isinstance(value, str)] if function.__name__ == "plot" else ():
        return ("; generate(pattern, n) makes points" if word.partition(":")[0] in [p.name for p in patterns()]
                else f"; plot(points, witness={word!r}) draws the region where it is reached" if word.partition(":")[0] in [m.name for m in measures()]
                else "; plot(points).save(path) writes a file")
    if re.search(r"takes from \d+ to \d+ positional", message):
        order = [p.name for p in inspect.signature(function).parameters.values() if p.kind == p.POSITIONAL_OR_KEYWORD]
        return f"; the order is {function.__name__}({', '.join(order)}), the others have names"
    first = re.escape(getattr(values[0], "__qualname__", " ")) if values else " "
    for of, says, remedy in _REMEDIES:
        if (not of or function.__name__ in of.split()) and re.search(says.replace("FIRST", first), message) and (of or ";" not in message or "counts the rows" in says):
            return f"; {remedy}"
    if no_text == ["pattern"] and message.startswith("pattern must be a str"):
        return ("; uses are in one text, 'pixel=random;lens=sobol'" if any(isinstance(value, dict) for value in values)
                else "; its name is one" if " Member(" in message else "; a set of one's own is a file, 'file:PATH'")
    found = re.match(r"no (\w+) '([^']*)'", message)
    if not found:
        return ""
    kind, word = found[1], found[2]
    if word == "all" and kind in ("pattern", "measure", "metric"):
        return f"; [x.name for x in koksma.{kind}s()] is a list of all"
    if "@" in word and kind == "pattern":
        return f"; the number is an argument of its own: {word.split('@')[0]!r}, {word.split('@')[1]}"
    if "," in word and "=" not in word and kind in ("pattern", "measure", "metric"):
        return f"; several are a list: {word.replace(' ', '').split(',')}"
    families = (("pattern", [p.name for p in patterns()]), ("measure", [m.name for m in measures()]), ("scene", scenes()))
    is_a = [what for what, names in families if what != kind in ("pattern", "measure", "scene") and word in names]
    return f"; {word!r} is a {is_a[0]}" if is_a else ""

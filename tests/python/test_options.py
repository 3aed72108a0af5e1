#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every option of every command of the program KOKSMA (in the environment) has a parameter or a function in the package, or
stands below with the reason why Python needs none. A new option fails here until somebody has decided about it."""
import inspect
import os
import re
import subprocess
import unittest

import koksma

# What all commands share: how rows are printed, how progress is shown, where a result is written.
EVERYWHERE = {
    "json": "results are objects", "long": "results are objects", "digits": "numbers are floats", "help": "help() shows docstrings",
    "quiet": "nothing is printed", "allow-exec": "allow_exec", "exec-seconds": "allow_exec(seconds)", "threads": "threads",
    "progress": "a callback where calls are long", "unknown": "refuse_unknown",
    "format": "to_frame, whose data frames write CSV and LaTeX", "scale": "a quotient of arrays",
}
SETS = {"patterns": "generate(pattern)", "n": "generate(n)", "dim": "generate(dim)", "seed": "generate(seed)"}

# By command and option: "function(parameter)" or "function", several with a space between; or a sentence that says why not.
OPTIONS = {
    "generate": {"patterns": "generate(pattern)", "n": "generate(n)", "dim": "generate(dim)", "first": "generate(first)",
                 "seed": "generate(seed)", "warp": "generate(warp) warp_points", "density": "generate(density)", "on": "generate(on)", "domain": "generate(domain)",
                 "output": "write"},
    "measure": {**SETS, "measures": "measure(measure)", "trials": "trials(trials)", "prefixes": "convergence(prefixes)",
                "at": "local_discrepancy(corner)", "sizes": "convergence(sizes)", "warp": "measure(warp) trials(warp) convergence(warp)",
                "paired": "Trials.__sub__", "time-limit": "measure(time_limit) trials(time_limit)"},
    "integrate": {"patterns": "integrate(pattern)", "n": "integrate(n)", "dim": "integrate(dim)", "trials": "integrate(trials)",
                  "seed": "integrate(seed)", "anova": "integrate(anova) sensitivity",
                  "samples": "integrate(samples) sensitivity(samples)",
                  "tolerance": "integrate(tolerance)", "relative": "integrate(relative)", "estimator": "integrate(estimator)",
                  "interval": "integrate(interval)", "confidence": "integrate(confidence)", "replicates": "integrate(replicates)",
                  "max-points": "integrate(max_points)", "range": "integrate(value_range)", "with": "a callable is called"},
    "optimise": {"n": "optimise(n)", "dim": "optimise(dim)", "from": "optimise(start)", "keep": "optimise(keep)",
                 "projections": "optimise(projections)", "weights": "optimise(weights)", "steps": "optimise(steps)",
                 "time-limit": "optimise(time_limit)", "seed": "optimise(seed) optimise_scene(seed)", "output": "write",
                 "power": "optimise(power)", "band": "radial_power(rings)", "scene": "optimise_scene(scene)",
                 "held-out": "optimise_scene(held_out)", "against": "optimise_scene(against)",
                 "candidates": "optimise_scene(candidates)", "phases": "optimise_scene(phases)", "size": "optimise_scene(size)",
                 "max-trials": "optimise_scene(max_trials)"},
    "mask": {"output": "write_mask", "filter": "mask(filter) mask_quality(filter)", "size": "mask(size)", "space": "mask(space)",
             "open": "mask(open)", "levels": "mask(levels)", "swaps": "mask(swaps)", "until": "mask(target)",
             "time-limit": "mask(time_limit)", "seed": "mask(seed)", "from": "mask(start)",
             "resume": "the program continues searches, by the recipes beside their files", "bits": "write_mask(bits)",
             "tests": "mask_quality(tests)", "rings": "the power spectrum of an array is NumPy's rfft2", "histogram": "NumPy's histogram",
             "correlation": "NumPy's irfft2 of the product of two rfft2"},
    "curve": {**SETS, "trials": "spectrum(sets) pair_correlation(sets)", "half": "spectrum(half)", "exact": "spectrum(exact)",
              "r-max": "pair_correlation(r_max)", "bins": "pair_correlation(bins)", "output": "write_image",
              "filter": "screen_errors(filter)"},
    "verify": {**SETS, "expect": "Finding", "record": "records", "measure": "records",
               "seeds": "verify_sets"},
    "identify": {**SETS, "seed": "generate(seed)"},
    "plot": {**SETS, "output": "Picture.save", "curve": "plot_compare and the methods draw of Spectrum, PairCorrelation and Convergence", "compare": "plot_compare",
             "size": "plot(size)", "title": "plot(title)", "theme": "plot(theme)", "columns": "plot(columns)", "rows": "plot(rows)",
             "grid": "plot(columns) plot(rows)", "rooks": "plot(columns) plot(rows)", "witness": "plot(witness)", "warp": "plot(warp)",
             "local-discrepancy": "plot(local_discrepancy)", "white": "Spectrum.power is an array for matplotlib's imshow",
             "measure": "plot_compare(measure)", "sizes": "plot_compare(sizes)", "trials": "plot_compare(trials)",
             "half": "spectrum(half)", "exact": "spectrum(exact)", "r-max": "pair_correlation(r_max)", "bins": "pair_correlation(bins)"},
    "render": {"error-map": "render_replicates", "replicates": "render_replicates(replicates)", "pattern": "render(pattern)", "spp": "render(spp)", "size": "render(size)", "seed": "render(seed)", "sky": "render(sky)",
               "environment": "render(environment)", "aov": "render(aov)", "output": "write_image", "pairing": "render(pairing)",
               "scope": "render(scope)", "lights": "render(lights)", "integrator": "render(integrator)", "depth": "render(depth)",
               "filter": "render(filter)", "splat": "render(splat)", "adaptive": "render(adaptive)", "budget": "render(budget)",
               "probe": "render(probes)", "counts": "Layers",
               "strata": "a drawing of one pixel for who develops an adaptive method, which is done in C"},
    "scene": {"check": "check_scene"},
    "compare": {"metric": "compare(metrics)", "reference": "compare(reference)", "output": "the difference of two arrays", "max-mean": "Comparison"},
    "rank": {"spp": "rank(spp)", "target-error": "rank_to_error(target_error)", "patterns": "rank(patterns)", "size": "rank(size)", "with": "rank(renderer)",
             "reference": "rank(reference)", "one-size": "rank(one_size)", "integrator": "rank(integrator)", "filter": "rank(filter)",
             "adaptive": "rank(adaptive)", "metric": "rank(metric)", "time-limit": "rank(time_limit)", "max-trials": "rank(max_trials)",
             "depth": "rank(depth)", "lights": "rank(lights)", "scope": "rank(scope)", "seed": "rank(seed)", "filter-with": "rank(process)"},
    "datasheet": {"output": "Datasheet.save", "beside": "datasheet(beside)", "scenes": "datasheet(scenes)",
                  "metric": "datasheet(metric)", "quick": "datasheet(quick)"},
    "study": {"output": "Study(folder) study_images(folder)", "trials": "Study(trials)", "quick": "Study(quick)",
              "time-limit": "Study.run(time_limit) Study.estimate(time_limit)", "rows": "audit(rows)", "seed": "audit(seed)",
              "reference": "study_images(reference)", "metric": "study_images(metric)",
              **dict.fromkeys(("patterns", "measures", "integrands", "points", "scene", "spp"), "a plan is a dict: Study(plan)")},
    "reproduce": {"output": "Study(folder)", "trials": "Study(trials)", "quick": "Study(quick)", "papers-only": "Study(plan)", "table": "Study.table(id)"},
    "list": {},
}
# Commands of the program itself.
NO_FUNCTION = {"completion", "manual", "help", "version"}


def program(*arguments):
    return subprocess.run([os.environ["KOKSMA"], *arguments], capture_output=True, text=True, check=True).stdout


def options_of(command):
    """Long names of the options in a command's help."""
    return set(re.findall(r"^ {2,6}(?:-\w, )?--([a-z][a-z-]*)", listed(command), re.M))


def listed(command):
    """The part of a command's help that lists options: from the first one on to the line after the last."""
    return re.search(r"^(?:  -|      --).*?(?=\n\n)", program(command, "--help"), re.M | re.S)[0]


class Options(unittest.TestCase):
    def test_every_command(self):
        commands = set(re.findall(r"^  ([a-z]+) {2,}", program("--help"), re.M))
        self.assertGreater(len(commands), 15)
        self.assertEqual(commands - NO_FUNCTION, set(OPTIONS))

    def test_every_option(self):
        for command, known in OPTIONS.items():
            with self.subTest(command=command):
                given = options_of(command) - set(EVERYWHERE)
                self.assertEqual(given - set(known), set(), "options without a place in Python")
                self.assertEqual(set(known) - given - {"check"}, set(), "options that the program no longer has")

    def test_every_parameter(self):
        for command, known in OPTIONS.items():
            for option, places in {**known, **EVERYWHERE}.items():
                for function, parameter in re.findall(r"([A-Za-z_]+(?:\.[a-z_]+)?)\((\w+)\)", places):
                    with self.subTest(command=command, option=option, place=places):
                        target = koksma
                        for name in function.split("."):
                            target = getattr(target, name)
                        self.assertIn(parameter, inspect.signature(target).parameters)
                if " " not in places and "(" not in places and option not in EVERYWHERE:
                    target = koksma
                    for name in places.split("."):
                        target = getattr(target, name)

    def test_same_defaults(self):
        """What the help gives as a default is the default here, but for a time limit, without which optimise may not begin."""
        for command, function, renamed in (("generate", koksma.generate, {}), ("render", koksma.render, {}), ("rank", koksma.rank, {}),
                                           ("optimise", koksma.optimise_scene, {}), ("integrate", koksma.integrate, {})):
            text = re.sub(r"\n {8,}", " ", listed(command))
            for option, default in re.findall(r"--([a-z-]+) [^\n]*\(default: ([a-z0-9-]+)\)", text):
                parameter = inspect.signature(function).parameters.get(renamed.get(option, option.replace("-", "_")))
                if option == "threads" or parameter is None or parameter.default is inspect.Parameter.empty or parameter.default is None or isinstance(
                        parameter.default, tuple):  # names of several, as of the patterns of rank
                    continue
                with self.subTest(command=command, option=option):
                    self.assertEqual(str(parameter.default), default)


if __name__ == "__main__":
    unittest.main()

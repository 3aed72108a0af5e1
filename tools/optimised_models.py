#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The models of docs/findings/optimised.md, from the rows of tools/optimised.py.

    tools/optimised_models.py [--rows FOLDER] [--error mae|rmse] [-o FILE.json] [--check PAGE.md]

It reads images-R, sets-R and bias-R.csv.xz of every seed R in FOLDER (default: studies/optimised) and design.json there, writes
all numbers to FILE.json (default: standard output gets only the tables), and prints the page's tables. --check fails if the page
lacks a line of them. --error rmse: of the root mean square error in place of the mean absolute one.

Model. y is the log of the mean absolute error, averaged over the filters and trials of an arm. For a target t, a number of points
n, a search s and a scene c,

    y = mu(n, c) + target(t) + target x n + target x scene + target x n x scene + set(s within t, n) + set x scene

with searches and scenes drawn at random: a claim is about other sets of that target in other scenes. A contrast of two targets
is made pair by pair (their searches began from the same random points), averaged over n; its variance is
(MS_search + MS_scene - the smaller mean square of both and their interaction) / (searches x scenes), which is never below the
larger of the two alone, with Satterthwaite's degrees of freedom. Intervals of a table hold together with 95 % (Bonferroni)."""
import argparse
import csv
import io
import itertools
import json
import lzma
import math
import os
import pathlib
import sys

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # matrices of 13 x 13: threads only wait for each other
import numpy as np  # pylint: disable=wrong-import-position

HOME = pathlib.Path(__file__).resolve().parent.parent / "studies" / "optimised"
SMALLER_IS_WORSE = {"relative-radius"}


def student(confidence, df):
    """The t with P(|T| <= t) = confidence, for df >= 1 degrees of freedom: t = sqrt(df) tan(a), where the density of a is
    proportional to cos(a)^(df - 1); by trapezoids."""
    angle = np.linspace(0, min(math.pi / 2, 60 / math.sqrt(df)), 4001)
    density = np.cos(angle)**(df - 1)
    within = np.concatenate([[0], np.cumsum(density[1:] + density[:-1])])
    return math.sqrt(df) * math.tan(np.interp(confidence * within[-1], within, angle))


def contrast(difference, tests=1):
    """Mean, low, high of differences by search and scene, an array of that shape; `tests` intervals hold together."""
    searches, scenes = difference.shape
    mean, rows, columns = difference.mean(), difference.mean(1), difference.mean(0)
    by_search, by_scene = scenes * rows.var(ddof=1), searches * columns.var(ddof=1)
    both = ((difference - rows[:, None] - columns + mean)**2).sum() / ((searches - 1) * (scenes - 1))
    variance = (by_search + by_scene - min(both, by_search, by_scene)) / difference.size
    if variance == 0:
        return mean, mean, mean
    df = (variance * difference.size)**2 / (by_search**2 / (searches - 1) + by_scene**2 / (scenes - 1))
    width = student(1 - 0.05 / tests, max(df, 1)) * math.sqrt(variance)
    return mean, mean - width, mean + width


def ratio(interval):
    """A contrast of logs as a ratio: value, low, high."""
    return [float(math.exp(x)) for x in interval]


def squares(y, names):
    """Sums of squares and degrees of freedom of every effect of a full factorial: {names of its factors: (SS, df)}."""
    found, axes = {}, range(y.ndim)
    for k in range(1, y.ndim + 1):
        for subset in itertools.combinations(axes, k):
            effect = np.zeros([y.shape[a] if a in subset else 1 for a in axes])
            for m in range(k + 1):
                for part in itertools.combinations(subset, m):
                    effect = effect + (-1)**(k - m) * y.mean(axis=tuple(a for a in axes if a not in part), keepdims=True)
            found[tuple(names[a] for a in subset)] = (float((effect**2).sum() * y.size / effect.size),
                                                      int(np.prod([y.shape[a] - 1 for a in subset])))
    return found


def shares(y, names, groups):
    """The share of all squares of each group: {name: test of an effect's factors}, the first that holds."""
    found, total = {name: 0.0 for name in groups}, 0.0
    for effect, (ss, _) in squares(y, names).items():
        found[next(name for name, holds in groups.items() if holds(set(effect)))] += ss
        total += ss
    return {name: ss / total for name, ss in found.items()}


def components(y):
    """Components of variance of y[target, n, search, scene] within n and scene, by the method of moments (0 where negative)."""
    (targets, ns, searches, scenes), s = y.shape, squares(y, "tnsc")
    mean = lambda *effects: sum(s[e][0] for e in effects) / sum(s[e][1] for e in effects)
    t, tn, tc, tnc = (mean(tuple(e)) for e in ("t", "tn", "tc", "tnc"))
    sets = mean(tuple("s"), tuple("ts"), tuple("ns"), tuple("tns"))
    rest = mean(tuple("sc"), tuple("tsc"), tuple("nsc"), tuple("tnsc"))
    found = {"target": (t - tn - tc + tnc) / (ns * searches * scenes), "target x n": (tn - tnc - sets + rest) / (searches * scenes),
             "target x scene": (tc - tnc) / (ns * searches), "target x n x scene": (tnc - rest) / searches,
             "search": (sets - rest) / scenes, "set x scene, noise": rest}
    return {name: max(float(value), 0.0) for name, value in found.items()}


def ranks(x):
    """Ranks along the first axis, ties averaged."""
    x = np.asarray(x, float)
    if x.ndim > 1:
        return np.stack([ranks(column) for column in x.T], axis=1)
    order = np.argsort(x, kind="stable")
    out = np.empty(len(x))
    out[order] = np.arange(len(x))
    _, inverse, count = np.unique(x, return_inverse=True, return_counts=True)
    return (np.bincount(inverse, out) / count)[inverse]


def correlations(ranked):
    """Correlations of the last column with each other one, and the partial ones given the others: Spearman's, of ranks."""
    both = np.corrcoef(ranked, rowvar=False)
    inverse = np.linalg.inv(both + 1e-9 * np.eye(len(both)))
    return both[-1, :-1], -inverse[-1, :-1] / np.sqrt(np.diag(inverse)[:-1] * inverse[-1, -1])


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(map(str, row)) + " |" for row in rows]


def in_text(interval, digits=2):
    return "{:.{d}f} ({:.{d}f}..{:.{d}f})".format(*interval, d=digits)


class Seed:
    """The rows of one seed."""

    def __init__(self, folder, seed, design, error="mae"):
        self.design, self.ns, self.scenes = design, design["n"], [s["name"] for s in design["scenes"]]
        self.targets = [t["name"] for t in design["targets"]]
        self.errors, self.patterns = {}, {}
        for r in read(folder / f"images-{seed}.csv.xz"):
            key = (r["target"], int(r["n"]), int(r["search"]), r["scene"])
            where = self.patterns if r["arm"] == "pattern" else self.errors.setdefault(r["arm"], {})
            where.setdefault(key, {})[r["filter"], int(r["trial"])] = math.log(float(r[error]))
        self.values = {(r["target"], int(r["n"]), int(r["search"])): [float(r[m]) for m in design["measures"]] for r in read(folder / f"sets-{seed}.csv.xz")}
        self.bias, self.cubes = read(folder / f"bias-{seed}.csv.xz"), {}

    def cube(self, arm, scenes=None, inner=np.mean):
        """y[target, n, search, scene], or with inner=list one more axis of filters and trials."""
        key = (arm, inner)
        if key not in self.cubes:
            self.cubes[key] = np.array([[[[inner([v for _, v in sorted(self.errors[arm][t, n, s, c].items())]) for c in self.scenes]
                                          for s in range(self.design["searches"])] for n in self.ns] for t in self.targets])
        return self.cubes[key][:, :, :, [self.scenes.index(c) for c in scenes or self.scenes]]

    def pattern(self, name, scenes=None):
        """y[n, scene] of a pattern; NaN for an n that it does not have."""
        return np.array([[np.mean(list(self.patterns.get((f"pattern:{name}", n, -1, c), {0: math.nan}).values())) for c in scenes or self.scenes]
                         for n in self.ns])

    def best_target(self, scenes=None):
        means = self.cube("shift", scenes).mean(axis=(1, 2, 3))
        return self.targets[int(np.argmin(means))]

    def best_pattern(self, k=None, scene=None):
        """The best pattern at the k-th n over the scenes, or in a scene over all n."""
        means = {}
        for name in self.design["best-patterns"]:
            y = self.pattern(name, [scene] if scene else None)
            means[name] = float((y if k is None else y[k]).mean())
        return min((v, name) for name, v in means.items() if v == v)[1]


def read(path):
    return list(csv.DictReader(io.StringIO(lzma.decompress(path.read_bytes()).decode())))


def effects(seed, arm, scenes=None):
    """Each target's error as a ratio to that of its random starts, and to the mean of all optimised targets."""
    y, tests = seed.cube(arm, scenes), len(seed.targets) - 1
    none, mean = seed.targets.index("none"), np.delete(y, seed.targets.index("none"), 0).mean(0)
    return {t: {"none": ratio(contrast((y[k] - y[none]).mean(0), tests)), "mean": ratio(contrast((y[k] - mean).mean(0), tests))}
            for k, t in enumerate(seed.targets) if k != none}


def against(seed, target, pattern, scenes=None, only=None, tests=1):
    """A target's error in the arm `shift` as a ratio to a pattern's, over the n that the pattern has."""
    difference = seed.cube("shift", scenes)[seed.targets.index(target)] - seed.pattern(pattern, scenes)[:, None]
    keep = [k for k in range(len(seed.ns)) if not np.isnan(difference[k]).any() and (only is None or k == only)]
    return ratio(contrast(difference[keep].mean(0), tests))


def pairwise(seed, first, others, scenes=None):
    """The ratio of the error of a target to those of others, by target, in the arm `shift`."""
    y = seed.cube("shift", scenes)
    at = seed.targets.index
    return {o: ratio(contrast((y[at(first)] - y[at(o)]).mean(0), len(others))) for o in others if o != first}


def in_scene(seed, target, pattern, scene):
    """The ratio in one scene, by its searches and the pattern's trials: nothing is said about other scenes."""
    y = seed.cube("shift", [scene])[seed.targets.index(target), :, :, 0]
    trials = seed.patterns
    keep = [k for k, n in enumerate(seed.ns) if (f"pattern:{pattern}", n, -1, scene) in trials]
    ours = y[keep].mean(0)
    theirs = np.array([list(trials[f"pattern:{pattern}", seed.ns[k], -1, scene].values()) for k in keep])
    variance = ours.var(ddof=1) / len(ours) + (theirs.var(axis=1, ddof=1) / theirs.shape[1]).sum() / len(keep)**2
    width = student(1 - 0.05 / len(seed.scenes), len(ours) - 1) * math.sqrt(variance)
    mean = ours.mean() - theirs.mean()
    return ratio((mean, mean - width, mean + width))


def predictors(seed, resamples=200):
    """Rank and partial rank correlations of measures with the error, means over n, by sets of all targets; intervals resample the
    ranks of whole targets."""
    targets = [t for t in seed.targets if t != "none"]
    y = seed.cube("shift").mean(3)
    cells = []
    for k, n in enumerate(seed.ns):
        x = np.array([[seed.values[t, n, s] for s in range(seed.design["searches"])] for t in targets])
        x = x * [-1 if m in SMALLER_IS_WORSE else 1 for m in seed.design["measures"]]
        both = np.concatenate([x, np.array([y[seed.targets.index(t), k] for t in targets])[..., None]], axis=2)
        cells.append(ranks(both.reshape(-1, both.shape[-1])).reshape(both.shape))

    def means(chosen):
        return np.mean([correlations(ranked[chosen].reshape(-1, ranked.shape[-1])) for ranked in cells], axis=0)

    rng, every = np.random.default_rng(1), means(np.arange(len(targets)))
    drawn = np.array([means(rng.integers(0, len(targets), len(targets))) for _ in range(resamples)])
    low, high = np.nanpercentile(drawn, [2.5, 97.5], axis=0)
    return {m: {kind: [float(every[i, j]), float(low[i, j]), float(high[i, j])] for i, kind in enumerate(("rank", "partial"))}
            for j, m in enumerate(seed.design["measures"])}


def reached(seed):
    """How well each target that is a measure was searched: its sets' mean value over that of the best other target's sets; above 1
    (below, for distances) another target's sets have more of it."""
    found = {}
    for k, measure in enumerate(seed.design["measures"]):
        means = {t: float(np.mean([math.log(seed.values[t, n, s][k]) for n in seed.ns for s in range(seed.design["searches"])])) for t in seed.targets}
        own, best = means.pop(measure), max if measure in SMALLER_IS_WORSE else min
        found[measure] = math.exp(own - best(means.values()))
    return found


def biases(seed):
    """By arm and n: the share of the squared error that is bias, its mean over scenes with a 95 % interval."""
    found = {}
    for arm, n in itertools.product(seed.design["bias"]["arms"], seed.design["bias"]["n"]):
        values = []
        for scene in seed.scenes:
            rows = [r for r in seed.bias if (r["arm"], int(r["n"]), r["scene"]) == (arm, n, scene) and r["target"] != "none"]
            values.append(sum(float(r["bias2"]) for r in rows) / sum(float(r["mse"]) for r in rows))
        width = student(0.95, len(values) - 1) * np.std(values, ddof=1) / math.sqrt(len(values))
        mean = float(np.mean(values))
        found.setdefault(arm, {})[str(n)] = [mean, mean - width, mean + width]
    return found


def factors(seed):
    """Shares of the sum of squares of log errors: all factors in the arm shift, and what phase does where only the pixel varies."""
    y = seed.cube("shift", inner=list)
    keep = [k for k, t in enumerate(seed.targets) if t != "none"]
    y = y[keep]
    shift = shares(y, "tnscf", {
        "scene": lambda e: e == {"c"}, "n": lambda e: e == {"n"}, "scene x n": lambda e: e == {"n", "c"},
        "filter and its interactions": lambda e: "f" in e and not e & {"t", "s"}, "target": lambda e: e == {"t"},
        "target x n": lambda e: e == {"t", "n"}, "target x scene": lambda e: e == {"t", "c"}, "target x n x scene": lambda e: e == {"t", "n", "c"},
        "target x filter": lambda e: "f" in e and "s" not in e, "search": lambda e: "s" in e and not e & {"c", "f"},
        "set x scene, set x filter, noise": lambda e: True})
    pixel = [s for s in seed.scenes if s in ("slats", "weave")]
    phase = shares(seed.cube("phase", pixel, list)[keep], "tnscp", {
        "scene, n": lambda e: e <= {"n", "c"}, "target": lambda e: e == {"t"}, "target x n, target x scene": lambda e: e <= {"t", "n", "c"},
        "search": lambda e: "s" in e and not e & {"c", "p"}, "set x scene": lambda e: "p" not in e,
        "phase, the same for all sets": lambda e: not e & {"t", "s"}, "phase x set": lambda e: True})
    return {"shift": shift, "phase": phase, "components": components(seed.cube("shift")[keep])}


def verdicts(seed, other, scenes=None):
    """The hypotheses that are about means, true or false; the best target is chosen by the other seed."""
    best = other.best_target(scenes)
    surely_less = lambda found: all(r[2] < 1 for r in found.values())
    return {"H2": surely_less(pairwise(seed, "l2-periodic", ["star", "l2-star", "l2-centered"], scenes)),
            "H3": surely_less(pairwise(seed, "l2-periodic", ["relative-radius", "step"], scenes)),
            "H4": all(against(seed, best, p, scenes, tests=len(seed.design["best-patterns"]))[2] < 1 for p in seed.design["best-patterns"])}


def analyse(seed, other):
    design, best = seed.design, other.best_target()
    found = {"best_target": seed.best_target(), "best_target_of_other_seed": best,
             "effects": {arm: effects(seed, arm) for arm in design["arms"]}, "bias": biases(seed), "factors": factors(seed), "predictors": predictors(seed), "reached": reached(seed),
             "best_against_targets": pairwise(seed, best, [t for t in seed.targets if t not in ("none", best)]),
             "periodic_against": pairwise(seed, "l2-periodic", ["star", "l2-star", "l2-centered", "relative-radius", "step"]),
             "best_against_patterns": {p: against(seed, best, p, tests=len(design["best-patterns"])) for p in design["patterns"]},
             "targets_against_sobol": {t: against(seed, t, "sobol:scramble=owen", tests=len(seed.targets)) for t in seed.targets}}
    found["gain_by_n"] = {str(n): {"pattern": other.best_pattern(k), "ratio": against(seed, best, other.best_pattern(k), only=k, tests=len(seed.ns))}
                          for k, n in enumerate(seed.ns)}
    found["gain_by_scene"] = {c: {"pattern": other.best_pattern(scene=c), "ratio": in_scene(seed, best, other.best_pattern(scene=c), c)} for c in seed.scenes}
    found["without_scene"] = {}
    for left_out in seed.scenes:
        rest = [c for c in seed.scenes if c != left_out]
        found["without_scene"][left_out] = {"best_target": seed.best_target(rest), **verdicts(seed, other, rest)}
    parts, partial = found["factors"], {m: p["partial"][0] for m, p in found["predictors"].items()}
    phase = sum(v for k, v in parts["phase"].items() if k.startswith("phase"))
    found["hypotheses"] = {"H1": parts["components"]["target"] > parts["components"]["search"], **verdicts(seed, other),
                           "H5": phase < parts["phase"]["target"], "H6": max(partial, key=partial.get) == "l2-periodic"}
    return found


def listed(pairs, digits):
    """Names with the values of both seeds, in one line."""
    return "; ".join(f"{name} " + ", ".join(f"{v:.{digits}f}" for v in values) for name, values in pairs)


def tables(results, design):
    """The page's tables, and its lines of numbers; of the first two seeds."""
    one, two = (results["seeds"][k] for k in sorted(results["seeds"], key=int)[:2])
    start = {t: e["none"] for t, e in one["effects"]["shift"].items()}
    order = sorted(start, key=lambda t: start[t][0])
    value = lambda r: f"{r[0]:.3f}"
    out = table(["target", "to its start", "to Owen-Sobol'", "seed 2", "fixed*"],
                [[t, in_text(start[t], 3), in_text(one["targets_against_sobol"][t], 3), value(two["targets_against_sobol"][t]),
                  value(one["effects"]["fixed"][t]["none"])] for t in order])
    out.append("; ".join(f"{n}: " + ", ".join(in_text(s["gain_by_n"][n]["ratio"]) for s in (one, two)) for n in one["gain_by_n"]) + ".")
    measures = sorted(one["predictors"], key=lambda m: -one["predictors"][m]["rank"][0])
    out.append("; ".join(f"{m} " + ", ".join(in_text(one["predictors"][m][kind]) for kind in ("rank", "partial")) for m in measures) + ".")
    for arm in ("shift", "phase"):
        names = [k for k in one["factors"][arm] if "target" in k or "search" in k or "set" in k]
        whole = [sum(s["factors"][arm][k] for k in names) for s in (one, two)]
        out.append(listed([(k, [100 * s["factors"][arm][k] / w for s, w in zip((one, two), whole)]) for k in names], 1) + ".")
    out.append(listed([(c, [s["gain_by_scene"][c]["ratio"][0] for s in (one, two)]) for c in one["gain_by_scene"]], 2) + ".")
    out.append("; ".join(f"{arm} " + ", ".join(in_text([100 * x for x in r], 0) for r in by_n.values()) for arm, by_n in one["bias"].items()) + ".")
    return out


def prose(results):
    """The numbers in the page's sentences: percents are 1 less the ratios of periodic L2, over both seeds."""
    both = list(results["seeds"].values())

    def percents(*targets):
        found = sorted(100 * (1 - s["periodic_against"][t][0]) for s in both for t in targets)
        return f"{found[0]:.0f} to {found[-1]:.0f} %" if f"{found[0]:.0f}" != f"{found[-1]:.0f}" else f"{found[0]:.0f} %"
    surely = next(sum(v[2] < 1 for v in s["best_against_targets"].values()) for s in both if s["best_target_of_other_seed"] == "l2-periodic")
    scenes = [c for c in both[0]["gain_by_scene"] if any(not r[1] <= 1 <= r[2] for s in both for r in [s["gain_by_scene"][c]["ratio"]])]
    agreement = results["agreement"]
    return [f"surely less than {('ten', 'eleven', 'twelve', 'thirteen')[surely - 10]} of them",
            f"surely less than star and L2 star, by {percents('star', 'l2-star')}, narrowly less than L2 centred, by {percents('l2-centered')}",
            f"distance and blue noise, by {percents('relative-radius', 'step')}", *(f"only `{c}` is sure" for c in scenes),
            f"All {agreement['within_intervals']} effects of seed 2 are within the intervals of seed 1, and at most "
            f"{100 * (agreement['largest_ratio'] - 1):.1f} % off",
            *(f"({h} {'holds' if both[0]['hypotheses'][h] else 'fails'})" for h in sorted(both[0]["hypotheses"]))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rows", type=pathlib.Path, default=HOME)
    parser.add_argument("--error", choices=["mae", "rmse"], default="mae")
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("--check", type=pathlib.Path)
    arguments = parser.parse_args()
    design = json.loads((HOME / "design.json").read_text(encoding="utf-8"))
    names = sorted(int(p.name[7:-7]) for p in arguments.rows.glob("images-*.csv.xz"))
    if len(names) < 2:
        parser.error(f"{arguments.rows}: rows of two seeds are needed (tools/optimised.py --seed 1, --seed 2)")
    seeds = {k: Seed(arguments.rows, k, design, arguments.error) for k in names}
    results = {"images": {str(k): sum(len(v) for arm in s.errors.values() for v in arm.values()) + sum(map(len, s.patterns.values())) for k, s in seeds.items()},
               "seeds": {str(k): analyse(s, seeds[next(o for o in names if o != k)]) for k, s in seeds.items()}}
    first, second = (results["seeds"][str(k)] for k in names[:2])
    logs = [[math.log(s["effects"]["shift"][t]["none"][0]) for t in first["effects"]["shift"]] for s in (first, second)]
    results["agreement"] = {"correlation": float(np.corrcoef(logs)[0, 1]), "largest_ratio": float(np.exp(np.abs(np.subtract(*logs)).max())),
                            "within_intervals": sum(e["none"][1] <= second["effects"]["shift"][t]["none"][0] <= e["none"][2]
                                                    for t, e in first["effects"]["shift"].items())}
    lines = tables(results, design)
    print("\n".join(lines))
    if arguments.output:
        arguments.output.write_text(json.dumps(results, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    if arguments.check:
        text = arguments.check.read_text(encoding="utf-8")
        page, words = text.splitlines(), " ".join(text.split())
        lost = [line for line in lines if line not in page and not line.startswith("|---")] + [p for p in prose(results) if p not in words]
        print("\n".join(f"optimised_models.py: {arguments.check} lacks: {line}" for line in lost), end="\n" if lost else "", file=sys.stderr)
        return 1 if lost else 0
    return 0


if __name__ == "__main__":
    sys.exit(main())

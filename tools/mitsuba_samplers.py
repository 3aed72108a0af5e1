#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Ranks samplers of Mitsuba 3 and patterns of Koksma in scenes of Mitsuba, for a page of the atlas.

    mitsuba_samplers.py ROWS.csv SCENE.xml..              adds a row for each scene, number of samples and sampler that ROWS.csv lacks
    mitsuba_samplers.py --summary ROWS.csv SUMMARY.json   what the page shows of them

A scene is named by its file; `cornell-box` is mitsuba.cornell_box(). The first form needs koksma and mitsuba in the
interpreter. Pictures have about 4,800 pixels; every sampler has up to 16 of them, against one of 16,384 samples a pixel by
`independent`, whose own error is left out of account (koksma.mitsuba.rank). The rows that ship,
studies/atlas/mitsuba-samplers.csv, are of cornell-box and of these files in docs/scenes of
github.com/mitsuba-renderer/mitsuba-data, commit 01100fa: integrator_direct_both bsdf_roughplastic_ggx
emitter_projector_textured bsdf_dielectric_glass sampler_independent_16spp bsdf_roughconductor_textured_carbon
medium_homogeneous_sss integrator_depth_inf emitter_spot_texture."""
import csv
import json
import math
import os
import statistics
import sys

SAMPLERS = ["independent", "stratified", "multijitter", "ldsampler",  # Mitsuba's; orthogonal takes 25 samples for 16
            "random", "n-rooks", "best-candidate", "correlated-multi-jittered", "pmj02", "sobol:scramble=owen", "lattice-rank1:shift=1",
            "halton:scramble=owen"]
SPP = [4, 16, 64]
COLUMNS = ["scene", "spp", "sampler", "position", "error", "low", "high", "trials", "width", "height", "mitsuba"]


def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def add_rows(path, scenes):
    import mitsuba
    mitsuba.set_variant(os.environ.get("KOKSMA_MITSUBA_VARIANT", "llvm_ad_rgb"))
    from koksma.mitsuba import Asked, Renderer, rank  # after the variant is chosen

    done = {(row["scene"], int(row["spp"])) for row in read(path)} if os.path.exists(path) else set()
    for text in scenes:
        name = os.path.splitext(os.path.basename(text))[0]
        scene = mitsuba.cornell_box() if text == "cornell-box" else text
        film = (1, 1) if text == "cornell-box" else mitsuba.load_file(text).sensors()[0].film().size()
        scale = math.sqrt(4800 / (film[0] * film[1]))
        size = (70, 70) if text == "cornell-box" else tuple(max(1, round(side * scale)) for side in film)
        todo = [spp for spp in SPP if (name, spp) not in done]
        renderer = Renderer(scene)
        exact = sum(renderer(Asked("", "independent", 1024, size, 10**6 + seed)).astype(float) for seed in range(16)) / 16 if todo else None
        for spp in todo:
            ranking = rank(scene, SAMPLERS, spp, size=size, time_limit=None, max_trials=16, reference=exact)
            new = not os.path.exists(path)
            with open(path, "a", encoding="utf-8", newline="") as file:
                out = csv.writer(file, lineterminator="\n")
                out.writerows([COLUMNS] if new else [])
                for row in ranking.rows:
                    out.writerow([name, spp, row.pattern, row.position, row.error, *row.interval, row.trials, *size, mitsuba.__version__])
            print(name, spp, ranking.rows[0].pattern, flush=True)


def student(freedom, tail):
    """The quantile of Student's t above which `tail` lies, to 1e-4."""
    step, x, left = 1e-4, 0, .5 - tail
    peak = math.gamma((freedom + 1) / 2) / math.gamma(freedom / 2) / math.sqrt(math.pi * freedom)
    while left > 0:
        left -= step * peak * (1 + (x + step / 2)**2 / freedom)**(-(freedom + 1) / 2)
        x += step
    return x


def interval(values, tail=.025):
    """Mean and Student's interval."""
    mean, half = statistics.fmean(values), student(len(values) - 1, tail) * statistics.stdev(values) / math.sqrt(len(values))
    return mean, mean - half, mean + half


def join(names):
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}, not told apart"


def summary(rows):
    """Rows of each sampler and number of samples: its error in that of `independent`, the geometric mean over the scenes with Student's
    interval for other scenes; `group`: first, unless its ratios to the sampler of the least mean are surely above 1, by Student's intervals
    that hold together with 95 %; `others`: how many are first beside one. A scene in which the interval of some sampler's error reaches 0 is left out of the means: a few pixels then
    decide it. In the glass sphere Mitsuba makes some of up to 3 10^25 by `ldsampler` and 3 10^7 by `stratified`, of 22 at most by
    others. Then rows of each scene and number of samples: the samplers in the first position, those whose error is undetermined, and the
    least error in that of `independent`; its interval holds where those of both errors do, which hold together with 95 %."""
    case = {(r["scene"], int(r["spp"]), r["sampler"]): {k: float(r[k]) for k in ("position", "error", "low", "high")} for r in rows}
    scenes = list(dict.fromkeys(r["scene"] for r in rows))
    for spp in SPP:
        sound = [s for s in scenes if all(case[s, spp, name]["low"] > 0 for name in SAMPLERS)]
        logs = {name: [math.log(case[s, spp, name]["error"] / case[s, spp, "independent"]["error"]) for s in sound] for name in SAMPLERS}
        order = sorted(SAMPLERS, key=lambda name: statistics.fmean(logs[name]))
        behind = {n: interval([x - y for x, y in zip(logs[n], logs[order[0]])], .025 / (len(SAMPLERS) - 1)) for n in order}
        first = [name for name in order if behind[name][1] <= 0]
        for name in order:
            mean, *ends = map(math.exp, interval(logs[name]))
            yield {"spp": spp, "sampler": name, "group": "first" if name in first else "rest", "others": len(first) - 1, "mean": mean,
                   "mean_low": ends[0], "mean_high": ends[1], "first": sum(case[s, spp, name]["position"] == 1 for s in sound),
                   "scenes": len(sound)}
    for scene in scenes:
        for spp in SPP:
            of = {name: case[scene, spp, name] for name in SAMPLERS}
            best, base = min(of.values(), key=lambda c: c["error"]), of["independent"]
            names = sorted(SAMPLERS, key=lambda n: of[n]["error"])
            yield {"scene": scene, "spp": spp, "best": join([n for n in names if of[n]["position"] == 1 and of[n]["low"] > 0]),
                   "unsure": ", ".join(n for n in names if not of[n]["low"] > 0) or "-",
                   "ratio": best["error"] / base["error"], "ratio_low": best["low"] / base["high"], "ratio_high": best["high"] / base["low"]}


def main():
    if sys.argv[1] == "--summary":
        with open(sys.argv[3], "w", encoding="utf-8") as file:
            for row in summary(read(sys.argv[2])):
                print(json.dumps(row), file=file)
    else:
        add_rows(sys.argv[1], sys.argv[2:])


if __name__ == "__main__":
    main()

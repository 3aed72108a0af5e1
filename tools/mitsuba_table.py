#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mitsuba_table.py [--spp N] [--side PIXELS] [--trials N] [--time-limit S] [--metric METRIC] [--pictures N]
[--only samples|time]: the tables of docs/renderers.md, as Markdown: Mitsuba's Cornell box with its own samplers and six of our
patterns, at equal samples and at equal time. The limit of time holds for each table.

Run it in the environment that scripts/try_mitsuba makes (PYTHONPATH=python, DRJIT_LIBLLVM_PATH). In the second table a
sampler has the samples that fit into the time of `independent`, at least one. The time is processor time of all threads,
which other programs on the machine change less than seconds of the clock, the least of several pictures of 256 x 256 pixels, in
which the samplers take turns.
In each some 0.25 s are Dr.Jit's tracing of a sampler in Python; in pictures of 64 x 64 they would be most of the time.
"""
import argparse
import time

import mitsuba as mi

mi.set_variant("llvm_ad_rgb")
import koksma.mitsuba  # noqa: E402

OURS = ("random", "jittered", "n-rooks", "correlated-multi-jittered", "pmj02:shuffle=1", koksma.mitsuba.OWEN_SOBOL)


def percent(x):
    return f"{100 * x:.0f} %" if abs(x) < 0.995 else f"{1 + x:.1f} times"


def fitting(sampler, n):
    """The largest number up to n of points that a sampler makes: Mitsuba's own round others up, which would be more time."""
    while True:
        try:
            if sampler in OURS:
                koksma.generate(sampler, n, 2)
                return n
            if mi.load_dict({"type": sampler, "sample_count": n}).sample_count() == n:
                return n
        except koksma.ArgumentError:
            pass
        n -= 1


def show(ranking, names, notes):
    """A row for each sampler; notes: the text of its last column."""
    print("| place | sampler | error x 1000 | interval | behind the first | interval | images | " + notes[0] + " |")
    print("|---|---|---|---|---|---|---|---|")
    for row in ranking.rows:
        low, high = (f"{1000 * x:.3f}" for x in row.interval)
        behind = "" if not row.behind else percent(row.behind)
        between = "" if not row.behind else " to ".join(map(percent, row.behind_interval))
        print(f"| {row.position or '-'} | `{names[row.pattern]}` | {1000 * row.error:.3f} | {low} to {high} | {behind} | "
              f"{between} | {row.trials} | {notes[1][row.pattern]} |")
    print(f"\n{ranking.seconds:.0f} s. Best: {f'`{names[ranking.best]}`' if ranking.best else 'undecided'}; error is {ranking.metric}, {ranking.size[0]} x {ranking.size[1]} "
          f"pixels; the reference's own error is {1000 * ranking.reference_error:.3f}.\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--side", type=int, default=64)
    parser.add_argument("--trials", type=int, default=64)
    parser.add_argument("--time-limit", type=float, default=600)
    parser.add_argument("--metric", default="mae")
    parser.add_argument("--pictures", type=int, default=5, help="large pictures of each sampler, by which the time is measured")
    parser.add_argument("--only", choices=("samples", "time"))
    a = parser.parse_args()
    scene, samplers = mi.cornell_box(), [*koksma.mitsuba.OWN, *OURS]
    samplers.remove("orthogonal")  # it takes squares of primes only, and rounds other numbers up
    options = dict(size=(a.side, a.side), time_limit=a.time_limit, max_trials=a.trials, metric=a.metric)
    if a.only != "time":
        print(f"Mitsuba {mi.__version__}, its Cornell box, {a.spp} samples a pixel:\n")
        equal = koksma.mitsuba.rank(scene, samplers, a.spp, **options)
        bands = {r.pattern: f"{r.coherence:.1f}{' bands' if r.coherent else ''}" for r in equal.rows}
        show(equal, {s: s for s in samplers}, ("coherence", bands))
    if a.only == "samples":
        return
    seconds = dict(zip(samplers, koksma.mitsuba.times(scene, samplers, a.spp, size=(256, 256), repeats=a.pictures, clock=time.process_time)))
    # A factor of 1 is a name, too: no sampler stands twice, and the reference is the plain one.
    factors = {s: seconds["independent"] / seconds[s] for s in samplers}
    names = {f"{s}*{fitting(s, max(1, round(a.spp * factors[s]))) / a.spp:.5f}": s for s in samplers}
    print(f"At the time of `independent` with {a.spp} samples:\n")
    show(koksma.mitsuba.rank(scene, list(names), a.spp, reference="independent", **options), names,
         ("samples (seconds of a large picture)", {n: f"{max(1, round(a.spp * float(n.partition('*')[2])))} ({seconds[s]:.2f})"
                                        for n, s in names.items()}))


if __name__ == "__main__":
    main()

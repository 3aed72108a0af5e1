#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Large data and small jobs: files of many points, ranges far out, start-up, tiny jobs of a study.

Each row is a figure of ours beside what it is compared with, taken in turns: the median of the rounds, the smallest and the
largest ratio in brackets. Seconds are by the clock where a disk or threads are measured, else of the processor; the load of
the machine is printed, as the clock depends on it. KOKSMA_BENCH_POINTS: points of the large files (10^8)."""
import json
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KOKSMA = os.path.join(ROOT, "build/release/koksma")
POINTS = int(float(os.environ.get("KOKSMA_BENCH_POINTS", "1e8")))
ROUNDS = 3


def run(*command, clock=False):
    """Seconds of a command: by the clock, or of the processor."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after, passed = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter() - start
    return passed if clock else after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def processor(call):
    start = time.process_time()
    call()
    return time.process_time() - start


def row(what, ours, theirs, peer, unit, scale=1.0):
    """scale / seconds is the figure; ours and theirs run in turns. theirs None: there is no peer."""
    pairs = [(ours(), theirs() if theirs else None) for _ in range(ROUNDS)]
    mine = scale / statistics.median(a for a, _ in pairs) if scale != 1.0 else statistics.median(a for a, _ in pairs)
    text = f"{what:44s} {mine:10.4g} {unit:12s}"
    if theirs:
        ratios = sorted(b / a for a, b in pairs)
        text += f" {statistics.median(ratios):8.3g} times {peer} ({ratios[0]:.3g} to {ratios[-1]:.3g})"
    print(text, flush=True)


def files(folder):
    """The peer writes as many bytes from a buffer of zeros, and syncs them, too."""
    npy, zeros = os.path.join(folder, "x.npy"), os.path.join(folder, "zeros")
    size = POINTS * 16

    def copy():
        start, block, left = time.perf_counter(), bytes(1 << 22), size
        with open(zeros, "wb", buffering=0) as file:
            while left > 0:
                left -= file.write(block[:min(left, len(block))])
            os.fsync(file.fileno())
        passed = time.perf_counter() - start
        os.unlink(zeros)
        return passed

    def ours(pattern):
        def seconds():
            passed = run(KOKSMA, "generate", pattern, "-n", str(POINTS), "-o", npy, "-q", clock=True)
            os.unlink(npy)
            return passed
        return seconds
    for pattern in ("sobol", "sobol:scramble=owen", "halton", "random"):
        row(f"{pattern}, {POINTS:.0e} points to NPY, clock", ours(pattern), copy, "a plain write", "Mpoints/s", POINTS / 1e6)
    print(f"{'  largest memory of any of them':44s} {resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024:10.4g} MiB")


def texts(folder):
    n, path = max(POINTS // 100, 1000), os.path.join(folder, "x.txt")
    row(f"random, {n:.0e} points to text", lambda: run(KOKSMA, "generate", "random", "-n", str(n), "-o", path), None, "",
        "Mpoints/s", n / 1e6)
    try:
        import numpy as np
        sys.path.insert(0, os.path.join(ROOT, "python"))
        import koksma
        row(f"{n:.0e} points from text", lambda: processor(lambda: koksma.read(path)),
            lambda: processor(lambda: np.loadtxt(path)), "numpy.loadtxt", "Mpoints/s", n / 1e6)
    except (ImportError, RuntimeError) as error:
        print(f"reading from Python: {error}")


def ranges():
    try:
        from scipy.stats import qmc
        import koksma
    except ImportError as error:
        print(f"ranges: {error}")
        return

    def scipys():
        engine = qmc.Sobol(2, scramble=False, bits=32)
        engine.fast_forward(10 ** 8)
        engine.random(1000)
    for spec in ("sobol", "sobol:scramble=owen"):
        row(f"{spec}, 1000 points from 1e8 on",
            lambda s=spec: processor(lambda: koksma.Engine(s, 2, seed=1).fast_forward(10 ** 8).random(1000)),
            lambda: processor(scipys), "scipy's Sobol", "s")


def programs(folder):
    row("start-up: generate n-rooks -n 16", lambda: run(KOKSMA, "generate", "n-rooks", "-n", "16"),
        lambda: run("/bin/true"), "/bin/true", "s")
    plan, jobs = os.path.join(folder, "tiny.json"), 200000
    with open(plan, "w", encoding="utf-8") as file:
        json.dump({"name": "tiny", "title": "tiny", "discrepancies": [
            {"patterns": ["random", "jittered"], "measures": ["l2-star"], "n": [4], "trials": jobs // 2}]}, file)

    def study(threads, clock=True):
        out = os.path.join(folder, "study")
        shutil.rmtree(out, ignore_errors=True)
        return run(KOKSMA, "study", "run", plan, "-o", out, "-q", "--threads", str(threads), clock=clock)
    row("study of tiny jobs, 1 thread, processor", lambda: study(1, False), None, "", "jobs/s", jobs)
    row("study of tiny jobs, 2 threads, clock", lambda: study(2), lambda: study(1), "1 thread", "jobs/s", jobs)


print("load of the last minute: %.1f, %d processors" % (os.getloadavg()[0], os.cpu_count() or 0))
os.environ.setdefault("KOKSMA_LIBRARY_DIR", os.path.join(ROOT, "build/release/src"))
with tempfile.TemporaryDirectory(dir=os.path.join(ROOT, "build")) as work:
    files(work)
    texts(work)
    ranges()
    programs(work)

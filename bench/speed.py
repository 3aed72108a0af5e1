#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every goal of speed in one run, as a table: `make bench`, about 8 minutes on a quiet machine of two cores.

    bench/speed.py [-o FILE] [PART OF A ROW'S NAME]

Ours and what it is compared with take turns, three each; a ratio is the median of the rounds, with the smallest and
the largest. Seconds are of the processor, so that other work counts little, but for threads and disks, which take the
clock. What is compared with is another program, where it is installed or its sources are named, or this program at an
older commit, which is built on the first run (build/speed/base, 3 minutes):

    DANDY, HELMER, OPENQMC   folders of their sources (jakobbossek/dandy, Andrew-Helmer/stochastic-generation,
                             AcademySoftwareFoundation/openqmc, all on GitHub)
    CYCODEBASE               the folder of cySampleElim.h (cemyuksel/cyCodeBase on GitHub)
    QUADS, VOID_CLUSTER, GAUSSIAN, UTK
                             folders of liris-origami/Quad-Optimized-LDS, Atrix256/BlueNoiseDitherPatternGeneration,
                             Atrix256/GaussianBlueNoise and utk-team/utk (all on GitHub), for bench/bench_authors.cpp
    GSL                      a prefix with include/gsl and a library, where pkg-config knows none
    KOKSMA_BENCH_BASE        a folder in which c86c5f3 is built (build/release); "none": no older program
    KOKSMA_BENCH_POINTS      points of the large file (10^8)
    KOKSMA_BENCH_ROUNDS      turns (3)

scipy, QMCPy, poisson-disc, Mitsuba, POV-Ray and Blender count where they are installed: run it by a Python that has the
first four. The crate blue-noise is built by cargo, where there is one, from crates.io."""
import argparse
import array
import datetime
import json
import math
import os
import platform
import re
import resource
import shutil
import statistics
import subprocess
import sys
import textwrap
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
KOKSMA = os.path.join(ROOT, "build/release/koksma")
WORK = os.path.join(ROOT, "build/speed")
BASE_COMMIT = "c86c5f3"
ROUNDS = int(os.environ.get("KOKSMA_BENCH_ROUNDS", "3"))
POINTS = int(float(os.environ.get("KOKSMA_BENCH_POINTS", "1e8")))
ISAS = [isa for isa in ("avx2", "avx512") if subprocess.run(
    [KOKSMA, "version"], env={**os.environ, "KOKSMA_KERNELS": isa}, capture_output=True, check=False).returncode == 0]


# ---- Programs ---------------------------------------------------------------------------------------------------

def run(*command, clock=False, isa=None, cwd=None):
    """Seconds of a command: by the clock, or of the processor."""
    env = {**os.environ, "KOKSMA_KERNELS": isa} if isa else None
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=env, cwd=cwd, check=False)
    after, passed = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter() - start
    if done.returncode:
        raise RuntimeError((done.stderr.decode(errors="replace").strip() or command[0]).splitlines()[-1])
    return passed if clock else after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def timed(program, *words, threads=1, isa=None):
    """What bench-row says: median seconds of repeats in one process, and the value."""
    env = {**os.environ, "KOKSMA_KERNELS": isa} if isa else None
    done = subprocess.run([program, str(threads), *map(str, words)], capture_output=True, text=True, env=env, check=False)
    if done.returncode:
        raise RuntimeError(done.stderr.strip()[-300:])
    numbers = [float(word) for word in done.stdout.split()]
    return numbers[0], numbers[3]


def build_base():
    """The folder in which the older commit is built; None: there is none."""
    named = os.environ.get("KOKSMA_BENCH_BASE")
    if named == "none":
        return None
    folder = named or os.path.join(WORK, "base")
    if not os.path.exists(os.path.join(folder, "build/release/koksma")):
        if named:
            sys.exit("speed.py: KOKSMA_BENCH_BASE=%s: no build/release/koksma there; name a folder in which %s is built, "
                     "or 'none'" % (named, BASE_COMMIT))
        os.makedirs(folder, exist_ok=True)
        tree = subprocess.run(["git", "-C", ROOT, "archive", BASE_COMMIT], capture_output=True, check=False)
        if tree.returncode:
            print("no commit %s here: rows beside it are left out" % BASE_COMMIT, file=sys.stderr)
            return None
        subprocess.run(["tar", "-x", "-C", folder], input=tree.stdout, check=True)
        print("building %s once" % BASE_COMMIT, file=sys.stderr)
        subprocess.run(["cmake", "-S", folder, "-B", folder + "/build/release", "-G", "Ninja", "-DBUILD_TESTING=OFF",
                        "-DCMAKE_BUILD_TYPE=Release"], stdout=subprocess.DEVNULL, check=True)
        subprocess.run(["ninja", "-C", folder + "/build/release", "koksma"], stdout=subprocess.DEVNULL, check=True)
    return folder


FLAGS = ["-std=gnu11", "-O3", "-march=native", "-ffp-contract=fast", "-w"]
ROW = os.path.join(ROOT, "bench/bench_row.c")
LIBRARY = os.path.join(ROOT, "build/release/src")
LINK = ["-L" + LIBRARY, "-Wl,-rpath," + LIBRARY, "-lkoksma", "-lm"]


def compiled(name, *commands):
    """A program of bench/; None, with the reason, where it can't be built."""
    out = os.path.join(WORK, name)
    for command in commands:
        done = subprocess.run([*command, "-o", out] if command is commands[-1] else command, capture_output=True, text=True,
                              check=False)
        if done.returncode:
            print("%s is left out: %s" % (name, done.stderr.strip().splitlines()[0][:200]), file=sys.stderr)
            return None
    return out


def build_peers(base):
    os.makedirs(WORK, exist_ok=True)
    ours = "-I" + os.path.join(ROOT, "include")
    peers = {"koksma": compiled("row", ["cc", *FLAGS, "-DWITH_LAB", ours, ROW, "-lkoksma-lab", *LINK, "-lkoksma-lab"])}
    if base:
        peers["base"] = compiled("row-base", ["cc", *FLAGS, "-I" + base + "/include", ROW,
                                              base + "/build/release/src/libkoksma.a", "-lm", "-lpthread"])
    if os.environ.get("DANDY"):
        copies = []
        for name in ("dem_discr.c", "bz_discr.c"):  # WORK_OUTPUT prints each improvement
            copies.append(os.path.join(WORK, name))
            with open(os.path.join(os.environ["DANDY"], "src", name), encoding="utf-8") as file:
                text = file.read().replace("#define WORK_OUTPUT", "")
            with open(copies[-1], "w", encoding="utf-8") as file:
                file.write(text)
        peers["dandy"] = compiled("row-dandy", ["cc", *FLAGS, "-fcommon", "-DWITH_DANDY", ours, "-I" + os.environ["DANDY"] + "/src",
                                                ROW, *copies, *LINK])
    if os.environ.get("HELMER"):
        folder, row = os.environ["HELMER"], os.path.join(WORK, "row-helmer.o")
        sources = [os.path.join(folder, "sampling", name) for name in os.listdir(folder + "/sampling") if name.endswith(".cpp")]
        includes = [word for header in ("cstdint", "cstddef", "limits", "algorithm") for word in ("-include", header)]
        peers["helmer"] = compiled("row-helmer", ["cc", *FLAGS, "-DWITH_HELMER", ours, "-c", ROW, "-o", row],
                                   ["c++", "-O3", "-march=native", "-w", *includes, "-I" + folder,
                                    os.path.join(ROOT, "bench/bench_helmer.cpp"), *sources, row, *LINK])
    if os.environ.get("CYCODEBASE"):
        peers["cyCodeBase"] = compiled("row-elimination", ["c++", "-O3", "-march=native", "-w", "-I" + os.environ["CYCODEBASE"],
                                                           os.path.join(ROOT, "bench/bench_elimination.cpp")])
    peers.update(build_authors())
    prefix = os.environ.get("GSL")
    gsl = ["-I%s/include" % prefix, "-L%s/lib" % prefix] if prefix else []
    peers["gsl"] = compiled("row-gsl", ["cc", *FLAGS, "-DWITH_GSL", ours, *gsl, ROW, *LINK, "-lgsl", "-lgslcblas", "-lm"])
    return {name: path for name, path in peers.items() if path}


def build_authors():
    """Programs of the authors of patterns, by bench/bench_authors.cpp."""
    flags = ["c++", "-std=c++17", "-O3", "-march=native", "-w"]
    for header in ("cstdint", "cstddef", "cstring", "cfloat", "cmath", "limits", "algorithm", "string"):
        flags += ["-include", header]
    source, found = os.path.join(ROOT, "bench/bench_authors.cpp"), {}
    for name, word, options in (("quads", "QUADS", lambda folder: ['-DAUTHORS_DATA="%s/initIrreducibleGF3.dat"' % folder, "-I" + folder]),
                                ("void-cluster", "VOID_CLUSTER", lambda folder: ["-I" + folder]),
                                ("gaussian", "GAUSSIAN", lambda folder: ["-I" + WORK]),
                                ("cascade", "UTK", lambda folder: ['-DUTK_DATA_PATH="%s/data"' % folder, "-I" + folder + "/include"])):
        folder = os.environ.get(word)
        if folder:
            folder = os.path.abspath(folder)
            if name == "gaussian":  # the kernel alone
                with open(os.path.join(folder, "gbn-toroidal.cu"), encoding="utf-8") as file:
                    text = file.read()
                start = text.index("__global__\nvoid gbn0(")
                with open(os.path.join(WORK, "gbn0.h"), "w", encoding="utf-8") as file:
                    file.write(text[start:text.index("// ----", start)])
            define = "-DWITH_" + {"cascade": "CASCADE"}.get(name, word)
            found[name] = compiled("row-" + name, [*flags, define, *options(folder), source])
    return found


# ---- Rows -------------------------------------------------------------------------------------------------------

class Table:
    def __init__(self, wanted):
        self.wanted, self.rows, self.limits = wanted, [], {}

    def has(self, part, what):
        return self.wanted in "%s %s" % (part, what)

    def add(self, part, what, ours, unit, goal="", met=None, peer="", ratio="", near=""):
        self.rows.append((part, what, ours, unit, peer, ratio, goal, met, near))
        print(" | ".join(str(word) for word in self.rows[-1]), file=sys.stderr, flush=True)

    def versus(self, part, what, ours, theirs, peer, goal=None, unit="ms", figure=lambda s: 1e3 * s, near=None, equal=True):
        """ours() and theirs() give seconds, or seconds and a value, which have to agree; goal: the least ratio."""
        if not self.has(part, what) or theirs is None:
            return
        try:
            pairs = [(ours(), theirs()) for _ in range(ROUNDS)]
        except RuntimeError as error:
            self.add(part, what, "left out", "", peer=peer, ratio=str(error)[:160])
            return
        if isinstance(pairs[0][0], tuple):
            for (_, a), (_, b) in pairs:
                if equal and a == a and b == b and abs(a - b) > 1e-9 * abs(a):
                    sys.exit("speed.py: %s: %.17g here and %.17g by %s" % (what, a, b, peer))
            pairs = [(a, b) for (a, _), (b, _) in pairs]
        ratios = sorted(b / a for a, b in pairs)
        middle, seconds = statistics.median(ratios), statistics.median(a for a, _ in pairs)
        self.add(part, what, "%.3g" % figure(seconds), unit, goal="≥ %g x" % goal if goal else "", peer=peer,
                 met=None if goal is None else middle >= goal, ratio="%.2f (%.2f-%.2f)" % (middle, ratios[0], ratios[-1]),
                 near=near(seconds) if near else "")

    def alone(self, part, what, ours, goal=None, most=True, unit="ms", figure=lambda s: 1e3 * s, near=None, rounds=ROUNDS):
        """goal: the most, or the least, of the figure."""
        if not self.has(part, what):
            return
        try:
            found = [ours() for _ in range(rounds)]
        except RuntimeError as error:
            self.add(part, what, "left out", "", ratio=str(error)[:160])
            return
        found = sorted(x[0] if isinstance(x, tuple) else x for x in found)
        values = sorted(figure(s) for s in found)
        value = statistics.median(values)
        met = None if goal is None else value <= goal if most else value >= goal
        self.add(part, what, "%.3g" % value, unit, met=met, goal="" if goal is None else "%s %g" % ("≤" if most else "≥", goal),
                 ratio="(%.3g-%.3g)" % (values[0], values[-1]) if rounds > 1 else "",
                 near=near(statistics.median(found)) if near else "")


def measure_limits(table, row):
    """The machine's: bytes stored a second, operations on doubles a second."""
    stores, (fma, lanes) = timed(row, "stores")[0], timed(row, "fma")
    table.limits = {"stores": (1 << 24) / stores, "flops": 2 * 8 * (1 << 23) * round(lanes / 1000) / fma}


# ---- Parts of the issue -----------------------------------------------------------------------------------------

def kernels(table):
    part = "1 kernels"
    if not table.has(part, "fast forms"):
        return
    subprocess.run(["cmake", "--build", ROOT + "/build/release", "--target", "bench-kernels"], stdout=subprocess.DEVNULL, check=True)
    out = subprocess.run([ROOT + "/build/release/bench/bench-kernels"], capture_output=True, text=True, check=False).stdout
    found = re.findall(r"^(\w+) .*?([\d.]+) x, (\w+)$", out, re.M)
    ratios = sorted((float(ratio), name, isa) for name, ratio, isa in found)
    if ratios:
        table.add(part, "fast forms over plain twins: median of %d" % len(ratios), "%.2f" % statistics.median(r for r, _, _ in ratios),
                  "x", ratio="(%.2f %s - %.2f %s)" % (*ratios[0][:2], *ratios[-1][:2]), goal="≥ 1 all", met=ratios[0][0] >= 1)


def renders(table, base):
    if not base:
        return
    old = base + "/build/release/koksma"

    def render(program, scene, pattern, isa, *more):
        return lambda: run(program, "render", scene, "-p", pattern, "--threads", "1", "-o", os.path.join(WORK, "x.pfm"), *more,
                           isa=isa)
    ball = ("-n", "64", "--size", "512x384")
    for isa in ISAS:
        for pattern, goal in (("jittered", 1.8), ("n-rooks", 1.8), ("sobol:scramble=owen", 1.8), ("pmj02", 1.8),
                              ("correlated-multi-jittered", 3), ("random", 1.4), ("regular", 1.4)):
            table.versus("2 draws", "ball, %s, %s" % (pattern, isa), render(KOKSMA, "ball", pattern, isa, *ball),
                         render(old, "ball", pattern, isa, *ball), BASE_COMMIT, goal, "Msamples/s",
                         lambda s: 512 * 384 * 64e-6 / s)
    for scene, size, goal in (("cornell", "128x96", 3), ("balls", "128x96", 3), ("glossy", "128x96", 3), ("bunny", "128x96", 3),
                              ("many-lights", "48x36", 10)):
        path = ("-n", "16", "--size", size, "--integrator", "path")
        w, h = map(int, size.split("x"))
        table.versus("3 paths", "%s, path, jittered" % scene, render(KOKSMA, scene, "jittered", None, *path),
                     render(old, scene, "jittered", None, *path), BASE_COMMIT, goal, "Msamples/s", lambda s, n=w * h: n * 16e-6 / s)


def sampler(table):
    part = "4 sampler.h"
    if not table.has(part, "draws") or not os.environ.get("OPENQMC"):
        return
    out = subprocess.run([ROOT + "/bench/bench_sampler.sh"], capture_output=True, text=True, check=False).stdout
    title = ""
    for line in out.splitlines():
        title = line if not line.startswith(" ") else title
        found = re.match(r" +(\w+) +([\d.]+) ns +([\d.]+) times", line)
        if found and "native" in title:
            goal = 1 if "pmj" in found[1] else 2
            table.add(part, "%s, %s" % (found[1], title.split()[0]), found[2], "ns", peer="OpenQMC", ratio=found[3],
                      goal="≥ %g x" % goal, met=float(found[3]) >= goal)


def measures(table, peers):
    part, row, base = "5 measures", peers["koksma"], peers.get("base")

    def at(program, *words, **more):
        return (lambda: timed(program, *words, **more)) if program else None
    owen = "sobol:scramble=owen"
    table.alone(part, "star 2D, Owen-Sobol' 1e5", at(row, "measure", "star", owen, 100000, 2), 120)
    table.alone(part, "star 2D, Owen-Sobol' 2^20", at(row, "measure", "star", owen, 1 << 20, 2), 2000, rounds=1)
    for n, dim, goal, base_goal in ((1000, 3, 5, 1.56), (200, 4, 5, 1.5)):  # c86c5f3 was 1.6 and 1.34 times as fast as dandy
        for peer, mode, least in (("dandy", ("dandy", "random", n, dim), goal),
                                  ("base", ("measure", "star", "random", n, dim), base_goal)):
            table.versus(part, "star %dD, %d random points" % (dim, n), at(row, "measure", "star", "random", n, dim),
                         at(peers.get(peer), *mode), peer.replace("base", BASE_COMMIT), least)
    table.versus(part, "edge, 1600 random points", at(row, "measure", "edge", "random", 1600, 2),
                 at(base, "measure", "edge", "random", 1600, 2), BASE_COMMIT, 2)
    table.versus(part, "edge-sampled, 1600 jittered", at(row, "measure", "edge-sampled", "jittered", 1600, 2),
                 at(base, "measure", "edge-sampled", "jittered", 1600, 2), BASE_COMMIT)
    table.versus(part, "pair correlation, 4096, 200 bins", at(row, "pairs", "random", 4096), at(base, "pairs", "random", 4096),
                 BASE_COMMIT, 3)
    n = 4096  # of a pair each coordinate takes 7 operations, none fused, so that the peak has half of the fused ones
    for dim in (5, 6, 8):
        table.alone(part, "l2-star %dD, 4096 points: pairs, of the unfused peak" % dim, at(row, "measure", "l2-star", "random", n, dim),
                    50, False, "%", lambda s, d=dim: 100 * n * n / 2 * 7 * d / s / (table.limits["flops"] / 2),
                    near=lambda s: "%.3g ms" % (1e3 * s))
    table.alone(part, "l2-star 2D, 1e6 points", at(row, "measure", "l2-star", "random", 1000000, 2), 1000, rounds=1)


def extremes(table, row):
    """The law is n^2 log^2 n at worst: with the constant that Hammersley points have at 4096, which are the hardest."""
    part, law = "5 measures", {n: (n * math.log2(n)) ** 2 for n in (4096, 16384)}
    if not table.has(part, "extreme 2D"):
        return
    constant = timed(row, "measure", "extreme", "hammersley", 4096, 2)[0] / law[4096]
    for pattern in ("jittered", "hammersley"):
        table.alone(part, "extreme 2D, %s, 16384, over n^2 log^2 n" % pattern,
                    lambda p=pattern: timed(row, "measure", "extreme", p, 16384, 2), 1, True, "", lambda s: s / law[16384] / constant,
                    near=lambda s: "%.3g s" % s, rounds=1)


def patterns(table, peers):
    part, row, n = "6 patterns", peers["koksma"], 1 << 20

    def near(dim):
        return lambda s: "%.1f times the stores" % (s * table.limits["stores"] / (8 * dim * n))
    for isa in ISAS:
        for pattern, name, goal in (("sobol:scramble=owen", "owen", 2), ("pmj02", "pmj02", 2)):
            table.versus(part, "%s 2D 1M, %s" % (pattern, isa), lambda p=pattern, i=isa: timed(row, "generate", p, n, 2, isa=i),
                         (lambda m=name: timed(peers["helmer"], "helmer", m, n, 2)) if "helmer" in peers else None,
                         "Helmer", goal, near=near(2))
            table.versus(part, "%s 2D 1M, %s" % (pattern, isa), lambda p=pattern, i=isa: timed(row, "generate", p, n, 2, isa=i),
                         (lambda p=pattern, i=isa: timed(peers["base"], "generate", p, n, 2, isa=i)) if "base" in peers else None,
                         BASE_COMMIT, near=near(2))
    for pattern in ("sobol", "halton"):
        table.versus(part, pattern + " 2D 1M", lambda p=pattern: timed(row, "generate", p, n, 2),
                     (lambda p=pattern: timed(peers["gsl"], "gsl", p, n, 2)) if "gsl" in peers else None, "GSL", near=near(2))
    for dim in (2, 3):
        table.versus(part, "sample-elimination %dD 4096" % dim, lambda d=dim: timed(row, "generate", "sample-elimination", 4096, d),
                     (lambda d=dim: timed(peers["cyCodeBase"], "elimination", 4096, d)) if "cyCodeBase" in peers else None,
                     "cyCodeBase", 1)
    table.versus(part, "fast spectrum, 4096 points, 639^2", lambda: timed(row, "fast", "random", 4096, 319),
                 (lambda: timed(peers["base"], "fast", "random", 4096, 319)) if "base" in peers else None, BASE_COMMIT,
                 1.52)  # 2.5 times UTK, which took 1.64 times as long as c86c5f3 elsewhere


def authors_patterns(table, peers):
    """The patterns of 2026, beside the programs of their authors or of others. A row without a program has its own time."""
    part, row, small = "6 patterns", peers["koksma"], 3 ** 10

    def ours(pattern, n, dim):
        return lambda: timed(row, "generate", pattern, n, dim)[0]

    def beside(what, pattern, n, dim, peer, name, *words, goal=1):
        if peer in peers:
            table.versus(part, what, ours(pattern, n, dim), lambda: timed(peers[peer], *words)[0], name, goal)
        else:
            table.alone(part, what, ours(pattern, n, dim))
    table.alone(part, "void-and-cluster 256 x 256", ours("void-and-cluster:size=256", 1 << 16, 2), 2000, rounds=1)
    beside("void-and-cluster 64 x 64", "void-and-cluster:size=64", 1 << 12, 2, "void-cluster", "demofox's program", "void-cluster", 64)
    # NVIDIA's program for masks in time (SpatiotemporalBlueNoiseSDK) needs submodules that its archive lacks: no peer
    table.alone(part, "void-and-cluster-3d 32 x 32 x 16", ours("void-and-cluster-3d:size=32,frames=16", 1 << 14, 3), 5000)
    beside("gaussian-blue-noise 2D 1024, to rest; theirs 1,000 steps", "gaussian-blue-noise", 1024, 2, "gaussian", "Ahmed's program, 1 core",
           "gaussian", 1024)
    beside("ternary-quads 4D 3^10", "ternary-quads", small, 4, "quads", "Ostromoukhov's program", "quads", small, 4)
    beside("ternary-quads:scramble=owen 4D 3^10", "ternary-quads:scramble=owen", small, 4, "quads", "Ostromoukhov's program", "owen-quads",
           small, 4)
    beside("cascaded-sobol:owen=1 4D 64k, 53 digits; theirs 32", "cascaded-sobol:owen=1", 1 << 16, 4, "cascade", "UTK", "cascade", 1 << 16, 4)
    for pattern in ("sz", "cascaded-sobol"):  # the program of the authors of sz was not to be had
        table.versus(part, pattern + " 4D 1M", ours(pattern, 1 << 20, 4), ours("sobol", 1 << 20, 4), "our sobol")


MANIFEST = """[package]
name = "void-and-cluster"
version = "0.1.0"
edition = "2021"
publish = false

[[bin]]
name = "void-and-cluster"
path = "%s/bench/bench_void_and_cluster.rs"

[dependencies]
blue-noise = "=0.2.2"
"""


def build_mask_crate():
    """The program of bench_void_and_cluster.rs, which cargo builds from crates.io; None where there is no cargo, or no crate."""
    folder = os.path.join(WORK, "void_and_cluster")
    if not shutil.which("cargo"):
        print("the crate blue-noise is left out: there is no cargo", file=sys.stderr)
        return None
    os.makedirs(folder, exist_ok=True)
    with open(folder + "/Cargo.toml", "w", encoding="utf-8") as file:
        file.write(MANIFEST % ROOT)
    done = subprocess.run(["cargo", "build", "--quiet", "--release"], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode:
        print("the crate blue-noise is left out: %s" % done.stderr.strip().splitlines()[-1][:200], file=sys.stderr)
        return None
    return folder + "/target/release/void-and-cluster"


def write_levels(path, levels, size):
    """A mask of bytes as .npy of their middles."""
    head = "{'descr': '<f4', 'fortran_order': False, 'shape': (%d, %d), }" % (size, size)
    with open(path, "wb") as file:
        file.write(b"\x93NUMPY\x01\x00\x76\x00" + head.ljust(117).encode() + b"\n")
        file.write(array.array("f", [(level + 0.5) / 256 for level in levels]).tobytes())


def masks(table, row):
    """void-and-cluster beside a crate; the row says what gaussian:sigma=1 leaves of each mask: its autocorrelation is about the
    Gaussian of 1.5 pixels that both place by."""
    part, what, size = "6 patterns", "void-and-cluster mask, 128 x 128", 128
    if not table.has(part, what):
        return
    program, raw = build_mask_crate(), os.path.join(WORK, "mask.raw")
    paths = [os.path.join(WORK, name) for name in ("mask-ours.npy", "mask-theirs.npy")]

    def error(path):
        done = subprocess.run([KOKSMA, "mask", "check", path, "--filter", "gaussian:sigma=1", "--json"], capture_output=True, text=True,
                              check=True)
        return json.loads(done.stdout)["error"]

    def near(_):
        with open(raw, "rb") as file:
            write_levels(paths[1], file.read(), size)
        done = subprocess.run([KOKSMA, "generate", "void-and-cluster:size=%d" % size, "-n", str(size * size)], capture_output=True,
                              text=True, check=True)
        levels = bytearray(size * size)
        for rank, line in enumerate(line for line in done.stdout.splitlines() if not line.startswith("#")):
            x, y = (int(float(word) * size) for word in line.split())
            levels[y * size + x] = rank * 256 // (size * size)
        write_levels(paths[0], levels, size)
        ours, others = map(error, paths)
        if ours > 1.01 * others:  # of one seed each
            sys.exit("speed.py: %s: a Gaussian leaves %.4g here, and %.4g of the crate's" % (what, ours, others))
        return "error %.4f, theirs %.4f" % (ours, others)
    table.versus(part, what, lambda: timed(row, "generate", "void-and-cluster:size=%d" % size, size * size, 2)[0], (lambda: run(program, str(size), raw)) if program else None,
                 "the crate blue-noise 0.2.2", 20, near=near)


def waits(table, row):
    """Where users wait for one command: patterns beside their simplest relatives, and many small sets."""
    def ours(pattern, n):
        return lambda: timed(row, "generate", pattern, n, 2)[0]
    table.versus("6 patterns", "gaussian-jittered 2D 1M", ours("gaussian-jittered", 1 << 20), ours("jittered", 1 << 20), "our jittered")
    for pattern in ("korobov", "lattice-rank1"):
        table.alone("6 patterns", pattern + " 2D 1e7, with its search", ours(pattern, 10000000), .4, True, "s", lambda s: s, rounds=1)
    table.alone("5 measures", "l2-star of 100,000 sets of 16, n-rooks", lambda: run(
        KOKSMA, "measure", "pattern:n-rooks@16", "-m", "l2-star", "--trials", "100000", "--threads", "1"), 2, True, "us a set", lambda s: 10 * s)
    table.alone("3 paths", "rank room.gltf, 4 patterns at 16 samples, until decided", lambda: run(
        KOKSMA, "rank", os.path.join(ROOT, "examples/room.gltf"), "--patterns", "sobol:scramble=owen,multi-jittered,jittered,random",
        "--one-size", "--threads", "1", "--time-limit", "600"), 60, True, "s", lambda s: s, rounds=1)


def python_package(table):
    """The Python package on one thread, beside packages that do the same; one that is not installed has no row."""
    part = "9 Python"
    try:
        import numpy
        os.environ.setdefault("KOKSMA_LIBRARY_DIR", LIBRARY)
        sys.path.insert(0, os.path.join(ROOT, "python"))
        import koksma
    except ImportError:
        return

    def least(call):
        """Of three, by the processor."""
        found = []
        for _ in range(3):
            start = time.process_time()
            call()
            found.append(time.process_time() - start)
        return min(found)

    def beside(what, ours, module, theirs, same, goal):
        """The row, if the module is installed and both sides have the same result."""
        try:
            peer = __import__(module, fromlist=["x"])
        except ImportError:
            table.alone(part, what, lambda: least(ours))
            return
        if table.has(part, what):
            if not same(peer):
                sys.exit("speed.py: %s: not the result of %s" % (what, module))
            table.versus(part, what, lambda: least(ours), lambda: least(lambda: theirs(peer)), module, goal)
    sets, n = 100000, 16
    for pattern in ("n-rooks", "sobol:scramble=owen"):
        beside("%d sets of %d, %s" % (sets, n, pattern), lambda p=pattern: koksma.generate(p, n, sets=sets, threads=1), "torch",
               lambda torch: torch.rand(sets, n, 2, dtype=torch.float64), lambda torch: True, None)  # of torch the time alone
    image, target = numpy.random.default_rng(1).random((2, 768, 768, 3), dtype=numpy.float32)
    grey = [x @ numpy.array([.2126, .7152, .0722]) for x in (image.astype(float), target.astype(float))]
    beside("rmse, 768 x 768", lambda: koksma.compare(image, target, ["rmse"]), "skimage.metrics", lambda m: m.mean_squared_error(image, target),
           lambda m: abs(koksma.compare(image, target, ["rmse"]).rmse ** 2 - m.mean_squared_error(*grey)) < 1e-9, None)
    npy, exr, other = (os.path.join(WORK, name) for name in ("rows.npy", "x.exr", "y.exr"))
    numpy.save(npy, numpy.random.default_rng(2).random((300000, 3)))
    beside("read 300,000 x 3 of NPY", lambda: koksma.read(npy), "numpy", lambda np: np.load(npy),
           lambda np: bool((koksma.read(npy) == np.load(npy)).all()), .7)

    def write_exr(exr_package):
        header = {"compression": exr_package.ZIP_COMPRESSION, "type": exr_package.scanlineimage}
        with exr_package.File(header, {"RGB": image}) as file:
            file.write(other)

    def same_exr(exr_package):
        koksma.write_image(exr, image)
        write_exr(exr_package)
        return bool((koksma.read_image(exr) == koksma.read_image(other)).all())
    beside("write EXR, 768 x 768", lambda: koksma.write_image(exr, image), "OpenEXR", write_exr, same_exr, 1)
    jpeg, other_jpeg = (os.path.join(WORK, name) for name in ("x.jpg", "y.jpg"))
    levels = numpy.where(image <= .0031308, 12.92 * image, 1.055 * image ** (1 / 2.4) - .055)

    def write_jpeg(imageio):
        imageio.imwrite(other_jpeg, (255 * levels + .5).astype(numpy.uint8), quality=100, subsampling=0)

    def same_jpeg(imageio):
        koksma.write_image(jpeg, image)
        write_jpeg(imageio)
        return int(numpy.abs(imageio.imread(jpeg).astype(int) - imageio.imread(other_jpeg)).max()) <= 2
    beside("write JPEG of full quality, 768 x 768; imageio from levels", lambda: koksma.write_image(jpeg, image), "imageio.v3", write_jpeg, same_jpeg, 1)


def qmcpy_files(table, row, qmcpy, seconds):
    """Matrices and vectors of the user: Joe & Kuo's matrices of two dimensions, and a vector for 2^20 points. Ours are read from
    files; QMCPy's own files are elsewhere in its package, so that it gets the same numbers as arrays."""
    import numpy
    part, n = "6 patterns", 1 << 16
    net, lattice = os.path.join(WORK, "net.txt"), os.path.join(WORK, "lattice.txt")
    column, rows, vector = 1 << 31, [[], []], [1, 182667]
    for c in range(32):
        rows[0].append(1 << 31 - c)
        rows[1].append(column)
        column ^= column >> 1
    with open(net, "w", encoding="utf-8") as file:
        file.write("# dnet\n2\n2\n32\n32\n" + "".join(" ".join(map(str, line)) + "\n" for line in rows))
    with open(lattice, "w", encoding="utf-8") as file:
        file.write("# lattice\n2\n1048576\n" + "".join("%d\n" % z for z in vector))
    matrices, z = numpy.array(rows, dtype=numpy.uint64), numpy.array(vector, dtype=numpy.uint64)
    for what, spec, make in (
            ("net-file 2D 64k", "net-file:" + net, lambda: qmcpy.DigitalNetB2(2, randomize="FALSE", generating_matrices=matrices, msb=True, t=32)),
            ("lattice-file 2D 64k", "lattice-file:" + lattice, lambda: qmcpy.Lattice(2, randomize="FALSE", generating_vector=z, m_max=20))):
        table.versus(part, what, lambda s=spec: timed(row, "generate", s, n, 2)[0],
                     lambda m=make: seconds(lambda: m().gen_samples(n, warn=False)), "QMCPy " + qmcpy.__version__, 1)


def python_peers(table, row):
    part = "6 patterns"
    try:
        import numpy
        from scipy.stats import qmc
        import scipy
    except ImportError:
        return

    def seconds(call):
        start = time.process_time()
        call()
        return time.process_time() - start
    n = 1 << 20
    for pattern, make in (("sobol", lambda: qmc.Sobol(2, scramble=False)), ("halton", lambda: qmc.Halton(2, scramble=False)),
                          ("n-rooks", lambda: qmc.LatinHypercube(2))):
        table.versus(part, pattern + " 2D 1M", lambda p=pattern: timed(row, "generate", p, n, 2)[0],
                     lambda m=make: seconds(lambda: m().random(n)), "scipy " + scipy.__version__)
    for pattern in ("sz", "cascaded-sobol"):
        table.versus(part, pattern + " 4D 1M", lambda p=pattern: timed(row, "generate", p, n, 4)[0],
                     lambda: seconds(lambda: qmc.Sobol(4, scramble=False).random(n)), "scipy's Sobol' " + scipy.__version__, 1)
    table.versus(part, "halton:scramble=owen 2D 64k", lambda: timed(row, "generate", "halton:scramble=owen", 1 << 16, 2)[0],
                 lambda: seconds(lambda: qmc.Halton(2, seed=1).random(1 << 16)), "scipy " + scipy.__version__, 1)
    for dim, count, radius in ((2, 2000, 0.0187), (3, 1000, 0.0885)):  # its sets have about as many points, and room for more
        table.versus(part, "poisson-disk-maximal %dD %d" % (dim, count),
                     lambda d=dim, c=count: timed(row, "generate", "poisson-disk-maximal", c, d)[0],
                     lambda d=dim, r=radius: seconds(lambda: qmc.PoissonDisk(d, radius=r, seed=1).fill_space()),
                     "scipy " + scipy.__version__, 1)
    try:
        import poisson_disc
        table.versus(part, "poisson-disk-maximal 2D 2000", lambda: timed(row, "generate", "poisson-disk-maximal", 2000, 2)[0],
                     lambda: seconds(lambda: poisson_disc.Bridson_sampling(numpy.ones(2), 0.0187)), "poisson-disc", 1)
    except ImportError:
        pass
    points = numpy.random.default_rng(1).random((10000, 2))
    for name, method in (("l2-star", "L2-star"), ("l2-centered", "CD"), ("l2-wraparound", "WD"), ("l2-mixture", "MD")):
        table.versus("5 measures", name + " 2D, 1e4 points", lambda m=name: timed(row, "measure", m, "random", 10000, 2)[0],
                     lambda m=method: seconds(lambda: qmc.discrepancy(points, method=m)), "scipy " + scipy.__version__)
    try:
        import qmcpy
    except ImportError:
        return
    for pattern, make in (("sobol:scramble=owen", lambda: qmcpy.DigitalNetB2(2, randomize="NUS", seed=1)),
                          ("halton", lambda: qmcpy.Halton(2, randomize="FALSE", seed=1))):
        small = 1 << 16
        table.versus(part, pattern + " 2D 64k", lambda p=pattern: timed(row, "generate", p, small, 2)[0],
                     lambda m=make: seconds(lambda: m().gen_samples(small)), "QMCPy " + qmcpy.__version__)
    for pattern, make in (("lattice-sequence", lambda: qmcpy.Lattice(2, randomize="FALSE", order="RADICAL INVERSE")),
                          ("sobol", lambda: qmcpy.DigitalNetB2(2, randomize="FALSE")),
                          ("interlaced-sobol", lambda: qmcpy.DigitalNetB2(2, randomize="FALSE", alpha=2))):
        table.versus(part, pattern + " 2D 64k", lambda p=pattern: timed(row, "generate", p, 1 << 16, 2)[0],
                     lambda m=make: seconds(lambda: m().gen_samples(1 << 16, warn=False)), "QMCPy " + qmcpy.__version__, 1)
    qmcpy_files(table, row, qmcpy, seconds)


def start_up(table, row, base):
    part = "7 start-up"

    def many(program, *words):
        """Of one of 20 processes in a row, by the processor."""
        return lambda: run("sh", "-c", 'for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do "$@"; done', "sh", program,
                           *words) / 20
    points = os.path.join(WORK, "sixteen.txt")
    run(KOKSMA, "generate", "n-rooks", "-n", "16", "-o", points)
    for words in (("generate", "n-rooks", "-n", "16"), ("measure", points), ("verify", points), ("list", "patterns"), ("--help",)):
        name = " ".join(os.path.basename(word) for word in words)
        table.alone(part, name, many(KOKSMA, *words), 2.5)
        if table.has(part, name):
            mib = timed(row, "memory", KOKSMA, *words)[0]
            table.add(part, name, "%.2g" % mib, "MiB", goal="≤ 5", met=mib <= 5)
    if base:
        table.versus(part, "measure sixteen.txt", many(KOKSMA, "measure", points),
                     many(base + "/build/release/koksma", "measure", points), BASE_COMMIT)


def write_ply(path):
    """1,114,656 triangles that share no vertices, as the issue's."""
    import array
    n = 1114656
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
                   b"property float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n" % (3 * n, n))
        places = array.array("f")
        for t in range(n):
            x, y, z = t % 1056 / 1056, t // 1056 / 1056, t % 7 / 100
            places.extend((x, y, z, x + 1e-3, y, z, x, y + 1e-3, z))
        places.tofile(file)
        faces = bytearray()
        for t in range(n):
            faces += b"\3" + (3 * t).to_bytes(4, "little") + (3 * t + 1).to_bytes(4, "little") + (3 * t + 2).to_bytes(4, "little")
        file.write(faces)


def large_data(table, row, base):
    part, npy, zeros = "8 large data", os.path.join(WORK, "x.npy"), os.path.join(WORK, "zeros")
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

    def stream():
        passed = run(KOKSMA, "generate", "sobol", "-n", str(POINTS), "-o", npy, "-q", clock=True)
        os.unlink(npy)
        return passed
    table.versus(part, "sobol, %.0e points to NPY, clock" % POINTS, stream, copy, "a plain write", 0.5, "Mpoints/s", lambda s: POINTS / 1e6 / s)
    text = os.path.join(WORK, "points.txt")
    if any(table.has(part, "%s 1e6 points as text" % mode) for mode in ("write", "read")):
        run(KOKSMA, "generate", "random", "-n", "1000000", "-o", text)
        for mode in ("write", "read"):
            table.alone(part, "%s 1e6 points as text" % mode, lambda m=mode: timed(row, m, text), 10, False, "Mpoints/s", lambda s: 1 / s)
    ply = os.path.join(WORK, "large.ply")
    name = "binary PLY, 1.1 M triangles, 54.6 MB"
    if table.has(part, name):
        if not os.path.exists(ply):
            write_ply(ply)
        table.alone(part, name, lambda: timed(row, "scene", ply), 0.15, True, "s", lambda s: s)
    plan, jobs = os.path.join(WORK, "tiny.json"), 300000
    with open(plan, "w", encoding="utf-8") as file:
        json.dump({"name": "tiny", "title": "tiny", "discrepancies": [
            {"patterns": ["random"], "measures": ["l2-star"], "n": [4], "trials": jobs}]}, file)

    def study(program, threads, clock):
        def once():
            out = os.path.join(WORK, "study")
            shutil.rmtree(out, ignore_errors=True)
            return run(program, "study", "run", plan, "-o", out, "-q", "--threads", str(threads), clock=clock)
        return once
    if base:
        table.versus(part, "study of 300,000 tiny jobs with report", study(KOKSMA, 1, False),
                     study(base + "/build/release/koksma", 1, False), BASE_COMMIT, 2, "jobs/s", lambda s: jobs / s)
    table.versus(part, "study of 300,000 tiny jobs, 2 threads, clock", study(KOKSMA, 2, True), study(KOKSMA, 1, True), "1 thread", 1.05, "jobs/s",
                 lambda s: jobs / s)


def threads(table, row):
    part = "9 two threads by the clock"

    def clock(count, *words):
        return lambda: timed(row, *words, threads="%dc" % count)[0]
    for what, words in (("star 3D 1000", ("measure", "star", "random", 1000, 3)), ("edge 1600", ("measure", "edge", "random", 1600, 2)),
                        ("exact spectrum 4096", ("exact", "random", 4096, 319)), ("l2-star 1e6", ("measure", "l2-star", "random", 1000000, 2)),
                        ("Owen-Sobol' 4M", ("generate", "sobol:scramble=owen", 1 << 22, 2))):
        table.versus(part, what, clock(2, *words), clock(1, *words), "1 thread")
    for pattern in ("jittered", "regular"):
        render = (KOKSMA, "render", "ball", "-p", pattern, "-n", "256", "--size", "512x384", "-o", os.path.join(WORK, "x.pfm"))
        table.versus(part, "ball, %s, 256 spp" % pattern, lambda r=render: run(*r, "--threads", "2", clock=True),
                     lambda r=render: run(*r, "--threads", "1", clock=True), "1 thread", None, "Msamples/s",
                     lambda s: 512 * 384 * 256e-6 / s)


def renderers(table):
    part = "9 other renderers"
    for script, name in (("bench_povray.sh", "povray"), ("bench_blender.sh", "blender")):
        if shutil.which(name) and table.has(part, name):
            out = subprocess.run([os.path.join(ROOT, "bench", script)], capture_output=True, text=True, check=False).stdout
            found = re.search(r"jittered ([\d.]+) \((\d+) times\)", out)
            if found:
                table.add(part, "ball, jittered, whole program", found[1], "Msamples/s", peer=name, ratio=found[2])
    mitsuba(table, part)


def write_globe(path, rows=55):
    """A sphere of radius .3 about (0, .3, 0) of 4 rows (rows - 1) triangles, with texture coordinates, as OBJ."""
    columns = 2 * rows
    with open(path, "w", encoding="utf-8") as file:
        for i in range(rows + 1):
            for j in range(columns + 1):
                theta, phi = math.pi * i / rows, 2 * math.pi * j / columns
                file.write("v %.6f %.6f %.6f\nvt %.6f %.6f\n" % (.3 * math.sin(theta) * math.cos(phi), .3 + .3 * math.cos(theta),
                                                               .3 * math.sin(theta) * math.sin(phi), j / columns, i / rows))
        for i in range(rows):
            for j in range(columns):
                a, b = i * (columns + 1) + j + 1, (i + 1) * (columns + 1) + j + 1
                for corners in ((a, a + 1, b + 1), (a, b + 1, b))[i == 0:2 - (i == rows - 1)]:
                    file.write("f " + " ".join("%d/%d" % (c, c) for c in corners) + "\n")


MITSUBA_ROWS = (("Mitsuba's Cornell box, path", 2), ("a textured mesh, path", 1.5), ("a GGX mesh, path", 1.5), ("1.1 M triangles, path", 1.5))


def mitsuba_scenes(mi, numpy):
    """The scenes of MITSUBA_ROWS as Mitsuba's dictionaries; the meshes are above a floor under a lamp."""
    globe, large, image = (os.path.join(WORK, name) for name in ("globe.obj", "large.ply", "squares.png"))
    if not os.path.exists(large):
        write_ply(large)
    write_globe(globe)
    squares = numpy.random.default_rng(1).integers(20, 236, (64, 64, 3), dtype=numpy.uint8)
    mi.Bitmap(squares.repeat(8, 0).repeat(8, 1)).write(image)
    box, turn = mi.cornell_box(), mi.ScalarTransform4f

    def on_floor(kind, path, material, place):
        return {"type": "scene", "integrator": {"type": "path"}, "sensor": {
            "type": "perspective", "fov": 30, "to_world": turn().look_at(origin=[0, 1, 2], target=[0, .25, 0], up=[0, 1, 0]),
            "film": {"type": "hdrfilm"}, "sampler": {"type": "independent"}},
            "mesh": {"type": kind, "filename": path, "to_world": place, "material": material},
            "floor": {"type": "rectangle", "to_world": turn().rotate([1, 0, 0], -90).scale(3), "material": {"type": "diffuse"}},
            "lamp": {"type": "rectangle", "to_world": turn().translate([0, 2, 1]).rotate([1, 0, 0], 90).scale(.5),
                     "emitter": {"type": "area", "radiance": {"type": "rgb", "value": 8.}}}}
    ggx = {"type": "roughconductor", "distribution": "ggx", "alpha": .3}
    images = {"type": "diffuse", "reflectance": {"type": "bitmap", "filename": image}}
    sheet = turn().translate([-.5, .1, .5]).rotate([1, 0, 0], -90)
    return (box, on_floor("obj", globe, images, turn()), on_floor("obj", globe, ggx, turn()),
            on_floor("ply", large, {"type": "twosided", "material": {"type": "diffuse"}}, sheet))


def mitsuba(table, part):
    """6 bounces without roulette, 32 random samples of each of 256 x 256 pixels, by its path tracers and by ours; of ours the time
    beyond that of one sample, of theirs the time after a first render, which compiles."""
    if not any(table.has(part, what) for what, _ in MITSUBA_ROWS):
        return
    try:
        import drjit
        import mitsuba as mi
        import numpy
    except ImportError:
        return
    side, samples, picture = 256, 32, os.path.join(WORK, "mitsuba.pfm")
    for variant, name in (("scalar_rgb", "scalar"), ("llvm_ad_rgb", "LLVM")):
        mi.set_variant(variant)
        drjit.set_thread_count(1)
        for (what, goal), given in zip(MITSUBA_ROWS, mitsuba_scenes(mi, numpy)):
            xml, means = os.path.join(WORK, "mitsuba.xml"), {}
            given["sensor"]["film"].update(width=side, height=side, rfilter={"type": "box"})
            given["integrator"].update(max_depth=6, rr_depth=100)
            mi.parser.write_file(mi.parser.parse_dict(mi.parser.ParserConfig(mi.variant()), given), xml)
            scene = mi.load_dict(given)

            def theirs(scene=scene, means=means):
                start = time.process_time()
                image = mi.render(scene, spp=samples).array
                means["Mitsuba"] = float(sum(image)) / len(image)
                return time.process_time() - start

            def ours(means=means, xml=xml):
                first, seconds = (run(KOKSMA, "render", xml, "--integrator", "path", "--depth", "6", "-p", "random", "-n", str(n),
                                      "--threads", "1", "-o", picture) for n in (1, samples))
                with open(picture, "rb") as file:
                    head, text = file.readline(), file.read()
                values = array.array("f", text[-4 * side * side * (3 if head == b"PF\n" else 1):])
                means["koksma"] = sum(values) / len(values)
                return (seconds - first) * samples / (samples - 1)
            if table.has(part, what):
                theirs()
                table.versus(part, what, ours, theirs, "Mitsuba %s, %s" % (mi.__version__, name),
                             goal if name == "LLVM" else None, "Msamples/s", lambda s: side * side * samples * 1e-6 / s)
                if abs(means["koksma"] - means["Mitsuba"]) > .03 * means["Mitsuba"]:
                    sys.exit("speed.py: %s: the pictures differ: %s" % (what, means))


# ---- The page ---------------------------------------------------------------------------------------------------

def page(table, load, minutes, reasons):
    model = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo", encoding="utf-8") if line.startswith("model name")),
                 platform.machine()) if os.path.exists("/proc/cpuinfo") else platform.machine()
    commit = subprocess.run(["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False).stdout.strip()
    table.rows.sort(key=lambda row: row[0])
    with_goal = [row for row in table.rows if row[7] is not None]
    missed = [row for row in with_goal if not row[7]]
    lines = ["# Speed beside peers and an older commit", "",
             "Written by `make bench` (`bench/speed.py`) on %s at commit %s: %s, %d processors, %s, load %.1f before and %.1f after; "
             "%.0f minutes." % (datetime.date.today().isoformat(), commit, model, os.cpu_count() or 0,
                                "kernels " + ", ".join(ISAS), load[0], load[1], minutes), ""]
    if max(load) > 1.5:
        lines += ["**The machine was not quiet.** Ratios, whose two sides took turns, count; times and rates of a row alone are too "
                  "slow, and two threads gain less than they would.", ""]
    lines += ["Seconds are of the processor, but where the row says clock, and for two threads. A ratio is peer over ours, so that "
              "more than 1 is faster than the peer: the median of %d turns, the smallest and the largest. This machine stores "
              "%.1f GB/s past the caches (16 MiB) and does %.0f Gflop/s of doubles on one core." %
              (ROUNDS, table.limits["stores"] / 1e9, table.limits["flops"] / 1e9), "",
              "%d of %d goals are met%s" % (len(with_goal) - len(missed), len(with_goal), "." if not missed else "; missed are:"), ""]
    told = set()
    for _, what, ours, unit, peer, ratio, goal, _, _ in missed:
        reason = next((text for key, text in reasons if key in what and text not in told), "")
        told.add(reason)
        lines.append("- %s: %s, goal %s%s%s" % (what, "%s times %s" % (ratio.split()[0], peer) if peer else "%s %s" % (ours, unit),
                                              goal.replace(" x", ""), " " + unit if not peer else "", "" if not reason else ". " + reason))
    lines += [""] if missed else []
    lines += ["| part | row | ours | | beside | ratio or range | goal | | limit |", "|---|---|---|---|---|---|---|---|---|"]
    for part, what, ours, unit, peer, ratio, goal, met, near in table.rows:
        lines.append("| %s | %s | %s | %s | %s | %s | %s | %s | %s |" % (
            part, what, ours, unit, peer, ratio, goal, "" if met is None else "yes" if met else "**no**", near))
    return "\n".join(line if line.startswith("|") else textwrap.fill(line, 124, subsequent_indent="  " * line.startswith("-"),
                                                                      break_long_words=False) for line in lines) + "\n"


# Why a goal is out of reach so far, by profiles: beside the rows whose names have the first text. No shares of time: they
# differ between machines, and no command measures them.
REASONS = [
    ("2 threads", "Store, report and fingerprint are of one thread."),
    ("tiny jobs", "The older program wrote no checksums, seal and fingerprint."),
    ("star 2D, Owen", "The kinetic tree is walked one point at a time, by branches."),
    ("pmj02 2D 1M, avx2", "Philox (10 rounds, half a counter a point), growing columns and storing rows of doubles share the time."),
    ("ball, regular", "A lattice has no random numbers whose drawing could be made faster."),
    ("ball, pmj02", "c86c5f3 drew pmj02 faster than jittered points."),
    ("ball, n-rooks", "Each use takes two random orders."),
    ("bunny", "c86c5f3 spent the time of Embree and of handing rays to it, too."),
    ("ball, correlated", "Each use takes three random orders."),
    ("ball, ", "Rays and light take as long at c86c5f3."),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", help="write the page here instead of to stdout")
    parser.add_argument("wanted", nargs="?", default="", help="only rows with this in their name")
    arguments = parser.parse_args()
    os.makedirs(WORK, exist_ok=True)
    base = build_base()
    peers = build_peers(base)
    begun, load = time.monotonic(), [os.getloadavg()[0]]
    table = Table(arguments.wanted)
    measure_limits(table, peers["koksma"])
    row = peers["koksma"]
    for part in (lambda: start_up(table, row, base), lambda: measures(table, peers), lambda: patterns(table, peers),
                 lambda: authors_patterns(table, peers),
                 lambda: renders(table, base), lambda: large_data(table, row, base), lambda: python_peers(table, row),
                 lambda: masks(table, row), lambda: waits(table, row), lambda: python_package(table),
                 lambda: sampler(table), lambda: threads(table, row), lambda: renderers(table), lambda: kernels(table),
                 lambda: extremes(table, row)):
        part()
        text = page(table, [*load, os.getloadavg()[0]], (time.monotonic() - begun) / 60, REASONS)
        if arguments.output:  # after each part, so that an interrupted run leaves what it has
            with open(arguments.output, "w", encoding="utf-8") as file:
                file.write(text)
    if not arguments.output:
        print(text, end="")


if __name__ == "__main__":
    main()

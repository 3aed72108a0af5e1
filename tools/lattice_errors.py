#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The tables of docs/findings/lattices.md: errors of the lattices of a built program, by formulas of its own.

    tools/lattice_errors.py build/release/koksma          all tables; a minute of one core
    tools/lattice_errors.py build/release/koksma small    without sets of more than 2^16 points
"""
import array
import math
import os
import subprocess
import sys
import tempfile

# Cools, Kuo & Nuyens 2006: exod2_base2_m20_CKN of Nuyens's Magic Point Shop, the first ten numbers.
CKN = [1, 182667, 469891, 498753, 110745, 446247, 250185, 118627, 245333, 283199]
# Lattice rules B, C and D of QuantLib, which cites the same paper (A is CKN): up to 2^20 points, other weights.
CKN_B = [1, 182667, 213731, 255351, 96013, 116671, 479315, 424089, 271103, 464421]
CKN_C = [1, 433461, 103659, 481853, 186513, 108043, 230553, 308877, 315969, 296357]
CKN_D = [1, 182667, 279195, 223491, 205755, 359329, 198937, 246491, 466233, 379083]
# Kuo's vector with weights 1/j^2 for up to 2^32 points, as LatticeRules.jl has it (K_3600_32).
K32 = [1, 433461, 472323, 440637, 231645, 275007, 113895, 331051, 283181, 384579]
# Hickernell, Kritzer, Kuo & Nuyens 2012: weights all 1, ten dimensions, as LatNet Builder has it.
HKKN = [1, 364981, 245389, 97823, 488939, 62609, 400749, 385317, 21281, 223487]
GAMMA = 3 / (8 * math.pi**2)


def rows(program, spec, n, dim, seed=0, count=2):
    """The first `count` points of a set, or all."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "set.npy")
        command = [program, "generate", spec, "-n", str(n), "-d", str(dim), "-s", str(seed), "-o", path]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(path, "rb") as file:
            head = file.read(10)
            file.seek(10 + int.from_bytes(head[8:10], "little"))
            values = array.array("d")
            values.fromfile(file, count * dim)
    return [values[i * dim : (i + 1) * dim] for i in range(count)]


def vector(program, spec, n, dim):
    return [round(x * n) for x in rows(program, spec, n, dim)[1]]


def sequence(program, dim):
    """The vector of lattice-sequence modulo 2^20: point 2^19 is z / 2^20."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "point.txt")
        command = [program, "generate", "lattice-sequence", "-n", "1", "-d", str(dim), "--first", str(1 << 19), "-o", path]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with open(path, encoding="ascii") as file:
            line = [line for line in file if not line.startswith("#")][0]
    return [round(float(x) * 2**20) for x in line.replace(",", " ").split()]


def p2(n, z, gamma):
    """The mean over i of prod_k (1 + 2 pi^2 gamma B_2({i z_k / n})), less 1; i and n - i have the same term."""
    weight = 2 * math.pi**2 * gamma
    terms = []
    for i in range(n // 2 + 1):
        product = 1.0
        for multiplier in z:
            x = i * multiplier % n / n
            product *= 1 + weight * (x * (x - 1) + 1 / 6)
        terms.append((product - 1) * (1 if i == 0 or 2 * i == n else 2))
    return math.fsum(terms) / n


def p2_of_prefixes(n, z, gamma):
    """P_2 of the first d coordinates for d = 1 to len(z), with running sums."""
    weight, sums = 2 * math.pi**2 * gamma, [0.0] * len(z)
    for i in range(n // 2 + 1):
        product, count = 1.0, 1 if i == 0 or 2 * i == n else 2
        for k, multiplier in enumerate(z):
            x = i * multiplier % n / n
            product *= 1 + weight * (x * (x - 1) + 1 / 6)
            sums[k] += (product - 1) * count
    return [total / n for total in sums]


def p2_of_pairs(n, z, gamma):
    """P_2 with order-2 weights: projections of one and of two coordinates."""
    weight, terms = 2 * math.pi**2 * gamma, []
    for i in range(n // 2 + 1):
        parts = [weight * (x * (x - 1) + 1 / 6) for x in (i * multiplier % n / n for multiplier in z)]
        total = sum(parts)
        terms.append((total + (total * total - sum(t * t for t in parts)) / 2) * (1 if i == 0 or 2 * i == n else 2))
    return math.fsum(terms) / n


def largest_ratios(program, most, embedded):
    """For each dimension the largest root of the ratio of P_2 to lattice-rank1's, over the powers of two, and where."""
    worst = [(0, 0)] * len(embedded)
    for n in (1 << m for m in range(4, most.bit_length())):
        own = p2_of_prefixes(n, vector(program, "lattice-rank1", n, len(embedded)), GAMMA)
        for d, (a, b) in enumerate(zip(p2_of_prefixes(n, embedded, GAMMA), own)):
            worst[d] = max(worst[d], (math.sqrt(a / b), n))
    return worst[1:]


def shifted_error(program, spec, n, dim, shifts):
    """prod_k (1 + B_2(x_k)), whose integral is 1, over `shifts` sets: the root mean square of the errors."""
    squares = 0.0
    for seed in range(shifts):
        terms = []
        for point in rows(program, spec + ":shift=1", n, dim, seed, n):
            product = 1.0
            for x in point:
                product *= 1 + x * (x - 1) + 1 / 6
            terms.append(product - 1)
        squares += (math.fsum(terms) / n) ** 2 / shifts
    return math.sqrt(squares)


def show(*cells):
    print("| " + " | ".join(c if isinstance(c, str) else f"{c:.3g}" for c in cells) + " |", flush=True)


def name(n):
    return f"2^{n.bit_length() - 1}" if n & (n - 1) == 0 else f"{n:,}"


def main():
    program, most = sys.argv[1], 1 << (16 if "small" in sys.argv[2:] else 20)
    embedded = sequence(program, 10)
    show("n", "lattice-rank1", "korobov", "lattice-sequence", "CKN", "B", "C", "D", "Kuo, 2^32", "Hickernell et al.")
    for n in [1 << k for k in (10, 12, 14, 16, 17, 18, 19, 20)] + [1009, 3000, 10007, 30030, 65537, 131071, 720720]:
        if n <= most:
            own = [vector(program, spec, n, 10) for spec in ("lattice-rank1", "korobov")]
            show(name(n), *(p2(n, z, GAMMA) for z in own + [embedded, CKN, CKN_B, CKN_C, CKN_D, K32, HKKN]))
    ratios = largest_ratios(program, most, embedded)
    show("dimensions", *(str(d) for d in range(2, 11)))
    show("lattice-sequence", *(f"{ratio:.2f}" for ratio, _ in ratios))
    show("at n", *(name(n) for _, n in ratios))
    show("n", "CKN over lattice-rank1:order=2, order-2 weights")
    for n in (1 << k for k in (10, 12, 14, 16, 18, 20)):
        if n <= most:
            best = vector(program, "lattice-rank1:order=2", n, 10)
            show(name(n), f"{math.sqrt(p2_of_pairs(n, CKN, GAMMA) / p2_of_pairs(n, best, GAMMA)):.2f}")
    show("n", "fibonacci", "lattice-rank1", "ratio")
    for n in (5, 8, 13, 21, 55, 233, 987, 4181, 17711, 75025, 317811):
        if n <= most:
            fibonacci, best = (p2(n, vector(program, spec, n, 2), 1) for spec in ("fibonacci", "lattice-rank1"))
            show(name(n), fibonacci, best, f"{fibonacci / best:.4f}")
    show("n", "lattice-rank1", "korobov")
    for n in (1 << k for k in (10, 12, 14, 16, 18, 20)):
        if n <= most:
            show(name(n), *(shifted_error(program, spec, n, 8, 8) for spec in ("lattice-rank1", "korobov")))


if __name__ == "__main__":
    main()

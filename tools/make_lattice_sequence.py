#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_lattice_sequence.py DIMENSIONS: the row of src/engine/patterns/data/lattice_sequence.csv, the vector of lattice-sequence.

Component by component: z_k is the odd number below 2^19 whose lattices of 2^3, 2^4, .. 2^20 points are all good. The
error of level m is lattice-rank1's, the mean over i of prod_j (1 + 3/4 B_2({i z_j / 2^m})) less 1; the z with the
smallest largest ratio of the error to the least of all z of that level is taken, the smallest z if several have it.
Embedded lattices and their criterion: Cools, Kuo & Nuyens 2006.

All z at once (Nuyens & Cools 2006): i / 2^m in lowest terms is odd i' / 2^q, q <= m, so that the sums of level m are
those of the q up to m. The units modulo 2^q are +-5^a, a < 2^(q-2), and B_2 is even: one cyclic convolution a level.
"""
import sys

import numpy as np

TOP, FIRST = 20, 3


def main():
    """Prints the table."""
    powers = {q: np.array([1], dtype=np.int64) for q in (1, 2)}  # 5^a modulo 2^q
    for q in range(FIRST, TOP + 1):
        p = np.array([1], dtype=np.int64)
        while len(p) < 1 << (q - 2):
            p = np.concatenate([p, p * pow(5, len(p), 1 << q) % (1 << q)])
        powers[q] = p
    kernel = {q: (lambda x: x * x - x + 1 / 6)(p / (1 << q)) for q, p in powers.items()}
    spectrum = {q: np.fft.rfft(k) for q, k in kernel.items()}
    product = {q: np.ones(len(p)) for q, p in powers.items()}
    # of z = 5^a modulo 2^TOP, its exponent modulo 2^(q-2) is its place in level q
    units = np.minimum(powers[TOP], (1 << TOP) - powers[TOP])
    vector = [1]
    for k in range(int(sys.argv[1])):
        if k:
            ratio = np.ones(1)
            total = np.array([1.125 ** (k + 1) + product[1][0] * (1 + 0.75 * kernel[1][0]) + 2 * product[2][0] * (1 + 0.75 * kernel[2][0])])
            for q in range(FIRST, TOP + 1):
                sums = np.fft.irfft(np.conj(np.fft.rfft(product[q])) * spectrum[q], len(product[q]))  # of 5^a: sum_b w(5^b) B_2(5^(a+b))
                total = np.tile(total, len(sums) // len(total)) + 2 * (product[q].sum() + 0.75 * sums)
                error = total - (1 << q)
                ratio = np.maximum(np.tile(ratio, len(sums) // len(ratio)), error / error.min())
            near = np.flatnonzero(ratio <= ratio.min() + 1e-12)
            vector.append(int(units[near].min()))
        exponent = int(np.flatnonzero(units == vector[-1])[0])
        for q in powers:
            product[q] = product[q] * (1 + 0.75 * np.roll(kernel[q], -exponent % len(product[q])))
        print(k, vector[-1], file=sys.stderr)
    assert len(set(vector)) == len(vector)
    print("z," + " ".join(map(str, vector)))


main()

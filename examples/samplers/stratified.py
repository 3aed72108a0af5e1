#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""stratified.py N DIM SEED: a sampler as a program, for the pattern exec:./stratified.py. One point at random in each of N
slices of the first coordinate; the points depend on the three arguments alone.

    koksma measure exec:./stratified.py@64 -m star,l2-star --allow-exec
"""
import random
import sys

n, dim, seed = map(int, sys.argv[1:4])
chance = random.Random(seed)
for i in range(n):
    print((i + chance.random()) / n, *(chance.random() for _ in range(dim - 1)))

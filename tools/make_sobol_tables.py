#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make_sobol_tables.py: prints two rows of src/engine/patterns/data/sobol.csv (needs scipy and the GSL library, which
hold the published numbers).

Joe & Kuo's numbers (2008, new-joe-kuo-6.21201) are read from scipy's copy. Bratley & Fox's (1988, ACM Algorithm 659)
are read off the points of GSL's generator, and checked to follow from their polynomials.
"""
import ctypes
import os

import numpy
import scipy.stats

DIMENSIONS = 1111


def joe_kuo():
    data = numpy.load(os.path.join(os.path.dirname(scipy.stats.__file__), "_sobol_direction_numbers.npz"))
    for poly, m in zip(data["poly"][1:DIMENSIONS], data["vinit"][1:DIMENSIONS]):
        degree = int(poly).bit_length() - 1
        yield [int(poly)] + [int(x) for x in m[:degree]]


def directions(row, count):
    degree, m = row[0].bit_length() - 1, list(row[1:])
    while len(m) < count:
        i = len(m)
        x = m[i - degree] ^ (m[i - degree] << degree)
        for k in range(1, degree):
            if row[0] >> (degree - k) & 1:
                x ^= m[i - k] << k
        m.append(x)
    return m


def bratley_fox():
    gsl = ctypes.CDLL("libgsl.so.27")
    gsl.gsl_qrng_alloc.restype = ctypes.c_void_p
    gsl.gsl_qrng_alloc.argtypes = [ctypes.c_void_p, ctypes.c_uint]
    gsl.gsl_qrng_get.argtypes = [ctypes.c_void_p, ctypes.POINTER(ctypes.c_double)]
    q = gsl.gsl_qrng_alloc(ctypes.c_void_p.in_dll(gsl, "gsl_qrng_sobol"), 40)
    x, last, columns = (ctypes.c_double * 40)(), [0] * 40, {}
    for i in range(1 << 12):
        gsl.gsl_qrng_get(q, x)
        now = [int(v * (1 << 30)) for v in x]
        place = ((i + 1) & -(i + 1)).bit_length() - 1
        columns[place] = [a ^ b for a, b in zip(now, last)]
        last = now
    count = len(columns)
    polynomials = [p for p in range(3, 512, 2) if primitive(p)]
    for k in range(1, 40):
        m = [columns[j][k] >> (29 - j) for j in range(count)]
        fits = [p for p in polynomials if directions([p] + m[:p.bit_length() - 1], count)[:count] == m]
        yield [fits[0]] + m[:fits[0].bit_length() - 1]


def primitive(p):
    degree, x, order = p.bit_length() - 1, 1, 0
    while True:
        x <<= 1
        if x >> degree & 1:
            x ^= p
        order += 1
        if x <= 1:
            return x == 1 and order == (1 << degree) - 1


for name, rows in (("joe_kuo", joe_kuo()), ("bratley_fox", bratley_fox())):
    print(name + "," + " ".join(str(number) for row in rows for number in row))

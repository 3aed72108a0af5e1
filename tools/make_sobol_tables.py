#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes src/engine/patterns/nets/sobol_joe_kuo.inc and sobol_bratley_fox.inc.

Usage: tools/make_sobol_tables.py [FOLDER]   (needs scipy and the GSL library, which hold the published numbers)

Joe & Kuo's numbers (2008, new-joe-kuo-6.21201) are read from scipy's copy. Bratley & Fox's (1988, ACM Algorithm 659)
are read off the points of GSL's generator, and checked to follow from their polynomials.
"""
import ctypes
import os
import sys

import numpy
import scipy.stats

DIMENSIONS = 1111
NOTICE = """/* Direction numbers of Sobol' sequences: for each dimension from the 2nd, its primitive polynomial (all coefficients,
   the highest first) and as many initial numbers m_1, m_2, ... as its degree.
   Made by tools/make_sobol_tables.py. %s */
"""
JOE_KUO = NOTICE % """Source: S. Joe and F. Y. Kuo, Constructing Sobol sequences with better
   two-dimensional projections, SIAM J. Sci. Comput. 30, 2635-2654 (2008), the set new-joe-kuo-6.21201 as shipped with
   scipy. The set's licence:

   Copyright (c) 2008, Frances Y. Kuo and Stephen Joe. All rights reserved.

   Redistribution and use in source and binary forms, with or without modification, are permitted provided that the
   following conditions are met:
   * Redistributions of source code must retain the above copyright notice, this list of conditions and the following
     disclaimer.
   * Redistributions in binary form must reproduce the above copyright notice, this list of conditions and the
     following disclaimer in the documentation and/or other materials provided with the distribution.
   * Neither the names of the copyright holders nor the names of the University of New South Wales and the University
     of Waikato and its contributors may be used to endorse or promote products derived from this software without
     specific prior written permission.

   THIS SOFTWARE IS PROVIDED BY THE COPYRIGHT HOLDERS "AS IS" AND ANY EXPRESS OR IMPLIED WARRANTIES, INCLUDING, BUT NOT
   LIMITED TO, THE IMPLIED WARRANTIES OF MERCHANTABILITY AND FITNESS FOR A PARTICULAR PURPOSE ARE DISCLAIMED. IN NO
   EVENT SHALL THE COPYRIGHT HOLDERS BE LIABLE FOR ANY DIRECT, INDIRECT, INCIDENTAL, SPECIAL, EXEMPLARY, OR
   CONSEQUENTIAL DAMAGES (INCLUDING, BUT NOT LIMITED TO, PROCUREMENT OF SUBSTITUTE GOODS OR SERVICES; LOSS OF USE, DATA,
   OR PROFITS; OR BUSINESS INTERRUPTION) HOWEVER CAUSED AND ON ANY THEORY OF LIABILITY, WHETHER IN CONTRACT, STRICT
   LIABILITY, OR TORT (INCLUDING NEGLIGENCE OR OTHERWISE) ARISING IN ANY WAY OUT OF THE USE OF THIS SOFTWARE, EVEN IF
   ADVISED OF THE POSSIBILITY OF SUCH DAMAGE."""
BRATLEY_FOX = NOTICE % """Source: P. Bratley and B. L. Fox, Algorithm 659: Implementing Sobol's
   quasirandom sequence generator, ACM Trans. Math. Softw. 14, 88-100 (1988)."""


def write(path, notice, rows):
    line = ""
    with open(path, "w") as out:
        out.write(notice)
        for number in (n for row in rows for n in row):
            piece = "%d," % number
            if len(line) + len(piece) > 118:
                out.write(line + "\n")
                line = ""
            line += piece
        out.write(line + "\n")


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


folder = sys.argv[1] if len(sys.argv) > 1 else "src/engine/patterns/parts"
write(os.path.join(folder, "sobol_joe_kuo.inc"), JOE_KUO, joe_kuo())
write(os.path.join(folder, "sobol_bratley_fox.inc"), BRATLEY_FOX, bratley_fox())

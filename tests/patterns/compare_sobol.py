#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares `koksma generate sobol` with scipy's points and GSL's, which come in Gray-code order. Exit code 77: neither is
installed."""
import ctypes
import ctypes.util
import subprocess
import sys

N = 1024


def ours(spec, dim):
    text = subprocess.run([sys.argv[1], "generate", spec, "-n", str(N), "-d", str(dim)], check=True,
                          capture_output=True, text=True).stdout
    return [[float(x) for x in line.split()] for line in text.splitlines() if not line.startswith("#")]


def scipys(dim):
    from scipy.stats import qmc
    return qmc.Sobol(dim, scramble=False).random(N).tolist()


def gsls(dim):
    library = ctypes.util.find_library("gsl")
    if not library:
        raise ImportError("gsl")
    gsl = ctypes.CDLL(library)
    gsl.gsl_qrng_alloc.restype = ctypes.c_void_p
    gsl.gsl_qrng_alloc.argtypes = [ctypes.c_void_p, ctypes.c_uint]
    gsl.gsl_qrng_get.argtypes = [ctypes.c_void_p, ctypes.POINTER(ctypes.c_double)]
    generator = gsl.gsl_qrng_alloc(ctypes.c_void_p.in_dll(gsl, "gsl_qrng_sobol"), dim)
    points, x = [[0.0] * dim], (ctypes.c_double * dim)()
    for _ in range(N - 1):
        gsl.gsl_qrng_get(generator, x)
        points.append(list(x))
    return points


compared = 0
for name, other, spec, dims in (("scipy", scipys, "sobol", (1, 2, 4, 32, 1111)),
                                ("GSL", gsls, "sobol:numbers=bratley-fox", (1, 2, 4, 32, 40))):
    for dim in dims:
        try:
            theirs = other(dim)
        except (ImportError, OSError):
            print(name, "is not installed")
            break
        mine = ours(spec, dim)
        for i in range(N):
            if mine[i ^ (i >> 1)] != theirs[i]:
                sys.exit("%s: dim %d: point %d is %s, not %s" % (name, dim, i, mine[i ^ (i >> 1)][:8], theirs[i][:8]))
        print(name, "agrees in", dim, "dimensions")
        compared += 1
sys.exit(0 if compared else 77)

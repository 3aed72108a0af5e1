#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: all quasi-random generators of GSL begin with the origin, or all after it; its Sobol' sequence is that of SciPy
# in any dimension, as both are in the order of Gray code.
# Seen: niederreiter_2 begins with the origin, sobol and halton after it. Sobol' is SciPy's from the second point on in
# two dimensions; the third and fourth coordinates have other direction numbers, those of Bratley & Fox.
# Packages: libgsl27 libgslcblas0 libgsl-dev 2.7.1+dfsg-5+deb12u1 (Debian bookworm), numpy==2.3.5 scipy==1.17.1 (PyPI)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
for package in libgsl27 libgslcblas0 libgsl-dev; do
  apt-get download -qq "$package=2.7.1+dfsg-5+deb12u1" 2>/dev/null
done
for package in *.deb; do dpkg-deb -x "$package" .; done
cat >points.c <<'END'
#include <gsl/gsl_qrng.h>
#include <stdio.h>
static void print(const gsl_qrng_type *type) {
  gsl_qrng *q = gsl_qrng_alloc(type, 4);
  double v[4];
  for (int i = 0; i < 7; i++) {
    gsl_qrng_get(q, v);
    printf("%s %.8f %.8f %.8f %.8f\n", gsl_qrng_name(q), v[0], v[1], v[2], v[3]);
  }
  gsl_qrng_free(q);
}
int main(void) {
  print(gsl_qrng_sobol);
  print(gsl_qrng_niederreiter_2);
  print(gsl_qrng_halton);
}
END
lib=$(dirname "$(find . -name 'libgsl.so' | head -1)")
cc -Iusr/include points.c -o points -L"$lib" -lgsl -lgslcblas -lm
LD_LIBRARY_PATH=$lib ./points >points.txt
python3 -m venv venv
venv/bin/pip install -q --disable-pip-version-check numpy==2.3.5 scipy==1.17.1
venv/bin/python - <<'END'
import numpy as np
from scipy.stats import qmc

sets = {}
for line in open("points.txt"):
    name, *point = line.split()
    sets.setdefault(name, []).append([float(x) for x in point])
origins = {name: not np.any(points[0]) for name, points in sets.items()}
theirs = qmc.Sobol(4, scramble=False).random(8)[1:]
equal = [bool(np.allclose(np.array(sets["sobol"])[:, d], theirs[:, d])) for d in range(4)]
print("begins with the origin:", origins)
print("coordinates of Sobol' that are SciPy's:", equal)
raise SystemExit(list(origins.values()) != [False, True, False] or equal != [True, True, False, False])
END

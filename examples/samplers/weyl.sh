#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# weyl.sh N DIM SEED: a sampler as a program, for the pattern exec:./weyl.sh. Multiples of the square roots of 2, 3, 5, ...
# modulo 1, from number SEED on.
exec awk -v n="$1" -v dim="$2" -v seed="$3" 'BEGIN {
  for (p = 2; roots < dim; p++) {
    prime = 1
    for (q = 2; q * q <= p; q++) if (p % q == 0) prime = 0
    if (prime) root[roots++] = sqrt(p)
  }
  for (i = 1; i <= n; i++) for (k = 0; k < dim; k++) {
    x = (seed % 65536 + i) * root[k]
    printf "%.15f%s", x - int(x), k + 1 < dim ? " " : "\n"
  }
}'

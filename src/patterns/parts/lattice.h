/* SPDX-License-Identifier: Apache-2.0 */
/* Rank-1 lattices: x_k = {i z_k / n}, every value the double nearest to its fraction. */
#ifndef KOKSMA_PATTERNS_PARTS_LATTICE_H
#define KOKSMA_PATTERNS_PARTS_LATTICE_H

#include <koksma/koksma.h>

/* z[k] < n for each coordinate. */
koksma_status koksma__fill_lattice(const koksma_run *run, const uint64_t *z, koksma_points *out);

/* The worst-case error P_2 of the lattice: the mean over i of the product over k of 1 + 2 pi^2 B_2({i z_k / n}),
   B_2(x) = x^2 - x + 1/6, less 1. product (n doubles) holds the products of the coordinates so far. */
double koksma__lattice_error(size_t n, uint64_t z, const double *product);
void koksma__lattice_extend(size_t n, uint64_t z, double *product);

/* The c-th of the multipliers to try for n points: all units modulo n while n is small, evenly chosen ones above; 0
   past the end. */
uint64_t koksma__lattice_candidate(size_t n, size_t c);

#endif

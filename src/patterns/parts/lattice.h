/* SPDX-License-Identifier: Apache-2.0 */
/* Rank-1 lattices: x_k = {i z_k / n}, every value the double nearest to its fraction. */
#ifndef KOKSMA_PATTERNS_PARTS_LATTICE_H
#define KOKSMA_PATTERNS_PARTS_LATTICE_H

#include <koksma/koksma.h>

/* z[k] < n for each coordinate. */
koksma_status koksma__fill_lattice(const koksma_run *run, const uint64_t *z, koksma_points *out);

/* What the searches minimise is the mean over i of the product over k of 1 + gamma 2 pi^2 B_2({i z_k / n}), with
   B_2(x) = x^2 - x + 1/6 and gamma = 3/(8 pi^2): the worst-case error P_2 with one weight for all coordinates, and
   the square of l2-wraparound over (4/3)^dim, plus 1. The term of i = 0 is the same for all multipliers and grows as
   1.125^dim: it stays out, as digits of the others would be lost in it, and so does the half of i that repeats the
   other. product has n doubles, whose entries 1 .. n/2 hold the products of the coordinates so far; n > 1. */
void koksma__lattice_start(size_t n, double *product);

/* How much a coordinate with the multiplier z would add, in a unit that is the same for all z; and with the
   coordinate taken into product. */
double koksma__lattice_added(size_t n, uint64_t z, const double *product);
double koksma__lattice_extend(size_t n, uint64_t z, double *product);

/* The best z_1 beside z_0 = 1, whatever the weights are: in two dimensions they scale the sums of all candidates
   alike. scratch has n doubles. */
koksma_status koksma__lattice_second(size_t n, const koksma_run *run, double *scratch, uint64_t *best);

/* The c-th of the multipliers to try for n points: all units modulo n while n is small, evenly chosen ones above; 0
   past the end. Some come twice. tries is how many of them a search looks at. */
uint64_t koksma__lattice_candidate(size_t n, size_t c);
size_t koksma__lattice_tries(size_t n);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Rank-1 lattices, x_k = {i z_k / n}, and the search for their multipliers z_k. Every coordinate is the double nearest
   to its exact fraction. */
#ifndef KOKSMA_PATTERNS_SHARED_LATTICE_H
#define KOKSMA_PATTERNS_SHARED_LATTICE_H

#include "patterns/shared/unit_sums.h"

/* Fills `out` with the lattice of out->n points; z[k] < n for each coordinate. */
koksma_status koksma__fill_lattice(const koksma_run *run, const uint64_t *z, koksma_points *out);

/* Fills `out` with points args->first, args->first + 1, ... of the lattice of args->n points. */
koksma_status koksma__range_lattice(const koksma_args *args, const uint64_t *z, koksma_points *out);

/* The searches minimise the mean over i of the product over k of 1 + gamma 2 pi^2 B_2({i z_k / n}), with B_2(x) =
   x^2 - x + 1/6 and gamma = 3/(8 pi^2): 1 plus the worst-case error P_2 with equal weights for all coordinates, and
   1 plus the square of l2-wraparound divided by (4/3)^dim. The sums leave out the term of i = 0, which is equal for
   all multipliers: it grows as 1.125^dim, so that digits of the other terms would be lost. The sums also leave out i
   > n/2, because the terms of i and n - i are equal. */
enum { KOKSMA__LATTICE_FEW = 64 };

typedef struct koksma__lattice_search {
    size_t n;
    const koksma_run *run;
    koksma__unit_sums *sums; /* the sums of unit_sums.c; NULL until the search needs them */
    double *product;         /* n numbers: elements 1 .. n/2 are the products of the coordinates so far */
    double *values;          /* n/2 + 1 numbers: the amount that each multiplier would add to the sum, up to rounding
                             */
    /* used only for small n. few: the memory of `product` and `values`; kernel[i]: B_2(i / n) */
    double few[2 * KOKSMA__LATTICE_FEW], kernel[KOKSMA__LATTICE_FEW];
} koksma__lattice_search;

/* Prepares a search for n > 1 points. The search must be closed even if koksma__lattice_open failed. */
koksma_status koksma__lattice_open(koksma__lattice_search *search, size_t n, const koksma_run *run);
void koksma__lattice_close(koksma__lattice_search *search);

/* koksma__lattice_start restarts the search, with no coordinates yet. koksma__lattice_extend appends a coordinate with
   the multiplier z and returns the amount that this adds to the sum, in a unit that is the same for all z. */
void koksma__lattice_start(koksma__lattice_search *search);
double koksma__lattice_extend(koksma__lattice_search *search, uint64_t z);

/* Computes in search->values the amount that each z would add to the sum; the value is infinite if z has a divisor in
   common with n. Because of rounding, any z whose value is at most *window above the least may be the best. For few
   points all finite values are 0. */
koksma_status koksma__lattice_value(koksma__lattice_search *search, double *window);

/* Sets search->values to infinity for each z that has a divisor in common with n, else to 0. */
void koksma__lattice_units(koksma__lattice_search *search);

/* Returns the last candidate z. Candidates end at n/2, because n - z is the mirror image of z. For even n the
   smallest unit modulo n above n/2 is a candidate, too. This unit is the mirror image of a candidate below n/2, but
   its sum has different rounding errors, which decide for n = 12 and a few other n below 30. Without this candidate
   the points for these n would change. */
uint64_t koksma__lattice_last(size_t n);

/* Finds the best z_1 for z_0 = 1. This z_1 does not depend on the weights, because in two dimensions these scale the
   sums of all candidates by the same factor. */
koksma_status koksma__lattice_second(koksma__lattice_search *search, uint64_t *best);

/* Finds the multipliers z of `dim` coordinates for a lattice of n > 1 points. With an order above 0 only projections of
   up to `order` coordinates have a weight: the factor of the next coordinate is then the sum of the elementary
   symmetric polynomials of degree 0 to order - 1 of all earlier terms, that of degree l times factors[l]; factors[0] is
   1. The progress that is reported ends at `share`. */
koksma_status koksma__lattice_find(const koksma_run *run, size_t n, int dim, int order, const double *factors,
                                   double share, uint64_t *z);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Rank-1 lattices: x_k = {i z_k / n}, every value the double nearest to its fraction. */
#ifndef KOKSMA_PATTERNS_SHARED_LATTICE_H
#define KOKSMA_PATTERNS_SHARED_LATTICE_H

#include "patterns/shared/unit_sums.h"

/* z[k] < n for each coordinate. */
koksma_status koksma__fill_lattice(const koksma_run *run, const uint64_t *z, koksma_points *out);

/* The range that args wants of those of args->n points. */
koksma_status koksma__range_lattice(const koksma_args *args, const uint64_t *z, koksma_points *out);

/* What the searches minimise is the mean over i of the product over k of 1 + gamma 2 pi^2 B_2({i z_k / n}), with
   B_2(x) = x^2 - x + 1/6 and gamma = 3/(8 pi^2): the worst-case error P_2 with one weight for all coordinates, and
   the square of l2-wraparound over (4/3)^dim, plus 1. The term of i = 0 is the same for all multipliers and grows as
   1.125^dim: it stays out, as digits of the others would be lost in it, and so does the half of i that repeats the
   other. */
enum { KOKSMA__LATTICE_FEW = 64 };

typedef struct koksma__lattice_search {
    size_t n;
    const koksma_run *run;
    koksma__unit_sums *sums; /* NULL until they are needed */
    double *product;         /* n numbers, of which [1 .. n/2] hold the products of the coordinates so far */
    double *values;          /* n/2 + 1 numbers: what each multiplier would add, up to rounding */
    double few[2 * KOKSMA__LATTICE_FEW], kernel[KOKSMA__LATTICE_FEW]; /* instead of more memory; B_2(i / n) */
} koksma__lattice_search;

/* n > 1. To be closed when it failed, too. */
koksma_status koksma__lattice_open(koksma__lattice_search *search, size_t n, const koksma_run *run);
void koksma__lattice_close(koksma__lattice_search *search);

/* No coordinates yet; and one more, which adds the result, in a unit that is the same for all z. */
void koksma__lattice_start(koksma__lattice_search *search);
double koksma__lattice_extend(koksma__lattice_search *search, uint64_t z);

/* The same with weights of projections of up to `order` coordinates alone: what a further coordinate multiplies is the
   sum of the elementary symmetric polynomials of degree 0 to order - 1 of the terms so far. sums: (n/2 + 1) order numbers,
   at i * order those of i, at first 1 in degree 0 (koksma__lattice_start's number) and 0. */
void koksma__lattice_extend_orders(koksma__lattice_search *search, uint64_t z, int order, double *sums);

/* What each z would add, in search->values: infinity at those that have a divisor in common with n. *window: those
   up to so much above the least may be the least. For few points, all are 0; units says only which have a divisor. */
koksma_status koksma__lattice_value(koksma__lattice_search *search, double *window);

void koksma__lattice_units(koksma__lattice_search *search);

/* Candidates z end at n/2, because n - z is the mirror image of z. For even n the smallest unit above n/2 is a
   candidate too: it mirrors one below, but rounding gives its sum other last bits, which decide for n = 12 and a few
   others below 30. Leaving it out would change their points. */
uint64_t koksma__lattice_last(size_t n);

/* The z that adds least: among those that the values leave open, by their sums in order of i, and the smallest if
   these are equal. */
koksma_status koksma__lattice_best(koksma__lattice_search *search, uint64_t *best);

/* The best z_1 beside z_0 = 1, whatever the weights are: in two dimensions they scale the sums of all candidates
   alike. */
koksma_status koksma__lattice_second(koksma__lattice_search *search, uint64_t *best);

#endif

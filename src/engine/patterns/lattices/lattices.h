/* SPDX-License-Identifier: Apache-2.0 */
/* Rank-1 lattices and the search for their multipliers. Each section is the interface of the file of its name. */
#ifndef KOKSMA_PATTERNS_LATTICES_LATTICES_H
#define KOKSMA_PATTERNS_LATTICES_LATTICES_H

#include <koksma/koksma.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- Unit group ------------------------------------------------------------------------------------------ */

/* The group of the units modulo m, with u and -u identified, as a product of cyclic groups. */

enum { KOKSMA__MAX_PRIMES = 10 }; /* numbers below 2^32 have at most 9 different prime factors */

typedef struct koksma__unit_axis {
    size_t length;
    uint64_t generator;
    bool turns; /* true: generator^(order / 2) is -1 modulo its prime power */
} koksma__unit_axis;

/* Finds generators g_k such that each unit u modulo m, or its negative -u, has one representation as a product of
   powers g_k^(x_k), 0 <= x_k < length_k. The first axis is the longest. *cut receives whether the length of the first
   axis is half its order; g_0^length_0 is then, up to the sign, the product of g_k^(order_k / 2) over the other axes
   that have `turns` set. Returns the number of axes. 2 < m < 2^32. */
int koksma__unit_axes(uint64_t m, koksma__unit_axis axes[KOKSMA__MAX_PRIMES], bool *cut);

/* Lists the primes that divide n in ascending order; returns how many there are. 0 < n < 2^32. */
int koksma__primes_of(uint64_t n, uint64_t primes[KOKSMA__MAX_PRIMES]);

/* ---- Unit sums ------------------------------------------------------------------------------------------- */

/* Computes for all multipliers at once how much another coordinate would add to the worst-case error of a lattice. */

typedef struct koksma__unit_sums koksma__unit_sums;

/* Prepares the sums for n > 2 points. The sums need 16 n bytes if n is a power of two, and up to 82 n bytes for other
   n (the most if n is a prime just above a power of two). The sums must be closed even if opening failed. */
koksma_status koksma__unit_sums_open(size_t n, const koksma_run *run, koksma__unit_sums **sums);
void koksma__unit_sums_close(koksma__unit_sums *sums);

/* Computes values[z], z <= n/2 (n/2 + 1 entries): the sum over 1 <= i <= n/2 of product[i] B_2({i z / n}), up to a
   constant that is equal for all z; infinity if z has a divisor in common with n. *error becomes the assumed bound
   on the rounding error. Time: O(n log n). Errors: INTERRUPTED. */
koksma_status koksma__unit_sums_find(koksma__unit_sums *sums, const koksma_run *run, const double *product,
                                     double *values, double *error);

/* ---- Lattice plane --------------------------------------------------------------------------------------- */

/* Finds the best z_1 for z_0 = 1 and n > 1 points, n < 2^32. This z_1 does not depend on the weights, because in two
   dimensions these scale the sums of all candidates by the same factor. Time: some n ln ln n. Errors: INTERRUPTED,
   MEMORY. */
koksma_status koksma__lattice_second(const koksma_run *run, size_t n, uint64_t *best);

/* Returns the last candidate z. Candidates end at n/2, because n - z is the mirror image of z. For even n the
   smallest unit modulo n above n/2 is a candidate, too. This unit is the mirror image of a candidate below n/2, but
   its sum has different rounding errors, which decide for n = 12 and a few other n below 30. Without this candidate
   the points for these n would change. */
uint64_t koksma__lattice_last(size_t n);

/* ---- Lattice --------------------------------------------------------------------------------------------- */

/* Rank-1 lattices, x_k = {i z_k / n}, and the search for their multipliers z_k. Every coordinate is the double nearest
   to its exact fraction. */

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

/* Finds the multipliers z of `dim` coordinates for a lattice of n > 1 points. With an order above 0 only projections of
   up to `order` coordinates have a weight: the factor of the next coordinate is then the sum of the elementary
   symmetric polynomials of degree 0 to order - 1 of all earlier terms, that of degree l times factors[l]; factors[0] is
   1. The progress that is reported ends at `share`. */
koksma_status koksma__lattice_find(const koksma_run *run, size_t n, int dim, int order, const double *factors,
                                   double share, uint64_t *z);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Algorithms of the L2 family: pairs, sorting, divide and conquer, gradients, values below the range of a double. */
#ifndef KOKSMA_MEASURES_L2_L2_H
#define KOKSMA_MEASURES_L2_L2_H

#include <koksma/koksma.h>

#include "core/double_double.h"
#include "core/sum.h"

/* ---- l2_pairs.c -------------------------------------------------------------------------------------------- */

/*
 * The L2 discrepancies. The square of each is
 *
 *     c^d - (2/n) sum_i prod_k a(x_ik) + (1/n^2) sum_ij prod_k K(x_ik, x_jk),
 *     a(u) = int_0^1 K(u, v) dv,  c = int_0^1 a(u) du,
 *
 * the squared norm of (points - volume) under the kernel K. With z = u - 1/2 every K of the family is
 *
 *     K(u, v) = g(z_u) + g(z_v) + q |u - v| + r (u - v)^2,
 *
 * with g and a polynomials in z, z^2 and |z|, so that a few coefficients describe each measure: measures/l2_boxes.c
 * has one row of coefficients for each.
 */
typedef struct koksma__l2_row {
    double c12;    /* 12 c */
    double a24[4]; /* 24 a(u) = a24[0] + a24[1] z + a24[2] z^2 + a24[3] |z| */
    double g[4];   /* g(z) = g[0] + g[1] z + g[2] z^2 + g[3] |z| */
    double q, r;
    const char *name; /* for error messages */
} koksma__l2_row;

/* f[0] + f[1] z + f[2] z^2 + f[3] |z|, z = u - 1/2. */
double koksma__l2_polynomial(const double f[4], double u);

/* Writes the square by a sum over all pairs, in O(n^2 d). Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__l2_by_pairs(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                  double *square);

/* Returns c^d - 2 linear / n + over_pairs / n^2. */
double koksma__l2_combine(const koksma__l2_row *row, int dim, size_t n, koksma__dd linear,
                          const koksma__sum *over_pairs);

/* ---- l2_gradient.c ----------------------------------------------------------------------------------------- */

/* Computes the square of an L2 discrepancy by sums over pairs, and its derivatives by all coordinates, in O(n^2 d).
   Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__l2_gradient(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                  double *square, double *gradient);

/* ---- l2_range.c -------------------------------------------------------------------------------------------- */

/* Computes the value by sums over pairs. The value is correct even if terms of the square, or the square itself (then
   NaN), are beyond the range of doubles. The error DIM means that the value, or a product over the first coordinates
   of a point, is beyond this range. */
koksma_status koksma__l2_value_by_pairs(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                        koksma_value *out);

/* Writes the value and its square to out, in O(n log n) for d <= 2 unless n is small, in O(n log^(d-1) n) for d = 3
   and 4 and large n, else in O(n^2 d). Errors: DIM, MEMORY, INTERRUPTED. */
koksma_status koksma__l2(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                         koksma_value *out);

/* ---- l2_sort.c --------------------------------------------------------------------------------------------- */

/* Writes the square in O(n log n), for one or two dimensions and n < 2^28, if r and all coefficients of a24 and g
   except the first are multiples of 1/16; where the compiler has no 128-bit integers it sums over pairs instead.
   Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__l2_by_sorting(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                    double *square);

/* ---- l2_divide.c ------------------------------------------------------------------------------------------- */

/* L2 discrepancies by divide and conquer. */
enum { KOKSMA__L2_DIVIDE_DIM = 4 };

/* Returns the number of products, 1 to 3, into which the kernel K(a, b) separates for a <= b. */
int koksma__l2_ranks(const koksma__l2_row *row);

/* Writes the square in O(n log^(d-1) n), for d = 3 to KOKSMA__L2_DIVIDE_DIM dimensions. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__l2_by_dividing(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                     double *square);

/* ---- l2_below.c -------------------------------------------------------------------------------------------- */

/* A point of the plane whose coordinates are multiples of a small unit: whole numbers of up to 2^52 in absolute
   value. */
typedef struct koksma__l2_point {
    int64_t x, y;
    uint32_t at; /* rank in x order */
} koksma__l2_point;

/* Returns sum_i x_i sum_j (y_i - y_j), where j runs over the points before point i both in x order and in y order.
   The n < 2^28 points must be in y order; `points` and `spare`, which has capacity for n points, are overwritten.
   Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__l2_sum_below(const koksma_run *run, size_t n, koksma__l2_point *points, koksma__l2_point *spare,
                                   koksma__dd *sum);

#endif

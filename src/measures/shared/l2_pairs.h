/* SPDX-License-Identifier: Apache-2.0 */
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
#ifndef KOKSMA_MEASURES_SHARED_L2_PAIRS_H
#define KOKSMA_MEASURES_SHARED_L2_PAIRS_H

#include <koksma/koksma.h>

#include "core/sum.h"
#include "measures/shared/double_double.h"

typedef struct koksma__l2_row {
    double c12;    /* 12 c */
    double a24[4]; /* 24 a(u) = a24[0] + a24[1] z + a24[2] z^2 + a24[3] |z| */
    double g[4];   /* g(z) = g[0] + g[1] z + g[2] z^2 + g[3] |z| */
    double q, r;
    const char *name; /* for error messages */
} koksma__l2_row;

/* f[0] + f[1] z + f[2] z^2 + f[3] |z|, z = u - 1/2. */
double koksma__l2_polynomial(const double f[4], double u);
koksma__dd koksma__l2_polynomial_dd(const double f[4], double z); /* this polynomial at z, in 106 bits */

/* prod_k a(x_k) in 106 bits. */
koksma__dd koksma__l2_linear(const koksma__l2_row *row, const double *x, int dim);

/* Writes the square by a sum over all pairs, in O(n^2 d). Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__l2_by_pairs(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                  double *square);

/* Returns c^d - 2 linear / n + over_pairs / n^2. */
double koksma__l2_combine(const koksma__l2_row *row, int dim, size_t n, koksma__dd linear,
                          const koksma__sum *over_pairs);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-star: the root mean square, over all boxes [0,y) with a corner at the origin, of the difference between the
 * share of points in the box and its volume. The first paper's S, the second's T with L2.
 *
 * Formula: S^2 = 3^-d - (2/n) sum_i prod_k (1 - x_ik^2)/2 + (1/n^2) sum_ij prod_k (1 - max(x_ik, x_jk)).
 * Source: Warnock 1972; Shirley 1991, section 5.5.7; Mitchell 1992, section 2.
 * Known exactly: one point at the centre of the square, S^2 = 23/288; random points, E(S^2) = (2^-d - 3^-d)/n;
 * m x m jittered, E(S^2) = ((m-1)/6 + 5/36)/m^4; 4 x 4 centres, S^2 = 1/9 - 2 (43/128)^2 + (11/32)^2.
 * Limits: the three terms are near 3^-d and cancel; with compensated sums S^2 is good to about 1e-16, so that S
 * keeps 9 digits at 10^6 low-discrepancy points.
 */
#include <math.h>

#include "kernels/kernels.h"
#include "measures/measures.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    (void)args;
    out->square = fmax(koksma__kernels()->l2_star(points->n, points->dim, points->xs), 0);
    out->value = sqrt(out->square);
    return KOKSMA_OK;
}

const koksma_measure koksma__measure_l2_star = {
    .name = "l2-star",
    .title = "L2 star discrepancy (root mean square over anchored boxes)",
    .cite = "warnock1972 zaremba1968 shirley1991 mitchell1992",
    .cost = "n^2 d",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .eval = eval,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-extreme: the root of the integral, over all boxes [lo, hi) with lo < hi in every coordinate, of the squared
 * difference between the share of points in the box and its volume. Times 2^(d/2) it is the root mean square.
 *
 * Formula: 12^-d - (2/n) sum_i prod_k x(1-x)/2 + (1/n^2) sum_ij prod_k (1 - max) min, with x, max and min of
 * coordinate k. Source: Morokoff and Caflisch 1994, whose T_N it is.
 * Known exactly: one point at the centre of the square, square = 11/288; random points, E = (6^-d - 12^-d)/n.
 * Limits: the three terms cancel. In one and two dimensions the sums are exact or of 106 bits, and the value is good
 * to 1e-11 of itself at 10^6 points; in more the square is good to about 1e-16 of its terms.
 */
#include "measures/measures.h"
#include "measures/shared/l2.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    return koksma__l2(KOKSMA__L2_EXTREME, points, args->run, out);
}

const koksma_measure koksma__measure_l2_extreme = {
    .name = "l2-extreme",
    .title = "L2 discrepancy over all boxes lo < hi, not divided by their measure",
    .cite = "morokoff1994 hickernell1998",
    .cost = "n log n in 2D, n log^(d-1) n in 3D, 4D, n^2 d",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .eval = eval,
};

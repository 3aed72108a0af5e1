/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-symmetric: l2-star with every corner of the cube as the anchor: the square is 4^d times the mean, over the 2^d
 * corners, of the square of l2-star.
 *
 * Formula: (4/3)^d - (2/n) sum_i prod_k (1 + 2x - 2x^2) + (1/n^2) sum_ij prod_k 2 (1 - t), t = |x_ik - x_jk|.
 * Source: Hickernell 1998. Known exactly: one point at the centre of the square, square = 23/18.
 * Limits: the three terms cancel. In one and two dimensions the sums are exact or of 106 bits, and the value is good
 * to 1e-11 of itself at 10^6 points; in more the square is good to about 1e-16 of its terms.
 */
#include "measures/measures.h"
#include "measures/shared/l2.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    return koksma__l2(KOKSMA__L2_SYMMETRIC, points, args->run, out);
}

const koksma_measure koksma__measure_l2_symmetric = {
    .name = "l2-symmetric",
    .title = "symmetric L2 discrepancy (mean over all corners as anchors)",
    .cite = "hickernell1998",
    .cost = "n log n in 2D, n log^(d-1) n in 3D, 4D, n^2 d",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .eval = eval,
};

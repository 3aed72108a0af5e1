/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-star: the root mean square, over all boxes [0,y) with a corner at the origin, of the difference between the
 * share of points in the box and its volume. The first paper's S, the second's T with L2.
 *
 * Formula: S^2 = 3^-d - (2/n) sum_i prod_k (1 - x_ik^2)/2 + (1/n^2) sum_ij prod_k (1 - max(x_ik, x_jk)).
 * Source: Warnock 1972; Shirley 1991, section 5.5.7; Mitchell 1992, section 2; in O(n log n) after Heinrich 1996.
 * Known exactly: one point at the centre of the square, S^2 = 23/288; random points, E(S^2) = (2^-d - 3^-d)/n;
 * m x m jittered, E(S^2) = ((m-1)/6 + 5/36)/m^4; 4 x 4 centres, S^2 = 1/9 - 2 (43/128)^2 + (11/32)^2.
 * Limits: the three terms cancel. In one and two dimensions the sums are exact or of 106 bits, and the value is good
 * to 1e-11 of itself at 10^6 points; in more the square is good to about 1e-17 of its terms.
 */
#include "measures/measures.h"
#include "measures/shared/l2.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    return koksma__l2(KOKSMA__L2_STAR, points, args->run, out);
}

const koksma_measure koksma__measure_l2_star = {
    .name = "l2-star",
    .title = "L2 star discrepancy (root mean square over anchored boxes)",
    .cite = "warnock1972 zaremba1968 heinrich1996 shirley1991 mitchell1992",
    .cost = "n log n in 2D, n log^(d-1) n in 3D, 4D, n^2 d",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .eval = eval,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-mixture: between l2-centered and l2-wraparound: boxes that grow from the corner next to a point and boxes that
 * wrap around, in equal parts.
 *
 * Formula: (19/12)^d - (2/n) sum_i prod_k (5/3 - h/4 - h^2/4)
 *          + (1/n^2) sum_ij prod_k (15/8 - (h_i + h_j)/4 - 3t/4 + t^2/2), h = |x_ik - 1/2|, t = |x_ik - x_jk|.
 * Source: Zhou, Fang and Ning 2013. SciPy's method='MD' is the square.
 * Known exactly: one point at the centre of the line, square = 19/12 - 10/3 + 15/8 = 1/8.
 * Limits: the three terms cancel. In one and two dimensions the sums are exact or of 106 bits, and the value is good
 * to 1e-11 of itself at 10^6 points; in more the square is good to about 1e-16 of its terms.
 */
#include "measures/measures.h"
#include "measures/shared/l2.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    return koksma__l2(KOKSMA__L2_MIXTURE, points, args->run, out);
}

const koksma_measure koksma__measure_l2_mixture = {
    .name = "l2-mixture",
    .title = "mixture L2 discrepancy",
    .cite = "zhou2013",
    .cost = "n log n in 2D, n log^(d-1) n in 3D, 4D, n^2 d",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .eval = eval,
};

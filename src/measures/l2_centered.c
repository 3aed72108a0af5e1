/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-centered: as l2-modified, with boxes between a point and the corner of the cube next to it: reflecting the
 * points about any plane x_k = 1/2 does not change it.
 *
 * Formula: (13/12)^d - (2/n) sum_i prod_k (1 + h/2 - h^2/2) + (1/n^2) sum_ij prod_k (1 + (h_i + h_j - t)/2), with
 * h = |x_ik - 1/2|, t = |x_ik - x_jk|. Source: Hickernell 1998. SciPy's method='CD' is the square.
 * Known exactly: one point at the centre of the square, square = 25/144.
 * Limits: the three terms cancel. In one and two dimensions the sums are exact or of 106 bits, and the value is good
 * to 1e-11 of itself at 10^6 points; in more the square is good to about 1e-16 of its terms.
 */
#include "measures/measures.h"
#include "measures/shared/l2.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    return koksma__l2(KOKSMA__L2_CENTERED, points, args->run, out);
}

const koksma_measure koksma__measure_l2_centered = {
    .name = "l2-centered",
    .title = "centered L2 discrepancy",
    .cite = "hickernell1998",
    .cost = "n log n in 2D, n log^(d-1) n in 3D, 4D, n^2 d",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .eval = eval,
};

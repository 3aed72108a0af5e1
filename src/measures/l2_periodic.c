/* SPDX-License-Identifier: Apache-2.0 */
/*
 * l2-periodic: the root mean square, over boxes on the torus whose starts and lengths are uniform, of the difference
 * between the share of points in the box and its volume. Shifting all points on the torus does not change it.
 *
 * Formula: -(3^-d) + (1/n^2) sum_ij prod_k (1/2 - t + t^2), t = |x_ik - x_jk|.
 * Source: Lev 1995; Hinrichs, Kritzinger and Pillichshammer 2020, who call it periodic.
 * Known exactly: one point in the square, square = 1/4 - 1/9 = 5/36; random points, E = (2^-d - 3^-d)/n.
 * Limits: the three terms cancel. In one and two dimensions the sums are exact or of 106 bits, and the value is good
 * to 1e-11 of itself at 10^6 points; in more the square is good to about 1e-16 of its terms.
 */
#include "measures/measures.h"
#include "measures/shared/l2.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    return koksma__l2(KOKSMA__L2_PERIODIC, points, args->run, out);
}

const koksma_measure koksma__measure_l2_periodic = {
    .name = "l2-periodic",
    .title = "L2 discrepancy over boxes on the torus (root mean square)",
    .cite = "lev1995 hinrichs2020",
    .cost = "n log n in 2D, n log^(d-1) n in 3D, 4D, n^2 d",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .eval = eval,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * extreme: the largest difference, over all axis-parallel boxes, between the share of points in the box and its
 * volume. The first paper's T ("Stroud's discrepancy"), which turning the points by 90 degrees does not change.
 *
 * Formula: T = sup over boxes of |#{x_i in box}/n - volume|. An excess is reached at a closed box whose sides are
 * at coordinates of points, a deficit at an open box whose sides are at coordinates of points, 0 or 1. Points at
 * exactly 0 are outside an open box that starts at 0.
 * Source: Stroud 1971; Shirley 1991, section 5.5.7. With grid=20 it is the procedure behind his table 5.7: sides at
 * multiples of 1/20 only, half-open boxes. Inferred from his value for the regular grid, 0.3600 where the supremum
 * is 0.4375.
 * Known exactly: 4 x 4 cell centres T = 7/16, with grid=20 0.36; a single point T = 1; Hammersley 1024 0.006079674.
 * Limits: counts are exact, volumes are rounded products: errors of a few 1e-16. A time limit leaves bounds; in 3D
 * the upper one is 1.
 */
#include "measures/shared/extreme.h"
#include "core/status.h"
#include "measures/measures.h"
#include "measures/shared/extreme_grid.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    if (args->params[0] > 0) {
        return koksma__extreme_grid(points, (int)args->params[0], args->run, out);
    }
    return (points->dim == 2 ? koksma__extreme_plane : koksma__extreme_small)(points, args->run, out);
}

static const koksma_param params[] = {
    {"grid", "sides at multiples of 1/grid only, half-open boxes (2D); 0: everywhere, exactly", 0, 0, 4096, NULL,
     true},
    {0},
};

const koksma_measure koksma__measure_extreme = {
    .name = "extreme",
    .title = "Stroud's discrepancy (all axis-parallel boxes)",
    .cite = "stroud1971 shirley1991",
    .cost = "n^2 log^2 n at worst in 2D, n^5 in 3D",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = 3,
    .params = params,
    .eval = eval,
};

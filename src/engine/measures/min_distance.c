/* SPDX-License-Identifier: Apache-2.0 */
/*
 * min-distance: the smallest distance between two points. In contrast to the discrepancies, a larger value means more
 * even points.
 *
 * Formula: min over i < j of |x_i - x_j|, on the unit torus or (torus=0) in space.
 * Source: Lagae and Dutre 2008, who compare Poisson disk patterns by it; see relative-radius.
 * Known exactly: the points (0,0) and (1/2,1/2) have 1/sqrt 2; the centres of a grid of m^dim cells have 1/m.
 * Limits: for a single point the measure fails with KOKSMA_N. The value is exact to rounding.
 */

#include "measures/distances/distances.h"
#include "measures/measures.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    return koksma__min_distance("min-distance", points, args->params[0] > 0, args->run, &out->value);
}

static const koksma_param params[] = {
    {"torus", "1: on the unit torus, 0: in the unit cube", 1, 0, 1, NULL, true},
    {0},
};

const koksma_measure koksma__measure_min_distance = {
    .name = "min-distance",
    .title = "smallest distance between two points (larger values are better)",
    .cite = "lagae2008",
    .cost = "n, or n log n for clustered points; from 3D on between n log n and n^2",
    .min_dim = 2,
    .max_dim = 16,
    .params = params,
    .eval = eval,
    .larger_is_better = true,
};

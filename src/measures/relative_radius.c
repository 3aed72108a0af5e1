/* SPDX-License-Identifier: Apache-2.0 */
/*
 * relative-radius: the smallest distance between two points, divided by the smallest distance in the densest packing
 * of n points. A larger value means more even points; good Poisson disk patterns have 0.65 to 0.85, the hexagonal
 * lattice has 1.
 *
 * Formula: min-distance / sqrt(2/(sqrt(3) n)), on the unit torus or (torus=0) in the plane.
 * Source: Lagae and Dutre 2008.
 * Known exactly: m x m centres sqrt(sqrt(3)/2) = 0.9306.
 * Limits: as for min-distance.
 */
#include <math.h>

#include "measures/measures.h"
#include "measures/shared/neighbours.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const koksma_status status =
        koksma__min_distance("relative-radius", points, args->params[0] > 0, args->run, &out->value);
    out->value /= sqrt(2 / (sqrt(3) * (double)points->n));
    return status;
}

static const koksma_param params[] = {
    {"torus", "1: on the unit torus, 0: in the plane", 1, 0, 1, NULL, true},
    {0},
};

const koksma_measure koksma__measure_relative_radius = {
    .name = "relative-radius",
    .title = "smallest distance over that of the densest packing (larger is better)",
    .cite = "lagae2008",
    .cost = "n, or n log n for clustered points",
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
    .larger_is_better = true,
};

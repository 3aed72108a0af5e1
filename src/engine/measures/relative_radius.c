/* SPDX-License-Identifier: Apache-2.0 */
/*
 * relative-radius: the smallest distance between two points, divided by the smallest distance in the densest packing
 * of n points. A larger value means more even points; good Poisson disk patterns in the plane have 0.65 to 0.85, the
 * densest lattice has 1.
 *
 * Formula: min-distance / (2 (c/n)^(1/dim)), on the unit torus or (torus=0) in space. c is the centre density of the
 * densest packing: the number of points in a unit volume when balls of radius 1 about them do not overlap.
 *
 *     dim  2             3            4    5            6            7     8
 *     c    1/(2 sqrt 3)  1/(4 sqrt 2) 1/8  1/(8 sqrt 2) 1/(8 sqrt 3) 1/16  1/16
 *
 * The packings of this table are the hexagonal lattice, D3 (face-centred cubic), D4, D5, E6, E7 and E8. These
 * packings are the densest in 2, 3 and 8 dimensions (Fejes Toth 1940, Hales 2005, Viazovska 2017). In 4 to 7
 * dimensions they are the densest lattice packings, and no denser packing is known. The measure does not exist in
 * other dimensions.
 * Source: Lagae and Dutre 2008, for the plane; the values of c are from Conway and Sloane 1999.
 * Known exactly: m x m cell centres have sqrt(sqrt(3)/2) = 0.9306; for dim >= 3 the points of the lattices above have
 * 1.
 * Limits: as for min-distance. With torus=0 a small set can have a value above 1, because there are no points beyond
 * the sides of the cube.
 */
#include <math.h>

#include "core/elementary.h"
#include "measures/distances/distances.h"
#include "measures/measures.h"

static double centre_density(int dim)
{
    const double densities[] = {1 / sqrt(32), 1.0 / 8, 1 / sqrt(128), 1 / sqrt(192), 1.0 / 16, 1.0 / 16};
    return densities[dim - 3];
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const koksma_status status =
        koksma__min_distance("relative-radius", points, args->params[0] > 0, args->run, &out->value);
    const double n = (double)points->n;
    out->value /= points->dim == 2 ? sqrt(2 / (sqrt(3) * n))
                                   : 2 * koksma__pow(centre_density(points->dim) / n, 1.0 / points->dim);
    return status;
}

static const koksma_param params[] = {
    {"torus", "1: on the unit torus, 0: in the unit cube", 1, 0, 1, NULL, true},
    {0},
};

const koksma_measure koksma__measure_relative_radius = {
    .name = "relative-radius",
    .title = "smallest distance divided by that of the densest packing (larger values are better)",
    .cite = "lagae2008 conway1999",
    .revision = 1, /* own elementary functions */
    .cost = "n, or n log n for clustered points; from 3D on between n log n and n^2",
    .min_dim = 2,
    .max_dim = 8,
    .params = params,
    .eval = eval,
    .larger_is_better = true,
};

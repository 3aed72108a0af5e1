/* SPDX-License-Identifier: Apache-2.0 */
/*
 * edge-in-disk: the points are mapped to the unit disk; the largest difference, over half-planes, between the share
 * of points in one and its share of the disk's area.
 *
 * Formula: sup over half-planes H of |#{x_i in H}/n - |H and D|/pi|; a line at distance s from the centre cuts off
 * (acos(s) - s sqrt(1 - s^2))/pi. Critical lines: through two points; through one, perpendicular to its radius
 * (measures/parts/half_planes.h). Source: Dobkin, Eppstein & Mitchell 1996 for the square; Shirley & Chiu 1997 for
 * the map. Known exactly: one point at radius a, 1 - (acos(a) - a sqrt(1 - a^2))/pi. Limits: mapped coordinates are
 * rounded, and a point within 4e-15 of a line is taken as on it: values to 1e-14.
 */
#include <math.h>

#include "measures/measures.h"
#include "measures/parts/half_planes.h"

static double share(const double *p, const double *u)
{
    const double s = fmax(fmin(u[0] * p[1] - u[1] * p[0], 1), -1); /* the line's distance to the left of the centre */
    return (acos(s) - s * sqrt((1 - s) * (1 + s))) / M_PI;
}

static int chords(const double *p, double directions[KOKSMA__MAX_CHORDS][2])
{
    const double radius = hypot(p[0], p[1]);
    if (radius < 1e-300) {
        directions[0][0] = 1;
        directions[0][1] = 0;
        return 1; /* all chords are bisected, and halve the disk */
    }
    directions[0][0] = -p[1] / radius;
    directions[0][1] = p[0] / radius;
    return 1;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    static const koksma__convex disk = {share, chords};
    koksma__warped w;
    koksma_status status = koksma__warped_init(&w, points, koksma__warps_to_disk, args->params[0]);
    if (!status) {
        status = koksma__half_planes(&w, &disk, args->run, out);
    }
    koksma__warped_fini(&w);
    return status;
}

static const koksma_param params[] = {KOKSMA__WARP_PARAM(koksma__warps_to_disk, 1), {0}};

const koksma_measure koksma__measure_edge_in_disk = {
    .name = "edge-in-disk",
    .title = "half-planes on the points mapped to the unit disk",
    .cite = "dobkin1996 shirley1997",
    .cost = "n^2 log n",
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * edge-in-triangle: the points are mapped to a triangle; the largest difference, over half-planes, between the share
 * of points in one and its share of the triangle's area. Affine maps change neither, so the triangle's shape is idle.
 *
 * Formula: sup over half-planes H of |#{x_i in H}/n - |H and T|/|T||. Critical lines: through two points, and the up
 * to three chords that a point bisects; in coordinates u, v along the sides from a corner, the chord from (2u, 0) to
 * (0, 2v) cuts off 4uv (measures/parts/half_planes.h). Source: Dobkin, Eppstein & Mitchell 1996 for the square.
 * Known exactly: one point at a corner 1; at the centroid 5/9.
 * Limits: as edge-in-disk.
 */
#include <math.h>

#include "measures/measures.h"
#include "measures/parts/half_planes.h"

static const double corners[3][2] = {{0, 0}, {1, 0}, {0, 1}};

static double share(const double *p, const double *u)
{
    double side[3];
    int left = 0;
    for (int k = 0; k < 3; k++) {
        side[k] = u[0] * (corners[k][1] - p[1]) - u[1] * (corners[k][0] - p[0]);
        left += side[k] > 0;
    }
    if (left == 0 || left == 3) {
        return left == 3;
    }
    for (int k = 0; k < 3; k++) {
        if ((side[k] > 0) == (left == 1)) { /* the corner that is alone on its side */
            const double a = side[k], b = side[(k + 1) % 3], c = side[(k + 2) % 3];
            const double cut = (a / (a - b)) * (a / (a - c));
            return left == 1 ? cut : 1 - cut;
        }
    }
    return 0;
}

static int chords(const double *p, double directions[KOKSMA__MAX_CHORDS][2])
{
    const double weights[3] = {1 - p[0] - p[1], p[0], p[1]};
    int count = 0;
    for (int k = 0; k < 3; k++) {
        const double u = fmax(weights[(k + 1) % 3], 0), v = fmax(weights[(k + 2) % 3], 0);
        if (2 * u > 1 || 2 * v > 1) {
            continue;
        }
        const double *a = corners[k], *b = corners[(k + 1) % 3], *c = corners[(k + 2) % 3];
        const double s = u + v > 0 ? u : 1, t = u + v > 0 ? v : 1; /* at the corner: parallel to the side beyond */
        const double x = t * (c[0] - a[0]) - s * (b[0] - a[0]), y = t * (c[1] - a[1]) - s * (b[1] - a[1]);
        const double length = hypot(x, y);
        directions[count][0] = x / length;
        directions[count++][1] = y / length;
    }
    return count;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    static const koksma__convex triangle = {share, chords};
    koksma__warped w;
    koksma_status status = koksma__warped_init(&w, points, koksma__warps_to_triangle, args->params[0]);
    if (!status) {
        status = koksma__half_planes(&w, &triangle, args->run, out);
    }
    koksma__warped_fini(&w);
    return status;
}

static const koksma_param params[] = {KOKSMA__WARP_PARAM(koksma__warps_to_triangle, 1), {0}};

const koksma_measure koksma__measure_edge_in_triangle = {
    .name = "edge-in-triangle",
    .title = "half-planes on the points mapped to a triangle",
    .cite = "dobkin1996 turk1990",
    .cost = "n^2 log n",
    .min_dim = 2,
    .max_dim = 2,
    .params = params,
    .eval = eval,
};

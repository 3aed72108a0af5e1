/* SPDX-License-Identifier: Apache-2.0 */
/* maximal: 2D: no place of the torus is further from all points than their smallest distance: no point can be
   added. */
#include "claims/claims.h"

/* The largest hole of the torus is at a corner of the Voronoi diagram; a fine grid of places, each allowed half of
   the grid's diagonal, finds any hole that is worth the name. */
void claim_MAXIMAL(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    enum { GRID = 150 };
    if (points->n < 16) {
        return;
    }
    const double d = smallest_distance(points, true);
    for (int a = 0; a < GRID * GRID; a++) {
        const double x = (a / GRID + 0.5) / GRID, y = (a % GRID + 0.5) / GRID;
        double best = INFINITY;
        for (size_t i = 0; i < points->n && best > d * d; i++) {
            const double u = gap(points->xs[2 * i], x, true), v = gap(points->xs[2 * i + 1], y, true);
            best = fmin(best, u * u + v * v);
        }
        if (best > d * d * (1 + 1e-9)) {
            fail_claim(spec, points, "there is room at (%g, %g)", x, y);
        }
    }
}

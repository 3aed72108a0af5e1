/* SPDX-License-Identifier: Apache-2.0 */
/* maximal: no place of the torus is further from all points than their smallest distance: no point can be added. */
#include "claims/claims.h"

/* The largest hole of the torus is at a corner of the Voronoi diagram; a fine grid of places finds any hole that is
   worth the name: 150^2 places in the plane, 28^3, 12^4, .. in more dimensions. */
void claim_MAXIMAL(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    static const int sides[] = {0, 0, 150, 28, 12, 7, 5};
    const int dim = points->dim, side = sides[dim];
    if (points->n < 16) {
        return;
    }
    const double d = smallest_distance(points, true);
    for (int a = 0; a < (int)pow(side, dim); a++) {
        double place[6], best = INFINITY;
        for (int k = 0, rest = a; k < dim; k++, rest /= side) {
            place[k] = (rest % side + 0.5) / side;
        }
        for (size_t i = 0; i < points->n && best > d * d; i++) {
            double square = 0;
            for (int k = 0; k < dim; k++) {
                const double t = gap(points->xs[i * (size_t)dim + (size_t)k], place[k], true);
                square += t * t;
            }
            best = fmin(best, square);
        }
        if (best > d * d * (1 + 1e-9)) {
            fail_claim(spec, points, "there is room at (%g, %g, ..)", place[0], place[1]);
        }
    }
}

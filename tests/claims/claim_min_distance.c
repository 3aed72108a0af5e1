/* SPDX-License-Identifier: Apache-2.0 */
/* min-distance: no two points are closer than the parameter d (on the torus if torus=1). */
#include "claims/claims.h"

void claim_MIN_DISTANCE(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const double d = param_of(spec, "d", 0);
    if (points->n > 1 && smallest_distance(points, param_of(spec, "torus", 1) != 0) < d * (1 - 1e-12)) {
        fail_claim(spec, points, "two points are closer than %g", d);
    }
}

/* SPDX-License-Identifier: Apache-2.0 */
/* blue: in 2D, with at least 4 points (a sequence: 64), the smallest distance on the torus is more than half of
   that in the densest packing. */
#include "claims/claims.h"

void claim_BLUE(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t least = spec->pattern->claims & KOKSMA_CLAIM_SEQUENCE ? 64 : 4;
    const double rho = smallest_distance(points, true) / koksma__packing_distance(points->n, 2, true);
    if (points->dim == 2 && points->n >= least && !(rho > 0.5)) {
        fail_claim(spec, points, "the smallest distance is %.3f of the densest packing's", rho);
    }
}

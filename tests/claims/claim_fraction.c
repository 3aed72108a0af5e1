/* SPDX-License-Identifier: Apache-2.0 */
/* fraction: in 2D on the torus, no two points are closer than the parameter f times the smallest distance in the
   densest packing. */
#include "claims/claims.h"

void claim_FRACTION(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const double f = param_of(spec, "f", 0), densest = koksma__packing_distance(points->n, 2, true);
    if (points->n > 1 && smallest_distance(points, true) < f * densest * (1 - 1e-12)) {
        fail_claim(spec, points, "two points are closer than %g of the densest packing's distance", f);
    }
}

/* SPDX-License-Identifier: Apache-2.0 */
/* dimension-prefixes: with the same n and seed, the points of one dimension more have the same first coordinates. */
#include "claims/claims.h"

void claim_DIMENSION_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    if (!keeps_dimensions(spec, points, seed)) {
        fail_claim(spec, points, "with a dimension more, other coordinates change");
    }
}

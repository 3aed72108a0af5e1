/* SPDX-License-Identifier: Apache-2.0 */
/* exchangeable: the points are in random order; shuffling has no effect. */
#include "claims/claims.h"

void claim_EXCHANGEABLE(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    check_means(spec, points, seed, true);
}

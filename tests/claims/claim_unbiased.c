/* SPDX-License-Identifier: Apache-2.0 */
/* unbiased: for every box B, the expected fraction of the points in B is the volume of B. */
#include "claims/claims.h"

void claim_UNBIASED(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    check_means(spec, points, seed, false);
}

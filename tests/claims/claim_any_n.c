/* SPDX-License-Identifier: Apache-2.0 */
/* any-n: serves every n >= 1. */
#include "claims/claims.h"

void claim_ANY_N(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)spec, (void)points, (void)seed; /* the walk fails on a refusal */
}

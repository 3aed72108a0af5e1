/* SPDX-License-Identifier: Apache-2.0 */
/* net2: in 2D with n = 2^m, the points are a (0,m,2)-net in base 2. */
#include "claims/claims.h"

void claim_NET2(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    if (points->dim == 2 && !(points->n & (points->n - 1)) && !is_net2_block(points, 0, points->n)) {
        fail_claim(spec, points, "not a (0,m,2)-net in base 2");
    }
}

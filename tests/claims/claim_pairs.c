/* SPDX-License-Identifier: Apache-2.0 */
/* pairs: n = 2^m: coordinates 2k and 2k + 1 are a (0,m,2)-net in base 2. */
#include "claims/claims.h"

void claim_PAIRS(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (int k = 0; k + 1 < points->dim && !(points->n & (points->n - 1)); k += 2) {
        koksma_points pair = projection_of(points, k, 2);
        if (!is_net2_block(&pair, 0, pair.n)) {
            fail_claim(spec, points, "coordinates %d and %d are not a (0,m,2)-net in base 2", k, k + 1);
        }
        koksma_points_fini(&pair);
    }
}

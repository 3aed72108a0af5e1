/* SPDX-License-Identifier: Apache-2.0 */
/* pairs-3: the first 3^m points: coordinates 2k and 2k + 1 are a (0,m,2)-net in base 3. */
#include "claims/claims.h"

void claim_PAIRS_3(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (int k = 0; k + 1 < points->dim; k += 2) {
        koksma_points pair = projection_of(points, k, 2);
        for (size_t n = 1; n <= pair.n; n *= 3) {
            if (!is_net_in_base(&pair, n, 3)) {
                fail_claim(spec, points, "coordinates %d and %d of the first %zu are not a (0,m,2)-net in base 3", k,
                           k + 1, n);
            }
        }
        koksma_points_fini(&pair);
    }
}

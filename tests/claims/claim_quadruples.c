/* SPDX-License-Identifier: Apache-2.0 */
/* quadruples: the first 4^m points: coordinates 4k to 4k + 3 are a (0,m,4)-net in base 4. */
#include "claims/claims.h"

void claim_QUADRUPLES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (int k = 0; k + 3 < points->dim; k += 4) {
        koksma_points four = projection_of(points, k, 4);
        for (size_t n = 1; n <= four.n; n *= 4) {
            if (!is_net_in_base(&four, n, 4)) {
                fail_claim(spec, points, "coordinates %d to %d of the first %zu are not a (0,m,4)-net in base 4", k,
                           k + 3, n);
            }
        }
        koksma_points_fini(&four);
    }
}

/* SPDX-License-Identifier: Apache-2.0 */
/* net2-prefixes: in 2D, for all a and m, points a 2^m to (a + 1) 2^m - 1 are a (0,m,2)-net in base 2. */
#include "claims/claims.h"

void claim_NET2_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (size_t n = 1; points->dim == 2 && n <= points->n; n *= 2) {
        for (size_t first = 0; first + n <= points->n; first += n) {
            if (!is_net2_block(points, first, n)) {
                fail_claim(spec, points, "points %zu to %zu are not a (0,m,2)-net in base 2", first, first + n - 1);
            }
        }
    }
}

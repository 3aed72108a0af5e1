/* SPDX-License-Identifier: Apache-2.0 */
/* centred: on each axis, each point lies in the middle half of its stratum (patterns that also claim `stratified`).
   */
#include "claims/claims.h"

void claim_CENTRED(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t m = root_of(points->n, points->dim);
    for (size_t i = 0; i < points->n && m; i++) {
        size_t rest = i;
        for (int k = points->dim - 1; k >= 0; k--, rest /= m) {
            const double place = points->xs[i * (size_t)points->dim + (size_t)k] * (double)m - (double)(rest % m);
            if (place < 0.25 - 1e-6 || place > 0.75 + 1e-6) {
                fail_claim(spec, points, "point %zu is outside of the middle half of its cell", i);
            }
        }
    }
}

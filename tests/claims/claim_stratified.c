/* SPDX-License-Identifier: Apache-2.0 */
/* stratified: for n = m^dim, each of the m^dim cells has one point; the points are in the order of the cells, in
   which the last coordinate changes fastest. */
#include "claims/claims.h"

void claim_STRATIFIED(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t m = root_of(points->n, points->dim);
    for (size_t i = 0; i < points->n && m; i++) {
        size_t rest = i;
        for (int k = points->dim - 1; k >= 0; k--, rest /= m) {
            const double x = points->xs[i * (size_t)points->dim + (size_t)k];
            if (stratum(x, m) != rest % m) {
                fail_claim(spec, points, "point %zu is not in its cell", i);
            }
        }
    }
}

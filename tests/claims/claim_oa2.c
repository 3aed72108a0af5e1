/* SPDX-License-Identifier: Apache-2.0 */
/* oa2: for n = s^2, each 2D projection has one point in each of its s x s cells. */
#include "claims/claims.h"

void claim_OA2(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t s = root_of(points->n, 2), ms[2] = {s, s};
    for (int a = 0; a < points->dim && s > 1 && param_of(spec, "strength", 2) == 2; a++) {
        for (int b = 0; b < a; b++) {
            const int use[2] = {a, b};
            if (!one_in_each(points, points->n, use, ms, 2)) {
                fail_claim(spec, points, "coordinates %d and %d do not have one point in each cell", b, a);
            }
        }
    }
}

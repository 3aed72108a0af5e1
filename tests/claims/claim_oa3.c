/* SPDX-License-Identifier: Apache-2.0 */
/* oa3: for n = s^3 and strength=3, each 3D projection has one point in each of its s x s x s cells. */
#include "claims/claims.h"

void claim_OA3(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t s = root_of(points->n, 3), ms[3] = {s, s, s};
    for (int a = 0; a < points->dim && s > 1 && param_of(spec, "strength", 2) == 3; a++) {
        for (int b = 0; b < a; b++) {
            for (int c = 0; c < b; c++) {
                const int use[3] = {a, b, c};
                if (!one_in_each(points, points->n, use, ms, 3)) {
                    fail_claim(spec, points, "coordinates %d, %d and %d lack a cell", c, b, a);
                }
            }
        }
    }
}

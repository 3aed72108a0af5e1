/* SPDX-License-Identifier: Apache-2.0 */
/* grid: in 2D with n = m^2, each of the m x m cells has one point; the points are in any order. */
#include "claims/claims.h"

void claim_GRID(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    const size_t m = root_of(points->n, 2), ms[2] = {m, m};
    const int use[2] = {0, 1};
    if (points->dim == 2 && m && !one_in_each(points, points->n, use, ms, 2)) {
        fail_claim(spec, points, "not one point in each cell");
    }
}

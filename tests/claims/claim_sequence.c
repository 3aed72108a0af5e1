/* SPDX-License-Identifier: Apache-2.0 */
/* sequence: for every k <= n, the first k of n points equal the set generated for k points. */
#include "claims/claims.h"

void claim_SEQUENCE(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    const size_t ks[] = {1, points->n / 2, points->n - 1};
    for (int t = 0; t < 3; t++) {
        koksma_points prefix;
        if (ks[t] == 0) {
            continue;
        }
        assert_ok(koksma_points_init(&prefix, ks[t], points->dim));
        assert_ok(koksma_generate(spec, seed, NULL, &prefix));
        if (memcmp(prefix.xs, points->xs, ks[t] * (size_t)points->dim * sizeof *points->xs)) {
            fail_claim(spec, points, "its first %zu points are not the set of %zu", ks[t], ks[t]);
        }
        koksma_points_fini(&prefix);
    }
}

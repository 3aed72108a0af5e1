/* SPDX-License-Identifier: Apache-2.0 */
/* deterministic: the seed does not matter, unless the parameter scramble or shuffle or a random modifier is set. */
#include "claims/claims.h"

void claim_DETERMINISTIC(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    const bool deterministic = koksma_has_one_set(spec);
    koksma_points other;
    assert_ok(koksma_points_init(&other, points->n, points->dim));
    assert_ok(koksma_generate(spec, seed + 1, NULL, &other));
    const bool equal = !memcmp(other.xs, points->xs, points->n * (size_t)points->dim * sizeof *points->xs);
    if (equal != deterministic && (deterministic || points->n >= 16)) {
        fail_claim(spec, points, deterministic ? "the seed matters" : "the seed does not matter");
    }
    koksma_points_fini(&other);
}

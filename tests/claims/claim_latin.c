/* SPDX-License-Identifier: Apache-2.0 */
/* latin: on each axis, each of the n intervals [j/n, (j+1)/n) has one point. */
#include "claims/claims.h"

void claim_LATIN(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (int k = 0; k < points->dim; k++) {
        if (!one_in_each(points, points->n, &k, &points->n, 1)) {
            fail_claim(spec, points, "coordinate %d is not Latin", k);
        }
    }
}

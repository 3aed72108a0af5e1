/* SPDX-License-Identifier: Apache-2.0 */
/* latin-prefixes: on axis k, each of the intervals [j/b^m, (j+1)/b^m) has one of the first b^m points, where b is
   the k-th prime. */
#include "claims/claims.h"
#include "patterns/nets/nets.h"

void claim_LATIN_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (int k = 0; k < points->dim; k++) {
        for (size_t m = 1; m <= points->n; m *= koksma__prime(k)) {
            if (!one_in_each(points, m, &k, &m, 1)) {
                fail_claim(spec, points, "the first %zu points are not Latin in coordinate %d", m, k);
            }
        }
    }
}

/* SPDX-License-Identifier: Apache-2.0 */
/* net-prefixes: in d dimensions, for every m, the first b^m points are a (0,m,d)-net in base b, where b is the
   smallest prime >= d. */
#include "claims/claims.h"
#include "patterns/nets/nets.h"

void claim_NET_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    size_t b = 2;
    if (points->dim > 7) {
        return;
    }
    for (int k = 1; b < (size_t)points->dim; k++) {
        b = koksma__prime(k);
    }
    for (size_t n = 1; n <= points->n; n *= b) {
        if (!is_net_in_base(points, n, b)) {
            fail_claim(spec, points, "the first %zu points are not a (0,m,%d)-net in base %zu", n, points->dim, b);
        }
    }
}

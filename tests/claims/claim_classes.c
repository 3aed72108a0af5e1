/* SPDX-License-Identifier: Apache-2.0 */
/* classes: in 2D, unless the parameter shuffle is set, for all a and m >= 2, the points a 2^m to (a + 1) 2^m - 1 fall into
   four classes, by the parity of bits 0, 2, 4, .. and of bits 1, 3, 5, .. of their index: (0,m-2,2)-nets in base 2. */
#include "claims/claims.h"

static int parity_of(size_t bits)
{
    int parity = 0;
    for (; bits; bits &= bits - 1) {
        parity = !parity;
    }
    return parity;
}

static void check_block(const koksma_spec *spec, const koksma_points *points, size_t first, size_t n)
{
    for (int c = 0; c < 4; c++) {
        koksma_points members;
        size_t count = 0;
        assert_ok(koksma_points_init(&members, n / 4, 2));
        for (size_t i = first; i < first + n; i++) {
            if (parity_of(i & 0x55555555) + 2 * parity_of(i & 0xaaaaaaaa) == c && count++ < n / 4) {
                memcpy(members.xs + 2 * (count - 1), points->xs + 2 * i, 2 * sizeof *members.xs);
            }
        }
        if (count != n / 4 || !is_net2_block(&members, 0, n / 4)) {
            fail_claim(spec, points, "class %d of the points %zu to %zu is not a (0,m,2)-net in base 2", c, first,
                       first + n - 1);
        }
        koksma_points_fini(&members);
    }
}

void claim_CLASSES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (size_t n = 4; points->dim == 2 && !param_of(spec, "shuffle", 0) && n <= points->n; n *= 2) {
        for (size_t first = 0; first + n <= points->n; first += n) {
            check_block(spec, points, first, n);
        }
    }
}

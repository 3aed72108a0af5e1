/* SPDX-License-Identifier: Apache-2.0 */
/* net2-prefixes: in 2D, for all a and m, points a 2^m to (a + 1) 2^m - 1 are a (0,m,2)-net in base 2. */
#include "claims/claims.h"

/* Blocks across and beyond point 2^32, up to the last point. */
static void check_late_blocks(const koksma_spec *spec, uint64_t seed)
{
    enum { N = 512 };
    static const uint64_t firsts[] = {((uint64_t)1 << 32) - N, (uint64_t)1 << 32, ((uint64_t)5 << 32) + 77 * N,
                                      ((uint64_t)1 << 50) - N, KOKSMA_MAX_INDEX + 1 - N};
    koksma_points points;
    assert_ok(koksma_points_init(&points, N, 2));
    for (size_t b = 0; b < sizeof firsts / sizeof *firsts; b++) {
        assert_ok(koksma_generate_range(spec, seed, 0, firsts[b], NULL, &points));
        for (size_t n = 1; n <= N; n *= 2) {
            if (!is_net2_block(&points, N - n, n)) {
                fail_claim(spec, &points, "points from %llu on are not a (0,m,2)-net in base 2",
                           (unsigned long long)(firsts[b] + N - n));
            }
        }
    }
    koksma_points_fini(&points);
}

void claim_NET2_PREFIXES(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    if (points->dim == 2 && koksma_has_ranges(spec)) {
        check_late_blocks(spec, seed);
    }
    for (size_t n = 1; points->dim == 2 && n <= points->n; n *= 2) {
        for (size_t first = 0; first + n <= points->n; first += n) {
            if (!is_net2_block(points, first, n)) {
                fail_claim(spec, points, "points %zu to %zu are not a (0,m,2)-net in base 2", first, first + n - 1);
            }
        }
    }
}

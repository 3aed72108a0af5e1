/* SPDX-License-Identifier: Apache-2.0 */
/* quadruples-3: the first 3^m points: coordinates 4k to 4k + 3 are a (1,m,4)-net in base 3: every product of four
   [a/3^d, (a+1)/3^d) of volume 3^(1-m) holds three of them. */
#include "claims/claims.h"

/* Whether each of the cells that have sides[k] strata along coordinate k holds three of the first n points. */
static bool three_in_each(const koksma_points *points, size_t n, const size_t *sides)
{
    unsigned char *counts = calloc(n / 3, 1);
    bool even = true;
    assert_non_null(counts);
    for (size_t i = 0; i < n && even; i++) {
        size_t cell = 0;
        for (int k = 0; k < 4; k++) {
            cell = cell * sides[k] + stratum(points->xs[4 * i + (size_t)k], sides[k]);
        }
        even = ++counts[cell] <= 3;
    }
    free(counts);
    return even;
}

static bool all_shapes(const koksma_points *points, size_t n, size_t *sides, int k, size_t left)
{
    bool even = true;
    for (sides[k] = 1; sides[k] <= left && even && k < 3; sides[k] *= 3) {
        even = all_shapes(points, n, sides, k + 1, left / sides[k]);
    }
    if (k == 3) {
        sides[k] = left;
        even = three_in_each(points, n, sides);
    }
    return even;
}

void claim_QUADRUPLES_3(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    (void)seed;
    for (int k = 0; k + 3 < points->dim; k += 4) {
        koksma_points four = projection_of(points, k, 4);
        for (size_t n = 3, sides[4]; n <= four.n; n *= 3) {
            if (!all_shapes(&four, n, sides, 0, n / 3)) {
                fail_claim(spec, points, "coordinates %d to %d of the first %zu are not a (1,m,4)-net in base 3", k,
                           k + 3, n);
            }
        }
        koksma_points_fini(&four);
    }
}

/* SPDX-License-Identifier: Apache-2.0 */
/* independent: the points are random and independent of each other. */
#include "claims/claims.h"

/* Over sets, the first coordinates of points 0 and 1, and of 0 and the last, vary and are not correlated. */
void claim_INDEPENDENT(const koksma_spec *spec, const koksma_points *points, uint64_t seed)
{
    enum { SETS = test_repeats(120, 40) };
    if (points->n > 32 || points->n < 3 || seed != 0) {
        return;
    }
    koksma_points other;
    assert_ok(koksma_points_init(&other, points->n, points->dim));
    double xs[3][SETS], means[3] = {0}, products[3] = {0}, squares[3] = {0};
    for (int s = 0; s < SETS; s++) {
        assert_ok(koksma_generate(spec, 2000 + (uint64_t)s, NULL, &other));
        for (size_t i = 0; i < 3; i++) {
            xs[i][s] = other.xs[(i < 2 ? i : other.n - 1) * (size_t)other.dim];
            means[i] += xs[i][s] / SETS;
        }
    }
    koksma_points_fini(&other);
    for (int s = 0; s < SETS; s++) {
        for (int i = 0; i < 3; i++) {
            products[i] += (xs[0][s] - means[0]) * (xs[i][s] - means[i]);
            squares[i] += (xs[i][s] - means[i]) * (xs[i][s] - means[i]);
        }
    }
    for (int i = 1; i < 3; i++) {
        const double correlation = products[i] / sqrt(squares[0] * squares[i]);
        if (!(fabs(correlation) < 4.5 / sqrt(SETS))) {
            fail_claim(spec, points, "two points have the correlation %.3f", correlation);
        }
    }
}

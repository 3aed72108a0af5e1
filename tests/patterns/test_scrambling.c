/* SPDX-License-Identifier: Apache-2.0 */
/* Hashed Owen scrambling has the law of the exact one as far as the mean and the variance of the L2 star discrepancy over
   200 seeds can tell. */
#include "claims/claims.h"
#include "test.h"

typedef struct moments {
    double mean, variance, mean_error, variance_error;
} moments;

static moments moments_of(const char *pattern, size_t n)
{
    enum { SEEDS = 200 };
    double values[SEEDS], mean = 0, m2 = 0, m4 = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        koksma_points points = test_points(pattern, n, 2, seed);
        values[seed] = test_measure("l2-star", &points).value;
        mean += values[seed] / SEEDS;
        koksma_points_fini(&points);
    }
    for (int i = 0; i < SEEDS; i++) {
        const double t = (values[i] - mean) * (values[i] - mean);
        m2 += t / SEEDS;
        m4 += t * t / SEEDS;
    }
    return (moments){mean, m2, sqrt(m2 / SEEDS), sqrt((m4 - m2 * m2) / SEEDS)};
}

TEST_CASE(hashed_owen_is_as_good_as_exact)
{
    static const size_t counts[] = {16, 64, 256};
    static const char *const hashed[] = {"sobol:scramble=hash-owen", "sobol:scramble=hash-owen,shuffle=1"};
    for (size_t c = 0; c < 3; c++) {
        const moments exact = moments_of("sobol:scramble=owen", counts[c]);
        for (size_t h = 0; h < 2; h++) {
            const moments other = moments_of(hashed[h], counts[c]);
            assert_near(other.mean, exact.mean, 3 * hypot(other.mean_error, exact.mean_error));
            assert_near(other.variance, exact.variance, 3 * hypot(other.variance_error, exact.variance_error));
        }
    }
}

/* Exact nested scrambling, its definition bit by bit, has the same moments. */
TEST_CASE(stochastic_generation_is_owens)
{
    const moments grown = moments_of("sobol:scramble=owen", 32), jittered = moments_of("jittered:columns=8", 32);
    assert_true(grown.mean < jittered.mean);
    /* E(S^2) of a scrambled (0,m,2)-net is that of any other: pmj02 */
    const moments other = moments_of("pmj02", 32);
    assert_near(other.mean, grown.mean, 3.5 * hypot(other.mean_error, grown.mean_error));
}

/* SPDX-License-Identifier: Apache-2.0 */
/* Slopes, rank correlations, bootstrap intervals and equal errors against values by hand and closed forms. */
#include <stdlib.h>

#include <koksma/series.h>

#include "core/quantiles.h"
#include "core/random.h"
#include "study/statistics.h"
#include "test.h"

/* A standard normal number: the sum of twelve uniform ones. */
static double normal(uint64_t seed, uint64_t i)
{
    double sum = -6, pair[2];
    for (uint32_t k = 0; k < 6; k++) {
        koksma__random_pair(seed, KOKSMA__PURPOSE_TEST, i, k, pair);
        sum += pair[0] + pair[1];
    }
    return sum;
}

static void slope_by_hand(void **state)
{
    (void)state;
    const double x[] = {0, 1, 2, 3}, y[] = {1, 3, 5, 7}, one[] = {1, 1, 1, 1}, none[] = {0, 0, 0, 0};
    const koksma__line line = koksma__fit_line(x, y, one, 4);
    assert_near(line.slope, 2, 1e-15);
    assert_near(line.intercept, 1, 1e-15);
    assert_near(line.slope_error, sqrt(1.0 / 5), 1e-15); /* 1 / sum (x - 1.5)^2 */
    const double bent[] = {0, 1, 1, 0};
    assert_near(koksma__fit_line(x, bent, none, 4).slope_error, sqrt(1.0 / 2 / 5), 1e-15);
    assert_true(isnan(koksma__fit_line(x, y, one, 1).slope));
}

/* The interval of the slope, +-1.96 standard errors, covers the true slope in 95 % of cases. */
static void slope_covers(void **state)
{
    (void)state;
    const double x[] = {1, 2, 3, 4, 5, 6}, sigma[] = {0.1, 0.2, 0.1, 0.3, 0.1, 0.2};
    int covered = 0;
    for (uint64_t t = 0; t < 2000; t++) {
        double y[6];
        for (uint64_t i = 0; i < 6; i++) {
            y[i] = 3 - 0.75 * x[i] + sigma[i] * normal(t, i);
        }
        const koksma__line line = koksma__fit_line(x, y, sigma, 6);
        covered += fabs(line.slope + 0.75) <= 1.96 * line.slope_error;
    }
    assert_in_range(covered, 1870, 1990); /* 1900 and up: the standard error only ever grows */
}

static void correlations_by_hand(void **state)
{
    (void)state;
    const double x[] = {1, 2, 3, 4, 5}, y[] = {2, 1, 4, 3, 5}, tied[] = {1, 1, 2, 2, 3}, flat[] = {1, 1, 1, 1, 1};
    assert_near(koksma__spearman(x, y, 5), 1 - 6 * 4.0 / (5 * 24), 1e-15); /* 1 - 6 sum d^2 / n (n^2 - 1) */
    assert_near(koksma__kendall(x, y, 5), (8 - 2) / 10.0, 1e-15);
    assert_near(koksma__spearman(x, x, 5), 1, 1e-15);
    assert_near(koksma__kendall(x, tied, 5), 8 / sqrt(10 * 8.0), 1e-15);
    assert_near(koksma__spearman(x, tied, 5), 9 / sqrt(10 * 9.0), 1e-15); /* ranks 1.5 1.5 3.5 3.5 5 */
    assert_true(isnan(koksma__spearman(x, flat, 5)) && isnan(koksma__kendall(flat, x, 5)));
}

/* The mean of the correlations over all orders is 0, of their squares 1/(n-1) and 2(2n+5)/(9n(n-1)). */
static void correlations_over_all_orders(void **state)
{
    (void)state;
    const double x[] = {1, 2, 3, 4, 5};
    double sums[4] = {0};
    int orders = 0;
    for (int code = 0; code < 3125; code++) {
        double y[5];
        int used = 0;
        for (int i = 0, rest = code; i < 5; i++, rest /= 5) {
            y[i] = rest % 5;
            used |= 1 << rest % 5;
        }
        if (used == 31) {
            const double rho = koksma__spearman(x, y, 5), tau = koksma__kendall(x, y, 5);
            sums[0] += rho;
            sums[1] += rho * rho;
            sums[2] += tau;
            sums[3] += tau * tau;
            orders++;
        }
    }
    assert_int_equal(orders, 120);
    assert_near(sums[0], 0, 1e-12);
    assert_near(sums[1] / 120, 1.0 / 4, 1e-12);
    assert_near(sums[2], 0, 1e-12);
    assert_near(sums[3] / 120, 2.0 * 15 / (9 * 5 * 4), 1e-12);
}

static void bootstrap_intervals(void **state)
{
    (void)state;
    double values[400], y[400];
    koksma__estimate e, again;
    for (uint64_t i = 0; i < 400; i++) {
        values[i] = normal(5, i);
        y[i] = values[i] + 0.1 * normal(6, i);
    }
    const koksma__summary s = koksma__summarize(values, 400, 1);
    assert_ok(koksma__bootstrap_mean(values, 400, 4000, 1, &e));
    assert_near(e.low, s.low, 0.1 * (s.high - s.low)); /* the t interval, for so many */
    assert_near(e.high, s.high, 0.1 * (s.high - s.low));
    assert_ok(koksma__bootstrap_mean(values, 400, 4000, 1, &again));
    assert_true(e.low == again.low && e.high == again.high);
    assert_ok(koksma__bootstrap_pairs(values, y, 100, koksma__spearman, 500, 3, &e));
    assert_true(e.low < e.value && e.value < e.high && e.low > 0.95 && e.high <= 1);
    assert_ok(koksma__bootstrap_pairs(values, y, 3, koksma__spearman, 500, 3, &e));
    assert_true(e.low == -1 && e.high == 1);
}

/* Bootstrap intervals of the mean of 30 exponential values cover it in about 92 to 95 % of cases. */
static void bootstrap_covers(void **state)
{
    (void)state;
    int covered = 0;
    for (uint64_t t = 0; t < 1000; t++) {
        double values[30], pair[2];
        koksma__estimate e;
        for (uint64_t i = 0; i < 30; i++) {
            koksma__random_pair(t, KOKSMA__PURPOSE_TEST, i, 9, pair);
            values[i] = -log(1 - pair[0]);
        }
        assert_ok(koksma__bootstrap_mean(values, 30, 400, t, &e));
        covered += e.low <= 1 && 1 <= e.high;
    }
    assert_in_range(covered, 890, 965);
}

static void paired_differences(void **state)
{
    (void)state;
    const double a[] = {3, 5, 8}, b[] = {1, 2, 4};
    const koksma__summary s = koksma__paired(a, b, 3, 1);
    assert_near(s.mean, 3, 0);
    assert_near(s.sd, 1, 1e-15);
    assert_near(s.high, 3 + 4.302652729749464 / sqrt(3), 1e-12);
    assert_near(koksma__student_quantile(0.9975, 20), 3.153400, 1e-6);
}

/* Errors 1 / sqrt n: 0.25 is reached by 16. */
static void samples_for_an_error(void **state)
{
    (void)state;
    const double n[] = {4, 64, 256}, mean[] = {0.5, 0.125, 0.0625}, error[] = {0.01, 0.0025, 0.001};
    const koksma__convergence p = {n, mean, error, 3};
    bool outside;
    koksma__estimate e = koksma__samples_for(&p, 0.25, 0, &outside);
    assert_near(e.value, 16, 1e-12);
    assert_false(outside);
    assert_near(log(e.high / 16), 1.959964 * 2 * sqrt(0.5) * 0.02, 1e-6);
    e = koksma__samples_for(&p, 0.03125, 0, &outside);
    assert_near(e.value, 1024, 1e-9);
    assert_true(outside);
    const double rising[] = {0.5, 0.6, 0.7};
    const koksma__convergence bad = {n, rising, error, 3};
    assert_true(isnan(koksma__samples_for(&bad, 0.1, 0, &outside).value));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slope_by_hand),        cmocka_unit_test(slope_covers),
        cmocka_unit_test(correlations_by_hand), cmocka_unit_test(correlations_over_all_orders),
        cmocka_unit_test(bootstrap_intervals),  cmocka_unit_test(bootstrap_covers),
        cmocka_unit_test(paired_differences),   cmocka_unit_test(samples_for_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

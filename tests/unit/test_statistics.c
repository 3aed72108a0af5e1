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

/* How often in 2000 cases the interval of the slope covers the true one, of n sizes with `trials` each: their
   standard errors are estimates, and so is nothing but the residuals with one trial. */
static int slopes_covered(size_t n, size_t trials)
{
    int covered = 0;
    for (uint64_t t = 0; t < 2000; t++) {
        double x[6], y[6], sigma[6], values[16];
        for (size_t i = 0; i < n; i++) {
            for (size_t k = 0; k < trials; k++) {
                values[k] = 3 - 0.75 * (double)i + 0.1 * (double)(1 + i % 3) * normal(t, 16 * i + k);
            }
            const koksma__summary s = koksma__summarize(values, trials, 1);
            x[i] = (double)i;
            y[i] = s.mean;
            sigma[i] = trials > 1 ? s.sd / sqrt((double)trials) : 0;
        }
        const koksma__line line = koksma__fit_line(x, y, sigma, n);
        const koksma__estimate e = koksma__slope(&line, trials);
        covered += e.low <= -0.75 && -0.75 <= e.high;
    }
    return covered;
}

/* 1900 are due; more where the standard errors are of few trials, whose Student's quantile is the safe side. */
static void slope_covers(void **state)
{
    (void)state;
    assert_in_range(slopes_covered(3, 1), 1820, 1970);
    assert_in_range(slopes_covered(6, 1), 1850, 1950);
    assert_in_range(slopes_covered(3, 3), 1900, 2000);
    assert_in_range(slopes_covered(6, 4), 1900, 2000);
    assert_in_range(slopes_covered(6, 16), 1860, 1980);
}

static void slope_of_two_points(void **state)
{
    (void)state;
    const double x[] = {0, 2}, y[] = {1, 3}, sigma[] = {0.3, 0.4}, none[] = {0, 0};
    koksma__line line = koksma__fit_line(x, y, sigma, 2);
    koksma__estimate e = koksma__slope(&line, 5);
    assert_near(e.value, 1, 1e-15);
    assert_near(e.high - e.value, koksma_student_975(4) * 0.25, 1e-12); /* sqrt(0.3^2 + 0.4^2) / 2 */
    line = koksma__fit_line(x, y, none, 2);
    e = koksma__slope(&line, 1);
    assert_true(e.value == 1 && isnan(e.low) && isnan(e.high));
    const double bent[] = {0, 1, 5, 3}, at[] = {0, 1, 2, 3}, small[] = {1e-3, 1e-3, 1e-3, 1e-3};
    line = koksma__fit_line(at, bent, small, 4); /* no line: the residuals say so */
    assert_int_equal(line.degrees, 2);
    e = koksma__slope(&line, 100);
    assert_near(e.high - e.value, koksma_student_975(2) * line.slope_error, 1e-12);
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
    assert_ok(koksma__bootstrap_pairs(values, y, 100, koksma__spearman, 500, 3, &e));
    assert_true(e.low < e.value && e.value < e.high && e.low > 0.95 && e.high <= 1);
    assert_ok(koksma__bootstrap_pairs(values, y, 100, koksma__spearman, 500, 3, &again));
    assert_true(e.low == again.low && e.high == again.high);
    for (size_t n = 1; n < 7; n++) { /* too few to say that it isn't 0 */
        assert_ok(koksma__bootstrap_pairs(values, values, n, koksma__spearman, 500, 3, &e));
        assert_true(e.low == -1 && e.high == 1);
    }
    assert_ok(koksma__bootstrap_pairs(values, values, 7, koksma__spearman, 500, 3, &e));
    assert_true(e.value == 1 && e.low == 1);
}

/* Of 10 pairs without correlation the interval excludes 0 in about 5 % of cases. */
static void bootstrap_covers(void **state)
{
    (void)state;
    int excluded = 0;
    for (uint64_t t = 0; t < 400; t++) {
        double x[10], y[10];
        koksma__estimate e;
        for (uint64_t i = 0; i < 10; i++) {
            x[i] = normal(t, i);
            y[i] = normal(t, 100 + i);
        }
        assert_ok(koksma__bootstrap_pairs(x, y, 10, koksma__spearman, 300, t, &e));
        excluded += e.low > 0 || e.high < 0;
    }
    assert_in_range(excluded, 4, 44);
}

static void paired_differences(void **state)
{
    (void)state;
    const double a[] = {3, 5, 8}, b[] = {1, 2, 4};
    const koksma__summary s = koksma__paired(a, b, 3, 1);
    assert_near(s.mean, 3, 0);
    assert_near(s.sd, 1, 1e-15);
    assert_near(s.high, 3 + 4.302652729749464 / sqrt(3), 1e-12);
    const koksma__summary one = koksma__paired(a, b, 1, 1);
    assert_true(one.mean == 2 && one.n == 1 && isnan(one.sd) && isnan(one.low) && isnan(one.high));
    const koksma__summary exact = koksma__exactly(2);
    assert_true(exact.mean == 2 && exact.sd == 0 && exact.low == 2 && exact.high == 2 && exact.max == 2);
    assert_near(koksma__student_quantile(0.9975, 20), 3.153400, 1e-6);
}

/* How often in 2000 cases of 8 pairs the interval covers a change by the factor `change`; the values vary by a tenth,
   `common` of which both of a pair have. */
static int changes_covered(double change, double common)
{
    int covered = 0;
    for (uint64_t t = 0; t < 2000; t++) {
        double a[8], base[8];
        for (size_t i = 0; i < 8; i++) {
            const double shared = common * normal(t, 3 * i);
            a[i] = change * (1 + 0.1 * (shared + sqrt(1 - common * common) * normal(t, 3 * i + 1)));
            base[i] = 1 + 0.1 * (shared + sqrt(1 - common * common) * normal(t, 3 * i + 2));
        }
        const koksma__estimate e = koksma__relative_change(a, base, 8);
        covered += e.low <= change - 1 && change - 1 <= e.high;
    }
    return covered;
}

static void relative_changes(void **state)
{
    (void)state;
    const double a[] = {3, 5, 8}, b[] = {1, 2, 4}, none[] = {0, 0, 0};
    const koksma__estimate e = koksma__relative_change(a, b, 3); /* 16/7; what is left of a: 5/7, 3/7, -8/7 */
    assert_near(e.value, 9.0 / 7, 1e-15);
    assert_near(e.high - e.value, 4.302652729749464 * sqrt(98.0 / 49 / 2 / 3) / (7.0 / 3), 1e-12);
    assert_near(e.high - e.value, e.value - e.low, 1e-12);
    const koksma__estimate one = koksma__relative_change(a, b, 1), same = koksma__relative_change(none, none, 3);
    assert_true(one.value == 2 && isnan(one.low) && isnan(one.high));
    assert_true(same.value == 0 && same.low == 0 && same.high == 0);
    assert_in_range(changes_covered(1, 0), 1860, 1940); /* 1900 are due */
    assert_in_range(changes_covered(3, 0), 1860, 1940);
    assert_in_range(changes_covered(3, 0.9), 1860, 1940);
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
        cmocka_unit_test(slope_by_hand),
        cmocka_unit_test(slope_covers),
        cmocka_unit_test(slope_of_two_points),
        cmocka_unit_test(correlations_by_hand),
        cmocka_unit_test(correlations_over_all_orders),
        cmocka_unit_test(bootstrap_intervals),
        cmocka_unit_test(bootstrap_covers),
        cmocka_unit_test(paired_differences),
        cmocka_unit_test(relative_changes),
        cmocka_unit_test(samples_for_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: Apache-2.0 */
/* Slopes, rank correlations, bootstrap intervals and equal errors against values by hand and closed forms. */
#include <stdlib.h>

#include <koksma/series.h>

#include "core/random.h"
#include "stats/stats.h"
#include "test.h"

/* A standard normal number (Box and Muller 1958). */
static double normal(uint64_t seed, uint64_t i)
{
    double pair[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_TEST, i, 0, pair);
    return sqrt(-2 * log1p(-pair[0])) * cos(6.283185307179586 * pair[1]);
}

/* A mean exp(y) whose log has the standard error sigma by so many trials; of one: that doesn't vary. */
static koksma__summary mean_of(double y, double sigma, size_t trials)
{
    return trials == 1 ? koksma__exactly(exp(y))
                       : (koksma__summary){.n = trials, .mean = exp(y), .sd = sigma * exp(y) * sqrt((double)trials)};
}

static koksma__trend trend_of(size_t count, const double *y, const double *sigma, size_t trials)
{
    double n[8];
    koksma__summary means[8];
    for (size_t i = 0; i < count; i++) {
        n[i] = exp((double)i);
        means[i] = mean_of(y[i], sigma ? sigma[i] : 0, trials);
    }
    return koksma__trend_of(n, means, count);
}

TEST_CASE(slope_by_hand)
{
    const double y[] = {1, 3, 5, 7}, one[] = {1, 1, 1, 1}, bent[] = {0, 1, 1, 0};
    koksma__estimate e = trend_of(4, y, one, 4).slope;
    assert_near(e.value, 2, 1e-14);
    /* c = (-3, -1, 1, 3) / 10: V = 20 / 100 and V^2 / sum c^4 = 0.04 / 0.0164 */
    assert_near(e.high - e.value, koksma__student_quantile(0.975, 3 * 0.04 / 0.0164) * sqrt(0.2), 1e-9);
    assert_near(e.value - e.low, e.high - e.value, 1e-14);
    e = trend_of(4, bent, NULL, 1).slope; /* nothing varies: 4 residuals of 1/2 */
    assert_near(e.value, 0, 1e-14);
    assert_near(e.high, koksma_student_975(2) * sqrt(1.0 / 2 / 5), 1e-12);
    const double last[] = {0, 0, 0, 0.1}; /* one varies: what others add is 0 */
    e = trend_of(4, bent, last, 9).slope;
    assert_near(e.high, koksma_student_975(8) * 0.1 * 0.3, 1e-9);
    assert_true(isnan(trend_of(1, y, one, 4).slope.value) && isnan(trend_of(0, y, one, 4).slope.value));
}

TEST_CASE(slope_of_two_points)
{
    const double n[] = {1, exp(2)}, y[] = {1, 3}, sigma[] = {0.3, 0.4};
    koksma__summary means[2];
    for (size_t i = 0; i < 2; i++) {
        means[i] = mean_of(y[i], sigma[i], 5);
    }
    koksma__estimate e = koksma__trend_of(n, means, 2).slope;
    assert_near(e.value, 1, 1e-14);
    const double degrees = 4 * 0.0625 / (0.09 * 0.09 + 0.16 * 0.16); /* (0.3^2 + 0.4^2) / 2^2 as of Welch's test */
    assert_near(e.high - e.value, koksma__student_quantile(0.975, degrees) * 0.25, 1e-9);
    means[0] = means[1] = koksma__exactly(2);
    e = koksma__trend_of(n, means, 2).slope; /* without errors, and without residuals */
    assert_true(e.value == 0 && isnan(e.low) && isnan(e.high));
    const double once = 2;
    means[0] = koksma__summarize(&once, 1, 1);
    assert_true(isnan(koksma__trend_of(n, means, 2).slope.low)); /* one trial of what varies */
}

/* Means of 8 pictures each, a little off a line: the interval is as narrow as the means are sure. */
TEST_CASE(slope_of_a_curve)
{
    const double n[] = {256, 1024, 4096}, mean[] = {4.8e-4, 1.7e-4, 7.22e-5}, off = log(4.8e-4 / 7.22e-5) / log(16);
    koksma__summary means[3];
    for (size_t i = 0; i < 3; i++) {
        means[i] = (koksma__summary){.n = 8, .mean = mean[i], .sd = 0.02 * mean[i]};
    }
    koksma__trend t = koksma__trend_of(n, means, 3);
    assert_near(t.slope.value, -off, 1e-12);
    const double error = 0.02 / sqrt(8) * sqrt(2) / log(16);
    assert_near(t.slope.high - t.slope.value, koksma__student_quantile(0.975, 14) * error, 1e-9);
    assert_true(t.off_line);
    means[1].mean = sqrt(mean[0] * mean[2]);
    assert_false(koksma__trend_of(n, means, 3).off_line);
}

/* How often in CASES the interval of the slope covers the true one, and how often the means are said to lie off a
   line: n sizes with `trials` each, whose logs are 3 - 0.75 i + bend (i - middle)^2 and spread differently. */
enum { CASES = 600 };

typedef struct rates {
    int covered, off_line;
} rates;

static rates rates_of(size_t n, size_t trials, double bend, double spread)
{
    rates found = {0, 0};
    for (uint64_t t = 0; t < CASES; t++) {
        double sizes[8], values[100];
        koksma__summary means[8];
        for (size_t i = 0; i < n; i++) {
            const double at = (double)i - 0.5 * (double)(n - 1), y = 3 - 0.75 * (double)i + bend * at * at;
            for (size_t k = 0; k < trials; k++) {
                values[k] = exp(y) * (1 + spread * (double)(1 + i % 3) * normal(t, 100 * i + k));
            }
            sizes[i] = exp((double)i);
            means[i] = koksma__summarize(values, trials, 1);
        }
        const koksma__trend trend = koksma__trend_of(sizes, means, n);
        found.covered += trend.slope.low <= -0.75 && -0.75 <= trend.slope.high;
        found.off_line += trend.off_line;
    }
    return found;
}

TEST_CASE(slope_covers)
{
    static const size_t sizes[] = {3, 4, 8}, trials[] = {3, 8, 100};
    for (size_t i = 0; i < 9; i++) {
        const size_t n = sizes[i % 3], t = trials[i / 3];
        const rates line = rates_of(n, t, 0, 0.05), curve = rates_of(n, t, 0.1, 0.02);
        assert_in_range(line.covered, 550, 592); /* 570 are due; 5.3 is a standard deviation */
        assert_in_range(line.off_line, 0, t < 8 ? 30 : 20);
        assert_in_range(curve.covered, 550, 592);
        assert_in_range(curve.off_line, t < 8 ? 120 : 570, CASES);
    }
    assert_in_range(rates_of(4, 1, 0, 0.05).covered, 540, 595); /* of the residuals, as one trial tells no error */
    assert_in_range(rates_of(8, 1, 0, 0.05).covered, 545, 592);
}

/* The mean of values that can't be negative is not negative; other intervals keep their low end, and nothing else moves. */
TEST_CASE(intervals_of_sizes_begin_at_0)
{
    const double far[] = {0.1, 0.9}, near[] = {1, 1.1}, one[] = {0.5};
    const koksma__summary signs = koksma__summarize(far, 2, 1), sizes = koksma__summarize_sizes(far, 2, 1);
    assert_true(signs.low < 0 && sizes.low == 0);
    assert_true(sizes.n == 2 && sizes.mean == signs.mean && sizes.sd == signs.sd && sizes.high == signs.high &&
                sizes.max == signs.max);
    assert_true(koksma__summarize_sizes(near, 2, 1).low == koksma__summarize(near, 2, 1).low);
    assert_true(koksma__summarize(near, 2, 1).low > 0 && isnan(koksma__summarize_sizes(one, 1, 1).low));
}

/* Values that are equal but for rounding vary by nothing, are ties, and weigh what they should. */
TEST_CASE(rounding_is_no_variation)
{
    const double tiny = 0x1p-52, a[] = {1, 1 + tiny, 1, 1 - tiny}, b[] = {1, 1, 1 + tiny, 1},
                 c[] = {1, 2, 1 + 1e-9, 3};
    koksma__summary s = koksma__summarize(a, 4, 1);
    assert_true(s.sd == 0 && s.low == s.mean && s.high == s.mean);
    assert_true(koksma__summarize(c, 2, 2).sd > 0);
    assert_true(koksma__compare(1, 1 + tiny) == 0 && koksma__compare(1, 1 + 1e-9) == -1 &&
                koksma__compare(2, 1) == 1);
    assert_true(koksma__compare(0, 0) == 0 && koksma__compare(0, 1e-300) == -1 && koksma__compare(-1, -2) == 1);
    const koksma__estimate change = koksma__relative_change(a, b, 4);
    assert_true(change.value == 0 && change.low == 0 && change.high == 0);
    const double x[] = {1, 1 + tiny, 2, 3, 4}, y[] = {2, 1, 3, 4, 5}, tied[] = {1, 1, 2, 3, 4};
    assert_near(koksma__spearman(x, y, 5), koksma__spearman(tied, y, 5), 0);
    koksma__summary means[4], exact[4];
    const double n[] = {1, 10, 100, 1000};
    for (size_t i = 0; i < 4; i++) {
        const double m = 1 / n[i] * (i == 2 ? 1.5 : 1), values[] = {m, i == 2 ? m * (1 + tiny) : m, m};
        means[i] = koksma__summarize(values, 3, 1);
        exact[i] = koksma__exactly(m);
    }
    const koksma__trend t = koksma__trend_of(n, means, 4), u = koksma__trend_of(n, exact, 4);
    assert_near(t.slope.value, u.slope.value, 1e-12);
    assert_near(t.slope.high, u.slope.high, 1e-12);
    assert_true(t.slope.high > t.slope.value + 0.1 && !t.off_line);
}

TEST_CASE(correlations_by_hand)
{
    const double x[] = {1, 2, 3, 4, 5}, y[] = {2, 1, 4, 3, 5}, tied[] = {1, 1, 2, 2, 3}, flat[] = {1, 1, 1, 1, 1};
    assert_near(koksma__spearman(x, y, 5), 1 - 6 * 4.0 / (5 * 24), 1e-15); /* 1 - 6 sum d^2 / n (n^2 - 1) */
    assert_near(koksma__spearman(x, x, 5), 1, 1e-15);
    assert_near(koksma__spearman(x, tied, 5), 9 / sqrt(10 * 9.0), 1e-15); /* ranks 1.5 1.5 3.5 3.5 5 */
    assert_true(isnan(koksma__spearman(x, flat, 5)) && isnan(koksma__spearman(flat, x, 5)));
}

/* The mean of the correlations over all orders is 0, of their squares 1/(n-1). */
/* One-sided critical values at 5 % and 1 % (Zar 1984, table B.20): at every n the first sum of squares beyond them is not
   significant any more. */
TEST_CASE(spearman_has_its_exact_limits)
{
    static const struct {
        size_t n;
        double alpha, limit;
    } table[] = {{4, .05, 1.000}, {5, .05, .900},  {6, .05, .829}, {7, .05, .714}, {8, .05, .643}, {9, .05, .600},
                 {10, .05, .564}, {5, .01, 1.000}, {6, .01, .943}, {7, .01, .893}, {8, .01, .833}, {30, .05, .306}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        assert_near(koksma__spearman_limit(table[i].n, table[i].alpha), table[i].limit, 0.0006);
    }
    assert_true(isnan(koksma__spearman_limit(3, .05)) && isnan(koksma__spearman_limit(1, .05)));
}

TEST_CASE(correlations_over_all_orders)
{
    const double x[] = {1, 2, 3, 4, 5};
    double sums[2] = {0};
    int orders = 0;
    for (int code = 0; code < 3125; code++) {
        double y[5];
        int used = 0;
        for (int i = 0, rest = code; i < 5; i++, rest /= 5) {
            y[i] = rest % 5;
            used |= 1 << rest % 5;
        }
        if (used == 31) {
            const double rho = koksma__spearman(x, y, 5);
            sums[0] += rho;
            sums[1] += rho * rho;
            orders++;
        }
    }
    assert_int_equal(orders, 120);
    assert_near(sums[0], 0, 1e-12);
    assert_near(sums[1] / 120, 1.0 / 4, 1e-12);
}

TEST_CASE(bootstrap_intervals)
{
    double values[400], y[400];
    const koksma__means x = {values, NULL, 0}, of_y = {y, NULL, 0};
    koksma__estimate e, again;
    for (uint64_t i = 0; i < 400; i++) {
        values[i] = normal(5, i);
        y[i] = values[i] + 0.1 * normal(6, i);
    }
    assert_ok(koksma__bootstrap_pairs(&x, &of_y, 100, 500, 3, NULL, NULL, &e));
    assert_true(e.low < e.value && e.value < e.high && e.low > 0.95 && e.high <= 1);
    assert_ok(koksma__bootstrap_pairs(&x, &of_y, 100, 500, 3, NULL, NULL, &again));
    assert_true(e.low == again.low && e.high == again.high);
    for (size_t n = 1; n < 7; n++) { /* too few to say that it isn't 0 */
        assert_ok(koksma__bootstrap_pairs(&x, &x, n, 500, 3, NULL, NULL, &e));
        assert_true(e.low == -1 && e.high == 1);
    }
    assert_ok(koksma__bootstrap_pairs(&x, &x, 7, 500, 3, NULL, NULL, &e));
    assert_true(e.value == 1 && e.low == 1);
}

/* Means that are not sure of their order have no sure correlation; equal seeds draw equal noise. */
TEST_CASE(bootstrap_redraws_means)
{
    double mean[9], wide[9], narrow[9], values[500], again[500];
    for (size_t i = 0; i < 9; i++) {
        mean[i] = (double)i;
        wide[i] = 1;
        narrow[i] = 1e-6;
    }
    const koksma__means sure = {mean, narrow, 1}, x = {mean, wide, 1}, y = {mean, wide, 2}, exact = {mean, NULL, 0};
    koksma__estimate e;
    assert_ok(koksma__bootstrap_pairs(&exact, &sure, 9, 500, 3, NULL, NULL, &e));
    assert_true(e.value == 1 && e.low == 1 && e.high == 1);
    assert_ok(koksma__bootstrap_pairs(&x, &y, 9, 500, 3, NULL, values, &e));
    assert_true(e.value == 1 && e.low > 0.3 && e.low < 0.9 && e.high <= 1);
    assert_ok(koksma__bootstrap_pairs(&x, &y, 9, 500, 3, NULL, again, &e));
    assert_memory_equal(values, again, sizeof values);
    assert_ok(koksma__bootstrap_pairs(&x, &x, 9, 500, 3, NULL, NULL, &e));
    assert_true(e.low == 1); /* the same means with the same noise */
}

/* Two measures of which one has the order of the errors, the other two neighbours exchanged, or half of it. */
TEST_CASE(correlations_told_apart)
{
    double errors[16], near[16], far[16], draws[3][500];
    koksma__estimate rho[3], e;
    for (size_t i = 0; i < 16; i++) {
        errors[i] = (double)i;
        near[i] = (double)(i == 3 ? 4 : i == 4 ? 3 : i);
        far[i] = i % 2 ? (double)i : 15 - (double)i;
    }
    const koksma__means y = {errors, NULL, 0}, x[] = {{errors, NULL, 0}, {near, NULL, 0}, {far, NULL, 0}};
    for (size_t m = 0; m < 3; m++) {
        assert_ok(koksma__bootstrap_pairs(&x[m], &y, 16, 500, 3, NULL, draws[m], &rho[m]));
    }
    const koksma__draws first = {2 * rho[0].value, 2, draws[0]}, second = {2 * rho[1].value, 2, draws[1]},
                        third = {rho[2].value, 1, draws[2]};
    assert_ok(koksma__bootstrap_difference(&first, &second, 500, &e));
    assert_near(e.value, 2 * (1 - rho[1].value), 1e-15);
    assert_true(e.low == 0 && e.high > e.value && e.high < 0.1); /* in some resamples neither of the two is */
    assert_ok(koksma__bootstrap_difference(&first, &third, 500, &e));
    assert_true(e.low > 0.5);
}

/* Of 10 pairs without correlation the interval excludes 0 in about 5 % of cases. */
TEST_CASE(bootstrap_covers)
{
    int excluded = 0;
    for (uint64_t t = 0; t < 400; t++) {
        double x[10], y[10];
        koksma__estimate e;
        for (uint64_t i = 0; i < 10; i++) {
            x[i] = normal(t, i);
            y[i] = normal(t, 100 + i);
        }
        const koksma__means of_x = {x, NULL, 0}, of_y = {y, NULL, 0};
        assert_ok(koksma__bootstrap_pairs(&of_x, &of_y, 10, 300, t, NULL, NULL, &e));
        excluded += e.low > 0 || e.high < 0;
    }
    assert_in_range(excluded, 4, 44);
}

TEST_CASE(summaries_of_few)
{
    const double values[] = {2, 3, 4};
    const koksma__summary s = koksma__summarize(values, 3, 1);
    assert_near(s.mean, 3, 0);
    assert_near(s.sd, 1, 1e-15);
    assert_near(s.high, 3 + 4.302652729749464 / sqrt(3), 1e-12);
    const koksma__summary one = koksma__summarize(values, 1, 1);
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

TEST_CASE(relative_changes)
{
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
TEST_CASE(samples_for_an_error)
{
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

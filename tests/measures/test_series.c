/* SPDX-License-Identifier: Apache-2.0 */
/* Tallies and slopes by hand, prefixes against single sets, exponents of theory against fitted ones. */
#include <koksma/series.h>

#include "test.h"

TEST_CASE(tally_by_hand)
{
    static const double values[] = {1e9 + 1, 1e9 + 2, 1e9 + 3, 1e9 + 6};
    koksma_tally t = {0};
    assert_true(isnan(koksma_tally_sd(&t)));
    for (int i = 0; i < 4; i++) {
        koksma_tally_add(&t, values[i]);
    }
    assert_near(t.mean, 1e9 + 3, 0);
    assert_near(koksma_tally_sd(&t), sqrt(14.0 / 3), 1e-6);
    assert_near(koksma_tally_error(&t), sqrt(14.0 / 12), 1e-6);
    assert_near(koksma_tally_interval(&t), koksma_student_975(3) * sqrt(14.0 / 12), 1e-6);
    assert_true(t.min == values[0] && t.max == values[3] && t.count == 4);
}

TEST_CASE(slopes_by_hand)
{
    double xs[6] = {1, 2, 4, 8, 16, 0}, ys[6];
    koksma_line line;
    for (int i = 0; i < 6; i++) {
        ys[i] = 3 * pow(xs[i], -0.75);
    }
    assert_true(koksma_log_line(6, xs, ys, &line)); /* the last pair is not used */
    assert_int_equal(line.count, 5);
    assert_near(line.slope, -0.75, 1e-14);
    assert_near(line.intercept, log(3), 1e-14);
    assert_near(line.slope_error, 0, 1e-7);
    /* Residuals +d, -d, 0, 0, 0 times weights: by the formula of least squares. */
    const double d = 0.01;
    ys[0] *= exp(d);
    assert_true(koksma_log_line(5, xs, ys, &line));
    assert_near(line.slope, -0.75 - 2 * d / (10 * log(2)), 1e-14); /* x in units of log 2: -2 .. 2 */
    assert_near(line.slope_error, sqrt(d * d * (1 - 0.2 - 0.4) / 3 / 10) / log(2), 1e-9);
    assert_false(koksma_log_line(2, xs, ys, &line));
    const double same[3] = {4, 4, 4};
    assert_false(koksma_log_line(3, same, ys, &line));
    assert_true(isnan(line.slope));
}

TEST_CASE(prefixes_are_sets)
{
    static const size_t sizes[] = {1, 7, 64, 100};
    koksma_points p = test_points("sobol", 100, 2, 0);
    koksma_spec measure;
    koksma_value values[4];
    assert_ok(koksma_measure_spec("l2-star", &measure));
    assert_ok(koksma_evaluate_prefixes(&measure, &p, sizes, 4, NULL, values));
    for (int i = 0; i < 4; i++) {
        const koksma_points prefix = {sizes[i], 2, p.xs};
        assert_near(values[i].value, test_measure("l2-star", &prefix).value, 0);
    }
    const size_t beyond[] = {16, 101};
    assert_int_equal(koksma_evaluate_prefixes(&measure, &p, beyond, 2, NULL, values), KOKSMA_N);
    koksma_points_fini(&p);
}

static double rate_of(const char *pattern, const char *measure, int dim)
{
    koksma_spec spec;
    assert_ok(koksma_pattern_spec(pattern, &spec));
    return koksma_rate(&spec, koksma_measure_find(measure), dim);
}

TEST_CASE(rates_by_hand)
{
    assert_near(rate_of("random", "star", 2), 0.5, 0);
    assert_near(rate_of("jittered", "l2-edge", 2), 0.75, 0);
    assert_near(rate_of("jittered", "l2-star", 3), 0.5 + 1.0 / 6, 1e-15);
    assert_near(rate_of("regular", "l2-star", 2), 0.5, 0);
    assert_near(rate_of("sobol", "star", 2), 1, 0);
    assert_near(rate_of("n-rooks", "l2-disk", 2), 0.5, 0);
    assert_true(isnan(rate_of("sobol", "l2-edge", 2)) && isnan(rate_of("random", "min-distance", 2)));
    assert_near(koksma_best_rate(koksma_measure_find("edge"), 3), 2.0 / 3, 1e-15);
    /* the columns don't become narrower */
    assert_near(rate_of("jittered:columns=2", "l2-edge", 2), 0.5, 0);
    assert_true(isnan(rate_of("multi-jittered", "star", 2)));
    assert_true(isnan(rate_of("regular:columns=2", "star", 2)) &&
                isnan(rate_of("half-jittered:columns=2", "star", 2)));
}

/* The exponent that theory gives is met by points, within what logarithms and few sizes allow, and does not beat the
   best. */
static void assert_rate_is_met(const char *pattern, bool takes_path, const char *measure, bool measured)
{
    static const double sizes[] = {64, 256, 1024, 4096};
    const double rate = takes_path ? (double)NAN : rate_of(pattern, measure, 2);
    assert_true(isnan(rate) || rate <= koksma_best_rate(koksma_measure_find(measure), 2));
    if (isnan(rate) || !measured) {
        return;
    }
    double means[4] = {0};
    for (int s = 0; s < 4; s++) {
        for (uint64_t seed = 0; seed < 4; seed++) {
            koksma_points p = test_points(pattern, (size_t)sizes[s], 2, seed);
            means[s] += test_measure(measure, &p).value / 4;
            koksma_points_fini(&p);
        }
    }
    koksma_line line;
    assert_true(koksma_log_line(4, sizes, means, &line));
    /* log n / n falls as n^(-1 + 1/log n) */
    if (!(line.slope < -rate + (rate < 1 ? 0.1 : 0.25) && line.slope > -rate - 0.1)) {
        print_error("%s, %s: slope %g, theory -%g\n", pattern, measure, line.slope, rate);
        fail();
    }
}

TEST_CASE(rates_are_met)
{
    static const char *const measures[] = {"l2-star", "star", "l2-extreme", "l2-edge", "l2-disk"};
    static const char *const narrow[] = {"jittered:columns=2",         "regular:columns=4",
                                         "multi-jittered:columns=2",   "half-jittered:columns=4",
                                         "uniform-jittered:columns=2", "correlated-multi-jittered:columns=2"};
    for (int m = 0; m < 5; m++) {
        for (size_t i = 0; koksma_pattern_at(i); i++) {
            assert_rate_is_met(koksma_pattern_at(i)->name, koksma_pattern_at(i)->operand, measures[m], m < 3);
        }
        for (size_t i = 0; i < sizeof narrow / sizeof *narrow; i++) {
            assert_rate_is_met(narrow[i], false, measures[m], m < 3);
        }
    }
}

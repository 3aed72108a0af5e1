/* SPDX-License-Identifier: Apache-2.0 */
/* Estimators and intervals against hand-made numbers, their formulas and their coverage; integration to a tolerance. */
#include <koksma/estimate.h>
#include <koksma/integrate.h>
#include <string.h>

#include "test.h"

static koksma_integral_estimate estimate(const char *estimator, const char *interval, double confidence,
                                         double lowest, double highest, const double *values, size_t n)
{
    koksma_integral_estimate e;
    const koksma_estimate_options o = {estimator, interval, confidence, lowest, highest, 0};
    assert_ok(koksma_estimate_integral(&o, values, n, NULL, &e));
    return e;
}

TEST_CASE(estimators_are_their_formulas)
{
    const double six[] = {5, 1, 9, 3, 7, 2}, nine[] = {0, 10, 2, 1, 20, 4, 2, 60, 100};
    const struct {
        const char *name;
        double six, nine;
    } known[] = {
        {"mean", 4.5, 199 / 9.0},
        {"median", 4, 4},
        {"median-of-means", 4.5, 30}, /* one group of 6; groups 0 1 2, 10 20 60 and 2 4 100 with means 1, 30, 106/3 */
        {"trimmed", 4.25, 38 / 5.0},  /* without 1 and 9; without 0, 1 and 60, 100 */
    };
    size_t count = 0;
    for (; koksma_estimator_at(count); count++) {
    }
    assert_int_equal(count, sizeof known / sizeof *known);
    for (size_t i = 0; i < count; i++) {
        assert_near(estimate(known[i].name, "student", 0, 0, 0, six, 6).value, known[i].six, 1e-14);
        assert_near(estimate(known[i].name, "student", 0, 0, 0, nine, 9).value, known[i].nine, 1e-13);
    }
}

/* Student: t of 4 degrees is 2.776445. Order statistics: 2 P(B <= 3) = .0352 for B of Binomial(15, 1/2), and 2 P(B <= 4)
   = .118, so that y_(4) and y_(12) are the interval of 15 values; of 6 values it has all, of 5 there is none. */
TEST_CASE(intervals_are_their_formulas)
{
    const double five[] = {3, 1, 5, 2, 4};
    koksma_integral_estimate e = estimate("mean", NULL, 0, 0, 0, five, 5);
    assert_near(e.value, 3, 1e-15);
    assert_near(e.high - 3, 2.7764451052 * sqrt(2.5 / 5), 1e-9);
    assert_near(e.low, 6 - e.high, 1e-14);
    assert_near(e.error, e.high - 3, 1e-14);
    assert_near(e.confidence, 0.95, 1e-15);
    double values[15];
    for (size_t i = 0; i < 15; i++) {
        values[i] = (double)(i * 4 % 15 + 1);
    }
    e = estimate("median", NULL, 0.95, 0, 0, values, 15);
    assert_near(e.value, 8, 0);
    assert_near(e.low, 4, 0);
    assert_near(e.high, 12, 0);
    e = estimate("median", "quantile", 0.95, 0, 0, values, 6);
    assert_near(e.low, 1, 0);
    assert_near(e.high, 13, 0);
    const koksma_estimate_options o = {.estimator = "median"};
    assert_int_equal(koksma_estimate_integral(&o, values, 5, NULL, &e), KOKSMA_ARGUMENT);
    assert_non_null(strstr(koksma_error_text(), "takes 6"));
}

/* Most values near 3 and two far off: the median, if they differ by less than .7 of a point's share; else, and for values
   spread evenly, the mean. */
TEST_CASE(auto_takes_the_median_of_heavy_tails)
{
    double tails[15], even[15];
    for (size_t i = 0; i < 15; i++) {
        tails[i] = 3 + 1e-4 * (double)i + (i == 4 ? 50 : i == 9 ? -20 : 0);
        even[i] = (double)i;
    }
    koksma_integral_estimate e;
    koksma_estimate_options o = {.share = 71 / 0.7};
    assert_ok(koksma_estimate_integral(&o, tails, 15, NULL, &e));
    assert_string_equal(e.estimator, "median");
    assert_string_equal(e.interval, "quantile");
    assert_near(e.value, 3.0007, 1e-3);
    assert_ok(koksma_estimate_integral(&o, even, 15, NULL, &e));
    assert_string_equal(e.estimator, "mean");
    assert_string_equal(e.interval, "student");
    assert_near(e.high, estimate("mean", "student", 0.975, 0, 0, even, 15).high, 1e-12); /* half of the risk */
    o.share = 69 / 0.7;
    assert_ok(koksma_estimate_integral(&o, tails, 15, NULL, &e));
    assert_string_equal(e.estimator, "mean");
    o.share = -1;
    assert_int_equal(koksma_estimate_integral(&o, tails, 15, NULL, &e), KOKSMA_ARGUMENT);
}

/* The formulas of Waudby-Smith & Ramdas once more, term by term, for values of a range from 10 to 30. */
TEST_CASE(bounded_intervals_are_their_formulas)
{
    const double x[] = {0.2, 0.9, 0.4, 0.35, 0.5, 0.1, 0.6, 0.45, 0.3, 0.7};
    enum { N = sizeof x / sizeof *x };
    double y[N], stake[N], before[N];
    const double level = log(2 / 0.1);
    for (size_t i = 0; i < N; i++) {
        double sum = 0.5, squares = 0.25;
        for (size_t k = 0; k < i; k++) {
            sum += x[k];
            squares += pow(x[k] - sum / (double)(k + 2), 2);
        }
        before[i] = sum / (double)(i + 1);
        stake[i] = sqrt(2 * level / (N * squares / (double)(i + 1)));
        y[i] = 10 + 20 * x[i];
    }
    double stakes = 0, mean = 0, spread = 0;
    for (size_t i = 0; i < N; i++) {
        const double l = fmin(stake[i], 0.5);
        stakes += l;
        mean += l * x[i];
        spread += 4 * pow(x[i] - before[i], 2) * (-log(1 - l) - l) / 4;
    }
    koksma_integral_estimate e = estimate("mean", "empirical-bernstein", 0.9, 10, 30, y, N);
    const double half = (level + spread) / stakes;
    assert_near(e.low, 10 + 20 * fmax(mean / stakes - half, 0), 1e-11);
    assert_near(e.high, 10 + 20 * fmin(mean / stakes + half, 1), 1e-11);
    e = estimate("mean", "betting", 0.9, 10, 30, y, N);
    const double ends[] = {(e.low - 10) / 20, (e.high - 10) / 20};
    for (int side = 0; side < 2; side++) {
        const double sign = side ? -1 : 1;
        for (int outside = 0; outside < 2; outside++) {
            const double m = ends[side] + (outside ? -sign : sign) * 1e-6;
            double capital = 1, most = 1;
            for (size_t i = 0; i < N; i++) {
                capital *= 1 + sign * fmin(stake[i], 0.75 / (side ? 1 - m : m)) * (x[i] - m);
                most = fmax(most, capital);
            }
            assert_true((most >= 2 / 0.1) == outside);
        }
    }
}

/* Independent values of a law with mean 1/3 on [0,1], which is 1 in one of three. Those that are proved hold in 95 % or
   more of the runs; the others come near for 60 values; none is so wide that it says nothing. */
TEST_CASE(intervals_cover)
{
    enum { N = 60 };
    const size_t runs = test_repeats(400, 10);
    koksma_points u = test_points("random", runs * N, 1, 5);
    const koksma_interval *interval;
    for (size_t i = 0; (interval = koksma_interval_at(i)); i++) {
        if (!strcmp(interval->name, "quantile")) {
            continue; /* of the median, which is 0 */
        }
        size_t covered = 0;
        double width = 0;
        for (size_t run = 0; run < runs; run++) {
            double values[N];
            for (size_t k = 0; k < N; k++) {
                values[k] = u.xs[run * N + k] < 1.0 / 3;
            }
            const koksma_integral_estimate e = estimate("mean", interval->name, 0.95, 0, 1, values, N);
            covered += e.low <= 1.0 / 3 && e.high >= 1.0 / 3;
            width += (e.high - e.low) / (double)runs;
        }
        const double least = interval->proved ? 0.95 : 0.91, noise = 4 * sqrt(0.05 * 0.95 / (double)runs);
        assert_that((double)covered >= (least - noise) * (double)runs && width <= 0.6 && width >= 0.2,
                    "%s covers in %zu of %zu runs, mean width %g", interval->name, covered, runs, width);
    }
    koksma_points_fini(&u);
}

/* ---- A tolerance ------------------------------------------------------------------------------------------------- */

typedef struct call {
    size_t points, calls;
    double (*at)(const double *x, int dim);
    koksma_status status;
} call;

static koksma_status values_of(void *context, const koksma_points *points, double *values)
{
    call *c = context;
    for (size_t i = 0; i < points->n; i++) {
        values[i] = c->at(points->xs + i * (size_t)points->dim, points->dim);
    }
    c->points += points->n;
    c->calls++;
    return c->status;
}

static double exponential(const double *x, int dim)
{
    return dim > 1 ? exp(x[0] + x[1]) : exp(x[0]);
}

static double kink(const double *x, int dim)
{
    (void)dim;
    return fabs(x[0] - 0.3) + x[1];
}

static double needle(const double *x, int dim)
{
    (void)dim;
    return x[0] < 1e-12 ? 1 : 0;
}

static koksma_status integrate(call *c, const char *pattern, const koksma_tolerance_options *o, const koksma_run *run,
                               koksma_tolerance *t)
{
    koksma_spec spec;
    assert_ok(koksma_pattern_spec(pattern, &spec));
    return koksma_integrate_to(values_of, c, 2, &spec, o, run, t);
}

TEST_CASE(errors_are_within_the_tolerance)
{
    const double truth = pow(exp(1) - 1, 2);
    const struct {
        const char *pattern, *estimator;
        double tolerance;
    } cases[] = {{"sobol:scramble=lms,digital-shift=1", "median", 1e-6},
                 {"sobol:scramble=owen", "mean", 1e-4},
                 {"n-rooks", "trimmed", 0.05},
                 {"halton:shift=1", "median-of-means", 1e-3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        call c = {.at = exponential};
        koksma_tolerance one, three;
        const koksma_tolerance_options o = {
            .estimate.estimator = cases[i].estimator, .absolute = cases[i].tolerance, .first_n = 64, .seed = 3};
        assert_ok(integrate(&c, cases[i].pattern, &o, &(koksma_run){.threads = 1}, &one));
        assert_ok(integrate(&(call){.at = exponential}, cases[i].pattern, &o, &(koksma_run){.threads = 3}, &three));
        assert_memory_equal(one.steps, three.steps, sizeof one.steps);
        const koksma_tolerance_step *last = &one.steps[one.n_steps - 1];
        assert_true(one.reached && last->estimate.error <= cases[i].tolerance);
        assert_near(last->estimate.value, truth, cases[i].tolerance);
        size_t sum = 0; /* a sequence is extended; n-rooks begins anew */
        for (size_t k = 0; k < one.n_steps; k++) {
            assert_int_equal(one.steps[k].n, 64 << k);
            sum += 15 * one.steps[k].n;
        }
        assert_int_equal(last->points, c.points);
        assert_int_equal(c.points, strcmp(cases[i].pattern, "n-rooks") ? 15 * last->n : sum);
        assert_true(c.calls < 2 * one.n_steps + c.points / 30000);
    }
}

static double step_at_a_third(const double *x, int dim)
{
    (void)dim;
    return x[0] < 1.0 / 3 ? 1 : 0;
}

/* Independent points: the error falls as n^-1/2, the slowest of unbiased sets, and a step after the other may end the
   search too early. Of 2,000 searches of 95 % at most 100 may err, and so may 20 of 99 %, plus three standard deviations;
   tolerances are spread over a factor of 2, so that none is the best for the steps. */
TEST_CASE(searches_hold_whenever_they_end)
{
    const int runs = test_repeats(2000, 20);
    const size_t replicates[] = {6, 15, 40};
    for (size_t k = 0; k < 3; k++) {
        int wrong = 0, strictly = 0;
        for (int run = 0; run < runs; run++) {
            koksma_tolerance t;
            koksma_tolerance_options o = {.replicates = replicates[k],
                                          .most_points = replicates[k] << 12,
                                          .first_n = 16,
                                          .seed = 100 * (uint64_t)run,
                                          .estimate.interval = run % 2 ? "student" : "auto",
                                          .absolute =
                                              0.02 * sqrt(15.0 / (double)replicates[k]) * (1 + run / (double)runs)};
            o.estimate.interval = replicates[k] < 15 ? "student" : o.estimate.interval;
            for (int strict = 0; strict < 2; strict++) {
                o.estimate.confidence = strict ? 0.99 : 0.95;
                assert_ok(integrate(&(call){.at = step_at_a_third}, "random", &o, NULL, &t));
                assert_true(t.reached);
                *(strict ? &strictly : &wrong) += fabs(t.steps[t.n_steps - 1].estimate.value - 1.0 / 3) > o.absolute;
            }
        }
        assert_true(wrong <= 0.05 * runs + 3 * sqrt(0.0475 * runs));
        assert_true(strictly <= 0.01 * runs + 3 * sqrt(0.0099 * runs));
    }
}

/* By default the sets are the parts of one: the estimate is the mean of all its points, the interval Student's of the means
   of eight runs of consecutive points; t of 7 degrees is 2.364624. A check of 256 points with the next seed is inside its
   prediction interval here. Named estimators have independent sets. */
TEST_CASE(parts_of_one_set_are_the_default)
{
    enum { N = 8 * 256, SEED = 5 };
    const char *const patterns[] = {"sobol:scramble=lms,digital-shift=1", "sobol:scramble=owen"};
    for (size_t p = 0; p < 2; p++) {
        koksma_tolerance t;
        koksma_tolerance_options o = {.seed = SEED, .most_points = N + 256};
        call c = {.at = kink};
        assert_ok(integrate(&c, patterns[p], &o, NULL, &t));
        assert_true(t.parts && t.replicates == 8 && t.n_steps == 3 && c.points == N + 256);
        koksma_points points = test_points(patterns[p], N, 2, SEED);
        double means[8] = {0}, all = 0, squares = 0;
        for (size_t i = 0; i < N; i++) {
            means[i / 256] += kink(points.xs + 2 * i, 2) / 256;
            all += kink(points.xs + 2 * i, 2) / N;
        }
        for (size_t r = 0; r < 8; r++) {
            squares += (means[r] - all) * (means[r] - all);
        }
        const koksma_integral_estimate *e = &t.steps[2].estimate;
        assert_near(e->value, all, 1e-13);
        assert_near(e->error / (2.3646242510 * sqrt(squares / 7 / 8)), 1, 1e-6);
        koksma_points_fini(&points);
        o.estimate.interval = "student";
        o.most_points = 0;
        o.absolute = 1;
        assert_ok(integrate(&c, patterns[p], &o, NULL, &t));
        assert_true(!t.parts && t.replicates == 15);
    }
    koksma_tolerance t;
    assert_ok(integrate(&(call){.at = kink}, "random", &(koksma_tolerance_options){.absolute = 1}, NULL, &t));
    assert_true(!t.parts && t.replicates == 15);
}

/* Of one scrambled net of eight parts: the true error is within the interval in 95 % of the runs or more, for a function
   that is smooth, one with a kink, one with a jump. */
TEST_CASE(parts_cover)
{
    const int runs = test_repeats(1000, 20);
    const struct {
        double (*at)(const double *x, int dim);
        double truth;
    } functions[] = {{exponential, 2.9524924420125598}, {kink, 0.79}, {step_at_a_third, 1.0 / 3}};
    for (size_t f = 0; f < 3; f++) {
        int held = 0;
        for (int run = 0; run < runs; run++) {
            koksma_tolerance t;
            const koksma_tolerance_options o = {.seed = (uint64_t)run, .most_points = 576};
            assert_ok(integrate(&(call){.at = functions[f].at}, "sobol:scramble=lms,digital-shift=1", &o, NULL, &t));
            const koksma_integral_estimate *e = &t.steps[0].estimate;
            held += fabs(e->value - functions[f].truth) <= e->error;
        }
        assert_true(held >= 0.95 * runs - 3 * sqrt(0.0475 * runs));
    }
}

static double valley(const double *x, int dim)
{
    (void)dim;
    return fabs(4 * x[0] - 2) * fabs(4 * x[1] - 2);
}

/* Of |4x - 2| |4y - 2| most linear scramblings integrate all but nothing wrongly, and some all parts alike: only the check
   shows those. */
TEST_CASE(a_check_finds_what_parts_share)
{
    const int runs = test_repeats(1000, 20);
    int wrong = 0;
    for (int run = 0; run < runs; run++) {
        koksma_tolerance t;
        const koksma_tolerance_options o = {.seed = 2 * (uint64_t)run, .absolute = 1e-4};
        assert_ok(integrate(&(call){.at = valley}, "sobol:scramble=lms,digital-shift=1", &o, NULL, &t));
        const koksma_tolerance_step *last = &t.steps[t.n_steps - 1];
        assert_true(t.reached && last->points == 9 * last->n);
        wrong += fabs(last->estimate.value - 1) > 1e-4;
    }
    assert_true(wrong <= 0.02 * runs + 3 * sqrt(0.02 * runs)); /* 68 of 1,000 without the check */
}

static bool stops(void *context, double fraction)
{
    (void)fraction;
    return --*(int *)context > 0;
}

/* Ended by its limit or interrupted, a search continues bit for bit; another function, seed or text is refused. */
TEST_CASE(searches_resume)
{
    const char *const patterns[] = {"sobol:scramble=owen", "n-rooks"}, *const estimators[] = {NULL, "median"};
    const char *file = "search.txt"; /* tests run in a folder of their own */
    for (size_t p = 0; p < 4; p++) {
        koksma_tolerance whole, part, rest;
        koksma_tolerance_options o = {
            .absolute = p % 2 ? 2e-3 : 1e-5, .seed = 9, .estimate.estimator = estimators[p / 2]};
        remove(file);
        assert_ok(integrate(&(call){.at = exponential}, patterns[p % 2], &o, NULL, &whole));
        assert_true(whole.reached && whole.n_steps > 2);
        o.resume = file;
        o.most_points = (whole.replicates + whole.parts) * whole.steps[1].n;
        assert_ok(integrate(&(call){.at = exponential}, patterns[p % 2], &o, NULL, &part));
        assert_true(!part.reached && part.n_steps == 2);
        o.most_points = 0;
        int calls = 25;
        const koksma_status status = integrate(&(call){.at = exponential}, patterns[p % 2], &o,
                                               &(koksma_run){.keep_going = stops, .context = &calls}, &part);
        assert_true(status == KOKSMA_OK || status == KOKSMA_INTERRUPTED);
        call c = {.at = exponential};
        assert_ok(integrate(&c, patterns[p % 2], &o, NULL, &rest));
        assert_int_equal(rest.n_steps, whole.n_steps);
        assert_memory_equal(rest.steps, whole.steps, whole.n_steps * sizeof *whole.steps);
        assert_near(rest.rate, whole.rate, 0);
        assert_true(c.points < whole.steps[whole.n_steps - 1].points);
        c.points = 0;
        assert_ok(integrate(&c, patterns[p % 2], &o, NULL, &rest));
        assert_int_equal(c.points, 1);
        assert_int_equal(integrate(&(call){.at = kink}, patterns[p % 2], &o, NULL, &rest), KOKSMA_ARGUMENT);
        assert_non_null(strstr(koksma_error_text(), "search.txt:5: the search in this file has 'first value"));
        o.seed++;
        assert_int_equal(integrate(&c, patterns[p % 2], &o, NULL, &rest), KOKSMA_ARGUMENT);
        o.seed--;
        FILE *stream = fopen(file, "r+");
        fseek(stream, -3, SEEK_END);
        fputc('x', stream);
        fclose(stream);
        assert_int_equal(integrate(&c, patterns[p % 2], &o, NULL, &rest), KOKSMA_MALFORMED);
        remove(file);
    }
}

/* Without a tolerance all steps are done; the rate of the mean over Owen's scrambling
   of a function with a kink in a coordinate is near -3/2, and the prediction of what a smaller error needs follows it. */
TEST_CASE(a_limit_ends_the_search)
{
    call c = {.at = kink};
    koksma_tolerance t;
    koksma_tolerance_options o = {
        .estimate.estimator = "mean", .replicates = 40, .most_points = 40 << 12, .first_n = 256};
    assert_ok(integrate(&c, "sobol:scramble=owen", &o, NULL, &t));
    assert_false(t.reached);
    assert_int_equal(t.n_steps, 5);
    assert_near(t.steps[0].estimate.confidence, 0.95, 1e-14);
    o.replicates = 5; /* too few for the confidence in each step: the 8 that the limit allows share it */
    assert_ok(integrate(&c, "sobol:scramble=owen", &o, NULL, &t));
    assert_int_equal(t.n_steps, 8);
    assert_near(t.steps[0].estimate.confidence, 1 - 0.05 / 8, 1e-14);
    o.replicates = 40;
    assert_ok(integrate(&c, "sobol:scramble=owen", &o, NULL, &t));
    assert_near(t.rate, -1.5, 0.3);
    assert_true(isnan(t.needed));
    o.absolute = 1e-9;
    assert_ok(integrate(&c, "sobol:scramble=owen", &o, NULL, &t));
    const double factor = pow(t.steps[4].estimate.error / 1e-9, -1 / t.rate);
    assert_near(t.needed / (40 << 12) / factor, 1, 1e-9);
    assert_true(t.needed_low < t.needed && t.needed < t.needed_high);
    o.absolute = 0;
    o.relative = 1e-3;
    assert_ok(integrate(&c, "sobol:scramble=owen", &o, NULL, &t));
    assert_true(t.reached && t.steps[t.n_steps - 1].estimate.error <= 1e-3 * 0.79);
}

static double step(const double *x, int dim)
{
    (void)dim;
    return x[0] < 0.001 ? 1 : 0;
}

/* Of 256 points of each set none or one is below .001: sets may all have the same, but the error is not 0. */
TEST_CASE(equal_estimates_have_an_error)
{
    for (uint64_t seed = 0; seed < 40; seed++) {
        koksma_tolerance t;
        const koksma_tolerance_options o = {.replicates = 8, .most_points = 8 * 256, .seed = seed, .absolute = 1e-4};
        assert_ok(integrate(&(call){.at = step}, "sobol:scramble=owen", &o, NULL, &t));
        const koksma_integral_estimate *e = &t.steps[0].estimate;
        assert_true(e->low <= e->value && e->value <= e->high && (e->error > 1e-4 || e->value == 0) && !t.reached);
    }
}

/* All values 0 at first: the interval [0,0] is no answer. */
TEST_CASE(equal_values_end_no_search_at_once)
{
    call c = {.at = needle};
    koksma_tolerance t;
    const koksma_tolerance_options o = {.absolute = 1e-3, .first_n = 16};
    assert_ok(integrate(&c, "random", &o, NULL, &t));
    assert_true(t.reached && c.points >= 1 << 16 && c.points < 1 << 18);
}

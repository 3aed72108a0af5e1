/* SPDX-License-Identifier: Apache-2.0 */
/* Errors of integration over trials and sizes, functions of a caller, and what is refused; the integrands themselves are
   tested by test_every_integrand.c. */

#include "integrands/integrands.h"
#include "test.h"

/* ---- Errors over trials ------------------------------------------------------------------------------------------ */

/* Random points: E of the squared error is variance / n, the slope -1/2. */
TEST_CASE(random_points_have_gain_one)
{
    koksma_integral *f;
    koksma_spec pattern;
    koksma_integration one, three;
    const koksma_integration_options options = {.sizes = {16, 64, 256, 1024}, .n_sizes = 4, .seed = 9, .trials = 400};
    assert_ok(koksma_integral_open("quarter-gaussian", 2, &f));
    assert_ok(koksma_pattern_spec("random", &pattern));
    const koksma_run threads[] = {{.threads = 1}, {.threads = 3}};
    assert_ok(koksma_integration_errors(f, &pattern, &options, &threads[0], &one));
    assert_ok(koksma_integration_errors(f, &pattern, &options, &threads[1], &three));
    assert_memory_equal(&one.slope, &three.slope, offsetof(koksma_integration_slope, approximate));
    assert_true(one.slope.approximate == three.slope.approximate);
    for (int i = 0; i < 4; i++) {
        assert_memory_equal(&one.rows[i], &three.rows[i], offsetof(koksma_integration_row, approximate));
        assert_true(one.rows[i].approximate == three.rows[i].approximate);
        assert_near(one.rows[i].gain, 1, 0.3);
        assert_true(one.rows[i].low < sqrt(f->variance / (double)one.rows[i].n) * 1.1);
        assert_true(one.rows[i].low < one.rows[i].rmse && one.rows[i].rmse < one.rows[i].high);
    }
    assert_true(one.slope.low < -0.5 && one.slope.high > -0.5 && one.slope.high - one.slope.low < 0.1);
    koksma_integral_close(f);
}

/* Rows of estimates that are made up: mean, deviation and RMSE by hand; an unknown integral; rounding. */
TEST_CASE(summaries_are_those_of_the_estimates)
{
    koksma_integration out;
    const koksma_integration_options options = {.sizes = {10, 100, 1000}, .n_sizes = 3, .trials = 2};
    const double estimates[] = {1.3, 0.99, 1.001, 0.9, 1.01, 0.999};
    assert_ok(koksma_integration_summary(1, 2, &options, estimates, &out));
    assert_near(out.rows[0].rmse, sqrt((0.09 + 0.01) / 2), 1e-14);
    assert_near(out.rows[0].mean, 1.1, 1e-14);
    assert_near(out.rows[0].sd, 0.2 * sqrt(2), 1e-14);
    assert_near(out.rows[0].gain, 2.0 / 10 / 0.05, 1e-11);
    assert_near(out.rows[0].z, 0.1 / 0.2, 1e-12);
    assert_true(isnan(out.rows[1].z)); /* the mean is right but for rounding */
    assert_near(out.rows[1].rmse, 0.01, 1e-14);
    assert_near(out.slope.value, log(0.001 / sqrt(0.05)) / log(100), 1e-12); /* the middle has no weight */
    assert_ok(koksma_integration_summary(NAN, NAN, &options, estimates, &out));
    assert_near(out.rows[0].rmse, out.rows[0].sd, 1e-14);
    assert_true(isnan(out.rows[0].gain) && isnan(out.rows[0].z));
    const double rounding[] = {1.3, 1.01, 1 + 1e-15, 0.9, 0.99, 1 - 1e-15};
    assert_ok(koksma_integration_summary(1, 2, &options, rounding, &out));
    assert_int_equal(out.slope.count, 0);
    assert_true(isnan(out.slope.value));
}

/* Estimates of mean 1 + d and deviation 1: a mean that is off by more than Student's t allows has no gain. The quantiles
   for 4 standard deviations, P = 6.334e-5 on both sides, are by the closed forms for one and two degrees. */
TEST_CASE(biased_estimates_have_no_gain)
{
    koksma_integration out;
    const double p = erfc(4 / sqrt(2));
    const struct {
        size_t trials;
        double least;
    } cases[] = {{2, 1 / tan(acos(-1) * p / 2)}, {3, sqrt(2 * (1 - p) * (1 - p) / (p * (2 - p)))}, {100000, 4.0005}};
    static double estimates[100000];
    for (size_t c = 0; c < 3; c++) {
        for (int side = 0; side < 4; side++) {
            const koksma_integration_options options = {.sizes = {1}, .n_sizes = 1, .trials = cases[c].trials};
            const double t = (double)cases[c].trials, z = (side & 1 ? 1.001 : 0.999) * cases[c].least;
            double square = 0, mean = 0;
            for (size_t i = 0; i < cases[c].trials; i++) {
                estimates[i] = i & 1 ? 1 : -1;
                mean += estimates[i] / t;
            }
            for (size_t i = 0; i < cases[c].trials; i++) {
                square += (estimates[i] - mean) * (estimates[i] - mean) / (t - 1);
            }
            const double off = (side & 2 ? -z : z) * sqrt(square / t);
            assert_ok(koksma_integration_summary(mean - off, 1, &options, estimates, &out));
            assert_near(out.rows[0].z, side & 2 ? -z : z, 1e-6 * z);
            assert_int_equal(isnan(out.rows[0].gain), side & 1);
        }
    }
}

/* Of 64 estimates that are 1 with probability .1 none or one may be by chance (p = .001, .01): no sign of bias, although
   z is large or infinite. */
TEST_CASE(rare_events_are_no_bias)
{
    koksma_integration out;
    const koksma_integration_options options = {.sizes = {1}, .n_sizes = 1, .trials = 64};
    double estimates[64] = {0};
    for (int hits = 0; hits < 2; hits++) {
        assert_ok(koksma_integration_summary(0.1, 0.1 * 0.9, &options, estimates, &out));
        assert_true(out.rows[0].z < (hits ? -4 : -1e9));
        assert_true(out.rows[0].gain > 0);
        estimates[hits] = 1;
    }
    assert_ok(koksma_integration_summary(0.5, 0.5 * 0.5, &options, estimates, &out)); /* 2 of 64 for a half: bias */
    assert_true(isnan(out.rows[0].gain));
}

/* ---- Functions of a caller, and what is refused ------------------------------------------------------------------ */

static double corner(const double *x, int dim, void *context)
{
    return x[0] * x[dim - 1] * *(const double *)context;
}

TEST_CASE(functions_of_a_caller)
{
    double factor = 4, mean, expected;
    koksma_integral *f, *g;
    koksma_integral_facts facts;
    const koksma_function function = {"mine", 2, 2, corner, &factor, NAN}, nameless = {"", 1, 1, corner, NULL, 0};
    assert_ok(koksma_integral_of_function(&function, 2, &f));
    koksma_integral_about(f, &facts);
    assert_string_equal(facts.text, "mine");
    assert_true(isnan(facts.value) && facts.axes == 2);
    koksma_points points = test_points("sobol", 4096, 2, 0);
    assert_ok(koksma_integral_open("bilinear", 2, &g));
    assert_ok(koksma_integrate(f, &points, NULL, &mean));
    assert_ok(koksma_integrate(g, &points, NULL, &expected));
    assert_near(mean, 4 * expected, 1e-13);
    koksma_points_fini(&points);
    koksma_integral_close(f);
    koksma_integral_close(g);
    assert_int_equal(koksma_integral_of_function(&function, 3, &f), KOKSMA_DIM);
    assert_int_equal(koksma_integral_of_function(&nameless, 1, &f), KOKSMA_ARGUMENT);
}

/* SPDX-License-Identifier: Apache-2.0 */
/* Our own exp, log, cos, sin and erf, beside libm's, and bits that every machine must give. */
#include "test.h"

#include "core/elementary.h"
#include "core/random.h"

static double ulp(double x)
{
    return nextafter(fabs(x), (double)INFINITY) - fabs(x);
}

static void test_near_libm(void **state)
{
    (void)state;
    for (int i = -400000; i <= 100000; i++) {
        const double x = i * 0.0017;
        assert_near(koksma__exp(x), exp(x), ulp(exp(x)));
    }
    for (int i = -70000; i <= 70000; i++) {
        const double x = i * 0.0001;
        assert_near(koksma__erf(x), erf(x), 2e-15 * fabs(erf(x)));
    }
    for (int i = 1; i < 400000; i++) {
        const double x = ldexp(i * 0x1p-18, i % 80 - 60);
        assert_near(koksma__log(x), log(x), 2 * ulp(log(x)));
    }
}

/* Beside long doubles, near multiples of pi / 2 too, where a sine is as small as 6e-17. */
static void test_cos_and_sin(void **state)
{
    (void)state;
    for (int i = -200000; i <= 200000; i++) {
        const double x = i % 2 ? i * 0.00031 : i * M_PI_4 / 2 + (i % 7 - 3) * 1e-16 * i;
        double c, s;
        koksma__cos_sin(x, &c, &s);
        assert_near(c, (double)cosl(x), ulp((double)cosl(x)));
        assert_near(s, (double)sinl(x), ulp((double)sinl(x)));
    }
    double c, s;
    koksma__cos_sin(M_PI, &c, &s);
    assert_near(s, 0x1.1a62633145c07p-53, 0); /* pi less its double */
    koksma__cos_sin(0, &c, &s);
    assert_true(c == 1 && s == 0);
}

/* The way there and back; near 1 a number's neighbours are far apart in t. */
static void test_inverse_erf(void **state)
{
    (void)state;
    for (int i = -300000; i <= 300000; i++) {
        const double x = i < -200000  ? -1 + ldexp(1, -(i + 300000) % 53)
                         : i > 200000 ? 1 - ldexp(1, -i % 53)
                                      : i * 5e-6;
        const double t = koksma__inverse_erf(fmax(-1, fmin(1, x)));
        assert_near(erf(t), x, 3e-15 * fabs(x));
        assert_true(t == -koksma__inverse_erf(-x));
    }
    for (int i = 1; i < 5900; i++) { /* our erf is good to 2e-15 */
        const double t = i * 0.001, back = koksma__inverse_erf(erf(t));
        assert_near(back, t, 1e-15 * t + 2.2e-15 / (1.13 * exp(-t * t)));
    }
}

static void test_bits(void **state)
{
    (void)state;
    assert_true(koksma__exp(0) == 1 && koksma__erf(0) == 0 && koksma__erf(-1.25) == -koksma__erf(1.25) &&
                koksma__log(1) == 0);
    /* A sum that a last bit anywhere changes. */
    double sum = 0, logs = 0;
    for (int i = 1; i < 5000; i++) {
        sum += koksma__exp(-0.01 * i) * i + koksma__erf(0.0013 * i) * i;
    }
    assert_near(sum, 0x1.792f260307a19p+23, 0);
    for (int i = 1; i < 5000; i++) {
        logs += koksma__log(0.37 * i) * i;
    }
    assert_near(logs, 0x1.4ecee4c5419eap+26, 0);
}

static void test_limits(void **state)
{
    (void)state;
    assert_true(koksma__exp(-1000) == 0 && koksma__exp(-(double)INFINITY) == 0 && isinf(koksma__exp(1000)));
    assert_true(koksma__erf((double)INFINITY) == 1 && koksma__erf(-50) == -1 && koksma__erf(1e-300) > 1e-300);
    assert_true(isnan(koksma__exp((double)NAN)) && isnan(koksma__erf((double)NAN)));
}

/* Where they are used: gaussian-jittered inverts the law of its points in their cells, for narrow and wide ones. */
static void test_gaussian_jittered(void **state)
{
    (void)state;
    static const double sigmas[] = {0.001, 0.01, 0.1, 0.25, 3, 1000};
    enum { M = 190, N = M * M }; /* more than one thread takes at a time */
    const koksma_run run = {.threads = 3};
    for (size_t s = 0; s < sizeof sigmas / sizeof *sigmas; s++) {
        char text[64];
        koksma_spec spec;
        koksma_points points;
        snprintf(text, sizeof text, "gaussian-jittered:sigma=%g", sigmas[s]);
        assert_ok(koksma_pattern_spec(text, &spec));
        assert_ok(koksma_points_init(&points, N, 2));
        assert_ok(koksma_generate(&spec, 3, &run, &points));
        const double scale = sqrt(2) * sigmas[s];
        for (int i = 0; i < N; i++) {
            double u[2];
            koksma__random_pair(3, KOKSMA__PURPOSE_POINT, (uint64_t)i, 0, u);
            for (int k = 0; k < 2; k++) {
                const double z = (points.xs[2 * i + k] * M - (k ? i % M : i / M) - 0.5) / scale;
                assert_near(erf(z) / erf(0.5 / scale), 2 * u[k] - 1, 1e-13 / fmin(scale, 1));
            }
        }
        koksma_points_fini(&points);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_near_libm),   cmocka_unit_test(test_cos_and_sin),
        cmocka_unit_test(test_inverse_erf), cmocka_unit_test(test_bits),
        cmocka_unit_test(test_limits),      cmocka_unit_test(test_gaussian_jittered),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

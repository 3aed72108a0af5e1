/* SPDX-License-Identifier: Apache-2.0 */
/* Our own elementary functions beside true values, and bits that every machine must give. */
#include "test.h"

#include <stdlib.h>

#include "core/elementary.h"
#include "core/random.h"

static double ulp(double x)
{
    return nextafter(fabs(x), (double)INFINITY) - fabs(x);
}

static double exp_of(double x)
{
    return koksma__exp(x);
}

/* The largest errors that the functions are allowed, in units in the last place of the true value, and arguments: from low
   to high, or up to high in size if low is 0; wide[]: the long doubles of libc, of one argument or two. */
static const struct function {
    const char *name;
    double (*f1)(double);
    double (*f2)(double, double);
    double ulps, low, high;
    long double (*wide1)(long double);
    long double (*wide2)(long double, long double);
} functions[] = {
#define ONE(name, function, ulps, low, high)                                                                         \
    {                                                                                                                \
#name, function, NULL, ulps, low, high, name##l, NULL                                                        \
    }
#define TWO(name, ulps, low, high)                                                                                   \
    {                                                                                                                \
#name, NULL, koksma__##name, ulps, low, high, NULL, name##l                                                  \
    }
    ONE(exp, exp_of, 1, 0, 700),
    ONE(log, koksma__log, 2, 1e-300, 1e300),
    ONE(erf, koksma__erf, 18, 0, 6),
    ONE(sin, koksma__sin, 1, 0, 1e5),
    ONE(cos, koksma__cos, 1, 0, 1e5),
    ONE(tan, koksma__tan, 2, 0, 1e5),
    ONE(asin, koksma__asin, 2, 0, 1),
    ONE(acos, koksma__acos, 2, 0, 1),
    ONE(atan, koksma__atan, 1, 0, 1e5),
    TWO(atan2, 2, 0, 1e5),
    ONE(exp2, koksma__exp2, 2, 0, 1000),
    ONE(expm1, koksma__expm1, 2, 0, 700),
    ONE(log1p, koksma__log1p, 4, 1e-300, 1e300),
    ONE(log2, koksma__log2, 3, 1e-300, 1e300),
    ONE(log10, koksma__log10, 3, 1e-300, 1e300),
    TWO(pow, 2, 1e-2, 1e2),
    ONE(cbrt, koksma__cbrt, 1, 0, 1e300),
    TWO(hypot, 1, 0, 1e5),
    ONE(sinh, koksma__sinh, 3, 0, 700),
    ONE(cosh, koksma__cosh, 2, 0, 700),
    ONE(asinh, koksma__asinh, 5, 0, 1e300),
    ONE(erfc, koksma__erfc, 20, 0, 26),
    ONE(lgamma, koksma__log_gamma, 4, 1e-3, 1e5),
#undef ONE
#undef TWO
};

/* The error of a value; log_gamma's near its zeros is that of a number of 1e-15. */
static double error_of(const struct function *f, const double x[2], double truth)
{
    const double value = f->f1 ? f->f1(x[0]) : f->f2(x[0], x[1]);
    return fabs(value - truth) / fmax(ulp(truth), f->f1 == koksma__log_gamma ? 1e-15 : 0);
}

/* Beside the long doubles of an x87 processor, for many arguments of every size. */
TEST_CASE(test_many_values)
{
    const bool able = (double)sinl(M_PI) == 0x1.a62633145c07p-53; /* knows pi to 66 bits */
    for (size_t i = 0; i < sizeof functions / sizeof *functions && able; i++) {
        const struct function *f = &functions[i];
        for (uint64_t k = 0; k < test_repeats(20000, 500); k++) {
            double x[2], u[2], v[2];
            koksma__random_pair(k, KOKSMA__PURPOSE_TEST, i, 0, u);
            koksma__random_pair(k, KOKSMA__PURPOSE_TEST, i, 1, v);
            for (int a = 0; a < 2; a++) {
                const double size = f->low > 0 ? f->low * pow(f->high / f->low, u[a]) : f->high * exp2(-40 * u[a]);
                x[a] = f->low == 0 && v[a] < 0.5 ? -size : size;
            }
            const double truth = (double)(f->f1 ? f->wide1(x[0]) : f->wide2(x[0], x[1]));
            const double error = error_of(f, x, truth);
            assert_that(error <= f->ulps, "%s of %a, %a is off by %g ulp", f->name, x[0], x[1], error);
        }
    }
}

/* True values of every function, from the table beside this file. */
TEST_CASE(test_true_values)
{
    FILE *file = fopen(KOKSMA_TESTS "/core/elementary.txt", "r");
    assert_non_null(file);
    char line[200];
    size_t rows[sizeof functions / sizeof *functions] = {0};
    while (fgets(line, sizeof line, file)) {
        char name[20], *end = line + strcspn(line, " ");
        double x[3] = {0};
        if (*line == '#') {
            continue;
        }
        snprintf(name, sizeof name, "%.*s", (int)(end - line), line);
        size_t i = 0;
        while (strcmp(functions[i].name, name) != 0) {
            assert_true(++i < sizeof functions / sizeof *functions);
        }
        const struct function *f = &functions[i];
        for (int k = 0; k < 2 + !f->f1; k++) {
            x[k] = strtod(end, &end);
        }
        const double error = error_of(f, x, x[1 + !f->f1]);
        assert_that(error <= f->ulps, "%s: off by %g ulp", strtok(line, "\n"), error);
        rows[i]++;
    }
    fclose(file);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_true(rows[i] >= 8);
    }
}

/* What a libm's functions give exactly. */
TEST_CASE(test_exact_values)
{
    for (int k = -300; k <= 300; k++) {
        assert_true(koksma__exp2(k) == ldexp(1, k) && koksma__log2(ldexp(1, k)) == k &&
                    koksma__pow(2, k) == ldexp(1, k));
    }
    for (int k = 0; k <= 22; k++) {
        double power = 1;
        for (int i = 0; i < k; i++) {
            power *= 10;
        }
        assert_true(koksma__pow(10, k) == power && koksma__pow(10, -k) == 1 / power && koksma__log10(power) == k);
        assert_true(k == 0 || koksma__log10(1 / power) == -k);
    }
    const double inf = (double)INFINITY, nan_value = (double)NAN;
    assert_true(koksma__pow(-3, 3) == -27 && koksma__pow(0, 0) == 1 && koksma__pow(0, 2) == 0 &&
                koksma__pow(0, -1) == inf);
    assert_true(isnan(koksma__pow(-2, 0.5)) && isnan(koksma__pow(nan_value, 2)) && koksma__pow(9, 1000) == inf &&
                koksma__pow(9, -1000) == 0 && koksma__pow(-9, -1001) == 0 && koksma__pow(0.5, inf) == 0);
    assert_true(koksma__log(0) == -inf && isnan(koksma__log(-1)) && koksma__log(inf) == inf &&
                koksma__log1p(-1) == -inf);
    assert_true(koksma__atan(inf) == M_PI_2 && koksma__atan2(0, -1) == M_PI && koksma__atan2(-0.0, -1) == -M_PI &&
                koksma__atan2(1, 0) == M_PI_2 && koksma__atan2(1, -0.0) == M_PI_2 && koksma__atan2(0, 0) == 0 &&
                koksma__atan2(-1, -1) == -3 * M_PI_4);
    assert_true(koksma__acos(1) == 0 && koksma__asin(-1) == -M_PI_2 && isnan(koksma__acos(1.5)) &&
                isnan(koksma__asin(nan_value)));
    assert_true(koksma__hypot(3, 4) == 5 && koksma__hypot(0, 0) == 0 && isnan(koksma__hypot(0, nan_value)) &&
                koksma__hypot(-inf, nan_value) == inf && koksma__cbrt(27) == 3 && koksma__cbrt(-8) == -2 &&
                koksma__sinh(0) == 0 && koksma__cosh(0) == 1 && isinf(koksma__log_gamma(inf)) &&
                isinf(koksma__log_gamma(0)) && koksma__erfc(30) == 0 && koksma__erfc(-30) == 2 &&
                koksma__expm1(-80) == -1);
}

/* Beside long doubles, near multiples of pi / 2 too, where a sine is as small as 6e-17. */
TEST_CASE(test_cos_and_sin)
{
    double c, s;
    koksma__cos_sin(M_PI, &c, &s);
    assert_near(s, 0x1.1a62633145c07p-53, 0); /* pi less its double */
    koksma__cos_sin(0, &c, &s);
    assert_true(c == 1 && s == 0);
    const bool able = (double)sinl(M_PI) == 0x1.a62633145c07p-53; /* those of an x87 processor know pi to 66 bits */
    for (int i = -200000; i <= 200000 && able; i++) {
        const double x = i % 2 ? i * 0.00031 : i * M_PI_4 / 2 + (i % 7 - 3) * 1e-16 * i;
        koksma__cos_sin(x, &c, &s);
        assert_near(c, (double)cosl(x), ulp((double)cosl(x)));
        assert_near(s, (double)sinl(x), ulp((double)sinl(x)));
    }
}

/* The way there and back; near 1 a number's neighbours are far apart in t. */
TEST_CASE(test_inverse_erf)
{
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

TEST_CASE(test_bits)
{
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

TEST_CASE(test_limits)
{
    assert_true(koksma__exp(-1000) == 0 && koksma__exp(-(double)INFINITY) == 0 && isinf(koksma__exp(1000)));
    assert_true(koksma__erf((double)INFINITY) == 1 && koksma__erf(-50) == -1 && koksma__erf(1e-300) > 1e-300);
    assert_true(isnan(koksma__exp((double)NAN)) && isnan(koksma__erf((double)NAN)));
}

/* Where they are used: gaussian-jittered inverts the law of its points in their cells, for narrow and wide ones. */
TEST_CASE(test_gaussian_jittered)
{
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

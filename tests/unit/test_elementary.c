/* SPDX-License-Identifier: Apache-2.0 */
/* Our own exp, log and erf, beside libm's, and bits that every machine must give. */
#include "test.h"

#include "core/elementary.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_near_libm),
        cmocka_unit_test(test_bits),
        cmocka_unit_test(test_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

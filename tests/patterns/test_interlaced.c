/* SPDX-License-Identifier: Apache-2.0 */
/* interlaced-sobol, from Dick's definition digit by digit, and the orders of its errors for a smooth integrand: 2 and 3
   where Sobol' has 1, and half an order more when scrambled. */
#include "test.h"

static unsigned digit_of(double x, int digit)
{
    return (unsigned)(ldexp(x, digit) - 2 * floor(ldexp(x, digit - 1)));
}

static void digits_alternate(void **state)
{
    (void)state;
    for (int order = 1; order <= 5; order++) {
        char text[64];
        snprintf(text, sizeof text, "interlaced-sobol:order=%d", order);
        koksma_points points = test_points(text, 300, 4, 0), base = test_points("sobol", 300, 4 * order, 0);
        for (size_t c = 0; c < 300 * 4; c++) {
            for (int digit = 1; digit <= 53; digit++) {
                const int r = (digit - 1) % order, l = (digit - 1) / order + 1;
                assert_int_equal(digit_of(points.xs[c], digit), digit_of(base.xs[c * (size_t)order + (size_t)r], l));
            }
        }
        koksma_points_fini(&points);
        koksma_points_fini(&base);
    }
}

/* prod_k (1 + exp(x_k) - e + 1), whose integral is 1. */
static double error_of(const char *text, size_t n, int dim, uint64_t seed)
{
    koksma_points points = test_points(text, n, dim, seed);
    long double mean = 0;
    for (size_t i = 0; i < n; i++) {
        long double product = 1;
        for (int k = 0; k < dim; k++) {
            product *= 1 + (expl(points.xs[i * (size_t)dim + (size_t)k]) - expl(1) + 1);
        }
        mean += (product - 1) / (long double)n;
    }
    koksma_points_fini(&points);
    return (double)mean;
}

static double rmse(const char *text, size_t n, int dim, int seeds)
{
    double square = 0;
    for (int s = 0; s < seeds; s++) {
        square += pow(error_of(text, n, dim, (uint64_t)s), 2) / seeds;
    }
    return sqrt(square);
}

/* The least squares slope from 2^5 to 2^13 points. In more dimensions powers of log n hide it for more points. */
static void errors_have_their_order(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int dim, seeds;
        double least, most;
    } cases[] = {{"sobol", 1, 1, 0.95, 1.05},          {"interlaced-sobol:order=1", 2, 1, 0.9, 1.1},
                 {"interlaced-sobol", 1, 1, 1.9, 2.2}, {"interlaced-sobol:order=3", 1, 1, 2.8, 3.3},
                 {"interlaced-sobol", 2, 1, 1.8, 2.6}, {"interlaced-sobol:scramble=owen", 1, 16, 2.3, 2.7}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        double order = 0;
        for (int m = -4; m <= 4; m++) {
            order -= m * log2(rmse(cases[c].text, (size_t)1 << (9 + m), cases[c].dim, cases[c].seeds)) / 60;
        }
        if (!(order >= cases[c].least && order <= cases[c].most)) {
            fail_msg("%s, dim = %d: errors fall as n^-%.2f", cases[c].text, cases[c].dim, order);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(digits_alternate),
        cmocka_unit_test(errors_have_their_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

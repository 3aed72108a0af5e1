/* SPDX-License-Identifier: Apache-2.0 */
/* Quantiles against published tables, closed forms and expansions. */
#include <koksma/series.h>

#include "stats/stats.h"
#include "test.h"

/* Abramowitz & Stegun 1964, tables 26.8 and 26.10; and in closed form: t with 1 degree is Cauchy's, chi-squared with
   2 is exponential. */
TEST_CASE(quantiles_are_the_published)
{
    assert_near(koksma__student_quantile(0.975, 1), tan(M_PI * 0.475), 1e-8);
    assert_near(koksma__student_quantile(0.975, 10), 2.228138852, 1e-8);
    assert_near(koksma__student_quantile(0.95, 30), 1.697260887, 1e-8);
    assert_near(koksma__student_quantile(0.975, 1e6), 1.959966, 1e-5);
    assert_near(koksma__chi_squared_quantile(0.1, 2), -2 * log(0.9), 1e-9);
    assert_near(koksma__chi_squared_quantile(0.95, 10), 18.307038053, 1e-8);
    assert_near(koksma__chi_squared_quantile(0.05, 100), 77.929465165, 1e-7);
}

/* Its expansion in 1 / degrees and the continued fraction agree where they meet, and nothing is lost beyond. */
TEST_CASE(student_of_many_degrees)
{
    const double z = 1.959963984540054;
    assert_near(koksma_student_975(999999), z + z * (1 + z * z) / 4e6, 2e-9);
    assert_near(koksma_student_975(1000001), z + z * (1 + z * z) / 4e6, 1e-11);
    double before = koksma_student_975(1000001);
    for (double degrees = 1e7; degrees < 1e19; degrees *= 10) {
        const double t = koksma__student_quantile(0.975, degrees);
        assert_true(t <= before && t > z - 1e-11);
        before = t;
    }
    assert_near(koksma_student_975(SIZE_MAX), z, 1e-9);
    assert_near(koksma__student_quantile(0.9995, 1e12), 3.290526731491895, 1e-10);
    assert_true(isnan(koksma_student_975(0)));
}

/* lgamma's sign is the program's: threads that ask for quantiles would write it at once. */
TEST_CASE(no_variable_of_the_program_is_written)
{
    signgam = 7;
    koksma_student_975(5);
    koksma__chi_squared_quantile(0.9, 3);
    assert_int_equal(signgam, 7);
}

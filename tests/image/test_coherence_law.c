/* SPDX-License-Identifier: Apache-2.0 */
/* How large the peak of a white error's spectrum is by chance, against tables and closed forms. */
#include <math.h>

#include "image/coherence.h"
#include "test.h"

static void tails_are_the_known_ones(void **state)
{
    (void)state;
    /* Fisher's table of 1929 at 5 %; his waves share one power: taken for independent, g is up to 1 % smaller. */
    const koksma__coherence_law five = {1, 5, 0, 0}, fifty = {1, 50, 0, 0};
    assert_near(koksma__coherence_quantile(&five, 0.05) / 5, 0.68377, 0.003);
    assert_near(koksma__coherence_quantile(&fifty, 0.05) / 50, 0.13135, 0.0005);
    /* One wave of T images without anything in common: chi-squared of 2 T degrees over 2 T; 18.307 = chi2_10 at 5 %.
     */
    const koksma__coherence_law one = {5, 1, 0, 0}, same = {5, 1, 0, 1};
    assert_near(koksma__coherence_quantile(&one, 0.05), 18.307038 / 10, 1e-6);
    /* All power at one frequency is the most that there can be: it has the probability 0, and not -0. */
    assert_true(koksma__coherence_tail(&five, 5) == 0 && !signbit(koksma__coherence_tail(&five, 5)));
    /* All in common: exponential. */
    assert_near(koksma__coherence_tail(&same, 3), exp(-3), 1e-12);
    /* A frequency that is its own mirror image: chi-squared of 1 degree, 3.841459 at 5 %; of T images of T degrees.
     */
    const koksma__coherence_law own = {5, 0, 1, 1}, own_free = {10, 0, 1, 0};
    assert_near(koksma__coherence_quantile(&own, 0.05), 3.8414588, 1e-6);
    assert_near(koksma__coherence_quantile(&own_free, 0.05), 18.307038 / 10, 1e-6);
    /* Between: two images with r in common are 1 + r and 1 - r times an exponential each (their difference's law). */
    const double r = 0.3, a = (1 + r) / 2, b = (1 - r) / 2, x = 4;
    const koksma__coherence_law two = {2, 1, 0, r};
    assert_near(koksma__coherence_tail(&two, x), (a * exp(-x / a) - b * exp(-x / b)) / (a - b), 1e-12);
    /* Continuous in what is common, also for thousands of images, and falling in x. */
    for (size_t images = 2; images <= 5000; images = 7 * images + 3) {
        double before = 0;
        for (double common = 0; common <= 1; common = common == 0 ? 1e-12 : common < 0.5 ? 4 * common : 2 * common) {
            const koksma__coherence_law law = {images, 6000, 3, fmin(common, 1)};
            const double level = koksma__coherence_quantile(&law, 0.05);
            assert_true(isfinite(level) && level > before - 1e-9);
            assert_near(koksma__coherence_tail(&law, level), 0.05, 1e-7);
            before = level;
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tails_are_the_known_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* SPDX-License-Identifier: Apache-2.0 */
/* Bias of adaptive sampling, measured: shuffled strata without a split are right in the mean, pixel by pixel; subdivision,
   whose deciding samples count, is not, and aligned strata are not even without a split. */
#include "rendering.h"

enum { WIDTH = 16, HEIGHT = 12, PIXELS = WIDTH * HEIGHT, SEEDS = test_repeats(80, 12) };

static koksma_render_options few_pixels(const koksma_scene *scene, const char *pattern, int spp)
{
    koksma_render_options options = options_of(scene, pattern, "distribution", spp, WIDTH);
    options.height = HEIGHT;
    return options;
}

/* The mean over pixels with noise of the squared deviation in standard errors: 1 without bias. Where few of the seeds
   see anything of an edge the noise is not known from them; there the deviation itself must be small. */
static double deviation(const moments *reference, const moments *few, bool biased)
{
    double sum = 0;
    int used = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double variance = few->square_error[i] + reference->square_error[i];
        const double off = few->mean[i] - reference->mean[i];
        if (few->square_error[i] > 2e-7) {
            sum += off * off / variance;
            used++;
        } else if (!biased) {
            assert_near(off, 0, test_repeats(2e-3, 1e-2));
        }
    }
    assert_true(used > PIXELS / 4);
    return sum / used;
}

/* The deviation's own spread is about sqrt(2 / pixels with noise), 0.13. Of 12 seeds its mean is 11/9, as that of the
   square of Student's t, and its spread 0.22; only the optimised run has enough of them to see a bias. */
TEST_CASE(bias_is_where_it_must_be)
{
    static const struct {
        const char *method;
        double budget;
        bool biased;
    } cases[] = {
        {"hierarchical:pairing=shuffled,levels=0", 0, false},
        {"hierarchical:levels=0", 0, true}, /* aligned strata leave most of the product unsampled */
        {"hierarchical:levels=1", 0, true},
        {"hierarchical:pairing=shuffled,levels=1", 0, true},
        {"selective:levels=1", 0, true},
    };
    static moments reference, few;
    koksma_scene *scene = shipped("ball");
    measure(scene, few_pixels(scene, "sobol:scramble=owen", test_repeats(512, 64)), NULL, 0, 12, 100000, &reference);
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        measure(scene, few_pixels(scene, "jittered", 16), cases[c].method, cases[c].budget, SEEDS, 1000 * c, &few);
        const double off = deviation(&reference, &few, cases[c].biased);
        if (cases[c].biased ? !(off > test_repeats(1.6, 0)) : !(off < test_repeats(1.4, 2.1))) {
            fail_msg("%s: mean square deviation %.2f", cases[c].method, off);
        }
    }
    koksma_scene_close(scene);
}

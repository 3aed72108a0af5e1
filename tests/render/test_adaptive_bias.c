/* SPDX-License-Identifier: Apache-2.0 */
/* Bias of adaptive sampling, measured: methods whose deciding samples are not counted are right in the mean, pixel by
   pixel; hierarchical subdivision that counts them is not, and aligned strata are not even without a split. */
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
        {"hierarchical:phase=folded,reuse=fresh,levels=1", 0, false},
        {"hierarchical:phase=shifted,reuse=fresh,levels=1", 0, false},
        {"hierarchical:phase=folded,levels=0", 0, false},
        {"hierarchical:pairing=shuffled,reuse=fresh,levels=1", 0, false},
        {"selective:reuse=fresh,levels=1", 0, false},
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

/* A floor under narrow slits and a small light: whether a sample is lit depends on pixel and light together, so the
   strata that are split are those whose sample met a lit pair, and an estimate that takes that pair's quarters again
   is too light, by 5 % and more, which is six standard errors here. */
static koksma_scene *slits(void)
{
    static char text[8192];
    size_t used = (size_t)snprintf(
        text, sizeof text,
        "{'camera': {'eye': [0, 9.9, 0], 'target': [0, 0, 0], 'up': [0, 0, -1], 'fov_deg': 33.7157},'materials': "
        "[{'name': 'm', 'kind': 'lambert', 'albedo': 1},{'name': 'k', 'kind': 'lambert', 'albedo': 0}], 'lights': "
        "[{'kind': 'rectangle','centre': [0, 20, 0], 'normal': [0, -1, 0], 'half': [0.25, 0.25], 'radiance': "
        "5000}],'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], 'normal': [0, 1, 0], 'material': 'm'}");
    for (int k = -14; k < 14; k++) {
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 ", {'kind': 'rectangle', 'centre': [%.3f, 10, 0], 'normal': [0, 1, 0],'half': "
                                 "[0.115, 8], 'material': 'k'}",
                                 0.25 * k + 0.125);
    }
    assert_true(used + 3 < sizeof text);
    strcpy(text + used, "]}");
    return scene_of(text);
}

/* Of the mean over the pixels, which are independent. */
static double mean_over_pixels(const moments *m, double *square_error)
{
    double sum = 0;
    *square_error = 0;
    for (int i = 0; i < PIXELS; i++) {
        sum += m->mean[i] / PIXELS;
        *square_error += m->square_error[i] / PIXELS / PIXELS;
    }
    return sum;
}

TEST_CASE(what_decided_is_not_met_again)
{
    static const char *const methods[] = {"hierarchical:pairing=shuffled,reuse=fresh",
                                          "hierarchical:phase=folded,reuse=fresh",
                                          "hierarchical:phase=shifted,reuse=fresh", "selective:reuse=fresh"};
    koksma_scene *scene = slits();
    static moments reference, few;
    double reference_error, error;
    measure(scene, few_pixels(scene, "sobol:scramble=owen", test_repeats(1024, 256)), NULL, 0, 4, 100000, &reference);
    const double expected = mean_over_pixels(&reference, &reference_error);
    for (size_t c = 0; c < sizeof methods / sizeof *methods; c++) {
        measure(scene, few_pixels(scene, "jittered", 4), methods[c], 0, test_repeats(250, 25), 1000 * c, &few);
        const double mean = mean_over_pixels(&few, &error);
        if (!(fabs(mean - expected) <= 4 * sqrt(error + reference_error))) {
            fail_msg("%s: %.5f, expected %.5f +- %.5f", methods[c], mean, expected, sqrt(error + reference_error));
        }
    }
    koksma_scene_close(scene);
}

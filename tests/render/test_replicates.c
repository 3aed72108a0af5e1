/* SPDX-License-Identifier: Apache-2.0 */
/* Images with their standard errors: against the definition, and against an image of many samples. */
#include "image/image.h"
#include "rendering.h"

enum { WIDTH = 12, HEIGHT = 9, PIXELS = WIDTH * HEIGHT, R = 8 };

static koksma_render_options options_for(const koksma_scene *scene, const char *pattern, int spp, uint64_t seed)
{
    koksma_render_options o = options_of(scene, pattern, "distribution", spp, WIDTH);
    o.height = HEIGHT;
    o.seed = seed;
    return o;
}

TEST_CASE(mean_and_error_are_those_of_the_images)
{
    koksma_replicates found;
    koksma_image images[5];
    koksma_scene *scene = shipped("cornell");
    koksma_render_options o = options_for(scene, "random", 4, 40);
    const koksma_run run = {.threads = 3};
    assert_ok(koksma_render_replicates(scene, &o, 5, &run, &found));
    assert_int_equal(found.replicates, 5);
    for (size_t r = 0; r < 5; r++) {
        o.seed = 40 + r;
        assert_ok(koksma_render(scene, &o, NULL, &images[r]));
        assert_int_equal(images[r].channels, found.error.channels);
    }
    double total = 0, square = 0;
    for (size_t v = 0; v < (size_t)PIXELS * (size_t)images[0].channels; v++) {
        double mean = 0, squares = 0;
        for (size_t r = 0; r < 5; r++) {
            mean += (double)images[r].pixels[v] / 5;
        }
        for (size_t r = 0; r < 5; r++) {
            squares += pow((double)images[r].pixels[v] - mean, 2);
        }
        assert_true(fabs((double)found.image.pixels[v] - mean) < 1e-6);
        assert_true(fabs((double)found.error.pixels[v] - sqrt(squares / 4 / 5)) < 1e-6);
    }
    for (size_t p = 0; p < PIXELS; p++) {
        double mean = 0;
        for (size_t r = 0; r < 5; r++) {
            mean += koksma__luminance(&images[r], p) / 5;
        }
        for (size_t r = 0; r < 5; r++) {
            square += pow(koksma__luminance(&images[r], p) - mean, 2) / 4 / 5 / PIXELS;
        }
        total += mean / PIXELS;
    }
    assert_true(fabs(found.mean - total) < 1e-9);
    assert_true(fabs(found.rmse - sqrt(square)) < 1e-9);
    assert_true(found.mean_low < found.mean && found.mean < found.mean_high);
    assert_true(found.rmse_low < found.rmse && found.rmse < found.rmse_high);
    koksma_replicates_fini(&found);
    koksma_replicates_fini(NULL);
    for (size_t r = 0; r < 5; r++) {
        koksma_image_fini(&images[r]);
    }
    koksma_scene_close(scene);
}

/* Student's 97.5 % quantile of R - 1 = 7 degrees of freedom, from tables. */
#define T_7 2.3646

/* In runs of other seeds: how often the pixel's, the mean's and the picture's intervals hold what an image of many samples
   has. */
TEST_CASE(intervals_hold_the_exact_image)
{
    koksma_image exact;
    const int runs = test_repeats(200, 2);
    static double squares[200], low[200], high[200];
    int pixels = 0, lit = 0, means = 0, pictures = 0;
    double truth = 0, square = 0;
    koksma_scene *scene = shipped("ball");
    koksma_render_options o = options_for(scene, "sobol:scramble=owen", 1 << 16, 1);
    assert_ok(koksma_render(scene, &o, NULL, &exact));
    for (size_t p = 0; p < PIXELS; p++) {
        truth += koksma__luminance(&exact, p) / PIXELS;
    }
    for (int run = 0; run < runs; run++) {
        koksma_replicates found;
        o = options_for(scene, "random", 16, 1000 + R * (uint64_t)run);
        assert_ok(koksma_render_replicates(scene, &o, R, NULL, &found));
        for (size_t p = 0; p < PIXELS; p++) {
            const double off = koksma__luminance(&found.image, p) - koksma__luminance(&exact, p);
            squares[run] += off * off / PIXELS;
            if (found.error.pixels[p] > 0) {
                pixels += fabs(off) <= T_7 * (double)found.error.pixels[p] + 1e-6; /* rounding of floats */
                lit++;
            }
        }
        means += found.mean_low <= truth && truth <= found.mean_high;
        low[run] = found.rmse_low;
        high[run] = found.rmse_high;
        square += squares[run] / runs;
        koksma_replicates_fini(&found);
    }
    for (int run = 0; run < runs; run++) {
        pictures += low[run] <= sqrt(square) && sqrt(square) <= high[run];
    }
    /* standard deviations of the shares of 200 runs: 1.5 %; pixels of one run are about independent */
    if (runs == 200) {
        assert_in_range(1000.0 * pixels / lit, 925, 975);
        assert_in_range(means, 180, 199);
        assert_in_range(pictures, 180, 200);
    }
    koksma_image_fini(&exact);
    koksma_scene_close(scene);
}

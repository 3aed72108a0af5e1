/* SPDX-License-Identifier: Apache-2.0 */
/* How many samples leave an error: the intervals hold the mean error of other images, by its definition. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "image/image.h"
#include "test.h"

enum { WIDTH = 12, HEIGHT = 9, EXACT = 16384, IMAGES = 300, MOST_SPP = 4096 };

static koksma_image render(const char *pattern, int spp, uint64_t seed)
{
    static koksma_scene *scene;
    koksma_render_options o;
    koksma_image image;
    if (!scene) {
        assert_int_equal(koksma_scene_open("ball", &scene), KOKSMA_OK);
    }
    koksma_render_options_init(&o, scene);
    assert_int_equal(koksma_render_patterns(pattern, &o), KOKSMA_OK);
    o.width = WIDTH;
    o.height = HEIGHT;
    o.spp = spp;
    o.seed = seed;
    o.integrator = koksma_integrator_find("distribution");
    o.filter = koksma_filter_find("box");
    o.lights = KOKSMA_LIGHTS_ALL;
    assert_int_equal(koksma_render(scene, &o, NULL, &image), KOKSMA_OK);
    return image;
}

/* The mean absolute error in luminance of images of spp samples, against an image of many. */
static double true_error(const char *pattern, int spp)
{
    static koksma_image exact;
    exact = exact.pixels ? exact : render("sobol:scramble=owen", EXACT, 1);
    double total = 0;
    for (uint64_t t = 0; t < IMAGES; t++) {
        koksma_image image = render(pattern, spp, 1000 + t);
        for (size_t p = 0; p < (size_t)WIDTH * HEIGHT; p++) {
            total += fabs(koksma__luminance(&image, p) - koksma__luminance(&exact, p)) / (WIDTH * HEIGHT);
        }
        koksma_image_fini(&image);
    }
    return total / IMAGES;
}

static koksma_rank_options options_of(const char *const *patterns, size_t n, uint64_t seed)
{
    return (koksma_rank_options){
        .scene = "ball", .patterns = patterns, .n_patterns = n, .width = WIDTH, .height = HEIGHT, .seed = seed};
}

TEST_CASE(intervals_hold_the_error_of_other_images)
{
    static double errors[2][MOST_SPP];
    const char *const patterns[] = {"jittered", "random"};
    const int runs = test_repeats(100, 2);
    int held = 0, near = 0;
    for (int r = 0; r < runs; r++) {
        const koksma_rank_options o = options_of(patterns, 2, (uint64_t)r);
        koksma_target_row rows[2];
        koksma_target_ranking ranking;
        assert_int_equal(koksma_rank_to_error(&o, 0.02, NULL, rows, &ranking), KOKSMA_OK);
        for (size_t i = 0; i < 2; i++) {
            const int spp = rows[i].spp, side = (int)lround(sqrt(spp));
            assert_int_equal(rows[i].state, KOKSMA_TARGET_CHECKED);
            assert_in_range(spp, 1, MOST_SPP - 1);
            assert_true(rows[i].pattern == 1 || side * side == spp); /* jittered makes squares only */
            double *error = &errors[rows[i].pattern][spp];
            *error = *error > 0 ? *error : true_error(patterns[rows[i].pattern], spp);
            held += rows[i].low <= *error && *error <= rows[i].high;
            near += rows[i].pattern == 1 && fabs(*error / 0.02 - 1) < 0.1;
            assert_true(rows[i].pattern == 0 || fabs(rows[i].rate + 0.5) < 0.1); /* independent samples: n^-1/2 */
        }
    }
    /* of 200 intervals of 95 % 190 hold in the mean, with a standard deviation of 3.1 */
    assert_in_range(held, runs == 100 ? 181 : 1, 2 * runs);
    assert_in_range(near, runs == 100 ? 90 : 0, runs);
}

TEST_CASE(no_pattern_and_no_thread_changes_another)
{
    const char *const patterns[] = {"jittered", "fibonacci:shift=1", "random"};
    koksma_target_row all[3], one;
    koksma_target_ranking ranking;
    koksma_rank_options o = options_of(patterns, 3, 7);
    const koksma_run run = {.threads = 3}, single = {.threads = 1};
    assert_int_equal(koksma_rank_to_error(&o, 0.03, &run, all, &ranking), KOKSMA_OK);
    assert_int_equal(ranking.width, WIDTH);
    assert_int_equal(ranking.height, HEIGHT);
    for (size_t i = 0; i < 3; i++) {
        o = options_of(&patterns[all[i].pattern], 1, 7);
        assert_int_equal(koksma_rank_to_error(&o, 0.03, &single, &one, &ranking), KOKSMA_OK);
        assert_int_equal(one.spp, all[i].spp);
        assert_true(one.error == all[i].error && one.low == all[i].low && one.needed == all[i].needed);
        assert_true(!i || all[i].spp >= all[i - 1].spp);
    }
}

TEST_CASE(what_is_not_reached_is_said)
{
    const char *const patterns[] = {"random", "lattice-file:none.txt"};
    koksma_target_row rows[2];
    koksma_target_ranking ranking;
    koksma_rank_options o = options_of(patterns, 1, 0);
    o.time_limit_s = 0.2;
    assert_int_equal(koksma_rank_to_error(&o, 1e-9, NULL, rows, &ranking), KOKSMA_OK);
    assert_true(ranking.cut_short);
    assert_int_not_equal(rows[0].state, KOKSMA_TARGET_CHECKED);
    assert_int_equal(rows[0].spp, 0);
    if (rows[0].state == KOKSMA_TARGET_EXTRAPOLATED) {
        assert_true(rows[0].needed > 1e6 && rows[0].needed_low <= rows[0].needed &&
                    rows[0].needed <= rows[0].needed_high);
    }
    o = options_of(patterns, 2, 0);
    assert_int_equal(koksma_rank_to_error(&o, 0.1, NULL, rows, &ranking), KOKSMA_MISSING);
    const double wrong[] = {0, -1, NAN, INFINITY};
    for (size_t i = 0; i < 4; i++) {
        o = options_of(patterns, 1, 0);
        assert_int_equal(koksma_rank_to_error(&o, wrong[i], NULL, rows, &ranking), KOKSMA_ARGUMENT);
        assert_non_null(strstr(koksma_error_text(), "target"));
    }
}

/* SPDX-License-Identifier: Apache-2.0 */
/* Errors over a screen, from their definition: random points are the unit of both numbers, equal pixels are all that a
   filter can leave, integrals are right, and a pattern of pixels is the one that the library makes. */
#include <math.h>

#include <koksma/integrate.h>

#include "test.h"

static koksma_screen_options options_of(int dim, size_t spp, uint64_t trials)
{
    koksma_screen_options o = {.dim = dim, .side = 32, .spp = spp, .seed = 5, .trials = trials};
    o.filter = (koksma_mask_filter){.width = 5, .height = 3};
    for (int i = 0; i < 15; i++) {
        o.filter.weights[i] = 1 + i % 5 % 3;
    }
    return o;
}

static void errors_of(const char *text, const koksma_screen_options *o, int threads, koksma_screen_row *rows)
{
    koksma_spec pattern;
    const koksma_run run = {.threads = threads};
    assert_ok(koksma_pattern_spec(text, &pattern));
    assert_ok(koksma_screen_errors(&pattern, o, &run, rows));
}

/* 64 samples: an integral that is off by a tenth of a standard deviation would raise both numbers by a quarter. */
TEST_CASE(random_points_are_the_unit)
{
    static const size_t spps[] = {1, 64};
    for (int i = 0; i < 2; i++) {
        const koksma_screen_options o = options_of(4, spps[i], (uint64_t)(i ? 2 : test_repeats(12, 3)));
        koksma_screen_row rows[4];
        errors_of("random", &o, 0, rows);
        for (int k = 0; k < 4; k++) {
            assert_int_equal(rows[k].coordinates, k + 1);
            assert_near(rows[k].plain, 1, 0.05);
            assert_near(rows[k].blurred, 1, 0.15);
            assert_true(rows[k].plain_error < 0.03 && rows[k].blurred_error < 0.1 && rows[k].blurred_error > 0);
        }
    }
}

/* Independent Owen-scrambled pixels are white, also where pairs fill four coordinates, and better than random points. */
TEST_CASE(independent_pixels_are_white)
{
    static const char *const patterns[] = {"sobol:scramble=owen", "zaremba:shift=1", "n-rooks"};
    for (int i = 0; i < 3; i++) {
        const koksma_screen_options o = options_of(4, 4, (uint64_t)test_repeats(4, 2));
        koksma_screen_row rows[4];
        errors_of(patterns[i], &o, 0, rows);
        for (int k = 0; k < 4; k++) {
            assert_near(rows[k].blurred, 1, 0.1);
            assert_true(rows[k].plain < 1);
        }
    }
}

/* All pixels have one error: the filter leaves all of it, 1 / sqrt(sum w^2) times what it leaves of white noise. */
TEST_CASE(equal_pixels_keep_their_error)
{
    const koksma_screen_options o = options_of(2, 4, 2);
    double sum = 0, squares = 0;
    for (int i = 0; i < 15; i++) {
        sum += o.filter.weights[i];
        squares += o.filter.weights[i] * o.filter.weights[i];
    }
    koksma_screen_row rows[2];
    errors_of("regular", &o, 0, rows);
    for (int k = 0; k < 2; k++) {
        assert_near(rows[k].blurred, sum / sqrt(squares), 1e-9);
        assert_near(rows[k].blurred_error, 0, 1e-9);
        assert_near(rows[k].plain_error, 0, 1e-9);
    }
}

/* Patterns of images and tiles: blue where both coordinates are of one pair; z-sampler and mask-offset were published for
   that. With one sample a coordinate alone is bluest with a mask for it. */
TEST_CASE(patterns_of_images_are_blue)
{
    static const char *const patterns[] = {"ranking-keys", "z-sampler", "mask-offset:width=16",
                                           "mask-offset:width=32,masks=vectors"};
    for (int i = 0; i < 4; i++) {
        const koksma_screen_options o = options_of(2, 1, (uint64_t)test_repeats(4, 2));
        koksma_screen_row rows[2];
        errors_of(patterns[i], &o, 0, rows);
        assert_true(rows[0].blurred < 0.75 && rows[1].blurred < 0.85);
        assert_near(rows[1].plain, 1, 0.1);
    }
}

TEST_CASE(threads_change_no_bit)
{
    const koksma_screen_options o = options_of(3, 2, 2);
    koksma_screen_row one[3], three[3];
    errors_of("z-sampler", &o, 1, one);
    errors_of("z-sampler", &o, 3, three);
    for (int k = 0; k < 3; k++) {
        assert_true(one[k].plain == three[k].plain && one[k].blurred == three[k].blurred);
        assert_true(one[k].plain_error == three[k].plain_error && one[k].blurred_error == three[k].blurred_error);
    }
}

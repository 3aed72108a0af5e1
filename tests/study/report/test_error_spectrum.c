/* SPDX-License-Identifier: Apache-2.0 */
/* The spectrum of an image's error: a wave has all its power in its ring, white noise has its variance in each. */
#include <math.h>
#include <string.h>

#include "study/report/report.h"
#include "test.h"

static void images_of(int width, int height, koksma_image *image, koksma_image *reference)
{
    assert_ok(koksma_image_init(image, width, height, 1));
    assert_ok(koksma_image_init(reference, width, height, 1));
    for (int i = 0; i < width * height; i++) {
        reference->pixels[i] = 0.5F;
    }
}

TEST_CASE(a_wave_is_in_its_ring)
{
    static const int sizes[][2] = {{64, 48}, {30, 45}, {33, 33}};
    for (size_t s = 0; s < 3; s++) {
        const int width = sizes[s][0], height = sizes[s][1], u = 5, v = 3;
        koksma_image image, reference;
        koksma__error_spectrum spectrum = {0};
        images_of(width, height, &image, &reference);
        for (int y = 0; y < height; y++) {
            for (int x = 0; x < width; x++) {
                const double turn = (double)(u * x) / width - (double)(v * y) / height;
                image.pixels[y * width + x] = (float)(0.75 + 0.25 * cos(2 * M_PI * turn)); /* its mean is left out */
            }
        }
        assert_ok(koksma__spectrum_add(&spectrum, &image, &reference));
        const double f = hypot((double)u / width, (double)v / height);
        const size_t ring = (size_t)(2 * (double)spectrum.n * f);
        /* How many frequencies its ring has; two of them, (u, -v) and (-u, v), share W H 0.25^2 / 2. */
        int count = 0;
        for (int i = -width / 2; i < width - width / 2; i++) {
            for (int k = -height / 2; k < height - height / 2; k++) {
                count += (i || k) &&
                         (size_t)(2 * (double)spectrum.n * hypot((double)i / width, (double)k / height)) == ring;
            }
        }
        for (size_t r = 0; r < spectrum.n; r++) {
            assert_near(spectrum.power[r], r == ring ? width * height * 0.0625 / 2 / count : 0, 1e-6);
        }
        koksma_image_fini(&image);
        koksma_image_fini(&reference);
    }
}

TEST_CASE(noise_is_flat)
{
    koksma__error_spectrum spectrum = {0};
    enum { WIDTH = 40, HEIGHT = 32, IMAGES = 64 };
    koksma_image image, reference;
    images_of(WIDTH, HEIGHT, &image, &reference);
    uint64_t bits = 1;
    for (int k = 0; k < IMAGES; k++) {
        for (int i = 0; i < WIDTH * HEIGHT;
             i++) { /* uniform in [0, 1): its variance is 1/12 (Knuth's MMIX constants) */
            bits = bits * 6364136223846793005ULL + 1442695040888963407ULL;
            image.pixels[i] = (float)((double)(bits >> 40) / (double)(1 << 24));
        }
        assert_ok(koksma__spectrum_add(&spectrum, &image, &reference));
    }
    assert_int_equal(spectrum.images, IMAGES);
    assert_int_equal(spectrum.n, 16);
    for (size_t r = 0; r < spectrum.n; r++) { /* P of a frequency is exponential: 4.5 standard errors of 4 and more */
        assert_near(spectrum.power[r] * 12, 1, 4.5 / sqrt(IMAGES * (r ? 4.0 * (double)r : 2)));
    }
    koksma_image small;
    assert_ok(koksma_image_init(&small, 4, 4, 1));
    assert_int_equal(koksma__spectrum_add(&spectrum, &image, &small), KOKSMA_ARGUMENT);
    koksma_image_fini(&small);
    koksma_image_fini(&image);
    koksma_image_fini(&reference);
}

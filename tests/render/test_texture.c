/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Colours of an image at texture coordinates. A mesh may have any coordinates, and a transform may make them infinite or
 * NaN: the pixels that are looked up are always those of the image.
 */
#include "render/scene_images.h"

#include <float.h>
#include <stdio.h>

#include "test.h"

TEST_CASE(every_coordinate_has_a_pixel)
{
    static const float all[] = {
        0,     -0.0f,  1,       -1e-9f,   0.49999997f, 1e6f,      -1e6f, 16777216, 2147483648.f, -2147483648.f,
        1e30f, -1e30f, FLT_MAX, -FLT_MAX, INFINITY,    -INFINITY, NAN};
    static const koksma__wrap wraps[] = {KOKSMA__WRAP_REPEAT, KOKSMA__WRAP_CLAMP, KOKSMA__WRAP_MIRROR};
    static const int widths[] = {1, 2, 3, 37, 65536};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        for (size_t w = 0; w < 3 * sizeof widths / sizeof *widths; w++) {
            const int n = widths[w / 3];
            size_t pair[2];
            const float weight = koksma__texture_split(all[i], n, wraps[w % 3], pair);
            assert_that(weight >= 0 && weight <= 1 && pair[0] < (size_t)n && pair[1] < (size_t)n,
                        "%g of %d, wrapped by %zu: pixels %zu and %zu, weight %g", (double)all[i], n, w % 3, pair[0],
                        pair[1], (double)weight);
        }
    }
}

/* The largest coordinates under the largest transform overflow, and their differences are NaN. */
TEST_CASE(transforms_may_overflow)
{
    float pixels[] = {0.25f, 0.5f, 0.25f, 0.5f}, rgb[3];
    const koksma_image image = {2, 2, 1, pixels};
    for (int wrap = 0; wrap < 3; wrap++) {
        const koksma__mapping m = {.moved = true,
                                   .matrix = {1e6f, -1e6f, 0, 1e6f, 1e6f, 0},
                                   .wrap = {(koksma__wrap)wrap, (koksma__wrap)wrap}};
        koksma__texture(&image, &m, FLT_MAX, FLT_MAX, 1, rgb);
        for (int k = 0; k < 3; k++) {
            assert_true(rgb[k] >= 0.25f && rgb[k] <= 0.5f);
        }
    }
}

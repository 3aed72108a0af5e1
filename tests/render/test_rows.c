/* SPDX-License-Identifier: Apache-2.0 */
/* Work in parts: rows of a picture have the bits of the whole one. */
#include <string.h>

#include "render/one_image.h"
#include "rendering.h"

TEST_CASE(rows_have_the_bits_of_the_whole)
{
    static const char *const filters[] = {"box", "mitchell"};
    for (size_t f = 0; f < 2; f++) {
        koksma_scene *scene;
        koksma_image whole, part;
        assert_ok(koksma_scene_open(f ? "ball" : "balls", &scene));
        koksma_render_options options = options_of(scene, "multi-jittered", "distribution", 16, 29);
        options.filter = koksma_filter_find(filters[f]);
        assert_true(koksma__rows_stand_alone(&options));
        assert_ok(koksma_render(scene, &options, NULL, &whole));
        const size_t row = (size_t)whole.width * (size_t)whole.channels;
        for (int y = 0; y < 29; y += 7) {
            const int rows = 29 - y < 7 ? 29 - y : 7;
            assert_ok(koksma__render_rows(scene, &options, y, rows, NULL, &part));
            assert_int_equal(part.height, rows);
            assert_int_equal(part.channels, whole.channels);
            assert_memory_equal(part.pixels, whole.pixels + (size_t)y * row,
                                (size_t)rows * row * sizeof *part.pixels);
            koksma_image_fini(&part);
        }
        koksma_image_fini(&whole);
        koksma_scene_close(scene);
    }
}

TEST_CASE(some_rows_need_the_others)
{
    koksma_scene *scene;
    assert_ok(koksma_scene_open("ball", &scene));
    koksma_render_options options = options_of(scene, "random", "path", 4, 8);
    assert_true(koksma__rows_stand_alone(&options));
    options.splat = true;
    assert_false(koksma__rows_stand_alone(&options));
    options.splat = false;
    options.scope = KOKSMA_SCOPE_IMAGE;
    assert_false(koksma__rows_stand_alone(&options));
    koksma_scene_close(scene);
}

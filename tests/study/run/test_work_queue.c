/* SPDX-License-Identifier: Apache-2.0 */
/* Work in parts: rows of a picture have the bits of the whole one, and every number of a queue is given out once. */
#include <string.h>

#include "render/render.h"
#include "rendering.h"
#include "study/run/run.h"

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

static bool is_even(const void *context, size_t i)
{
    (void)context;
    return i % 2 == 0;
}

TEST_CASE(a_queue_gives_each_number_once)
{
    koksma__work_queue q;
    size_t i, seen = 0;
    assert_ok(koksma__work_queue_open(20, &q));
    assert_true(koksma__work_queue_put(&q, 3)); /* done before */
    assert_false(koksma__work_queue_put(&q, 3));
    assert_true(koksma__work_queue_take(&q, 20, is_even, NULL, &i) && i == 0);
    assert_true(koksma__work_queue_take(&q, 20, is_even, NULL, &i) && i == 2);
    assert_true(koksma__work_queue_take(&q, 20, NULL, NULL, &i) && i == 1);
    assert_true(koksma__work_queue_take(&q, 20, NULL, NULL, &i) && i == 4);
    assert_true(koksma__work_queue_take(&q, 3, is_even, NULL, &i) && i == 6);
    assert_true(koksma__work_queue_take(&q, 4, is_even, NULL, &i) && i == 8);
    assert_false(koksma__work_queue_take(&q, 2, is_even, NULL, &i) && i > 6); /* 10 is out of reach */
    assert_false(koksma__work_queue_take_lost(&q, &i));
    while (koksma__work_queue_take(&q, 20, NULL, NULL, &i)) {
        assert_true(koksma__work_queue_put(&q, i));
        seen++;
    }
    assert_int_equal(seen + 7, 20);
    unsigned lost = 0;
    for (int k = 0; k < 6; k++) {
        assert_true(koksma__work_queue_take_lost(&q, &i));
        lost |= 1u << i;
    }
    assert_int_equal(lost, 1u << 0 | 1u << 1 | 1u << 2 | 1u << 4 | 1u << 6 | 1u << 8);
    for (i = 0; i < 20; i++) {
        koksma__work_queue_put(&q, i);
    }
    assert_int_equal(q.left, 0);
    assert_false(koksma__work_queue_take_lost(&q, &i));
    koksma__work_queue_close(&q);
}

/* SPDX-License-Identifier: Apache-2.0 */
/* The images of a scene: each is read once for each use, and belongs to the scene; their colours at coordinates. */
#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/image.h>

#include "core/status.h"
#include "render/scene_images.h"
#include "test.h"

/* The images' part of the hash of a scene with a light that shows the image. */
static uint64_t hash_with(koksma_scene *scene, koksma_image *image)
{
    koksma__light light = {.image = image};
    scene->lights = &light;
    scene->n_lights = 1;
    const uint64_t hash = koksma__scene_images_hash(scene);
    scene->lights = NULL;
    scene->n_lights = 0;
    return hash;
}

/* Two rows of one grey pixel: 0.25 above, 0.5 below. */
static void write_two(const char *path)
{
    koksma_image image;
    assert_ok(koksma_image_init(&image, 1, 2, 1));
    image.pixels[0] = 0.25f;
    image.pixels[1] = 0.5f;
    assert_ok(koksma_image_write(path, &image, NULL));
    koksma_image_fini(&image);
}

TEST_CASE(a_file_is_read_once_for_each_use)
{
    koksma_scene scene = {.n_images = 0};
    koksma_image *plain, *again, *tinted, *turned;
    koksma__image_use use = KOKSMA__PLAIN_IMAGE;
    double mean[3];
    write_two("two.pfm");
    assert_int_equal(link("two.pfm", "other.pfm"), 0);
    assert_ok(koksma__scene_image(&scene, "two.pfm", &use, &plain));
    assert_ok(koksma__scene_image(&scene, "other.pfm", &use, &again));
    assert_ptr_equal(plain, again);
    use.upside_down = true;
    assert_ok(koksma__scene_image(&scene, "two.pfm", &use, &turned));
    assert_true(plain->pixels[0] == 0.25f && turned->pixels[0] == 0.5f && turned->pixels[1] == 0.25f);
    use = KOKSMA__PLAIN_IMAGE;
    use.tint[2] = 0.5;
    assert_ok(koksma__scene_image(&scene, "two.pfm", &use, &tinted));
    assert_true(tinted->channels == 3 && tinted->pixels[3] == 0.5f && tinted->pixels[5] == 0.25f);
    koksma__scene_image_mean(&scene, tinted, true, mean);
    assert_true(mean[0] == 0.375 && mean[2] == 0.1875);
    assert_int_not_equal(hash_with(&scene, plain), hash_with(&scene, turned));
    assert_int_equal(hash_with(&scene, plain), hash_with(&scene, plain));
    assert_int_not_equal(koksma__scene_images_hash(&scene), 0); /* no material or light shows any of them */
    assert_int_equal(scene.n_images, 3);
    assert_int_equal(scene.image_bytes, 8 + 8 + 24);
    unlink("other.pfm");
    unlink("two.pfm");
    koksma__scene_images_fini(&scene);
}

/* A failure is remembered, whatever the tint; one of opening is not. */
TEST_CASE(a_damaged_file_is_read_once)
{
    koksma_scene scene = {.n_images = 0};
    koksma_image *image;
    koksma__image_use use = KOKSMA__PLAIN_IMAGE;
    static const unsigned char damaged[] = "Pf\n2 2\n-1\n";
    for (int i = 0; i < 3; i++) {
        use.tint[0] = i;
        assert_int_equal(koksma__scene_image_within(&scene, "images[0]", damaged, 10, &use, &image),
                         KOKSMA_MALFORMED);
        assert_string_equal(koksma_error_text(), "images[0]: cut short: it claims 2 x 2 pixels but has only 0 bytes");
        assert_null(image);
        assert_false(koksma__is_refused());
        assert_int_equal(koksma__scene_image(&scene, "none.pfm", &use, &image), KOKSMA_MISSING);
    }
    assert_int_equal(scene.n_images, 1);
    koksma__scene_images_fini(&scene);
}

/* What was decoded before a failure counts, for each part: here one pixel and the bytes of the file. */
TEST_CASE(failures_count)
{
    koksma_scene scene = {.n_images = 0};
    koksma_image *image;
    static const unsigned char infinite[] = "Pf\n1 1 -1\n\0\0\x80\x7F";
    for (int part = KOKSMA__IMAGE_COLOURS; part <= KOKSMA__IMAGE_NUMBERS; part++) {
        koksma__image_use use = KOKSMA__PLAIN_IMAGE;
        use.part = (koksma__image_part)part;
        for (int i = 0; i < 2; i++) {
            assert_int_equal(koksma__scene_image_within(&scene, "a", infinite, 14, &use, &image), KOKSMA_MALFORMED);
            assert_string_equal(koksma_error_text(), "a: pixel 0,0 has the value inf");
        }
        assert_int_equal(scene.image_bytes, (part + 1) * (4 + 14));
        assert_int_equal(scene.image_file_bytes, 14);
    }
    koksma__scene_images_fini(&scene);
}

/* Bytes within a model count once, however the images in them overlap. */
TEST_CASE(bytes_of_files_count_once)
{
    koksma_scene scene = {.n_images = 0};
    koksma_image *image;
    unsigned char bytes[34] = "Pf\n1 1 -1\n....Pf\n1 1 -1\n....", more[14];
    assert_ok(koksma__scene_image_within(&scene, "a", bytes, 14, &KOKSMA__PLAIN_IMAGE, &image));
    assert_int_equal(scene.image_file_bytes, 14);
    assert_ok(koksma__scene_image_within(&scene, "b", bytes + 14, 14, &KOKSMA__PLAIN_IMAGE, &image));
    assert_int_equal(scene.image_file_bytes, 28);
    koksma__image_use numbers = KOKSMA__PLAIN_IMAGE;
    numbers.part = KOKSMA__IMAGE_NUMBERS;
    assert_ok(koksma__scene_image_within(&scene, "a", bytes, 14, &numbers, &image));
    assert_int_equal(koksma__scene_image_within(&scene, "c", bytes, 28, &numbers, &image), KOKSMA_MALFORMED);
    assert_int_equal(scene.image_file_bytes, 28);
    memcpy(more, bytes, sizeof more);
    assert_ok(koksma__scene_image_within(&scene, "d", more, sizeof more, &numbers, &image));
    assert_int_equal(scene.image_file_bytes, 42);
    koksma__scene_images_fini(&scene);
}

/* An image that nothing uses any more is freed; its bytes no longer count. */
TEST_CASE(unused_images_are_dropped)
{
    koksma__light light = {.image = NULL};
    koksma_scene scene = {.n_lights = 1, .lights = &light};
    koksma_image made, *kept;
    assert_ok(koksma_image_init(&made, 2, 1, 3));
    assert_ok(koksma__scene_image_keep(&scene, &made, &kept));
    assert_null(made.pixels);
    light.image = kept;
    koksma__scene_image_drop(&scene, kept);
    assert_int_equal(scene.n_images, 1);
    light.image = NULL;
    koksma__scene_image_drop(&scene, kept);
    koksma__scene_image_drop(&scene, NULL);
    assert_int_equal(scene.n_images, 0);
    assert_int_equal(scene.image_bytes, 0);
    koksma__scene_images_fini(&scene);
}

/* A mesh may have any coordinates, and a transform may make them infinite or NaN: the pixels that are looked up are always
   those of the image. */
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

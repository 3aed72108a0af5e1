/* SPDX-License-Identifier: Apache-2.0 */
/* The images of a scene: each is read once for each use, and belongs to the scene. */
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

/* SPDX-License-Identifier: Apache-2.0 */
/* An image as light from everywhere: where its pixels are, what they give, and with what density they are chosen. */
#include <float.h>
#include <string.h>

#include "lanes.h"
#include "render/lights/lights.h"
#include "rendering.h"

enum { WIDTH = 8, HEIGHT = 4 };

static koksma__shading_light opened(koksma_image *image, double scale, double angle_rad)
{
    const koksma__light light = {.radiance = {scale, scale, scale}, .angle_rad = angle_rad, .image = image};
    koksma__shading_light e = {.kind = &koksma__light_environment};
    assert_ok(e.kind->open(NULL, &light, &e));
    return e;
}

static float sample_of(const koksma__shading_light *e, const float u[2], float w[3])
{
    koksma__beam beam;
    light_sample(e, w, u, &beam);
    memcpy(w, beam.w, sizeof beam.w);
    return beam.pdf;
}

/* Pixel i has the radiance i + 1 in red. */
static koksma_image numbered(void)
{
    koksma_image image;
    assert_ok(koksma_image_init(&image, WIDTH, HEIGHT, 3));
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
        image.pixels[3 * i] = (float)(i + 1);
    }
    return image;
}

static double solid_angle(int row)
{
    return 2 * M_PI / WIDTH * (cos(M_PI * row / HEIGHT) - cos(M_PI * (row + 1) / HEIGHT));
}

static int pixel_along(const koksma__shading_light *e, float x, float y, float z)
{
    const float length = sqrtf(x * x + y * y + z * z), w[3] = {x / length, y / length, z / length};
    float rgb[3];
    e->kind->radiance(e, w, rgb);
    return (int)lrintf(rgb[0]) - 1;
}

/* Row 0 is up; the middle of a row is along -z, and what is right of it, seen from inside, is along +x. */
TEST_CASE(pixels_are_where_they_should_be)
{
    koksma_image image = numbered();
    koksma__shading_light e = opened(&image, 1, 0);
    assert_int_equal(pixel_along(&e, 0.001f, 1, -0.01f) / WIDTH, 0);
    assert_int_equal(pixel_along(&e, 0.001f, -1, -0.01f) / WIDTH, HEIGHT - 1);
    assert_int_equal(pixel_along(&e, -0.1f, 0.1f, -1), WIDTH + WIDTH / 2 - 1);
    assert_int_equal(pixel_along(&e, 0.1f, 0.1f, -1), WIDTH + WIDTH / 2);
    assert_int_equal(pixel_along(&e, 1, 0.1f, -0.1f), WIDTH + 3 * WIDTH / 4 - 1);
    assert_int_equal(pixel_along(&e, 1, -0.1f, 0.1f), 2 * WIDTH + 3 * WIDTH / 4);
    assert_int_equal(pixel_along(&e, 0.1f, 0.1f, 1), WIDTH + WIDTH - 1);
    assert_int_equal(pixel_along(&e, -0.1f, 0.1f, 1), WIDTH);
    e.kind->close(e.data);
    /* A quarter turn about y takes -z to -x and +x to -z. */
    e = opened(&image, 1, M_PI / 2);
    assert_int_equal(pixel_along(&e, -1, 0.1f, -0.1f), WIDTH + WIDTH / 2);
    assert_int_equal(pixel_along(&e, -1, 0.1f, 0.1f), WIDTH + WIDTH / 2 - 1);
    assert_int_equal(pixel_along(&e, -0.1f, 0.1f, -1), WIDTH + 3 * WIDTH / 4 - 1);
    e.kind->close(e.data);
    koksma_image_fini(&image);
}

/* Ways that are chosen have the density that is told, and give the integral of the radiance. */
TEST_CASE(choosing_is_unbiased)
{
    enum { SIDE = 512 };
    koksma_image image = numbered();
    koksma__shading_light e = opened(&image, 0.5, 1);
    double exact = 0, sum = 0, chosen[WIDTH * HEIGHT] = {0}, all = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        exact += 0.5 * (i + 1) * solid_angle(i / WIDTH);
        all += (i + 1) * sin(M_PI * (i / WIDTH + 0.5) / HEIGHT);
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        const float u[2] = {((float)(i % SIDE) + 0.5f) / SIDE, ((float)(i / SIDE) + 0.5f) / SIDE};
        float w[3], rgb[3];
        const float density = sample_of(&e, u, w);
        assert_near((double)(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]), 1, 1e-6);
        assert_near((double)(e.kind->pdf(&e, w, w, 0, w) / density), 1, 1e-5);
        e.kind->radiance(&e, w, rgb);
        sum += (double)rgb[0] / (double)density;
        chosen[lrintf(2 * rgb[0]) - 1] += 1.0 / SIDE / SIDE;
    }
    assert_near(sum / SIDE / SIDE / exact, 1, 2e-3);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double share = (i + 1) * sin(M_PI * (i / WIDTH + 0.5) / HEIGHT) / all;
        assert_near(chosen[i], 0.99 * share + 0.01 * solid_angle(i / WIDTH) / (4 * M_PI), 3e-3);
    }
    e.kind->close(e.data);
    koksma_image_fini(&image);
}

/* The density integrates to 1 over all ways, also where no light comes from. */
TEST_CASE(density_is_a_density)
{
    enum { ROWS = 400, COLUMNS = 800 };
    koksma_image image = numbered();
    memset(image.pixels, 0, 3 * WIDTH * sizeof *image.pixels);
    koksma__shading_light e = opened(&image, 1, 0.3);
    double sum = 0;
    for (int i = 0; i < ROWS * COLUMNS; i++) {
        const double polar = M_PI * (i / COLUMNS + 0.5) / ROWS, azimuth = 2 * M_PI * (i % COLUMNS + 0.5) / COLUMNS;
        const float w[3] = {(float)(sin(polar) * cos(azimuth)), (float)cos(polar),
                            (float)(sin(polar) * sin(azimuth))};
        const double density = (double)e.kind->pdf(&e, w, w, 0, w);
        assert_true(density >= 0.0099 / (4 * M_PI));
        sum += density * sin(polar) * (M_PI / ROWS) * (2 * M_PI / COLUMNS);
    }
    assert_near(sum, 1, 2e-3);
    e.kind->close(e.data);
    koksma_image_fini(&image);
}

/* Negative radiance is dark, and an image without any light is black and not NaN; what has no value is refused. */
TEST_CASE(odd_pixels_are_dark_or_refused)
{
    static const float odd[] = {-1, -INFINITY, 0, -0.0f, -FLT_MAX, 0};
    static const float bad[] = {NAN, INFINITY, FLT_MAX};
    koksma_image image;
    assert_ok(koksma_image_init(&image, 6, 1, 1));
    memcpy(image.pixels, odd, sizeof odd);
    koksma__shading_light e = opened(&image, 1, 0);
    assert_float_equal(e.power, 0, 0);
    for (int i = 0; i < 64; i++) {
        const float u[2] = {(float)(i % 8) / 8, (float)(i / 8) / 8};
        float w[3], rgb[3];
        const float density = sample_of(&e, u, w);
        e.kind->radiance(&e, w, rgb);
        assert_true(density > 0 && density < 1e6f);
        assert_float_equal(rgb[0] + rgb[1] + rgb[2], 0, 0);
    }
    e.kind->close(e.data);
    image.pixels[2] = 3; /* grey */
    e = opened(&image, 2, 0);
    assert_near((double)e.power, 3 * 2 / 6.0, 1e-6);
    e.kind->close(e.data);
    for (size_t i = 0; i < 3; i++) {
        const koksma__light light = {.radiance = {1, 1, 1}, .image = &image};
        image.pixels[4] = bad[i];
        assert_int_equal(e.kind->open(NULL, &light, &e), KOKSMA_MALFORMED);
        assert_non_null(strstr(koksma_error_text(), "pixel 4,0"));
        e.kind->close(e.data);
    }
    koksma_image_fini(&image);
}

/* Only the row at the zenith shines, however narrow it is: ways are chosen with their density, and met there. Its
   light on a surface that faces it is the integral of the cosine, pi sin^2 of the row's angle. */
TEST_CASE(a_row_at_the_pole_is_whole)
{
    enum { SIDE = 256 };
    for (int height = 256; height <= 4096; height *= 4) {
        for (int pole = 0; pole < 2; pole++) {
            koksma_image image;
            assert_ok(koksma_image_init(&image, 4, height, 1));
            for (size_t x = 0; x < 4; x++) {
                image.pixels[x + (pole ? 4 * (size_t)(height - 1) : 0)] = 1;
            }
            koksma__shading_light e = opened(&image, 1, 0);
            double sum = 0;
            for (int i = 0; i < SIDE * SIDE; i++) {
                const float u[2] = {((float)(i % SIDE) + 0.5f) / SIDE, ((float)(i / SIDE) + 0.5f) / SIDE};
                float w[3], rgb[3];
                const float density = sample_of(&e, u, w);
                e.kind->radiance(&e, w, rgb);
                sum += (double)rgb[0] * fabs((double)w[1]) / (double)density / (SIDE * SIDE);
            }
            assert_near(sum / (M_PI * pow(sin(M_PI / height), 2)), 1, 5e-3);
            e.kind->close(e.data);
            koksma_image_fini(&image);
        }
    }
}

/* A floor of albedo 0.9 under a sky of two halves: 0.9 times the mean of the radiances, by symmetry. */
TEST_CASE(floor_is_lit_by_an_image)
{
    koksma_image image;
    assert_ok(koksma_image_init(&image, 32, 16, 1));
    for (size_t i = 0; i < 32 * 16; i++) {
        image.pixels[i] = i % 32 < 16 ? 1.0f : 3.0f;
    }
    assert_ok(koksma_image_write("environment.pfm", &image, ""));
    koksma_image_fini(&image);
    koksma_scene *scene = scene_of("{'camera': {'eye': [0, 1, 4], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': "
                                   "[{'name': 'm', 'kind': 'lambert', 'albedo': 0.9}],'shapes': [{'kind': 'plane', "
                                   "'centre': [0, 0, 0], 'normal': [0, 1, 0], 'material': 'm'}],'lights': [{'kind': "
                                   "'environment', 'image': 'environment.pfm', 'scale': 0.5, 'angle_deg': 30}]}");
    remove("environment.pfm");
    static const char *const integrators[] = {"distribution", "path"};
    for (size_t i = 0; i < 2; i++) {
        double error;
        koksma_render_options options = options_of(scene, "n-rooks", integrators[i], 256, 24);
        const double mean = mean_of(scene, &options, &error);
        assert_mean(mean, error, 0.9 * 0.5 * 2);
        assert_true(error < 2e-3);
    }
    koksma_scene_close(scene);
}

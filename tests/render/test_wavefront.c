/* SPDX-License-Identifier: Apache-2.0 */
/* The general pipeline against closed forms and furnaces. tests/render/test_integrators.c has those of every integrator. */
#include "rendering.h"

/* ---- Furnaces --------------------------------------------------------------------------------------------- */

#define SIGHT "'camera': {'eye': [0, 0, 5], 'target': [0, 0, 0], 'fov_deg': 0.01}"
#define WORLD "'lights': [{'kind': 'environment', 'radiance': 1}]"
#define BALL_OF "'shapes': [{'kind': 'sphere', 'centre': [0, 0, 0], 'radius': 1, 'material': 'm'}]"

/* ---- Form factors ----------------------------------------------------------------------------------------- */

#define PATCH                                                                                                        \
    "'camera': {'eye': [0, 1, 4], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': 'm', 'kind': "        \
    "'lambert', 'albedo': 0.9}],'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], 'normal': [0, 1, 0], 'material': " \
    "'m'}]"

/* A light that is seen does not stand in its own light, be it small and far or all of it far from the origin,
   where places are known to a thousandth. */
TEST_CASE(seen_lights_do_not_shade_themselves)
{
    static const struct {
        double x;
        const char *light; /* for x, x */
        double reflected, off;
    } cases[] = {
        {0, "'kind': 'sphere', 'centre': [%.9g, 8, 0], 'radius': 0.1", 2e-4 * 0.8, 2e-4},
        {0, "'kind': 'sphere', 'centre': [%.9g, 8, 0], 'radius': 0.01", 2e-6 * 0.8, 2e-4},
        {1000, "'kind': 'disk', 'centre': [%.9g, 8, 0], 'normal': [0, -1, 0], 'radius': 0.01", 2e-6 * 0.64, 2e-4},
        {10000, "'kind': 'disk', 'centre': [%.9g, 8, 0], 'normal': [0, -1, 0], 'radius': 0.01", 2e-6 * 0.64, 2e-3},
        {10000, "'kind': 'rectangle', 'centre': [%.9g, 8, 0], 'normal': [0, -1, 0], 'half': [0.01, 0.01]",
         2e-6 * 0.64 * 4 / M_PI, 2e-3},
    };
    for (size_t i = 0; i < 2 * sizeof cases / sizeof *cases; i++) {
        char text[1024], light[256];
        const double x = cases[i / 2].x;
        snprintf(light, sizeof light, cases[i / 2].light, x + 6); /* at distance 10, aslant */
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [%.9g, 2, 4], 'target': [%.9g, 0, 0], 'fov_deg': 0.01},'materials': [{'name': "
                 "'m', 'kind': 'lambert', 'albedo': 0.9}],'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], "
                 "'normal': [0, 1, 0], 'material': 'm'}],'lights': [{%s, 'radiance': 2, 'visible': true}]}",
                 x, x, light);
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "n-rooks", i % 2 ? "path" : "distribution", 64, 8);
        const double mean = mean_of(scene, &options, NULL), expected = 0.9 * cases[i / 2].reflected;
        assert_near(mean, expected, cases[i / 2].off * expected);
        koksma_scene_close(scene);
    }
}

/* In a closed room of albedo a and area A, a lamp of power P is absorbed by the walls: (1 - a) A times their mean
   irradiance is P, so that the mean radiance is a / (1 - a) P / (pi A). From the middle of a cube each wall fills a
   square picture evenly. Paths of every length count. */
static double closed_room(const char *integrator, int spp, double *total_error)
{
    static const char *const sides[] = {"1, 0, 0", "-1, 0, 0", "0, 1, 0", "0, -1, 0", "0, 0, 1", "0, 0, -1"};
    double sum = 0, squares = 0;
    for (size_t i = 0; i < 6; i++) {
        char text[1024];
        double error;
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [0, 0, 0], 'target': [%s], 'up': [%s], 'fov_deg': 90},'materials': [{'name': "
                 "'m', 'kind': 'lambert', 'albedo': 0.5}], 'shapes': [{'kind': 'box', 'centre': [0, 0, 0], 'half': "
                 "[1, 1, 1], 'material': 'm'}], 'lights': [{'kind': 'rectangle', 'centre': [0, 0.5, 0], 'normal': "
                 "[0, -1, 0], 'half': [0.2, 0.2],'radiance': 10}]}",
                 sides[i], i / 2 == 1 ? "1, 0, 0" : "0, 1, 0");
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "random", integrator, spp, 16);
        options.depth = 64;
        options.seed = i;
        sum += mean_of(scene, &options, &error);
        squares += error * error;
        koksma_scene_close(scene);
    }
    *total_error = sqrt(squares) / 6;
    return sum / 6;
}

TEST_CASE(paths_of_every_length_count)
{
    const double expected = 10 * 0.16 / 24;
    double error;
    const double paths = closed_room("path", 64, &error);
    assert_mean(paths, error, expected);
    /* interpolation may be a little off */
    assert_near(closed_room("irradiance-cache", 4, &error), expected, 0.03 * expected);
}

/* A scene in other units, a power of two as large, is the same picture: no rounding is another one, and only records
   are found in other cells, and so added in another order. */
TEST_CASE(cache_knows_no_units)
{
    koksma_image images[3];
    for (int i = 0; i < 3; i++) {
        char text[1024];
        const double s = ldexp(1, i < 2 ? 17 * i : -13);
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [0, 0, 0], 'target': [%.9g, 0, 0], 'fov_deg': 2},'materials': [{'name': 'm', "
                 "'kind': 'lambert', 'albedo': 0.5}], 'shapes': [{'kind': 'box', 'centre': [0, 0, 0], 'half': [%.9g, "
                 "%.9g, %.9g], 'material': 'm'}], 'lights': [{'kind': 'rectangle', 'centre': [0, %.9g, 0], 'normal': "
                 "[0, -1, 0], 'half': [%.9g, %.9g],'radiance': 10}]}",
                 s, s, s, s, s / 2, s / 4, s / 4);
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "regular", "irradiance-cache", 1, 24);
        options.depth = 2;
        assert_ok(koksma_render(scene, &options, NULL, &images[i]));
        koksma_scene_close(scene);
    }
    for (size_t p = 0; p < 24 * 24; p++) {
        const double one = (double)images[0].pixels[p];
        assert_near((double)images[1].pixels[p], one, 1e-4 * one);
        assert_near((double)images[2].pixels[p], one, 1e-4 * one);
    }
    for (int i = 0; i < 3; i++) {
        koksma_image_fini(&images[i]);
    }
}

/* A lamp that shines up at a mirror alone: what lights the floor and the wall comes by that mirror, which is left
   out, whichever rays of a record find the lamp. */
TEST_CASE(cache_leaves_out_what_mirrors_throw)
{
    koksma_scene *scene = scene_of(
        "{'camera': {'eye': [0, 1, 6], 'target': [0, 0, 0], 'fov_deg': 20},'materials': [{'name': 'm', 'kind': "
        "'lambert', 'albedo': 0.9},{'name': 'mirror', 'kind': 'mirror', 'reflectance': 0.9}], 'shapes': [{'kind': "
        "'plane', 'centre': [0, 0, 0], 'normal': [0, 1, 0], 'material': 'm'},{'kind': 'rectangle', 'centre': [0, "
        "0.75, -2], 'normal': [0, 0, 1], 'half': [2, 0.75], 'material': 'm'},{'kind': 'plane', 'centre': [0, 4, 0], "
        "'normal': [0, -1, 0], 'material': 'mirror'}],'lights': [{'kind': 'rectangle', 'centre': [0, 2, 0], "
        "'normal': [0, 1, 0],'half': [0.5, 0.5], 'radiance': 10, 'visible': true}]}");
    koksma_render_options options = options_of(scene, "random", "path", 16, 16);
    assert_true(mean_of(scene, &options, NULL) > 0.05);
    options.integrator = koksma_integrator_find("irradiance-cache");
    options.spp = 1;
    for (options.seed = 0; options.seed < 3; options.seed++) {
        assert_near(mean_of(scene, &options, NULL), 0, 0);
    }
    koksma_scene_close(scene);
}

/* Without bounces there is no light between surfaces, with either integrator. */
TEST_CASE(cache_has_the_depth_of_paths)
{
    koksma_image images[2];
    koksma_scene *scene = shipped("cornell");
    for (int i = 0; i < 2; i++) {
        koksma_render_options options = options_of(scene, "n-rooks", i ? "irradiance-cache" : "path", 4, 16);
        options.depth = 0;
        assert_ok(koksma_render(scene, &options, NULL, &images[i]));
    }
    assert_memory_equal(images[0].pixels, images[1].pixels, 16 * 16 * 3 * sizeof(float));
    koksma_image_fini(&images[0]);
    koksma_image_fini(&images[1]);
    koksma_scene_close(scene);
}

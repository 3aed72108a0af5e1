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
}

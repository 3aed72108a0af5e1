/* SPDX-License-Identifier: Apache-2.0 */
/* Renders as a whole: bits, light in closed form, shadows, errors. */

#include "rendering.h"

/* Every way in which threads share work: pixels, records that are entered in order, and splats; also without layers. */
TEST_CASE(same_bits_for_any_number_of_threads)
{
    static const struct {
        const char *scene, *integrator, *pattern;
        int spp;
        bool splat;
    } cases[] = {
        {"ball", "distribution", "random", 1, false},   {"ball", "distribution", "jittered", 4, false},
        {"ball", "distribution", "n-rooks", 25, false}, {"ball", "distribution", "regular", 100, false},
        {"ball", "distribution", "random", 16, true},   {"fog", "path", "random", 4, false},
        {"cornell", "path", "n-rooks", 1, false},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        koksma_layers one, other;
        koksma_run run = {.threads = 1};
        koksma_scene *scene = shipped(cases[c].scene);
        koksma_render_options options = options_of(scene, cases[c].pattern, cases[c].integrator, cases[c].spp, 45);
        options.height = 34; /* no multiple of anything */
        options.splat = cases[c].splat;
        options.filter = koksma_filter_find(options.splat ? "mitchell" : "box");
        assert_ok(koksma_render_layers(scene, &options, &run, &one));
        const size_t size = (size_t)(45 * 34 * one.image.channels) * sizeof(float);
        for (int way = 0; way < 4; way++) { /* 2 threads, 5, 5 without layers, another seed */
            run.threads = way ? 5 : 2;
            options.seed = way < 3 ? 0 : 8;
            assert_ok((way == 2 ? koksma_render_only : koksma_render_layers)(scene, &options, &run, &other));
            assert_true((memcmp(one.image.pixels, other.image.pixels, size) != 0) == (way == 3));
            assert_true(way > 1 || !memcmp(one.variance.pixels, other.variance.pixels, 45 * 34 * sizeof(float)));
            koksma_layers_fini(&other);
        }
        koksma_layers_fini(&one);
        koksma_scene_close(scene);
    }
}

static double pixel(const koksma_scene *scene, const char *pattern, int spp)
{
    const koksma_render_options options = options_of(scene, pattern, "distribution", spp, 1);
    return mean_of(scene, &options, NULL);
}

/* The form factor from a small patch to a parallel rectangle of a x b at distance 1, one corner above the patch
   (Howell's catalogue, B-3). */
static double corner_factor(double a, double b)
{
    const double p = sqrt(1 + a * a), q = sqrt(1 + b * b);
    return (a / p * atan(b / p) + b / q * atan(a / q)) / (2 * M_PI);
}

#define PATCH                                                                                                        \
    "'camera': {'eye': [0, 1, 4], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': 'm', 'kind': "        \
    "'lambert', 'albedo': 0.9}],"
#define FLOOR "{'kind': 'plane', 'centre': [0, 0, 0], 'normal': [0, 1, 0], 'material': 'm'}"
#define LAMP(x)                                                                                                      \
    "'lights': [{'kind': 'rectangle', 'centre': [" x ", 2, 0], 'normal': [0, -1, 0], 'half': [1, 0.5],'radiance': "  \
    "2}]"

/* Reflected radiance is albedo x radiance x form factor. 64 x 64 strata make the error about 1e-5. */
TEST_CASE(light_is_its_form_factor)
{
    koksma_scene *scene = scene_of("{" PATCH "'shapes': [" FLOOR "]," LAMP("0") "}");
    const double centred = 4 * corner_factor(0.5, 0.25);
    assert_near(pixel(scene, "jittered", 4096), 0.9 * 2 * centred, 1e-4);
    assert_near(pixel(scene, "regular", 4096), 0.9 * 2 * centred, 1e-4);
    koksma_scene_close(scene);
    scene = scene_of("{" PATCH "'shapes': [" FLOOR "]," LAMP("3") "}");
    const double aside = 2 * (corner_factor(2, 0.25) - corner_factor(1, 0.25));
    assert_near(pixel(scene, "jittered", 4096), 0.9 * 2 * aside, 1e-4);
    koksma_scene_close(scene);
}

/* A screen over half of the lamp takes half of its light; over all of it, all; a ball around the patch too. */
TEST_CASE(shadows_take_light)
{
    const double full = 0.9 * 2 * 4 * corner_factor(0.5, 0.25);
    static const struct {
        const char *shape;
        double left;
    } screens[] = {
        {"{'kind': 'rectangle', 'centre': [1, 1.5, 0], 'normal': [0, 1, 0], 'half': [1, 1]", 0.5},
        {"{'kind': 'rectangle', 'centre': [0, 1.5, 0], 'normal': [0, 1, 0], 'half': [2, 2]", 0},
        {"{'kind': 'disk', 'centre': [0, 1.5, 0], 'normal': [0, -1, 0], 'radius': 2", 0},
        {"{'kind': 'sphere', 'centre': [0, 1, 0], 'radius': 0.9", 0},
        {"{'kind': 'sphere', 'centre': [0, 3, 0], 'radius': 0.9", 1},
        {"{'kind': 'plane', 'centre': [0, 2.5, 0], 'normal': [0, 1, 0]", 1},
    };
    for (size_t i = 0; i < sizeof screens / sizeof *screens; i++) {
        char text[1024];
        snprintf(text, sizeof text, "{" PATCH "'shapes': [" FLOOR ", %s, 'material': 'm'}]," LAMP("0") "}",
                 screens[i].shape);
        /* seen from where the sphere does not stand in the way */
        char *eye = strstr(text, "[0, 1, 4]");
        memcpy(eye, "[5, 1, 9]", 9);
        koksma_scene *scene = scene_of(text);
        assert_near(pixel(scene, "jittered", 4096), screens[i].left * full, 2e-3);
        koksma_scene_close(scene);
    }
}

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

/* SPDX-License-Identifier: Apache-2.0 */
/* The integrator `whitted`: lights as points at their centres, and the tree of rays in glass. */
#include "rendering.h"

/* A patch of albedo 0.9 under radiance 2 from a small area A at distance d and cosines c: 0.9 / pi 2 A c c' / d^2. */
TEST_CASE(lights_are_points_at_their_centres)
{
    static const struct {
        const char *light;
        double reflected;
    } cases[] = {
        {"'kind': 'sphere', 'centre': [3, 4, 0], 'radius': 0.5, 'radiance': 2", 0.9 * 2 * 0.25 / 25 * 0.8},
        {"'kind': 'disk', 'centre': [0, 2, 0], 'normal': [0, -1, 0], 'radius': 1.5, 'radiance': 2",
         0.9 * 2 * 2.25 / 4},
        {"'kind': 'rectangle', 'centre': [3, 4, 0], 'normal': [0, -1, 0], 'half': [0.5, 0.25], 'radiance': 2",
         0.9 / M_PI * 2 * 0.5 / 25 * 0.64},
        {"'kind': 'rectangle', 'centre': [3, 4, 0], 'normal': [0, 1, 0], 'half': [0.5, 0.25], 'radiance': 2", 0},
        {"'kind': 'point', 'centre': [3, 4, 0], 'intensity': 5", 0.9 / M_PI * 5 / 25 * 0.8},
        {"'kind': 'directional', 'direction': [3, -4, 0], 'irradiance': 5", 0.9 / M_PI * 5 * 0.8},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases + 4; i++) {
        const size_t c = i < sizeof cases / sizeof *cases ? i : i - sizeof cases / sizeof *cases;
        char text[1024];
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [0, 1, 4], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': 'm', "
                 "'kind': 'lambert', 'albedo': 0.9}],'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], 'normal': [0, "
                 "1, 0], 'material': 'm'}],'lights': [{%s%s}]}",
                 cases[c].light, c < i ? ", 'visible': true" : ""); /* a surface of its own is no shadow */
        assert_near(mean_of_text(text, "regular", "whitted", 2, 4, 2, NULL), cases[c].reflected,
                    2e-4 * cases[c].reflected);
    }
}

/* Straight through a ball of glass, R = ((n - 1) / (n + 1))^2 = 0.04 at each of its sides: rays see the white around
   it after a reflection, after the two refractions, and after these with reflections inside, each of which takes a
   bounce. */
TEST_CASE(glass_sends_rays_both_ways)
{
    static const char scene[] =
        "{'camera': {'eye': [0, 0, 5], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': 'm', 'kind': "
        "'dielectric', 'ior': 1.5}],'shapes': [{'kind': 'sphere', 'centre': [0, 0, 0], 'radius': 1, 'material': "
        "'m'}],'lights': [{'kind': 'environment', 'radiance': 1}]}";
    const double r = 0.04, t = 1 - r;
    assert_near(mean_of_text(scene, "regular", "whitted", 0, 4, 2, NULL), 0, 0);
    assert_near(mean_of_text(scene, "regular", "whitted", 1, 4, 2, NULL), r, 1e-5);
    assert_near(mean_of_text(scene, "regular", "whitted", 2, 4, 2, NULL), r + t * t, 1e-5);
    assert_near(mean_of_text(scene, "regular", "whitted", 3, 4, 2, NULL), r + t * t * (1 + r), 1e-5);
    assert_near(mean_of_text(scene, "regular", "whitted", 4, 4, 2, NULL), r + t * t * (1 + r + r * r), 1e-5);
    assert_near(mean_of_text(scene, "regular", "whitted", 9, 4, 2, NULL), r + t * t * (1 + r + r * r),
                1e-5); /* the next weighs less than 1/1000 */
}

/* A light that is chosen stands for all of them, and has no place on it to draw. */
TEST_CASE(one_light_stands_for_all)
{
    koksma_scene *scene = scene_of(
        "{'camera': {'eye': [0, 3, 4], 'target': [0, 0, 0], 'fov_deg': 30},'materials': [{'name': 'm', 'kind': "
        "'lambert', 'albedo': 0.9}],'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], 'normal': [0, 1, 0], "
        "'material': 'm'},{'kind': 'sphere', 'centre': [0, 0.3, 0], 'radius': 0.3, 'material': 'm'}],'lights': "
        "[{'kind': 'rectangle', 'centre': [-2, 2, 0], 'facing': [0, 0, 0], 'half': [0.5, 0.5],'radiance': 3}, "
        "{'kind': 'disk', 'centre': [2, 3, 1], 'facing': [0, 0, 0], 'radius': 0.5,'radiance': 9}]}");
    for (size_t k = 0; k < 12; k++) {
        double error;
        koksma_render_options options = options_of(scene, "random", k % 2 ? "utah" : "whitted", 16, 24);
        options.scope = KOKSMA_SCOPE_IMAGE;
        const double all = mean_of(scene, &options, NULL);
        options.pairing = k / 2 % 2 ? KOKSMA_PAIRING_NATIVE : KOKSMA_PAIRING_SHUFFLED;
        options.lights = (koksma_light_selection)(KOKSMA_LIGHTS_ONE + (int)(k / 4));
        options.depth = 0;
        const double sum = mean_over_seeds(scene, options, 8, 1, &error);
        assert_true(error < 0.01);
        assert_near(sum, all, 6 * error + 2e-3);
    }
    koksma_scene_close(scene);
}

/* An environment has no centre: rays and mirrors see it, and no surface has light from it, whichever way it faces. */
TEST_CASE(environments_are_seen_and_light_nothing)
{
    static const char *const ways[] = {"0, 1, 0", "1, 0, 0", "0, 0, 1", "0, 0, -1"};
    for (size_t i = 0; i < 8; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [%s], 'target': [0, 0, 0], 'up': [1, 1, 1], 'fov_deg': 0.01},'materials': "
                 "[{'name': 'm', %s}], 'shapes': [{'kind': 'plane', 'centre': [0, 0, 0],'normal': [%s], 'material': "
                 "'m'}], 'lights': [{'kind': 'environment', 'radiance': 2}]}",
                 ways[i / 2], i % 2 ? "'kind': 'mirror', 'reflectance': 0.5" : "'kind': 'lambert', 'albedo': 0.9",
                 ways[i / 2]);
        assert_near(mean_of_text(text, "regular", "whitted", 2, 4, 2, NULL), i % 2 ? 1 : 0, 1e-6);
    }
}

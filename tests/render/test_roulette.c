/* SPDX-License-Identifier: Apache-2.0 */
/* Russian roulette: it ends no path that has lost nothing, and keeps the mean of those that have. */
#include "rendering.h"

/* Where nothing absorbs, every path that leaves brings the same light, and roulette has nothing to end: all pixels of
   white bodies before a white sky are 1, by every integrator that plays it, however many vertices paths have. Glass
   keeps most of what goes round in it, corners send paths from side to side. */
TEST_CASE(white_furnaces_do_not_vary)
{
    static const char corner[] =
        "{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, 1, 0], 'half': [1, 1], 'material': 'm'}, {'kind': "
        "'rectangle', 'centre': [0, 1, -1], 'normal': [0, 0, 1], 'half': [1, 1], 'material': 'm'}, {'kind': "
        "'rectangle', 'centre': [-1, 1, 0], 'normal': [1, 0, 0], 'half': [1, 1], 'material': 'm'}";
    static const char ball[] = "{'kind': 'sphere', 'centre': [0, 0.6, 0], 'radius': 0.5, 'material': 'm'}";
    static const struct {
        const char *material, *integrator;
    } cases[] = {
        {"'kind': 'lambert', 'albedo': 1", "path"},
        {"'kind': 'utah', 'albedo': 1, 'reflectance': 0, 'exponent': 9", "path"},
        {"'kind': 'mirror', 'reflectance': 1", "path"},
        {"'kind': 'dielectric', 'ior': 1.5", "path"},
        {"'kind': 'dielectric', 'ior': 2.4", "path"},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char text[2048];
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [1.5, 2, 4], 'target': [0, 0.5, 0], 'fov_deg': 30}, 'background': "
                 "1,'materials': [{'name': 'm', %s}], 'shapes': [%s%s%s]}",
                 cases[c].material, strstr(cases[c].material, "dielectric") ? "" : corner,
                 strstr(cases[c].material, "dielectric") ? "" : ", ", ball);
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "random", cases[c].integrator, 64, 16);
        koksma_image image;
        options.depth = KOKSMA_MAX_DEPTH;
        assert_ok(koksma_render(scene, &options, NULL, &image));
        for (size_t i = 0; i < 16 * 16; i++) {
            assert_that(fabs((double)image.pixels[i] - 1) <= 1e-5, "%s by %s: pixel %zu is %.6f", cases[c].material,
                        cases[c].integrator, i, (double)image.pixels[i]);
        }
        koksma_image_fini(&image);
        koksma_scene_close(scene);
    }
}

/* What absorbs ends paths, and the mean stays that of an integrator which ends none: mirrors face to face. */
TEST_CASE(roulette_keeps_the_mean)
{
    static const char *const materials[] = {"'kind': 'mirror', 'reflectance': 0.9",
                                            "'kind': 'phong', 'reflectance': 0.95, 'exponent': 300",
                                            "'kind': 'ggx', 'reflectance': [0.97, 0.8, 0.6], 'roughness': 0.2",
                                            "'kind': 'dielectric', 'ior': 1.5, 'tint': 0.98"};
    for (size_t m = 0; m < 4; m++) {
        char text[1024];
        double mean[2], error[2];
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [0, 0.5, 6], 'target': [0, 0, 0], 'fov_deg': 15}, 'background': 1,'materials': "
                 "[{'name': 'm', %s}], 'shapes': [{'kind': 'box', 'centre': [0, 1.2, 0], 'half': [1, 0.2, 3], "
                 "'material': 'm'},{'kind': 'box', 'centre': [0, -0.4, 0], 'half': [1, 0.2, 3], 'material': 'm'}]}",
                 materials[m]);
        koksma_scene *scene = scene_of(text);
        for (int k = 0; k < 2; k++) {
            koksma_render_options options = options_of(scene, "random", k ? "path" : "distribution", 32, 24);
            options.depth = 24;
            mean[k] = mean_over_seeds(scene, options, 16, 10, &error[k]);
        }
        assert_that(fabs(mean[0] - mean[1]) <= 4.5 * hypot(error[0], error[1]) + 1e-6,
                    "%s: %.6f +- %.1g without roulette, %.6f +- %.1g with it", materials[m], mean[0], error[0],
                    mean[1], error[1]);
        koksma_scene_close(scene);
    }
}

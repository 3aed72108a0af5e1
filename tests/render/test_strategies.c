/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Path tracing by each weight of the strategies that find light: sampling lights, sampling lobes, and their mixtures by
 * Veach's heuristics. All estimate one integral (Veach 1997, section 9.2), so that on surfaces of every material under
 * every kind of light each has the mean of the others; what they differ in is variance: on a smooth plate a large light
 * is found by lobes, on a rough one a small light by sampling it.
 */
#include "kinds.h"
#include "render/integrators/integrators.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "rendering.h"

#define SPHERE(x, radius)                                                                                            \
    "{'kind': 'sphere', 'centre': [" #x ", 1.5, 0], 'radius': " #radius ", 'radiance': 2, 'visible': true}"

static bool follows_paths(const koksma_integrator *in)
{
    const koksma__integrator_flags *flags = in->flags;
    return flags->followed & KOKSMA__LOBE_DIFFUSE && flags->areas && !flags->replace_scene;
}

static double mean_by(const char *text, const char *integrator, int depth, koksma_light_selection lights, int spp,
                      double *error)
{
    koksma_scene *scene = scene_of(text);
    koksma_render_options options = options_of(scene, "random", integrator, spp, 12);
    options.depth = depth;
    options.lights = lights;
    const double mean = mean_of(scene, &options, error);
    koksma_scene_close(scene);
    return mean;
}

/* A background is no light, and a ray past the depth limit doesn't see it; a point light no ray meets. */
TEST_CASE(all_leave_out_the_same)
{
    static const char *const text =
        "{'camera': {'eye': [0, 3, 0], 'target': [0, 0, 0], 'up': [0, 0, 1], 'fov_deg': 0.02}, 'background': 9, "
        "'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 0.5}], 'shapes': [{'kind': 'plane', 'centre': [0, "
        "0, 0], 'normal': [0, 1, 0], 'material': 'm'}], 'lights': [{'kind': 'point', 'centre': [0, 2, 0], "
        "'intensity': 4}]}";
    for (size_t i = 0; koksma_integrator_at(i); i++) {
        for (int depth = 0; follows_paths(koksma_integrator_at(i)) && depth < 2; depth++) {
            double error;
            const double mean = mean_by(text, koksma_integrator_at(i)->name, depth, KOKSMA_LIGHTS_ALL, 4, &error);
            assert_near(mean, 0.5 / M_PI + (depth ? 0.5 * 9 : 0), 1e-5);
        }
    }
}

/* Under two visible balls, a hidden rectangle and an even sky, a plate of every material before a wall, at three depths. */
TEST_CASE(means_agree)
{
    static const koksma_light_selection selections[] = {KOKSMA_LIGHTS_ALL, KOKSMA_LIGHTS_ONE, KOKSMA_LIGHTS_POWER};
    for (size_t b = 0; koksma__bsdfs[b]; b++) {
        char fields[1024], text[3072];
        const unsigned forms = koksma__bsdfs[b]->diffuse;
        kind_fields(&koksma__bsdfs[b]->kind, 3, fields, sizeof fields);
        snprintf(
            text, sizeof text,
            "{'camera': {'eye': [0, 1, 3], 'target': [0, 0, 0], 'fov_deg': 30}, 'materials': [{'name': 'm', 'kind': "
            "'%s'%s%s}, {'name': 'w', 'kind': 'lambert', 'albedo': 0.5}], 'shapes': [{'kind': 'rectangle', 'centre': "
            "[0, 0, 0], 'normal': [0, 1, 0], 'half': [2, 2], 'material': 'm'}, {'kind': 'rectangle', 'centre': [0, "
            "1, -1.5], 'normal': [0, 0, 1], 'half': [2, 1], 'material': 'w'}], 'lights': [" SPHERE(
                -0.7,
                0.5) ", " SPHERE(0.7,
                                 0.1) ", {'kind': 'rectangle', 'centre': [0, 2, 1], 'normal': [0, -1, 0], 'half': "
                                      "[0.3, 0.3], 'radiance': 1}, {'kind': 'environment', 'radiance': 0.2}]}",
            koksma__bsdfs[b]->kind.name,
            forms & KOKSMA__ALBEDO ? ", 'albedo': 0.01"
            : forms                ? ", 'albedos': [0.3, 0.6], 'period': 0.2"
                                   : "",
            fields);
        for (int depth = 0; depth < 3; depth++) {
            double error, expected_error;
            const double expected = mean_by(text, "path", depth, KOKSMA_LIGHTS_ALL, 64, &expected_error);
            for (size_t i = 0; koksma_integrator_at(i); i++) {
                if (!follows_paths(koksma_integrator_at(i))) {
                    continue;
                }
                const char *name = koksma_integrator_at(i)->name;
                const double mean = mean_by(text, name, depth, selections[(b + (size_t)depth) % 3], 64, &error);
                assert_that(fabs(mean - expected) <= 5 * hypot(error, expected_error) + 1e-5,
                            "%s, depth %d, %s: %g +- %g, path %g +- %g", koksma__bsdfs[b]->kind.name, depth, name,
                            mean, error, expected, expected_error);
            }
        }
    }
}

/* Veach's figure 9.2: on a smooth plate a large light is found by lobes, on a rough one a small light by sampling; the
   other strategy has over 20 times the error, and both heuristics stay below a 20th of it on either plate. */
static double error_by(const char *integrator, const char *roughness, const char *light)
{
    char text[1024];
    double error;
    snprintf(text, sizeof text,
             "{'camera': {'eye': [0, 1.5, 3], 'target': [0, 0, 0], 'fov_deg': 0.02}, 'materials': [{'name': 'm', "
             "'kind': 'ggx', 'reflectance': 0.9, 'roughness': %s}], 'shapes': [{'kind': 'rectangle', 'centre': [0, "
             "0, 0], 'normal': [0, 1, 0], 'half': [2, 2], 'material': 'm'}], 'lights': [{'kind': 'sphere', 'centre': "
             "[0, 1.5, -3], 'radius': %s, 'radiance': 1, 'visible': true}]}",
             roughness, light);
    mean_by(text, integrator, -1, KOKSMA_LIGHTS_ALL, 64, &error);
    return error;
}

TEST_CASE(heuristics_are_near_the_better_strategy)
{
    const double smooth_light = error_by("path-light", "0.1", "0.8"),
                 smooth_bsdf = error_by("path-bsdf", "0.1", "0.8");
    const double rough_light = error_by("path-light", "0.7", "0.02"),
                 rough_bsdf = error_by("path-bsdf", "0.7", "0.02");
    assert_true(smooth_bsdf < 0.05 * smooth_light);
    assert_true(rough_light < 0.05 * rough_bsdf);
    static const char *const mixed[] = {"path", "path-balance"};
    for (size_t i = 0; i < 2; i++) {
        assert_true(error_by(mixed[i], "0.1", "0.8") < 0.05 * smooth_light);
        assert_true(error_by(mixed[i], "0.7", "0.02") < 0.05 * rough_bsdf);
    }
}

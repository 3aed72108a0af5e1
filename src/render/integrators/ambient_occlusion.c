/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Replaces the scene by one whose path-traced image is its ambient occlusion: all surfaces become white and diffuse,
 * all lights become black, samples are not clamped, and the background has radiance 1. A direction sampled from a
 * surface with the density cos / pi then contributes 1 if its ray leaves the scene and 0 if the ray hits anything. The
 * shapes, the camera and the cached geometry remain those of the original scene.
 */
#include "render/integrators/integrators.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"
#include "render/materials/materials.h"

koksma_status koksma__ambient_occlusion_scene(const koksma_scene *scene, koksma_scene **out)
{
    koksma_scene *copy = malloc(sizeof *copy);
    *out = copy;
    KOKSMA__REQUIRE_MEMORY(copy, sizeof *copy);
    *copy = *scene;
    copy->materials = calloc(scene->n_materials + 1, sizeof *copy->materials);
    copy->lights = calloc(scene->n_lights + 1, sizeof *copy->lights);
    if (!copy->materials || !copy->lights) {
        return koksma__fail_memory(scene->n_materials * sizeof *copy->materials +
                                   scene->n_lights * sizeof *copy->lights);
    }
    for (size_t i = 0; i < scene->n_materials; i++) {
        koksma__material *m = &copy->materials[i];
        m->bsdf = &koksma__bsdf_lambert;
        m->albedo[0][0] = m->albedo[0][1] = m->albedo[0][2] = 1;
    }
    for (size_t i = 0; i < scene->n_lights; i++) { /* the lights' shapes remain and occlude */
        koksma__light *l = &copy->lights[i];
        *l = scene->lights[i];
        memset(l->radiance, 0, sizeof l->radiance);
        l->visible = false;
    }
    copy->medium.is_there = false;
    copy->clamp = INFINITY; /* the scene's limit is one of its light */
    for (int k = 0; k < 3; k++) {
        copy->background[k] = 1;
        copy->ambient[k] = 0;
    }
    return KOKSMA_OK;
}

void koksma__ambient_occlusion_release(koksma_scene *scene)
{
    KOKSMA__FREE(scene->materials, scene->lights, scene);
}

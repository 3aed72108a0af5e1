/* SPDX-License-Identifier: Apache-2.0 */
/* What tests of mesh files begin with. */
#ifndef KOKSMA_TESTS_MESHES_H
#define KOKSMA_TESTS_MESHES_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/render.h>

#include "test.h"

/* Skips a test that needs Embree where the build is without it. */
static inline void need_meshes(void)
{
    if (!koksma_mesh_tracer()) {
        skip();
    }
}

/* Puts " in place of ', which literals would have to escape; returns the text. */
static inline char *json_of(char *text)
{
    for (char *at = text; (at = strchr(at, '\''));) {
        *at = '"';
    }
    return text;
}

static inline void write_json(const char *path, const char *text)
{
    char *copy = strdup(text);
    assert_non_null(copy);
    test_write(path, json_of(copy));
    free(copy);
}

/* The picture of a scene, side x side pixels. */
static inline koksma_image picture_of(const koksma_scene *scene, const char *integrator, const char *pattern, int spp,
                                      int side, int threads)
{
    koksma_render_options options;
    koksma_image image;
    const koksma_run run = {.threads = threads};
    koksma_render_options_init(&options, scene);
    options.width = options.height = side;
    options.spp = spp;
    options.integrator = koksma_integrator_find(integrator);
    assert_ok(koksma_pattern_spec(pattern, &options.pattern));
    assert_ok(koksma_render(scene, &options, &run, &image));
    return image;
}

/* The form factor from a small patch to a parallel rectangle of a x b at distance 1, one corner above the patch
   (Howell's catalogue, B-3). */
static inline double corner_factor(double a, double b)
{
    const double p = sqrt(1 + a * a), q = sqrt(1 + b * b);
    return (a / p * atan(b / p) + b / q * atan(a / q)) / (2 * M_PI);
}

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Scenes from texts and the means of their pictures, for the tests of the renderer. */
#ifndef KOKSMA_TESTS_RENDERING_H
#define KOKSMA_TESTS_RENDERING_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/render.h>

#include "scene/scene.h"
#include "test.h"

static inline koksma_scene *scene_of(const char *text)
{
    koksma_scene *scene;
    if (koksma__scene_open_text("test.json", text, strlen(text), &scene)) {
        fail_msg("%s", koksma_error_text());
    }
    return scene;
}

static inline koksma_render_options options_of(const koksma_scene *scene, const char *pattern, const char *integrator,
                                               int spp, int side)
{
    koksma_render_options options;
    koksma_render_options_init(&options, scene);
    assert_ok(koksma_pattern_spec(pattern, &options.pattern));
    options.integrator = koksma_integrator_find(integrator);
    assert_non_null(options.integrator);
    options.spp = spp;
    options.width = options.height = side;
    return options;
}

/* Mean of the image's first channel, and the standard error of it from the pixels, which are independent. */
static inline double mean_of(const koksma_scene *scene, const koksma_render_options *options, double *error)
{
    koksma_image image;
    double sum = 0, squares = 0;
    assert_ok(koksma_render(scene, options, NULL, &image));
    const size_t n = (size_t)image.width * (size_t)image.height;
    for (size_t i = 0; i < n; i++) {
        sum += (double)image.pixels[i * (size_t)image.channels];
    }
    for (size_t i = 0; i < n; i++) {
        const double off = (double)image.pixels[i * (size_t)image.channels] - sum / (double)n;
        squares += off * off;
    }
    koksma_image_fini(&image);
    if (error) {
        *error = n > 1 ? sqrt(squares / (double)(n - 1) / (double)n) : 0;
    }
    return sum / (double)n;
}

/* Within 4 standard errors and the rounding of floats. */
#define assert_mean(got, error, expected)                                                                            \
    do {                                                                                                             \
        const double got_ = (got), expected_ = (expected);                                                           \
        if (!(fabs(got_ - expected_) <= 4 * (error) + 2e-6 * fabs(expected_))) {                                     \
            fail_msg("%s = %.9g +- %.2g, expected %.9g", #got, got_, (double)(error), expected_);                    \
        }                                                                                                            \
    } while (0)

#endif

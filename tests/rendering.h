/* SPDX-License-Identifier: Apache-2.0 */
/* Random numbers, scenes from texts and the means of their pictures, for the tests of the renderer. */
#ifndef KOKSMA_TESTS_RENDERING_H
#define KOKSMA_TESTS_RENDERING_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/render.h>

#include "core/random.h"
#include "scene/scene.h"
#include "test.h"

/* All instruction sets, whose bits are the same. */
static const char *const isas[] = {"ref", "baseline", "avx2", "avx512"};

/* Random numbers and directions, one after the other. */
static uint64_t counter;

static inline double uniform(double low, double high)
{
    double pair[2];
    koksma__random_pair(11, KOKSMA__PURPOSE_TEST, counter++, 0, pair);
    return low + (high - low) * pair[0];
}

static inline void unit_vector(float v[3])
{
    double w[3], square;
    do {
        w[0] = uniform(-1, 1);
        w[1] = uniform(-1, 1);
        w[2] = uniform(-1, 1);
        square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    } while (!(square > 0.01 && square < 1));
    for (int k = 0; k < 3; k++) {
        v[k] = (float)(w[k] / sqrt(square));
    }
}

/* Texts of scenes may have ' in place of ", which literals would have to escape. */
static inline koksma_status open_text(const char *text, koksma_scene **scene)
{
    const size_t size = strlen(text);
    char *json = malloc(size + 1);
    assert_non_null(json);
    for (size_t i = 0; i <= size; i++) {
        json[i] = (char)(text[i] == '\'' ? '"' : text[i]);
    }
    const koksma_status status = koksma__scene_open_text("test.json", json, size, scene);
    free(json);
    return status;
}

static inline koksma_scene *scene_of(const char *text)
{
    koksma_scene *scene;
    assert_that(!open_text(text, &scene), "%s", koksma_error_text());
    return scene;
}

static inline koksma_scene *shipped(const char *name)
{
    koksma_scene *scene;
    assert_ok(koksma_scene_open(name, &scene));
    return scene;
}

/* The text of a scene that shows nothing but an even background. */
#define SKY_ALONE(radiance)                                                                                          \
    "{'camera': {'eye': [0, 0, 1], 'target': [0, 0, 0], 'fov_deg': 40}, 'background': " radiance                     \
    ", 'materials': [], 'shapes': []}"

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

/* The means of the image's channels, three times the same of a grey one, and the standard errors of them from the pixels,
   which are independent. */
static inline void means_of(const koksma_scene *scene, const koksma_render_options *options, double mean[3],
                            double error[3])
{
    koksma_image image;
    assert_ok(koksma_render(scene, options, NULL, &image));
    const size_t n = (size_t)image.width * (size_t)image.height, channels = (size_t)image.channels;
    for (size_t k = 0; k < 3; k++) {
        double sum = 0, squares = 0;
        for (size_t i = 0; i < n; i++) {
            sum += (double)image.pixels[i * channels + k % channels];
        }
        mean[k] = sum / (double)n;
        for (size_t i = 0; i < n; i++) {
            const double off = (double)image.pixels[i * channels + k % channels] - mean[k];
            squares += off * off;
        }
        error[k] = n > 1 ? sqrt(squares / (double)(n - 1) / (double)n) : 0;
    }
    koksma_image_fini(&image);
}

/* Those of the first channel. */
static inline double mean_of(const koksma_scene *scene, const koksma_render_options *options, double *error)
{
    double means[3], errors[3];
    means_of(scene, options, means, errors);
    if (error) {
        *error = errors[0];
    }
    return means[0];
}

/* Pixels over many seeds (the first channel) and the image's mean, which is known better from these than from pixels that
   differ by what they show. */
enum { MOST_PIXELS = 1024 };
typedef struct moments {
    double mean[MOST_PIXELS], square_error[MOST_PIXELS]; /* of each pixel, and of its mean */
    double image_mean, image_error, variance;            /* variance: of pixels, in the mean */
} moments;

/* By an adaptive method, if there is one, with a budget or without (0). */
static inline void measure(const koksma_scene *scene, koksma_render_options options, const char *method,
                           double budget, int seeds, uint64_t first, moments *out)
{
    static const koksma_run alone = {.threads = 1}; /* pictures are too small for more */
    const size_t pixels = (size_t)options.width * (size_t)options.height;
    koksma_adaptive_options adaptive;
    double sum = 0, squares = 0;
    assert_true(pixels <= MOST_PIXELS);
    memset(out, 0, sizeof *out);
    for (int s = 0; s < seeds; s++) {
        koksma_layers layers = {0};
        double total = 0;
        options.seed = first + (uint64_t)s;
        if (method) {
            assert_ok(koksma_adaptive_parse(method, &adaptive));
            adaptive.budget = budget;
            assert_ok(koksma_render_adaptive(scene, &options, &adaptive, &alone, &layers, NULL));
        } else {
            assert_ok(koksma_render(scene, &options, &alone, &layers.image));
        }
        for (size_t i = 0; i < pixels; i++) {
            const double value = (double)layers.image.pixels[i * (size_t)layers.image.channels];
            out->mean[i] += value / seeds;
            out->square_error[i] += value * value / seeds;
            total += value / (double)pixels;
        }
        sum += total / seeds;
        squares += total * total / seeds;
        koksma_layers_fini(&layers);
    }
    for (size_t i = 0; i < pixels; i++) {
        const double variance = fmax(out->square_error[i] - out->mean[i] * out->mean[i], 0);
        out->square_error[i] = variance / (seeds - 1);
        out->variance += variance / (double)pixels;
    }
    out->image_mean = sum;
    out->image_error = sqrt(fmax(squares - sum * sum, 0) / (seeds - 1));
}

static inline double mean_over_seeds(const koksma_scene *scene, koksma_render_options options, int seeds,
                                     uint64_t first, double *error)
{
    static moments m;
    measure(scene, options, NULL, 0, seeds, first, &m);
    *error = m.image_error;
    return m.image_mean;
}

/* The mean of a square picture of the scene in a text, to a depth (-1: the scene's). */
static inline double mean_of_text(const char *text, const char *pattern, const char *integrator, int depth, int spp,
                                  int side, double *error)
{
    koksma_scene *scene = scene_of(text);
    koksma_render_options options = options_of(scene, pattern, integrator, spp, side);
    options.depth = depth;
    const double mean = mean_of(scene, &options, error);
    koksma_scene_close(scene);
    return mean;
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

/* SPDX-License-Identifier: Apache-2.0 */
/* `many-lights` with a shadow ray to every light and with one shadow ray a viewing ray, at the same time on one
   thread: root mean square errors against 512 samples of all lights, over seeds, and whether the one is biased.
 */
#include <math.h>
#include <stdio.h>
#include <time.h>

#include <koksma/render.h>

enum { SEEDS = 5, ALL_SPP = 16, MOST_SPP = 4096 };

typedef struct result {
    double seconds, rmse, mean_off, mean_error; /* mean of image - reference over pixels, and its standard error */
} result;

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool measure(const koksma_scene *scene, koksma_render_options *options, const koksma_image *reference,
                    result *out)
{
    const koksma_run alone = {.threads = 1};
    const size_t n = (size_t)reference->width * (size_t)reference->height;
    double off = 0, squares = 0;
    *out = (result){.seconds = 1e30};
    for (int seed = 0; seed < SEEDS; seed++) {
        koksma_image image;
        koksma_image_error error;
        double mean = 0;
        options->seed = (uint64_t)seed + 1;
        const double start = now_s();
        if (koksma_render(scene, options, &alone, &image) || koksma_image_compare(&image, reference, &error)) {
            fprintf(stderr, "bench-lights: %s\n", koksma_error_text());
            return false;
        }
        out->seconds = fmin(out->seconds, now_s() - start);
        out->rmse += error.rmse / SEEDS;
        for (size_t i = 0; i < n; i++) {
            mean += ((double)image.pixels[i] - (double)reference->pixels[i]) / (double)n;
        }
        off += mean / SEEDS;
        squares += mean * mean / SEEDS;
        koksma_image_fini(&image);
    }
    out->mean_off = off;
    out->mean_error = sqrt(fmax(squares - off * off, 0) / (SEEDS - 1));
    return true;
}

int main(void)
{
    koksma_scene *scene;
    koksma_render_options options;
    koksma_image reference;
    result all, one;
    if (koksma_scene_open("many-lights", &scene)) {
        fprintf(stderr, "bench-lights: %s\n", koksma_error_text());
        return 1;
    }
    koksma_render_options_init(&options, scene);
    koksma_pattern_spec("sobol:scramble=owen", &options.pattern);
    options.spp = 512;
    options.seed = 999;
    if (koksma_render(scene, &options, NULL, &reference)) {
        return 1;
    }
    options.spp = ALL_SPP;
    if (!measure(scene, &options, &reference, &all)) {
        return 1;
    }
    printf("all lights   %4d spp  %.3f s  rmse %.5f\n", options.spp, all.seconds, all.rmse);
    options.lights = KOKSMA_LIGHTS_ONE;
    for (options.spp = 64; options.spp < MOST_SPP; options.spp *= 2) {
        if (!measure(scene, &options, &reference, &one)) {
            return 1;
        }
        printf("one shadow ray   %4d spp  %.3f s  rmse %.5f  mean difference %.1e +- %.1e\n", options.spp,
               one.seconds, one.rmse, one.mean_off, one.mean_error);
        if (one.seconds * 2 > all.seconds) {
            break;
        }
    }
    /* The error falls about as spp^-1/2 at worst: what it would be at exactly the same time. */
    printf("at equal time one shadow ray leaves %.2f of the error\n",
           one.rmse / all.rmse * sqrt(one.seconds / all.seconds));
    koksma_image_fini(&reference);
    koksma_scene_close(scene);
    return 0;
}

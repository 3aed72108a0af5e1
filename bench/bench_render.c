/* SPDX-License-Identifier: Apache-2.0 */
/* Msamples/s of `ball` at 512 x 384, 64 samples a pixel, direct light (a sample is a camera ray and a shadow ray to
   each of the two lights), best of a few runs, on one and on two threads, and whether the bits are the same.
   By processor time, a thread's share of it, so that other work on the machine counts little, and by the clock. It is
   a small scene of grey analytic shapes, all that lambert_lanes.c does: general renderers pay for meshes, spectra,
   textures and materials that anyone may add. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <koksma/render.h>

enum { ROUNDS = 8, WIDTH = 512, HEIGHT = 384, SPP = 64 };

static double now_s(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The best times of a few renders: a thread's processor time, and the clock's. */
typedef struct times {
    double processor, wall;
} times;

/* The last image stays in *image. */
static times best_s(const koksma_scene *scene, const koksma_render_options *options, int threads, koksma_image *image)
{
    const koksma_run run = {.threads = threads};
    times best = {1e30, 1e30};
    for (int i = 0; i < ROUNDS; i++) {
        koksma_image_fini(image);
        const double wall = now_s(CLOCK_MONOTONIC), processor = now_s(CLOCK_PROCESS_CPUTIME_ID);
        if (koksma_render(scene, options, &run, image)) {
            fprintf(stderr, "bench-render: %s\n", koksma_error_text());
            return best;
        }
        best.processor = fmin(best.processor, (now_s(CLOCK_PROCESS_CPUTIME_ID) - processor) / threads);
        best.wall = fmin(best.wall, now_s(CLOCK_MONOTONIC) - wall);
    }
    return best;
}

static int bench(const koksma_scene *scene, const char *pattern)
{
    koksma_render_options options;
    koksma_image one = {0}, two = {0};
    koksma_render_options_init(&options, scene);
    options.width = WIDTH;
    options.height = HEIGHT;
    options.spp = SPP;
    if (koksma_pattern_spec(pattern, &options.pattern)) {
        fprintf(stderr, "bench-render: %s\n", koksma_error_text());
        return 1;
    }
    const double samples = 1e-6 * WIDTH * HEIGHT * SPP;
    const times alone = best_s(scene, &options, 1, &one), both = best_s(scene, &options, 2, &two);
    const bool same = one.pixels && two.pixels && !memcmp(one.pixels, two.pixels, WIDTH * HEIGHT * sizeof(float));
    printf("%-12s  %8.1f  %8.1f  %9.1f  %8.1f  %s\n", pattern, samples / alone.processor, samples / alone.wall,
           samples / both.processor, samples / both.wall, same ? "yes" : "NO");
    koksma_image_fini(&one);
    koksma_image_fini(&two);
    return !same;
}

int main(void)
{
    static const char *const patterns[] = {"random", "jittered", "n-rooks", "regular"};
    koksma_scene *scene;
    int failed = 0;
    if (koksma_scene_open("ball", &scene)) {
        fprintf(stderr, "bench-render: %s\n", koksma_error_text());
        return 1;
    }
    printf("Msamples/s of ball, %d x %d, %d spp, direct light, %d rays a sample\n", WIDTH, HEIGHT, SPP,
           koksma_scene_rays_per_sample(scene));
    printf("pattern       1 thread  by clock  2 threads  by clock  same bits\n");
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        failed |= bench(scene, patterns[i]);
    }
    koksma_scene_close(scene);
    return failed;
}

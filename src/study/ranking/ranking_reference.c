/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sixteen replicates of 16 times as many samples as the patterns have, 64 at least: together 256 times as many, as
 * far as KOKSMA_MAX_SPP allows. Where errors fall as slowly as 1/sqrt N, the reference's is 1/16 of that of jittered
 * samples; with the power -3/4 of jittered edges 1/32. The mean without replicate r is mean - (r-th - mean) / (k -
 * 1), so that equal replicates leave no difference at all.
 */
#include "study/ranking/ranking_reference.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "image/formats.h"

enum { REPLICATES = KOKSMA__RANK_REPLICATES, LEAST_SPP = 64, TIMES = 16 };

long long koksma__rank_reference_spp(int spp)
{
    long long side = 1;
    while (side * side < LEAST_SPP || (side * side < (long long)TIMES * spp && side * side < KOKSMA_MAX_SPP)) {
        side++;
    }
    return side * side;
}

/* Deviations are updated replicate by replicate (Welford 1962). */
static bool add_replicate(koksma__rank_reference *reference, const koksma_image *image, double *squares)
{
    bool finite = true;
    const int r = reference->made++;
    for (size_t p = 0; p < reference->pixels; p++) {
        const double y = koksma__luminance(image, p), off = y - reference->mean[p];
        reference->without[p * REPLICATES + (size_t)r] = y;
        reference->mean[p] += off / (r + 1);
        squares[p] += off * (y - reference->mean[p]);
        finite &= (bool)isfinite(y);
    }
    return finite;
}

/* A normal error of deviation s / sqrt k has the mean absolute value sqrt(2/pi) s / sqrt k. */
static void finish(koksma__rank_reference *reference, const double *squares)
{
    double total = 0;
    for (size_t p = 0; p < reference->pixels; p++) {
        total += sqrt(2 / M_PI * squares[p] / (REPLICATES - 1) / REPLICATES);
        for (int r = 0; r < REPLICATES; r++) {
            double *at = &reference->without[p * REPLICATES + (size_t)r];
            *at = reference->mean[p] - (*at - reference->mean[p]) / (REPLICATES - 1);
        }
    }
    reference->error = total / (double)reference->pixels;
}

koksma_status koksma__rank_reference_init(koksma__rank_reference *reference, const koksma__study_scene *scene,
                                          const char *pattern, const char *variant, int spp, const koksma_run *run)
{
    const size_t pixels = (size_t)scene->width * (size_t)scene->height;
    double *squares = calloc(pixels, sizeof *squares);
    *reference = (koksma__rank_reference){.pixels = pixels,
                                          .mean = calloc(pixels, sizeof *reference->mean),
                                          .without = calloc(pixels, REPLICATES * sizeof *reference->without)};
    koksma_status status = squares && reference->mean && reference->without
                               ? KOKSMA_OK
                               : koksma__fail_memory(pixels * (REPLICATES + 2) * sizeof *squares);
    while (!status && reference->made < REPLICATES) {
        koksma_image image;
        const koksma__picture picture = {.pattern = pattern,
                                         .variant = variant,
                                         .spp = koksma__rank_reference_spp(spp),
                                         .width = scene->width,
                                         .height = scene->height,
                                         .seed =
                                             koksma__job_seed("rank-reference|%s|%s|%dx%d|%d", scene->hash, variant,
                                                              scene->width, scene->height, reference->made)};
        status = koksma__study_render(scene, &picture, run, &image);
        if (!status) {
            const bool finite = add_replicate(reference, &image, squares);
            koksma_image_fini(&image);
            status = finite ? KOKSMA_OK
                            : koksma__fail(KOKSMA_IMPOSSIBLE, "%s: pixels of the reference are not finite numbers",
                                           scene->name);
        }
    }
    if (!status) {
        finish(reference, squares);
        status = scene->render && reference->error == 0
                     ? koksma__fail(KOKSMA_IMPOSSIBLE,
                                    "%s: pictures by %s are equal for all seeds: a reference takes a pattern that "
                                    "depends on the seed",
                                    scene->name, pattern)
                     : KOKSMA_OK;
    }
    free(squares);
    return status;
}

void koksma__rank_reference_fini(koksma__rank_reference *reference)
{
    free(reference->mean);
    free(reference->without);
    *reference = (koksma__rank_reference){0};
}

void koksma__rank_reference_compare(const koksma__rank_reference *reference, const koksma_image *image,
                                    double errors[1 + KOKSMA__RANK_REPLICATES])
{
    double sums[REPLICATES] = {0}, sum = 0;
    for (size_t p = 0; p < reference->pixels; p++) {
        const double y = koksma__luminance(image, p), *without = reference->without + p * REPLICATES;
        sum += fabs(y - reference->mean[p]);
        for (int r = 0; r < REPLICATES; r++) {
            sums[r] += fabs(y - without[r]);
        }
    }
    errors[0] = sum / (double)reference->pixels;
    for (int r = 0; r < REPLICATES; r++) {
        errors[1 + r] = sums[r] / (double)reference->pixels;
    }
}

void koksma__rank_reference_subtract(const koksma__rank_reference *reference, const koksma_image *image,
                                     double *errors)
{
    for (size_t p = 0; p < reference->pixels; p++) {
        errors[p] = koksma__luminance(image, p) - reference->mean[p];
    }
}

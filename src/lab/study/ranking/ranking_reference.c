/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The reference of a ranking is the mean of sixteen replicates. At stage 0 each has as many samples as the patterns, and
 * at least 16; at each further stage 4 times as many, as far as KOKSMA_MAX_SPP allows: at stage 2 the reference has 256
 * times as many samples as a trial. Where errors fall as slowly as 1/sqrt N, its error is then 1/16 of that of an image
 * with the same pattern; where they fall as N^-3/4, it is 1/32. Stage 1 begins with 24 trials of a pattern and stage 2
 * with 96, so that a reference costs at most about as much as the trials of the closest patterns so far, and a ranking
 * shows its first results after the time of 16 trials and of the first rounds. The mean without replicate r is computed
 * as mean - (replicate r - mean) / (k - 1) for k replicates, so that equal replicates give exactly equal means.
 */
#include "study/ranking/ranking_reference.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "image/formats.h"
#include "image/image.h"

enum { REPLICATES = KOKSMA__RANK_REPLICATES, LEAST_SPP = 16, STAGE_1 = 3, STAGE_2 = 7 };

int koksma__rank_reference_stage(int round)
{
    return round < STAGE_1 ? 0 : round < STAGE_2 ? 1 : 2;
}

long long koksma__rank_reference_spp(int spp, int stage)
{
    const long long least = (long long)(spp > LEAST_SPP ? spp : LEAST_SPP) << 2 * stage;
    long long side = 1;
    while (side * side < least && side * side < KOKSMA_MAX_SPP) {
        side++;
    }
    return side * side;
}

/* The luminance of pixel p of the mean so far. */
static double luminance(const koksma__rank_reference *reference, size_t p)
{
    const double *v = reference->mean + p * (size_t)reference->metric.metric->channels;
    return reference->metric.metric->channels == 1 ? v[0] : KOKSMA__LUMINANCE(v);
}

/* Adds a replicate by Welford's method (1962). squares: sums of the squared deviations of each pixel's luminance.
   Returns whether all pixels are finite. */
static bool add_replicate(koksma__rank_reference *reference, const koksma_image *image, double *squares)
{
    bool finite = true;
    const int r = reference->made++;
    const size_t channels = (size_t)reference->metric.metric->channels;
    double *const values = reference->without + (size_t)r * reference->values;
    koksma__metric_values(reference->metric.metric, image, values);
    for (size_t p = 0; p < reference->pixels; p++) {
        const double y = koksma__luminance(image, p), off = y - luminance(reference, p);
        for (size_t v = p * channels; v < (p + 1) * channels; v++) {
            reference->mean[v] += (values[v] - reference->mean[v]) / (r + 1);
            finite &= (bool)isfinite(values[v]);
        }
        squares[p] += off * (y - luminance(reference, p));
    }
    return finite;
}

/* Computes the expected error of the reference and its means without each replicate. A normal error of standard
   deviation s / sqrt k has the mean absolute value sqrt(2/pi) s / sqrt k. */
static void finish(koksma__rank_reference *reference, const double *squares)
{
    double total = 0;
    for (size_t p = 0; p < reference->pixels; p++) {
        total += sqrt(2 / M_PI * squares[p] / (REPLICATES - 1) / REPLICATES);
    }
    for (size_t i = 0; i < REPLICATES * reference->values; i++) {
        const double mean = reference->mean[i % reference->values];
        reference->without[i] = mean - (reference->without[i] - mean) / (REPLICATES - 1);
    }
    reference->error = total / (double)reference->pixels;
}

/* Allocates a reference without replicates. Errors: MEMORY. */
static koksma_status begin(koksma__rank_reference *reference, const koksma_metric_spec *metric,
                           const koksma__study_scene *scene)
{
    const size_t pixels = (size_t)scene->width * (size_t)scene->height;
    *reference = (koksma__rank_reference){.metric = metric ? *metric : (koksma_metric_spec){&koksma__metric_mae, {0}},
                                          .width = scene->width,
                                          .height = scene->height,
                                          .pixels = pixels};
    reference->values = pixels * (size_t)reference->metric.metric->channels;
    reference->mean = calloc(reference->values, sizeof *reference->mean);
    reference->without = calloc(reference->values, REPLICATES * sizeof *reference->without);
    return reference->mean && reference->without
               ? KOKSMA_OK
               : koksma__fail_memory(reference->values * (REPLICATES + 1) * sizeof *reference->mean);
}

static koksma_status fail_of_pixels(const koksma__study_scene *scene)
{
    return koksma__fail(KOKSMA_IMPOSSIBLE, "%s: pixels of the reference are not finite numbers", scene->name);
}

static koksma_status render_replicate(koksma__rank_reference *reference, const koksma__study_scene *scene,
                                      koksma__picture *picture, int stage, double *squares, const koksma_run *run)
{
    koksma_image image;
    picture->seed = koksma__job_seed("rank-reference|%s|%s|%dx%d|%d|%d", scene->hash, picture->variant, scene->width,
                                     scene->height, stage, reference->made);
    koksma_status status = koksma__study_render(scene, picture, run, &image);
    if (!status) {
        status = add_replicate(reference, &image, squares) ? KOKSMA_OK : fail_of_pixels(scene);
        koksma_image_fini(&image);
    }
    return status;
}

koksma_status koksma__rank_reference_init(koksma__rank_reference *reference, const koksma_metric_spec *metric,
                                          const koksma__study_scene *scene, const char *pattern,
                                          const char *of_trials, int spp, int stage, const koksma_run *run)
{
    char variant[KOKSMA__VARIANT_TEXT];
    koksma__variant_of_reference(of_trials, variant);
    koksma_status status = begin(reference, metric, scene);
    double *squares = calloc(reference->pixels, sizeof *squares);
    koksma__picture picture = {.pattern = pattern,
                               .variant = variant,
                               .spp = koksma__rank_reference_spp(spp, stage),
                               .width = scene->width,
                               .height = scene->height};
    status = status || squares ? status : koksma__fail_memory(reference->pixels * sizeof *squares);
    while (!status && reference->made < REPLICATES) {
        status = render_replicate(reference, scene, &picture, stage, squares, run);
    }
    if (!status) {
        finish(reference, squares);
        status = scene->render && reference->error == 0
                     ? koksma__fail(KOKSMA_IMPOSSIBLE,
                                    "%s: %s makes the same picture for every seed, but a reference needs a pattern "
                                    "that depends on the seed",
                                    scene->name, pattern)
                     : KOKSMA_OK;
    }
    free(squares);
    return status;
}

koksma_status koksma__rank_reference_take(koksma__rank_reference *reference, const koksma_metric_spec *metric,
                                          const koksma__study_scene *scene, const koksma_image *image)
{
    KOKSMA__TRY(koksma__image_usable(image));
    KOKSMA__FAIL_IF(image->width != scene->width || image->height != scene->height, KOKSMA_ARGUMENT,
                    "the reference has %d x %d pixels, and the images of the patterns %d x %d: choose its size",
                    image->width, image->height, scene->width, scene->height);
    KOKSMA__TRY(begin(reference, metric, scene));
    koksma__metric_values(reference->metric.metric, image, reference->mean);
    bool finite = true;
    for (size_t v = 0; v < reference->values; v++) {
        finite &= (bool)isfinite(reference->mean[v]);
    }
    for (size_t i = 0; i < REPLICATES * reference->values; i++) {
        reference->without[i] = reference->mean[i % reference->values];
    }
    reference->made = REPLICATES;
    reference->error = NAN;
    return finite ? KOKSMA_OK : fail_of_pixels(scene);
}

void koksma__rank_reference_fini(koksma__rank_reference *reference)
{
    free(reference->mean);
    free(reference->without);
    *reference = (koksma__rank_reference){0};
}

koksma_status koksma__rank_reference_compare(const koksma__rank_reference *reference, const koksma_image *image,
                                             double errors[KOKSMA__RANK_ERRORS])
{
    const koksma_metric_spec *spec = &reference->metric;
    const size_t size = (reference->values + reference->pixels) * sizeof(double);
    double *const values = malloc(size);
    KOKSMA__REQUIRE_MEMORY(values, size);
    double *const map = values + reference->values;
    koksma__metric_values(spec->metric, image, values);
    koksma_status status = KOKSMA_OK;
    for (int r = REPLICATES; !status && r >= 0;
         r--) { /* the whole reference comes last, because koksma__metric_pool below reorders its errors in `map` */
        const koksma_metric_input in = {spec->params, reference->width, reference->height, values,
                                        r ? reference->without + (size_t)(r - 1) * reference->values
                                          : reference->mean};
        const char kept = koksma__call_begin();
        status = koksma__call_end(kept, spec->metric->errors(&in, map), "koksma_metric.errors");
        errors[r] = status ? 0 : koksma__metric_mean(spec->metric, map, reference->pixels);
    }
    if (!status) {
        const koksma_metric_value value = koksma__metric_pool(spec->metric, map, reference->pixels);
        errors[KOKSMA__RANK_ROBUST] = value.robust;
        errors[KOKSMA__RANK_TOP_SHARE] = value.top_share;
    }
    free(values);
    return status;
}

void koksma__rank_reference_subtract(const koksma__rank_reference *reference, const koksma_image *image,
                                     double *errors)
{
    for (size_t p = 0; p < reference->pixels; p++) {
        errors[p] = koksma__luminance(image, p) - luminance(reference, p);
    }
}

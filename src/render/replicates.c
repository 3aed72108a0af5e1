/* SPDX-License-Identifier: Apache-2.0 */
/*
 * An image with its standard errors, from R independent renders (koksma_render_replicates). Mean and sum of squared
 * deviations of each value are updated by Welford's method (1962), so that the replicates need no memory. The update with
 * replicate r adds (r - 1) / r (x_r - mean of those before)^2 to the sum: for each pixel these are uncorrelated, and each
 * estimates the variance of one replicate. Their means over the pixels are R - 1 estimates of the mean square error of a
 * replicate, from which its interval follows by Student's t.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "image/formats.h"
#include "image/image.h"
#include "render/one_image.h"
#include "samples/uses.h"
#include "stats/stats.h"

enum { LEAST = 3 };

typedef struct job {
    const koksma_run *run; /* of the caller */
    size_t replicates, made;
    size_t pixels, values;  /* values: pixels times channels */
    double *mean, *squares; /* of each value */
    double *means, *errors; /* means[r]: luminance of replicate r; errors[r - 1]: of r >= 1, see above */
} job;

static bool go_on(void *context, double fraction)
{
    const job *j = context;
    return koksma__keep_going(j->run, ((double)j->made + fraction) / (double)j->replicates);
}

/* The luminance of pixel p of the mean so far. */
static double luminance(const job *j, size_t p)
{
    const size_t channels = j->values / j->pixels;
    const double *v = j->mean + p * channels;
    return channels == 1 ? v[0] : KOKSMA__LUMINANCE(v);
}

static void add(job *j, const koksma_image *image)
{
    const double count = (double)j->made + 1;
    double total = 0, squares = 0;
    for (size_t p = 0; p < j->pixels; p++) {
        const double y = koksma__luminance(image, p), off = y - luminance(j, p);
        total += y;
        squares += off * off;
    }
    for (size_t v = 0; v < j->values; v++) {
        const double off = (double)image->pixels[v] - j->mean[v];
        j->mean[v] += off / count;
        j->squares[v] += off * ((double)image->pixels[v] - j->mean[v]);
    }
    if (j->made) {
        j->errors[j->made - 1] = (count - 1) / count * squares / (double)j->pixels;
    }
    j->means[j->made++] = total / (double)j->pixels;
}

/* A use whose pattern has one set, or may be biased, has errors that no number of replicates shows. */
static koksma_status check_patterns(const koksma_render_options *options)
{
    for (int u = 0; u < KOKSMA_N_USES; u++) {
        const int group = koksma__place_of_use_at(options, u).group;
        const koksma_spec *own = group < 0 ? &options->patterns[u] : &options->groups[group].pattern,
                          *spec = own->pattern ? own : &options->pattern;
        char text[KOKSMA_MAX_SPEC];
        koksma_spec_text(spec, text);
        KOKSMA__FAIL_IF(
            koksma_has_one_set(spec), KOKSMA_ARGUMENT,
            "pattern: %s has one set, so that its replicates do not show its error; shift=1 or a scramble "
            "makes it random",
            text);
        KOKSMA__FAIL_IF(
            !koksma_is_unbiased(spec), KOKSMA_ARGUMENT,
            "pattern: %s is not known to be unbiased, and replicates do not show a bias; shift=1 makes it "
            "unbiased",
            text);
    }
    return KOKSMA_OK;
}

/* Renders the replicates; their sums have the shape of the first. */
static koksma_status render_all(job *j, const koksma_scene *scene, const koksma_render_options *options,
                                koksma_replicates *out)
{
    koksma_render_options o = *options;
    const koksma_run run = {.threads = j->run ? j->run->threads : 0, .keep_going = go_on, .context = j};
    koksma_status status = KOKSMA_OK;
    for (size_t r = 0; r < j->replicates && !status; r++) {
        koksma_layers layers;
        o.seed = options->seed + r;
        status = koksma_render_only(scene, &o, &run, &layers);
        if (!status && !r) {
            const koksma_image *first = &layers.image;
            j->pixels = (size_t)first->width * (size_t)first->height;
            j->values = j->pixels * (size_t)first->channels;
            j->mean = calloc(j->values, sizeof *j->mean);
            j->squares = calloc(j->values, sizeof *j->squares);
            status = j->mean && j->squares ? KOKSMA_OK : koksma__fail_memory(2 * j->values * sizeof *j->mean);
            status = status ? status : koksma_image_init(&out->image, first->width, first->height, first->channels);
            status = status ? status : koksma_image_init(&out->error, first->width, first->height, first->channels);
        }
        if (!status) {
            add(j, &layers.image);
            out->rays += layers.rays;
        }
        koksma_layers_fini(&layers);
    }
    return status;
}

/* Computes the results from the sums. */
static void finish(const job *j, koksma_replicates *out)
{
    const double count = (double)j->replicates;
    for (size_t v = 0; v < j->values; v++) {
        out->image.pixels[v] = (float)j->mean[v];
        out->error.pixels[v] = (float)sqrt(j->squares[v] / (count - 1) / count);
    }
    const koksma__summary mean = koksma__summarize(j->means, j->replicates, 1),
                          square = koksma__summarize_sizes(j->errors, j->replicates - 1, 1);
    out->replicates = j->replicates;
    out->mean = mean.mean;
    out->mean_low = mean.low;
    out->mean_high = mean.high;
    out->rmse = sqrt(square.mean / count);
    out->rmse_low = sqrt(square.low / count);
    out->rmse_high = sqrt(square.high / count);
}

koksma_status koksma_render_replicates(const koksma_scene *scene, const koksma_render_options *options,
                                       size_t replicates, const koksma_run *run, koksma_replicates *out)
{
    KOKSMA__REQUIRE(scene, options, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__TRY(check_patterns(options));
    KOKSMA__FAIL_IF(replicates < LEAST || replicates > KOKSMA_MAX_REPLICATES, KOKSMA_ARGUMENT,
                    "replicates: it takes %d to %d, not %zu", LEAST, KOKSMA_MAX_REPLICATES, replicates);
    KOKSMA__FAIL_IF(replicates - 1 > UINT64_MAX - options->seed, KOKSMA_ARGUMENT,
                    "seed: %zu replicates from %llu on exceed the last seed, 2^64 - 1", replicates,
                    (unsigned long long)options->seed);
    *out = (koksma_replicates){0};
    job j = {.run = run,
             .replicates = replicates,
             .means = calloc(replicates, sizeof *j.means),
             .errors = calloc(replicates, sizeof *j.errors)};
    koksma_status status = j.means && j.errors ? render_all(&j, scene, options, out)
                                               : koksma__fail_memory(2 * replicates * sizeof *j.means);
    if (status) {
        koksma_replicates_fini(out);
    } else {
        finish(&j, out);
    }
    free(j.mean);
    free(j.squares);
    free(j.means);
    free(j.errors);
    return status;
}

void koksma_replicates_fini(koksma_replicates *replicates)
{
    if (replicates) {
        koksma_image_fini(&replicates->image);
        koksma_image_fini(&replicates->error);
        *replicates = (koksma_replicates){0};
    }
}

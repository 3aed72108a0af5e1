/* SPDX-License-Identifier: Apache-2.0 */
/*
 * two-stage: the first sets only decide how many sets the pixel gets, and the estimate is from those, which are
 * fresh. The numbers of samples are then independent of the values that are averaged, and there is no bias (Kirk &
 * Arvo 1991).
 *
 *     with a threshold   k = (e / threshold)^2 sets, e = s / (m + floor) the relative error that one set has
 *     with a budget      k proportional to e, as many as it has room for (Neyman 1934: the best allocation for sums
 *                        of squared relative errors)
 *
 * s is the standard deviation of the sets' means, m their mean. A few sets can agree by luck; so where the samples
 * are not all equal, e^2 is averaged with that of the image, which weighs as `prior` degrees of freedom. Every pixel
 * gets one fresh set at least.
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "render/samples/adaptive/adaptive.h"

enum { FLOOR = KOKSMA__SETS_THRESHOLD + 1, PRIOR };

static const koksma_param params[] = {
    KOKSMA__SETS_PARAMS(4, 2),
    {"threshold", "standard error over (mean + floor); 0: none, the budget decides", 0, 0, 1e6, NULL, false},
    {"floor", "luminance below which errors count as absolute", 0.01, 1e-9, 1e9, NULL, false},
    {"prior", "degrees of freedom that the mean error of the image weighs", 1, 0, 1e6, NULL, false},
    {0},
};

static void decide(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand)
{
    (void)run;
    (void)pixel;
    (void)scratch;
    (void)demand;
}

/* The squared relative error of one set, from the pilot alone. */
static double square_of(const koksma__adaptive *run, size_t pixel)
{
    const koksma__pixel_sets *p = koksma__sets_of(run, pixel);
    const double error =
        koksma__sets_standard_error(run, p) / (fmax(koksma__sets_mean(run, p), 0) + run->options->params[FLOOR]);
    return error * error * p->sets;
}

/* extra: relative errors of one set, by pixel. */
static void find_errors(const koksma__adaptive *run, double *errors)
{
    const double prior = run->options->params[PRIOR];
    double mean = 0;
    for (size_t p = 0; p < run->pixels; p++) {
        errors[p] = square_of(run, p);
        mean += errors[p] / (double)run->pixels;
    }
    for (size_t p = 0; p < run->pixels; p++) {
        const koksma__pixel_sets *sets = koksma__sets_of(run, p);
        bool varies = false;
        for (int k = 0; k < run->frame->channels; k++) {
            varies |= sets->lo[k] < sets->hi[k];
        }
        const double own = sets->sets - 1.0;
        errors[p] = varies ? sqrt((own * errors[p] + prior * mean) / (own + prior)) : 0;
    }
}

/* Sets of a pixel for a scale: 1 at least, `most` at most. */
static double sets_for(const koksma__adaptive *run, size_t pixel, double scale)
{
    const double *errors = run->extra;
    const double threshold = run->options->params[KOKSMA__SETS_THRESHOLD], error = errors[pixel];
    const double wanted = threshold > 0 ? ceil(error * error / (threshold * threshold)) : HUGE_VAL;
    const double most = run->options->params[KOKSMA__SETS_MOST], sets = fmin(wanted, floor(error * scale));
    return sets > most ? most : sets < 1 ? 1 : sets;
}

static double total_for(const koksma__adaptive *run, double scale)
{
    double total = 0;
    for (size_t p = 0; p < run->pixels; p++) {
        total += sets_for(run, p, scale);
    }
    return total * (double)koksma__set_size(run);
}

/* The largest scale that the budget allows; what each pixel's one set costs is in `spent` already. */
static double find_scale(const koksma__adaptive *run)
{
    const double ones = (double)run->pixels * (double)koksma__set_size(run);
    const double left = (double)(run->budget - run->spent) + ones;
    double lo = 0, hi = 1e12;
    if (run->budget == UINT64_MAX || total_for(run, hi) <= left) {
        return hi;
    }
    for (int i = 0; i < 100; i++) {
        const double middle = i < 60 ? sqrt(fmax(lo, 1e-6) * hi) : 0.5 * (lo + hi);
        if (total_for(run, middle) <= left) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    return lo;
}

static koksma_status open(koksma__adaptive *run)
{
    const koksma_status status = koksma__sets_open(run);
    run->extra = status ? NULL : malloc(run->pixels * sizeof(double));
    return status || run->extra ? status : koksma__fail_memory(run->pixels * sizeof(double));
}

/* The pilot is dropped when what replaces it is there, and not before: of a picture that is interrupted in between
   it is all that there is. */
static void take(koksma__adaptive *run, size_t pixel, const float *rgb, const float *weights)
{
    koksma__pixel_sets *sets = koksma__sets_of(run, pixel);
    *sets = (koksma__pixel_sets){.drawn = sets->drawn};
    koksma__sets_take(run, pixel, rgb, weights);
}

static void last(koksma__adaptive *run)
{
    find_errors(run, run->extra);
    const double scale = find_scale(run);
    for (size_t p = 0; p < run->pixels; p++) {
        const double n = sets_for(run, p, scale);
        run->demands[p] =
            (koksma__sample_demand){.now = (uint32_t)(n * (double)koksma__set_size(run)), .selected = true};
    }
}

static const koksma__adaptive_method method = {.fresh = true,
                                               .pilot = true,
                                               .open = open,
                                               .close = koksma__sets_close,
                                               .draw = koksma__sets_draw,
                                               .take = take,
                                               .decide = decide,
                                               .last = last,
                                               .result = koksma__sets_result};

const koksma_adaptive koksma__adaptive_two_stage = {
    .name = "two-stage",
    .title = "first sets decide, fresh ones are counted: no bias",
    .cite = "kirk1991 neyman1934",
    .params = params,
    .functions = &method,
};

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
 * s is the standard deviation of the sets' means, m their mean. Every pixel gets one fresh set at least.
 */
#include <math.h>

#include "render/adaptive/adaptive.h"

enum { FLOOR = KOKSMA__SETS_THRESHOLD + 1 };

static const koksma_param params[] = {
    KOKSMA__SETS_PARAMS(4, 2),
    {"threshold", "standard error over (mean + floor); 0: none, the budget decides", 0, 0, 1e6, NULL, false},
    {"floor", "luminance below which errors count as absolute", 0.01, 1e-9, 1e9, NULL, false},
    {0},
};

static void decide(koksma__adaptive *run, size_t pixel, void *scratch, koksma__ask *ask)
{
    (void)run;
    (void)pixel;
    (void)scratch;
    (void)ask;
}

/* The relative error of one set. */
static double error_of(const koksma__adaptive *run, size_t pixel)
{
    const koksma__pixel_sets *p = koksma__sets_of(run, pixel);
    return koksma__sets_standard_error(run, p) * sqrt(p->sets) /
           (fmax(koksma__sets_mean(run, p), 0) + run->options->params[FLOOR]);
}

/* Sets of a pixel for a scale: 1 at least, `most` at most. */
static double sets_for(const koksma__adaptive *run, size_t pixel, double scale)
{
    const double threshold = run->options->params[KOKSMA__SETS_THRESHOLD], error = error_of(run, pixel);
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

static void last(koksma__adaptive *run)
{
    const double scale = find_scale(run);
    for (size_t p = 0; p < run->pixels; p++) {
        koksma__pixel_sets *sets = koksma__sets_of(run, p);
        const double n = sets_for(run, p, scale);
        *sets = (koksma__pixel_sets){.drawn = sets->drawn};
        run->asks[p] = (koksma__ask){.now = (uint32_t)(n * (double)koksma__set_size(run)), .served = true};
    }
}

static const koksma__adaptive_rules rules = {.fresh = true,
                                             .pilot = true,
                                             .open = koksma__sets_open,
                                             .close = koksma__sets_close,
                                             .draw = koksma__sets_draw,
                                             .take = koksma__sets_take,
                                             .decide = decide,
                                             .last = last,
                                             .result = koksma__sets_result};

const koksma_adaptive koksma__adaptive_two_stage = {
    .name = "two-stage",
    .title = "first sets decide, fresh ones are counted: no bias",
    .cite = "kirk1991 neyman1934",
    .params = params,
    .rules = &rules,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The method `two-stage`: the first sets (the pilot) only decide how many sets a pixel gets; the estimate uses new
 * sets, whose number is then independent of the values that are averaged, so that there is no bias (Kirk & Arvo
 * 1991). The number of sets is
 *
 *     k = (e / threshold)^2     with a threshold, where e = s / (m + floor) is the relative error of one set
 *     k proportional to e       with a budget, as many sets as the budget allows (Neyman 1934: the best allocation for
 *                               sums of squared relative errors)
 *
 * Here s is the standard deviation of the means of the pilot sets and m is their mean. A few sets can agree by
 * chance; so unless the samples of a pixel are all equal, e^2 is averaged with the mean e^2 of the image, which has
 * the weight of `prior` degrees of freedom. Every pixel gets at least one new set.
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "render/samples/adaptive/adaptive.h"

enum { FLOOR = KOKSMA__SETS_THRESHOLD + 1, PRIOR };

static const koksma_param params[] = {
    KOKSMA__SETS_PARAMS(4, 2),
    {"threshold", "largest standard error divided by (mean + floor); 0: no threshold, only a budget", 0, 0, 1e6, NULL,
     false},
    {"floor", "luminance below which errors count as absolute", 0.01, 1e-9, 1e9, NULL, false},
    {"prior", "weight of the image's mean squared error in a pixel's estimate, in degrees of freedom", 1, 0, 1e6,
     NULL, false},
    {0},
};

/* Returns the squared relative error of one set, estimated from the pilot. */
static double square_of(const koksma__adaptive *run, size_t pixel)
{
    const koksma__pixel_sets *p = koksma__sets_of(run, pixel);
    const double error =
        koksma__sets_standard_error(run, p) / (fmax(koksma__sets_mean(run, p), 0) + run->options->params[FLOOR]);
    return error * error * p->sets;
}

/* Computes the relative error of one set for each pixel, to be stored in run->extra. */
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

/* Returns the number of sets of a pixel, from 1 to the parameter `most`: as many as the threshold requires, but at
   most `scale` times the relative error of one set. */
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

/* Finds the largest scale that the budget allows; the cost of one set per pixel is already in `spent`. */
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

static const koksma__adaptive_method method = {
    .family = &koksma__sets_family, .fresh = true, .pilot = true, .open = open, .last = last};

const koksma_adaptive koksma__adaptive_two_stage = {
    .name = "two-stage",
    .title = "the first sets decide, and only new sets count: no bias",
    .cite = "kirk1991 neyman1934",
    .params = params,
    .functions = &method,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The method `relative-error`: a pixel gets more samples while the standard error of its luminance is above threshold
 * x (mean + floor). The standard error is estimated from the variance between the means of the sets, which are
 * independent replicates of the pattern. The samples of one stratified set are not independent, and their variance
 * over n overestimates the error. For the same reason a sequence is not continued: each set is drawn independently.
 * With k sets the estimate has k - 1 degrees of freedom: with fewer than 4 sets in the first round many pixels stop
 * by chance.
 */
#include <math.h>

#include "render/samples/adaptive/adaptive_sets.h"

enum { FLOOR = KOKSMA__SETS_THRESHOLD + 1 };

static const koksma_param params[] = {
    KOKSMA__SETS_PARAMS(4, 2),
    {"threshold", "largest standard error divided by (mean + floor); 0: no threshold, only a budget", 0, 0, 1e6, NULL,
     false},
    {"floor", "luminance below which errors count as absolute", 0.01, 1e-9, 1e9, NULL, false},
    {0},
};

static void decide(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand)
{
    const koksma__pixel_sets *p = koksma__sets_of(run, pixel);
    const double *values = run->options->params;
    const double error = koksma__sets_standard_error(run, p) / (fmax(koksma__sets_mean(run, p), 0) + values[FLOOR]);
    (void)scratch;
    if (error > values[KOKSMA__SETS_THRESHOLD]) {
        koksma__sets_demand(run, pixel, 1, error, demand);
    }
}

static const koksma__adaptive_method method = {KOKSMA__SETS_METHOD, .fresh = true, .open = koksma__sets_open,
                                               .take = koksma__sets_take, .decide = decide};

const koksma_adaptive koksma__adaptive_relative_error = {
    .name = "relative-error",
    .title = "more samples until the means of the sets agree, relative to the pixel's brightness",
    .cite = "-",
    .params = params,
    .functions = &method,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * relative-error: more while the standard error of the pixel's luminance is above threshold x (mean + floor). It is
 * taken from the spread of the means of the sets, which are independent replicates of the pattern: samples of one
 * stratified set are not, and their variance over n says too much. Sets of a sequence are drawn afresh,
 * too, not continued. From k sets it has k - 1 degrees of freedom: with fewer than 4 at first many pixels stop by
 * luck.
 */
#include <math.h>

#include "render/samples/adaptive/adaptive.h"

enum { FLOOR = KOKSMA__SETS_THRESHOLD + 1 };

static const koksma_param params[] = {
    KOKSMA__SETS_PARAMS(4, 2),
    {"threshold", "standard error over (mean + floor); 0: none, the budget decides", 0, 0, 1e6, NULL, false},
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

static const koksma__adaptive_method method = {.fresh = true,
                                               .open = koksma__sets_open,
                                               .close = koksma__sets_close,
                                               .draw = koksma__sets_draw,
                                               .take = koksma__sets_take,
                                               .decide = decide,
                                               .result = koksma__sets_result};

const koksma_adaptive koksma__adaptive_relative_error = {
    .name = "relative-error",
    .title = "more until the sets' means agree, relative to the pixel's brightness",
    .cite = "-",
    .params = params,
    .functions = &method,
};

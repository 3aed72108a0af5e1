/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The method `contrast`: the eye responds to ratios of light, so a pixel gets more samples while its samples have a
 * high contrast
 *
 *     C = (max - min) / (max + min).
 *
 * The contrast is high if it is above 0.4 in red, 0.3 in green or 0.6 in blue (Mitchell 1987); grey images use the
 * bound of green. The parameter `threshold` multiplies the three bounds; 1 gives Mitchell's. More samples can only
 * widen the range, so a pixel that once exceeds the threshold gets the largest number of samples. Every pixel thus
 * ends with one of two sample counts, as in the paper, unless the budget is exhausted first.
 */
#include <math.h>

#include "render/samples/adaptive/adaptive_sets.h"

static const koksma_param params[] = {
    KOKSMA__SETS_PARAMS(1, 1),
    {"threshold", "factor that multiplies Mitchell's bounds; 0: no threshold, only a budget", 0, 0, 1e6, NULL, false},
    {0},
};

static void decide(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand)
{
    static const double bounds[3] = {0.4, 0.3, 0.6};
    const koksma__pixel_sets *p = koksma__sets_of(run, pixel);
    double score = 0;
    (void)scratch;
    for (int k = 0; k < run->frame->channels; k++) {
        const double lo = fmax((double)p->lo[k], 0), hi = (double)p->hi[k];
        const double contrast = hi > lo ? (hi - lo) / (hi + lo) : 0;
        score = fmax(score, contrast / bounds[run->frame->channels == 1 ? 1 : k]);
    }
    if (score > run->options->params[KOKSMA__SETS_THRESHOLD]) {
        /* pixels with fewer samples come first, so that the budget is spread */
        koksma__sets_demand(run, pixel, 1, score / p->sets, demand);
    }
}

static const koksma__adaptive_method method = {KOKSMA__SETS_METHOD, .open = koksma__sets_open,
                                               .take = koksma__sets_take, .decide = decide};

const koksma_adaptive koksma__adaptive_contrast = {
    .name = "contrast",
    .title = "more samples for pixels whose samples have a high contrast",
    .cite = "mitchell1987",
    .params = params,
    .functions = &method,
};

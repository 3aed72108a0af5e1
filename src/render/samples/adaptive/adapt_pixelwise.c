/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The methods that decide pixel by pixel whether a pixel gets another set.
 *
 * contrast: the eye responds to ratios of light, so a pixel gets more samples while its samples have a
 * high contrast
 *
 *     C = (max - min) / (max + min).
 *
 * The contrast is high if it is above 0.4 in red, 0.3 in green or 0.6 in blue (Mitchell 1987); grey images use the
 * bound of green. The parameter `threshold` multiplies the three bounds; 1 gives Mitchell's. More samples can only
 * widen the range, so a pixel that once exceeds the threshold gets the largest number of samples. Every pixel thus
 * ends with one of two sample counts, as in the paper, unless the budget is exhausted first.
 *
 * confidence: a pixel gets more samples while the uncertainty of its luminance is above the threshold.
 * With n samples of variance s^2, the uncertainty is
 *
 *     test=t      the half width of the mean's interval: t_(n-1),(1+level)/2  s / sqrt(n)   (Purgathofer 1987)
 *     test=chi2   the upper confidence bound of the mean's standard error (Lee, Redner & Uselton 1985):
 *                 sqrt((n - 1) s^2 / chi2_(n-1),(1-level) / n)
 *
 * Both tests assume independent samples from a normal distribution; stratified samples have a smaller error than the
 * tests estimate.
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "render/samples/adaptive/adaptive.h"
#include "stats/stats.h"

/* ---- contrast --------------------------------------------------------------------------------------------------- */

static const koksma_param contrast_params[] = {
    KOKSMA__SETS_PARAMS(1, 1),
    {"threshold", "factor that multiplies Mitchell's bounds; 0: no threshold, only a budget", 0, 0, 1e6, NULL, false},
    {0},
};

static void decide_by_contrast(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand)
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

static const koksma__adaptive_method contrast = {
    .family = &koksma__sets_family, .open = koksma__sets_open, .decide = decide_by_contrast};

const koksma_adaptive koksma__adaptive_contrast = {
    .name = "contrast",
    .title = "more samples for pixels whose samples have a high contrast",
    .cite = "mitchell1987",
    .params = contrast_params,
    .functions = &contrast,
};

/* ---- confidence ------------------------------------------------------------------------------------------ */

enum { TEST = KOKSMA__SETS_THRESHOLD + 1, LEVEL };
/* The factors are tabulated for up to FACTORS sets; for more sets they hardly change, and the last factor is used. */
enum { FACTORS = 1024 };

static const char *const tests[] = {"t", "chi2", NULL};
static const koksma_param confidence_params[] = {
    KOKSMA__SETS_PARAMS(1, 1),
    {"threshold", "uncertainty of luminance below which a pixel stops; 0: no threshold, only a budget", 0, 0, 1e6,
     NULL, false},
    {"test", "confidence interval of the mean (t), or bound of its standard error (chi2)", 0, 0, 1, tests, true},
    {"level", "confidence level", 0.9, 0.5, 0.9999, NULL, false},
    {0},
};

/* Returns the factor by which s / sqrt(n) is multiplied for n samples. */
static double factor(const koksma__adaptive *run, double n)
{
    const double level = run->options->params[LEVEL];
    if (run->options->params[TEST] > 0) {
        return sqrt((n - 1) / koksma__chi_squared_quantile(1 - level, n - 1));
    }
    return koksma__student_quantile(0.5 * (1 + level), n - 1);
}

static void decide_by_confidence(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand)
{
    const koksma__pixel_sets *p = koksma__sets_of(run, pixel);
    const double n = (double)p->sets * (double)koksma__set_size(run);
    const double error = sqrt(koksma__sets_variance(run, p) / n);
    (void)scratch;
    const double *factors = run->extra;
    const double doubt = error * factors[p->sets < FACTORS ? p->sets : FACTORS];
    if (doubt > run->options->params[KOKSMA__SETS_THRESHOLD]) {
        koksma__sets_demand(run, pixel, 1, doubt, demand);
    }
}

static koksma_status open_confidence(koksma__adaptive *run)
{
    const koksma_status status = koksma__sets_open(run);
    KOKSMA__FAIL_IF(!status && run->demands[0].now < 2, KOKSMA_N,
                    "confidence: the first round needs 2 samples; use a larger spp, or first=2");
    double *factors = status ? NULL : malloc((FACTORS + 1) * sizeof *factors);
    run->extra = factors;
    if (!status && !factors) {
        return koksma__fail_memory((FACTORS + 1) * sizeof *factors);
    }
    const double most = run->options->params[KOKSMA__SETS_MOST];
    for (int k = 1; !status && k <= FACTORS && k <= most; k++) {
        const double n = (double)koksma__set_size(run) * k;
        factors[k] = n > 1 ? factor(run, n) : 0;
    }
    return status;
}

static const koksma__adaptive_method confidence = {
    .family = &koksma__sets_family, .open = open_confidence, .decide = decide_by_confidence};

const koksma_adaptive koksma__adaptive_confidence = {
    .name = "confidence",
    .title = "more samples until a confidence interval of the pixel's luminance is narrow",
    .cite = "lee1985 purgathofer1987",
    .params = confidence_params,
    .functions = &confidence,
};

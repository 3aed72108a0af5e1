/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The methods whose samples come in sets of the pattern with spp points each, and which decide pixel by pixel whether it
 * gets another set. Each set of a pixel is drawn as if it were for a different pixel. If the pattern is a sequence, the
 * sets are instead consecutive blocks of one sequence, so that the samples of a pixel are always a prefix of the
 * sequence. A group of uses always has separate sets, whatever its pattern.
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
#include <string.h>

#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/files/files.h"
#include "render/one_image.h"
#include "render/samples/adaptive/adaptive.h"
#include "render/samples/samples.h"
#include "render/vector3.h"
#include "stats/stats.h"

enum { LANE_CONTINUED = 1 << 21 }; /* keys of the shuffles' random numbers, above the keys of uses and pairings */

/* Statistics of the sets of a pixel. `origin`, the luminance of the first sample, is subtracted from all
   luminances, so that equal values have variance 0. */
typedef struct pixel_sets {
    uint32_t sets;      /* number of sets in the sums */
    uint32_t drawn;     /* number of sets that were drawn */
    float lo[3], hi[3]; /* minimum and maximum of the samples in each channel */
    float origin;
    double sum[3]; /* weighted sum of the samples in each channel */
    double all[3];
    double sum_y, sum_yy; /* sums of the luminances of samples and of their squares */
    double sum_w3;        /* sum of the cubed weights */
    double moments[3][3]; /* element [j][k] is the sum over the samples of weight^j luminance^k */
} pixel_sets;

/* The parameters of every method begin with these. */
enum { FIRST, MOST, THRESHOLD };
#define SETS_PARAMS                                                                                                  \
    {"first", "number of point sets in the first round", 1, 1, 4096, NULL, true},                                    \
    {                                                                                                                \
        "most", "largest number of point sets of a pixel", 64, 1, 1 << 16, NULL, true                                \
    }

/* ---- Open and close --------------------------------------------------------------------------------------- */

static bool continues(const koksma__adaptive *run, int u)
{
    const koksma_render_options *options = run->frame->options;
    const koksma_spec *spec = options->patterns[u].pattern ? &options->patterns[u] : &options->pattern;
    return koksma__place_of_use_at(options, u).group < 0 && koksma_is_sequence(spec) && spec->pattern->max_dim >= 2 &&
           options->pairing != KOKSMA_PAIRING_NATIVE;
}

/* Finds out whether two seeds give the same points, by generating both sets: the claims of a pattern cannot decide
   this, because they depend on its parameters. */
static koksma_status compare_sets(const koksma_spec *spec, size_t n, int dim, bool *same)
{
    koksma_points one = {0}, two = {0};
    koksma_status status = koksma_points_init(&one, n, dim);
    status = status ? status : koksma_points_init(&two, n, dim);
    status = status ? status : koksma_generate(spec, 1, NULL, &one);
    status = status ? status : koksma_generate(spec, 2, NULL, &two);
    status = koksma__file_gap(spec, n, status);
    *same = !status && !memcmp(one.xs, two.xs, n * (size_t)dim * sizeof *one.xs);
    koksma_points_fini(&one);
    koksma_points_fini(&two);
    return status;
}

/* Fails if the pattern of a use or of a group gives the same points for every set. */
static koksma_status check_patterns(const koksma__adaptive *run)
{
    const koksma_render_options *options = run->frame->options;
    koksma_status status = KOKSMA_OK;
    /* whether options->pattern, the pattern of all uses that have none of their own, has been checked */
    bool seen = false;
    for (int u = 0; !status && u < KOKSMA_N_USES; u++) {
        const koksma__place_of_use place = koksma__place_of_use_at(options, u);
        const bool own = place.group >= 0 || options->patterns[u].pattern;
        const koksma_spec *spec = place.group >= 0 ? &options->groups[place.group].pattern
                                  : own            ? &options->patterns[u]
                                                   : &options->pattern;
        const koksma_pattern *p = spec->pattern;
        const int dim = place.group >= 0 ? place.dim : 2;
        bool same = false;
        if ((seen && !own) || !koksma__use_is_there(&run->frame->uses, u) || continues(run, u)) {
            continue; /* successive blocks of a sequence differ */
        }
        seen |= !own;
        if (p->min_dim <= dim && p->max_dim >= dim) {
            status = compare_sets(spec, (size_t)options->spp, dim, &same);
        }
        KOKSMA__FAIL_IF(same, KOKSMA_ARGUMENT,
                        "%s: all sets of pattern %s are the same; with shift=1 they would differ",
                        run->options->method->name, p->name);
    }
    return status;
}

static koksma_status open_sets(koksma__adaptive *run)
{
    const double *params = run->options->params;
    const char *name = run->options->method->name;
    const double first = params[FIRST], most = params[MOST];
    const double samples = (double)run->frame->options->spp * (first + most);
    KOKSMA__TRY(check_patterns(run));
    KOKSMA__FAIL_IF(most < first || samples > KOKSMA_MAX_SPP, KOKSMA_ARGUMENT,
                    "%s: first=%.0f and most=%.0f sets of %d samples: most must be at least first, and both together "
                    "at most %d samples",
                    name, first, most, run->frame->options->spp, KOKSMA_MAX_SPP);
    KOKSMA__FAIL_IF(!run->options->budget && !(params[THRESHOLD] > 0), KOKSMA_ARGUMENT,
                    "%s: give a threshold, or a budget, or both", name);
    run->state = calloc(run->pixels, sizeof(pixel_sets));
    KOKSMA__REQUIRE_MEMORY(run->state, run->pixels * sizeof(pixel_sets));
    for (size_t p = 0; p < run->pixels; p++) {
        const uint32_t n = (uint32_t)(first * run->frame->options->spp);
        run->demands[p] = (koksma__sample_demand){.now = n};
    }
    return KOKSMA_OK;
}

static void close_sets(koksma__adaptive *run)
{
    free(run->state);
}

static pixel_sets *sets_of(const koksma__adaptive *run, size_t pixel)
{
    return (pixel_sets *)run->state + pixel;
}

static size_t set_size(const koksma__adaptive *run)
{
    return (size_t)run->frame->options->spp;
}

/* ---- Samples ---------------------------------------------------------------------------------------------- */

/* Draws the sets `first` to first + count - 1 of a pixel as blocks of one two-dimensional sequence; each block is
   shuffled separately. pairs[2 i] and pairs[2 i + 1] are the two coordinates of point i. */
static koksma_status draw_blocks(const koksma__adaptive *run, size_t pixel, uint32_t use, size_t first, size_t count,
                                 koksma__sample_scratch *room, float *pairs)
{
    static const koksma_run alone = {.threads = 1};
    static const float none[2] = {0, 0};
    const koksma_render_options *options = run->frame->options;
    const size_t n = set_size(run);
    koksma_points points = {(first + count) * n, 2, room->xs};
    KOKSMA__TRY(koksma_generate(koksma__use_spec(options, use), koksma__random_seed(options->seed, pixel, use),
                                &alone, &points));
    for (size_t k = first; k < first + count; k++, pairs += 2 * n) {
        const bool shuffles = options->pairing == KOKSMA_PAIRING_SHUFFLED && use != KOKSMA__USE_PIXEL;
        run->frame->batch->place(room->xs + 2 * k * n, n, none, shuffles ? room->pairs : pairs);
        if (shuffles) {
            koksma__kernels()->words(options->seed, KOKSMA__PURPOSE_SHUFFLE,
                                     (pixel + k * run->pixels) * ((n + 3) / 4), LANE_CONTINUED + use, (n + 3) / 4,
                                     room->words);
            run->frame->batch->shuffle(room->pairs, room->words, n, pairs);
        }
    }
    return KOKSMA_OK;
}

static koksma_status draw(const koksma__adaptive *run, size_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs)
{
    const size_t n = set_size(run), samples = run->demands[pixel].now;
    const size_t first = sets_of(run, pixel)->drawn;
    koksma_status status = KOKSMA_OK;
    if (!continues(run, koksma__use_index(use))) {
        for (size_t k = 0; !status && k < samples / n; k++) {
            status =
                run->base.draw(&run->base, pixel + (first + k) * run->pixels, use, offset, room, pairs + 2 * k * n);
        }
        return status;
    }
    status = draw_blocks(run, pixel, use, first, samples / n, room, pairs);
    for (size_t i = 0; !status && i < samples; i++) {
        pairs[2 * i] += offset[0];
        pairs[2 * i + 1] += offset[1];
    }
    return status;
}

static void take_set(pixel_sets *p, size_t n, size_t channels, const float *rgb, const float *weights)
{
    double sum_y = 0;
    if (!p->sets) {
        p->origin = koksma__sample_luminance(rgb, channels);
    }
    for (size_t i = 0; i < n; i++, rgb += channels) {
        const double l = (double)koksma__sample_luminance(rgb, channels), y = l - (double)p->origin;
        const double weight = weights ? (double)weights[i] : 1;
        for (size_t k = 0; k < channels; k++) {
            const bool none = !p->sets && !i;
            p->lo[k] = none || rgb[k] < p->lo[k] ? rgb[k] : p->lo[k];
            p->hi[k] = none || rgb[k] > p->hi[k] ? rgb[k] : p->hi[k];
            p->sum[k] += weight * (double)rgb[k];
            p->all[k] += (double)rgb[k];
        }
        sum_y += y;
        p->sum_yy += y * y;
        p->sum_w3 += weight * weight * weight;
        for (int j = 0; j < 3; j++) {
            const double power = j == 2 ? weight * weight : j ? weight : 1;
            p->moments[j][0] += power;
            p->moments[j][1] += power * y;
            p->moments[j][2] += power * y * y;
        }
    }
    p->sum_y += sum_y;
    p->sets++;
    p->drawn++;
}

static void take(koksma__adaptive *run, size_t pixel, const koksma__sample_values *values)
{
    const size_t n = set_size(run), channels = (size_t)run->frame->channels;
    pixel_sets *sets = sets_of(run, pixel);
    for (size_t k = 0; k < run->demands[pixel].now / n; k++) {
        take_set(sets, n, channels, values->rgb + k * n * channels, values->weights ? values->weights + k * n : NULL);
    }
}

/* Sets *demand to `sets` more sets, or to as many as the pixel may still take. */
static void demand_sets(const koksma__adaptive *run, size_t pixel, double sets, double score,
                        koksma__sample_demand *demand)
{
    const double left = run->options->params[MOST] - sets_of(run, pixel)->sets;
    const double more = sets < left ? sets : left;
    *demand = (koksma__sample_demand){.now = (uint32_t)(more * (double)set_size(run)), .score = (float)score};
}

/* ---- Statistics --------------------------------------------------------------------------------------- */

static double samples_of(const koksma__adaptive *run, const pixel_sets *p)
{
    return (double)p->sets * (double)set_size(run);
}

static double variance(double sum, double squares, double n)
{
    return n > 1 ? fmax(squares - sum * sum / n, 0) / (n - 1) : 0;
}

/* The variance of the luminance of a sample, as if the samples were independent. */
static double variance_of(const koksma__adaptive *run, const pixel_sets *p)
{
    return variance(p->sum_y, p->sum_yy, samples_of(run, p));
}

/* Sample i of filter weight w_i has the weight a w_i + b in the pixel, as film.c describes; the weights add up to 1. */
static void weights_of(const koksma__adaptive *run, const pixel_sets *p, double *a, double *b)
{
    const double n = samples_of(run, p);
    const bool has_lobes = run->frame->filter && koksma__filter_is_signed(run->frame->filter);
    *a = !has_lobes ? 1 / n : n > 1 ? 1 / (n - 1) : 0;
    *b = has_lobes ? 1 / n - *a * p->moments[1][0] / n : 0;
}

/* Computes the value and the variance of a pixel as film.c does for a filter with negative lobes: film.c defines the
   weights v and w of a sample of luminance y; the sums of v^j y^k follow from those of w^j y^k. */
static double signed_result(const koksma__adaptive *run, const pixel_sets *p, double n, double rgb[3])
{
    const double(*m)[3] = p->moments;
    double a, b;
    weights_of(run, p, &a, &b);
    for (int k = 0; k < 3; k++) {
        rgb[k] = a * p->sum[k] + b * p->all[k];
    }
    double of[3]; /* sums of v^2 y^k */
    for (int k = 0; k < 3; k++) {
        of[k] = a * a * m[2][k] + 2 * a * b * m[1][k] + b * b * m[0][k];
    }
    const double v3 = a * a * a * p->sum_w3 + 3 * a * a * b * m[2][0] + 3 * a * b * b * m[1][0] + b * b * b * n;
    const double mean = a * m[1][1] + b * m[0][1];
    const double off = of[2] - mean * (2 * of[1] - mean * of[0]), left = of[0] - 2 * v3 + of[0] * of[0];
    return off > 0 && left > 1e-12 * of[0] ? off * of[0] / left : 0;
}

static double result(const koksma__adaptive *run, size_t pixel, double rgb[3])
{
    const pixel_sets *p = sets_of(run, pixel);
    const double n = samples_of(run, p);
    if (p->sets && run->frame->filter && koksma__filter_is_signed(run->frame->filter)) {
        return signed_result(run, p, n, rgb);
    }
    for (int k = 0; p->sets && k < 3; k++) {
        rgb[k] = p->sum[k] / n;
    }
    return p->sets ? variance(p->moments[0][1], p->moments[0][2], n) / n : 0;
}

static size_t bytes_of(int spp)
{
    (void)spp;
    return sizeof(pixel_sets);
}

static const koksma__adaptive_family family = {
    .bytes = bytes_of, .close = close_sets, .draw = draw, .take = take, .result = result};

/* ---- contrast --------------------------------------------------------------------------------------------------- */

static const koksma_param contrast_params[] = {
    SETS_PARAMS,
    {"threshold", "factor that multiplies Mitchell's bounds; 0: no threshold, only a budget", 0, 0, 1e6, NULL, false},
    {0},
};

static void decide_by_contrast(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand)
{
    static const double bounds[3] = {0.4, 0.3, 0.6};
    const pixel_sets *p = sets_of(run, pixel);
    double score = 0;
    (void)scratch;
    for (int k = 0; k < run->frame->channels; k++) {
        const double lo = fmax((double)p->lo[k], 0), hi = (double)p->hi[k];
        const double contrast = hi > lo ? (hi - lo) / (hi + lo) : 0;
        score = fmax(score, contrast / bounds[run->frame->channels == 1 ? 1 : k]);
    }
    if (score > run->options->params[THRESHOLD]) {
        /* pixels with fewer samples come first, so that the budget is spread */
        demand_sets(run, pixel, 1, score / p->sets, demand);
    }
}

static const koksma__adaptive_method contrast = {.family = &family, .open = open_sets, .decide = decide_by_contrast};

const koksma_adaptive koksma__adaptive_contrast = {
    .name = "contrast",
    .title = "more samples for pixels whose samples have a high contrast",
    .cite = "mitchell1987",
    .params = contrast_params,
    .functions = &contrast,
};

/* ---- confidence ------------------------------------------------------------------------------------------ */

enum { TEST = THRESHOLD + 1, LEVEL };
/* The factors are tabulated for up to FACTORS sets; for more sets they hardly change, and the last factor is used. */
enum { FACTORS = 1024 };

static const char *const tests[] = {"t", "chi2", NULL};
static const koksma_param confidence_params[] = {
    SETS_PARAMS,
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
    const pixel_sets *p = sets_of(run, pixel);
    const double n = (double)p->sets * (double)set_size(run);
    const double error = sqrt(variance_of(run, p) / n);
    (void)scratch;
    const double *factors = run->extra;
    const double doubt = error * factors[p->sets < FACTORS ? p->sets : FACTORS];
    if (doubt > run->options->params[THRESHOLD]) {
        demand_sets(run, pixel, 1, doubt, demand);
    }
}

static koksma_status open_confidence(koksma__adaptive *run)
{
    const koksma_status status = open_sets(run);
    KOKSMA__FAIL_IF(!status && run->demands[0].now < 2, KOKSMA_N,
                    "confidence: the first round needs 2 samples; use a larger spp, or first=2");
    double *factors = status ? NULL : malloc((FACTORS + 1) * sizeof *factors);
    run->extra = factors;
    if (!status && !factors) {
        return koksma__fail_memory((FACTORS + 1) * sizeof *factors);
    }
    const double most = run->options->params[MOST];
    for (int k = 1; !status && k <= FACTORS && k <= most; k++) {
        const double n = (double)set_size(run) * k;
        factors[k] = n > 1 ? factor(run, n) : 0;
    }
    return status;
}

static const koksma__adaptive_method confidence = {
    .family = &family, .open = open_confidence, .decide = decide_by_confidence};

const koksma_adaptive koksma__adaptive_confidence = {
    .name = "confidence",
    .title = "more samples until a confidence interval of the pixel's luminance is narrow",
    .cite = "lee1985 purgathofer1987",
    .params = confidence_params,
    .functions = &confidence,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The methods that split strata.
 *
 * hierarchical: strata are split where neighbours differ (Kajiya 1986), in all uses of sample dimensions
 * (pixel, lens, light, ...) together (Shirley 1991, section 5.6). With pairing=aligned, neighbours in the pixel are
 * neighbours in every use. With pairing=shuffled they are not: strata that are neighbours in one use can be far apart
 * in another, and are then split although no neighbours differ there (Shirley's figure 5.36). Where the values are
 * constant, no stratum is split. The estimate is biased, because the values that decide about splits are also
 * averaged.
 *
 * selective: splits strata only in the use of sample dimensions (pixel, lens, light, ...) that causes
 * most of the pixel's variance, a choice that Shirley 1991, section 5.6, leaves open. The uses are paired by random
 * permutations, so that neighbouring strata of one use are not neighbours in another. Therefore neighbours have
 * similar values only in the use that causes the variance. Geary's contiguity ratio (1954) measures this similarity
 * from the values v of the m x m samples of the first round, without further samples. Over the P pairs of
 * neighbouring cells (columns and rows) of a use the ratio is
 *
 *     c = (sum over pairs (v_i - v_j)^2 / P)  /  (2 s^2),     s^2 the variance of all values
 *
 * The ratio c has mean 1 if the values lie on the cells in random order, and tends to 0 if the use explains the
 * values. The base use of a pixel is the one with the smallest c, if c is at most the parameter `below`; else no
 * stratum is split. It then works like `hierarchical`, but compares neighbours and quarters cells in the base
 * use only. In the other uses each part keeps the whole cell, so that the four parts together cover the stratum; they
 * would not if cells were quartered in several uses at once. The candidates for the base use are the pixel, the lens
 * and time, and the first lights and the lobe of the first two vertices.
 */
#include "render/samples/adaptive/adaptive.h"
#include "render/vector3.h"

#define STRATA_PARAMS                                                                                                \
    {"levels", "largest number of times that a stratum is split", 2, 0, KOKSMA__MAX_LEVELS, NULL, true},             \
    {                                                                                                                \
        "threshold", "difference of two values beyond which their strata are split", 0.05, 0, 1e30, NULL, false      \
    }

/* ---- hierarchical ----------------------------------------------------------------------------------------------- */

enum { PAIRING = KOKSMA__STRATA_PARAMS };

static const char *const pairings[] = {"aligned", "shuffled", NULL};
static const koksma_param hierarchical_params[] = {
    STRATA_PARAMS,
    {"pairing", "how the strata of different uses are paired", 0, 0, 1, pairings, true},
    {0},
};

static koksma_status open_hierarchical(koksma__adaptive *run)
{
    const koksma_status status = koksma__strata_open(run);
    koksma__strata *s = run->state;
    if (s) {
        s->shuffled = run->options->params[PAIRING] > 0;
    }
    return status;
}

static const koksma__adaptive_method hierarchical = {
    .family = &koksma__strata_family, .open = open_hierarchical, .decide = koksma__strata_decide};

const koksma_adaptive koksma__adaptive_hierarchical = {
    .name = "hierarchical",
    .title = "splits strata where the values of neighbours differ, in all uses together",
    .cite = "kajiya1986 shirley1991",
    .params = hierarchical_params,
    .own_samples = true,
    .functions = &hierarchical,
};

/* ---- selective ------------------------------------------------------------------------------------------- */

enum { BELOW = KOKSMA__STRATA_PARAMS };

static const koksma_param selective_params[] = {
    STRATA_PARAMS,
    {"below", "largest contiguity ratio at which a use is split", 0.8, 0, 2, NULL, false},
    {0},
};

static koksma_status open_selective(koksma__adaptive *run)
{
    const koksma_status status = koksma__strata_open(run);
    koksma__strata *s = run->state;
    if (s) {
        s->shuffled = s->selective = true;
        s->below = run->options->params[BELOW];
    }
    return status;
}

static double square(float a, float b)
{
    return ((double)a - (double)b) * ((double)a - (double)b);
}

/* Returns half the mean squared difference of neighbours. y: the values in the order of the cells of the use. */
static double roughness(const float *y, uint32_t n, uint32_t width)
{
    double sum = 0;
    uint32_t pairs = 0;
    for (uint32_t i = 0; i < n; i++) {
        if (i % width + 1 < width) {
            sum += square(y[i], y[i + 1]);
            pairs++;
        }
        if (i + width < n) {
            sum += square(y[i], y[i + width]);
            pairs++;
        }
    }
    return pairs ? 0.5 * sum / pairs : 0;
}

static double variance(const float *y, uint32_t n)
{
    double sum = 0, squares = 0;
    for (uint32_t i = 0; i < n; i++) {
        const double off = (double)y[i] - (double)y[0];
        sum += off;
        squares += off * off;
    }
    return n > 1 ? (squares - sum * sum / n) / (n - 1) : 0;
}

/* Finds the base use of a pixel from its first values; returns false if no use causes the variance. The buffers
   `permutation` and `y` have room for m^2 numbers each. */
static bool find_base(koksma__adaptive *run, size_t pixel, uint32_t *permutation, float *y)
{
    const koksma__strata *s = run->state;
    koksma__tree *tree = &s->trees[pixel];
    const uint32_t n = s->m * s->m;
    uint32_t uses[KOKSMA_MAX_SPACES];
    double least = s->below;
    bool found = false;
    for (int u = koksma__list_spaces(&run->frame->uses, uses) - 1; u >= 0;
         u--) { /* the loop counts down, so that among uses with equal ratios the first one, the pixel, is chosen */
        koksma__use_cells cells;
        koksma__use_cells_init(run, pixel, uses[u], permutation, &cells);
        for (uint32_t i = 0; i < n; i++) {
            const float *v = tree->strata[i].value;
            y[cells.permutation ? cells.permutation[i] : i] =
                run->frame->channels == 1 ? v[0] : koksma__luminance3(v);
        }
        const double total = variance(y, n), rough = roughness(y, n, cells.line ? n : s->m);
        if (total > 0 && rough <= least * total) {
            least = rough / total;
            tree->base = uses[u];
            found = true;
        }
    }
    return found;
}

static void decide(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand)
{
    const koksma__strata *s = run->state;
    const uint32_t n = s->m * s->m;
    koksma__tree *tree = &s->trees[pixel];
    if (!tree->searched) {
        tree->searched = true;
        tree->carried = find_base(run, pixel, scratch, (float *)((uint32_t *)scratch + n));
    }
    if (tree->carried) {
        koksma__strata_decide(run, pixel, scratch, demand);
    }
}

static const koksma__adaptive_method selective = {
    .family = &koksma__strata_family, .open = open_selective, .decide = decide};

const koksma_adaptive koksma__adaptive_selective = {
    .name = "selective",
    .title = "splits strata where the values of neighbours differ, in the use that causes most of the variance",
    .cite = "shirley1991 geary1954",
    .params = selective_params,
    .own_samples = true,
    .functions = &selective,
};

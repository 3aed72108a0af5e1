/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The methods that split strata: hierarchical integration, in which a stratum is split in four when its value differs from
 * that of any of its 8-connected neighbours; the estimate is the sum of volume x value over the strata (Kajiya 1986;
 * Shirley 1991, section 5.6, figure 5.35). adaptive.h describes the strata.
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

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "render/one_image.h"
#include "render/vector3.h"

/* The largest number of strata in the image; they take 3.5 GiB. */
#define MAX_STRATA ((size_t)1 << 27)

/* The parameters of every method begin with these. */
enum { LEVELS, THRESHOLD, FURTHER };
/* ---- Open and close --------------------------------------------------------------------------------------- */

static koksma_status too_many(const koksma__adaptive *run)
{
    return koksma__fail(KOKSMA_ARGUMENT, "%s: more than %zu strata in the image", run->options->method->name,
                        MAX_STRATA);
}

static koksma_status open_trees(koksma__adaptive *run, koksma__strata *s)
{
    const uint32_t n = s->m * s->m;
    s->trees = calloc(run->pixels, sizeof *s->trees);
    KOKSMA__REQUIRE_MEMORY(s->trees, run->pixels * sizeof *s->trees);
    atomic_store(&s->total, run->pixels * n);
    for (size_t p = 0; p < run->pixels; p++) {
        koksma__tree *tree = &s->trees[p];
        tree->strata = malloc(n * sizeof *tree->strata);
        KOKSMA__REQUIRE_MEMORY(tree->strata, run->pixels * n * sizeof *tree->strata);
        tree->n = n;
        for (uint32_t i = 0; i < n; i++) {
            tree->strata[i] = (koksma__stratum){.number = i, .pending = true};
        }
        run->demands[p] = (koksma__sample_demand){.now = n};
    }
    return KOKSMA_OK;
}

static koksma_status open_strata(koksma__adaptive *run)
{
    const double *params = run->options->params;
    const char *name = run->options->method->name;
    const uint32_t spp = (uint32_t)run->frame->options->spp, m = (uint32_t)lround(sqrt(spp));
    koksma__strata *s = calloc(1, sizeof *s);
    run->state = s;
    KOKSMA__REQUIRE_MEMORY(s, sizeof *s);
    s->m = m;
    s->levels = (uint32_t)params[LEVELS];
    s->threshold = (float)params[THRESHOLD];
    KOKSMA__FAIL_IF(m * m != spp, KOKSMA_N, "%s: spp = %u is not m^2; %u or %u would do", name, spp,
                    (unsigned)(floor(sqrt(spp)) * floor(sqrt(spp))), (unsigned)(ceil(sqrt(spp)) * ceil(sqrt(spp))));
    KOKSMA__FAIL_IF(m << s->levels > KOKSMA__MAX_STRATA_SIDE, KOKSMA_ARGUMENT,
                    "%s: levels=%u of %u x %u strata: the finest grid may have at most %d x %d", name, s->levels, m,
                    m, KOKSMA__MAX_STRATA_SIDE, KOKSMA__MAX_STRATA_SIDE);
    if (run->pixels > MAX_STRATA / spp) {
        return too_many(run);
    }
    /* the scratch memory for the grid, the permutation and the differences */
    run->scratch = (2 * ((size_t)spp << 2 * s->levels) + spp) * sizeof(uint32_t);
    return open_trees(run, s);
}

static void close_strata(koksma__adaptive *run)
{
    koksma__strata *s = run->state;
    for (size_t p = 0; s && s->trees && p < run->pixels; p++) {
        run->report.splits += s->trees[p].splits;
        run->report.needless += s->trees[p].needless;
        free(s->trees[p].strata);
    }
    if (s) {
        free(s->trees);
    }
    free(s);
}

/* ---- Splitting -------------------------------------------------------------------------------------------- */

/* Fills a grid of the finest cells with the indices of the strata that cover them. */
static void paint(const koksma__adaptive *run, size_t pixel, uint32_t depth, uint32_t *permutation, uint32_t *grid,
                  uint32_t *width)
{
    const koksma__strata *s = run->state;
    const koksma__tree *tree = &s->trees[pixel];
    koksma__use_cells base;
    koksma__use_cells_init(run, pixel, tree->base, permutation, &base);
    *width = base.line ? s->m * s->m << 2 * depth : s->m << depth;
    for (uint32_t i = 0; i < tree->n; i++) {
        const uint32_t below = depth - tree->strata[i].level, side = 1u << below << (base.line ? below : 0);
        uint32_t cell[2];
        koksma__stratum_cell(s, &base, &base, &tree->strata[i], cell);
        for (uint32_t y = 0; y < (base.line ? 1 : side); y++) {
            for (uint32_t x = 0; x < side; x++) {
                grid[(cell[1] * side + y) * *width + cell[0] * side + x] = i;
            }
        }
    }
}

/* Compares strata i and j; most[i] is the largest difference above the threshold between stratum i and a
   neighbour. */
static void compare(const koksma__strata *s, const koksma__tree *tree, uint32_t i, uint32_t j, float *most)
{
    float off = 0;
    for (int k = 0; k < 3; k++) {
        off = fmaxf(off, fabsf(tree->strata[i].value[k] - tree->strata[j].value[k]));
    }
    if (off > s->threshold) {
        most[i] = fmaxf(most[i], off);
        most[j] = fmaxf(most[j], off);
    }
}

static void compare_all(const koksma__strata *s, const koksma__tree *tree, const uint32_t *grid, uint32_t width,
                        uint32_t height, float *most)
{
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            const uint32_t *at = grid + y * width + x;
            const bool right = x + 1 < width, down = y + 1 < height;
            compare(s, tree, *at, right ? at[1] : *at, most);
            compare(s, tree, *at, down ? at[width] : *at, most);
            compare(s, tree, *at, right && down ? at[width + 1] : *at, most);
            compare(s, tree, *at, x && down ? at[width - 1] : *at, most);
        }
    }
}

/* Under a budget, the score of a pixel is the variance that each new sample may remove: the sum of (volume x
   difference)^2 over the strata to be split, divided by the number of samples that these splits take. */
static void decide_by_neighbours(koksma__adaptive *run, size_t pixel, void *scratch, koksma__sample_demand *demand)
{
    koksma__strata *s = run->state;
    koksma__tree *tree = &s->trees[pixel];
    const size_t finest = (size_t)s->m * s->m << 2 * s->levels;
    uint32_t depth = 0, width, *grid = scratch, *permutation = grid + finest;
    float *most = (float *)(grid + finest + (size_t)s->m * s->m);
    double gain = 0;
    for (uint32_t i = 0; i < tree->n; i++) {
        depth = tree->strata[i].level > depth ? tree->strata[i].level : depth;
        most[i] = 0;
    }
    paint(run, pixel, depth, permutation, grid, &width);
    compare_all(s, tree, grid, width, (s->m * s->m << 2 * depth) / width, most);
    tree->marked = 0;
    for (uint32_t i = 0; i < tree->n; i++) {
        koksma__stratum *stratum = &tree->strata[i];
        const double part = ldexp((double)most[i], -2 * stratum->level);
        stratum->marked = most[i] > 0 && stratum->level < s->levels;
        tree->marked += stratum->marked;
        gain += stratum->marked ? part * part : 0;
    }
    demand->now = tree->marked * 3;
    demand->score = tree->marked ? (float)(gain / demand->now) : 0;
}

/* Replaces each marked stratum by its four parts. */
static koksma_status prepare(koksma__adaptive *run, size_t pixel)
{
    koksma__strata *s = run->state;
    koksma__tree *tree = &s->trees[pixel];
    if (!tree->marked) {
        return KOKSMA_OK;
    }
    const size_t n = tree->n + 3 * (size_t)tree->marked;
    if (atomic_fetch_add(&s->total, 3 * (size_t)tree->marked) + 3 * (size_t)tree->marked > MAX_STRATA) {
        return too_many(run);
    }
    koksma__stratum *strata = malloc(n * sizeof *strata), *to = strata;
    koksma__use_cells base;
    KOKSMA__REQUIRE_MEMORY(strata, n * sizeof *strata);
    koksma__use_cells_init(run, pixel, tree->base, NULL, &base);
    for (uint32_t i = 0; i < tree->n; i++) {
        const koksma__stratum *from = &tree->strata[i];
        if (!from->marked) {
            *to++ = *from;
            continue;
        }
        const int kept = koksma__stratum_quarter(s, &base, from);
        for (int k = 0; k < 4; k++) {
            *to = *from;
            to->level++;
            to->digits = (uint16_t)(from->digits << 2 | k);
            to->marked = false;
            to++->pending = k != kept;
        }
    }
    free(tree->strata);
    tree->strata = strata;
    tree->n = (uint32_t)n;
    tree->splits += tree->marked;
    tree->marked = 0;
    return KOKSMA_OK;
}

/* ---- Samples ---------------------------------------------------------------------------------------------- */

static size_t probes(const koksma__adaptive *run, size_t pixel)
{
    const koksma__strata *s = run->state;
    return (size_t)s->trees[pixel].marked * (size_t)run->options->probes;
}

static koksma_status draw(const koksma__adaptive *run, size_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs)
{
    const koksma__strata *s = run->state;
    const koksma__tree *tree = &s->trees[pixel];
    const uint32_t probes = (uint32_t)run->options->probes;
    koksma__use_cells base, cells;
    /* only the member `base` is used, which places samples in the base use */
    koksma__use_cells_init(run, pixel, tree->base, NULL, &base);
    koksma__use_cells_init(run, pixel, use, room->words, &cells);
    for (uint32_t i = 0; i < tree->n; i++) {
        const koksma__stratum *stratum = &tree->strata[i];
        const bool wanted = run->probing ? stratum->marked : stratum->pending;
        for (uint32_t k = 0; wanted && k < (run->probing ? probes : 1); k++) {
            koksma__stratum_place(s, use == tree->base ? &cells : &base, &cells, stratum,
                                  run->probing ? KOKSMA__STAGE_PROBE + k : KOKSMA__STAGE_TREE, pairs);
            *pairs++ += offset[0];
            *pairs++ += offset[1];
        }
    }
    return KOKSMA_OK;
}

/* A split is needless if all values of the stratum, those of the probes included, differ by at most the threshold. */
static void take_probes(const koksma__adaptive *run, koksma__tree *tree, const float *rgb)
{
    const koksma__strata *s = run->state;
    const int channels = run->frame->channels;
    for (uint32_t i = 0; i < tree->n; i++) {
        koksma__stratum *stratum = &tree->strata[i];
        bool alike = stratum->marked;
        for (int k = 0; stratum->marked && k < channels; k++) {
            float lo = stratum->value[k], hi = lo;
            for (int j = 0; j < run->options->probes; j++) {
                lo = fminf(lo, rgb[j * channels + k]);
                hi = fmaxf(hi, rgb[j * channels + k]);
            }
            alike &= hi - lo <= s->threshold;
        }
        tree->needless += alike;
        stratum->needless |= (uint8_t)(alike << stratum->level);
        rgb += stratum->marked ? run->options->probes * channels : 0;
    }
}

static void take(koksma__adaptive *run, size_t pixel, const koksma__sample_values *values)
{
    koksma__strata *s = run->state;
    koksma__tree *tree = &s->trees[pixel];
    const size_t channels = (size_t)run->frame->channels;
    size_t sample = 0;
    if (run->probing) {
        take_probes(run, tree, values->rgb);
        return;
    }
    for (uint32_t i = 0; i < tree->n; i++) {
        if (tree->strata[i].pending) {
            memcpy(tree->strata[i].value, values->rgb + channels * sample, channels * sizeof(float));
            tree->strata[i].weight = values->weights ? values->weights[sample] : 1;
            tree->strata[i].pending = false;
            sample++;
        }
    }
}

/* ---- The end ---------------------------------------------------------------------------------------------- */

static double volume_of(const koksma__strata *s, const koksma__stratum *stratum)
{
    return ldexp(1, -2 * stratum->level) / ((double)s->m * s->m);
}

/* The weights of the strata of a pixel, by the formula of film.c for samples of weight 1 / n, with the volumes of the
   strata in place of 1 / n, and 1 / (sum of squared volumes) - 1 in place of n - 1. */
typedef struct strata_weights {
    double mean, scale;
} strata_weights;

static strata_weights weights_of(const koksma__adaptive *run, const koksma__tree *tree)
{
    const koksma__strata *s = run->state;
    const bool has_lobes = run->frame->filter && koksma__filter_is_signed(run->frame->filter);
    double mean = 0, volumes = 0;
    for (uint32_t i = 0; i < tree->n; i++) {
        const double volume = volume_of(s, &tree->strata[i]);
        mean += volume * (double)tree->strata[i].weight;
        volumes += volume * volume;
    }
    return (strata_weights){mean, has_lobes && volumes < 1 ? 1 / (1 - volumes) : 0};
}

static double weight_of(const strata_weights *w, const koksma__stratum *stratum)
{
    return 1 + ((double)stratum->weight - w->mean) * w->scale;
}

static double result(const koksma__adaptive *run, size_t pixel, double rgb[3])
{
    const koksma__strata *s = run->state;
    const koksma__tree *tree = &s->trees[pixel];
    const size_t channels = (size_t)run->frame->channels;
    const strata_weights weights = weights_of(run, tree);
    double mean = 0, squares = 0;
    for (uint32_t i = 0; i < tree->n; i++) {
        const float *v = tree->strata[i].value;
        const double weight = weight_of(&weights, &tree->strata[i]);
        const double volume = weight * volume_of(s, &tree->strata[i]);
        for (int k = 0; k < 3; k++) {
            rgb[k] += volume * (double)v[k];
        }
        mean += volume * (double)koksma__sample_luminance(v, channels);
    }
    for (uint32_t i = 0; i < tree->n; i++) {
        const float *v = tree->strata[i].value;
        const double weight = weight_of(&weights, &tree->strata[i]);
        const double volume = weight * volume_of(s, &tree->strata[i]);
        const double off = (double)koksma__sample_luminance(v, channels) - mean;
        squares += volume * volume * off * off;
    }
    return squares;
}

static size_t bytes_of(int spp)
{
    return sizeof(koksma__tree) + (size_t)spp * sizeof(koksma__stratum);
}

static const koksma__adaptive_family family = {.bytes = bytes_of,
                                               .close = close_strata,
                                               .prepare = prepare,
                                               .draw = draw,
                                               .take = take,
                                               .probes = probes,
                                               .result = result,
                                               .show = koksma__strata_show};

#define STRATA_PARAMS                                                                                                \
    {"levels", "largest number of times that a stratum is split", 2, 0, KOKSMA__MAX_LEVELS, NULL, true},             \
    {                                                                                                                \
        "threshold", "difference of two values beyond which their strata are split", 0.05, 0, 1e30, NULL, false      \
    }

/* ---- hierarchical ----------------------------------------------------------------------------------------------- */

static const char *const pairings[] = {"aligned", "shuffled", NULL};
static const koksma_param hierarchical_params[] = {
    STRATA_PARAMS,
    {"pairing", "how the strata of different uses are paired", 0, 0, 1, pairings, true},
    {0},
};

static koksma_status open_hierarchical(koksma__adaptive *run)
{
    const koksma_status status = open_strata(run);
    koksma__strata *s = run->state;
    if (s) {
        s->shuffled = run->options->params[FURTHER] > 0;
    }
    return status;
}

static const koksma__adaptive_method hierarchical = {
    .family = &family, .open = open_hierarchical, .decide = decide_by_neighbours};

const koksma_adaptive koksma__adaptive_hierarchical = {
    .name = "hierarchical",
    .title = "splits strata where the values of neighbours differ, in all uses together",
    .cite = "kajiya1986 shirley1991",
    .params = hierarchical_params,
    .own_samples = true,
    .functions = &hierarchical,
};

/* ---- selective ------------------------------------------------------------------------------------------- */

static const koksma_param selective_params[] = {
    STRATA_PARAMS,
    {"below", "largest contiguity ratio at which a use is split", 0.8, 0, 2, NULL, false},
    {0},
};

static koksma_status open_selective(koksma__adaptive *run)
{
    const koksma_status status = open_strata(run);
    koksma__strata *s = run->state;
    if (s) {
        s->shuffled = s->selective = true;
        s->below = run->options->params[FURTHER];
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
                koksma__sample_luminance(v, (size_t)run->frame->channels);
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
        decide_by_neighbours(run, pixel, scratch, demand);
    }
}

static const koksma__adaptive_method selective = {.family = &family, .open = open_selective, .decide = decide};

const koksma_adaptive koksma__adaptive_selective = {
    .name = "selective",
    .title = "splits strata where the values of neighbours differ, in the use that causes most of the variance",
    .cite = "shirley1991 geary1954",
    .params = selective_params,
    .own_samples = true,
    .functions = &selective,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * selective: splits strata only in the use that causes most of the pixel's variance, a question that Shirley 1991,
 * section 5.6, leaves open. The uses are paired by random permutations, so neighbouring strata of one use are not
 * neighbours in another, and only in the use that causes the variance do neighbours have similar values. Geary's
 * contiguity ratio (1954) measures this from the first m x m values v, without further samples: over the P pairs of
 * neighbouring cells (columns and rows) of a use
 *
 *     c = (sum over pairs (v_i - v_j)^2 / P)  /  (2 s^2),     s^2 the variance of all values
 *
 * has mean 1 when the values lie on the cells in a random order, and goes to 0 when the use explains them. The
 * pixel's base use is that with the smallest c, if c is below `below`; else nothing is split. Then it works as
 * `hierarchical` does, but compares neighbours and quarters cells in the base use only. In the other uses each part
 * keeps the whole cell, so that the parts cover the stratum; four parts that quarter several uses at once would
 * not. Candidates: pixel, lens, time, and of the first two vertices the first lights and the lobe.
 */
#include "render/samples/adaptive/adaptive_strata.h"
#include "render/vector3.h"

enum { BELOW = KOKSMA__STRATA_REUSE + 1 };

static const koksma_param params[] = {
    KOKSMA__STRATA_PARAMS,
    {"below", "contiguity ratio that the use must have", 0.8, 0, 2, NULL, false},
    {0},
};

static koksma_status open(koksma__adaptive *run)
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

/* The mean square of neighbours' differences, over 2. y: the values in the order of the use's cells. */
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

/* The base use of a pixel whose first values are in its strata; false: no use carries the variance. scratch has 2
   m^2 words. */
static bool find_base(koksma__adaptive *run, size_t pixel, uint32_t *permutation, float *y)
{
    const koksma__strata *s = run->state;
    koksma__tree *tree = &s->trees[pixel];
    const uint32_t n = s->m * s->m;
    uint32_t uses[KOKSMA_MAX_SPACES];
    double least = s->below;
    bool found = false;
    for (int u = koksma__list_spaces(&run->frame->uses, uses) - 1; u >= 0;
         u--) { /* of equals the pixel wins, which is first */
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

static const koksma__adaptive_method method = {.open = open,
                                               .close = koksma__strata_close,
                                               .prepare = koksma__strata_prepare,
                                               .draw = koksma__strata_draw,
                                               .take = koksma__strata_take,
                                               .decide = decide,
                                               .last = koksma__strata_last,
                                               .probes = koksma__strata_probes,
                                               .result = koksma__strata_result,
                                               .show = koksma__strata_show};

const koksma_adaptive koksma__adaptive_selective = {
    .name = "selective",
    .title = "strata that differ from a neighbour are split, in the use that carries the variance",
    .cite = "shirley1991 geary1954",
    .params = params,
    .own_samples = true,
    .functions = &method,
};

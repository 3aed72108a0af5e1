/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Computes the position of a stratum's sample in each use by a walk from one of the m x m initial cells down the
 * splits, in the base use and the other use together (adaptive_place.h defines these terms). Every random number is a
 * hash of (seed, pixel, use, node), where a node is a current or former stratum, so that no positions need to be
 * stored.
 *
 * With reuse=kept, a stratum that is split into four passes its sample on to the part that contains it: part b in the
 * base use, and quarter c in another use. In the other use part k gets quarter k ^ b ^ c (exclusive or), so that part
 * b gets quarter c and the other three parts get the other three quarters. With shuffled pairing those three quarters
 * are permuted at random.
 *
 * With reuse=fresh, the samples of the last stage must be independent of those by which strata were split. The rule k
 * ^ b ^ c would always pair quarter b with quarter c again, which together contain the sample that caused the split.
 * So in the last stage part k gets one of the four quarters with equal probability, by a new random number. The mean
 * over the parts is then an unbiased estimate for the stratum, whatever the tree is.
 */
#include <math.h>
#include <string.h>

#include "core/random.h"
#include "render/samples/adaptive/adaptive.h"
#include "render/samples/samples.h"

/* The current position of a walk: a cell, and the offset of the sample in that cell. */
typedef struct spot {
    uint32_t cell[2];
    double x[2];
} spot;

static uint64_t node_of(uint32_t number, uint32_t digits, uint32_t level)
{
    return (uint64_t)number << 24 | (uint64_t)digits << 8 | level;
}

static void jitter(const koksma__use_cells *use, uint64_t node, uint32_t stage, double x[2])
{
    koksma__random_pair(use->seed, KOKSMA__PURPOSE_POINT, node, stage, x);
}

static int quarter_of(const koksma__use_cells *use, const double x[2])
{
    return use->line ? (int)(4 * x[0]) : (x[0] >= 0.5) | (x[1] >= 0.5) << 1;
}

static void enter(const koksma__use_cells *use, int quarter, uint32_t cell[2])
{
    const uint32_t q = (uint32_t)quarter;
    if (use->line) {
        cell[0] = 4 * cell[0] + q;
    } else {
        cell[0] = 2 * cell[0] + (q & 1);
        cell[1] = 2 * cell[1] + (q >> 1);
    }
}

/* Converts the offset in a cell to the offset in the quarter that contains it. */
static void zoom(const koksma__use_cells *use, int quarter, double x[2])
{
    if (use->line) {
        x[0] = 4 * x[0] - quarter;
    } else {
        x[0] = 2 * x[0] - (quarter & 1);
        x[1] = 2 * x[1] - (quarter >> 1);
    }
}

static spot start(const koksma__strata *s, const koksma__use_cells *use, uint32_t number)
{
    const uint32_t i = use->permutation ? use->permutation[number] : number;
    spot at = {.cell = {use->line ? i : i % s->m, use->line ? 0 : i / s->m}};
    jitter(use, node_of(number, 0, 0), KOKSMA__STAGE_TREE, at.x);
    return at;
}

/* Returns the quarter of the other use that part k of a node gets. b and c are the quarters of the two uses that
   contain the node's sample. */
static int partner(const koksma__strata *s, const koksma__use_cells *use, uint64_t node, bool last, int k, int b,
                   int c)
{
    static const int orders[6][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 1, 3},
                                     {0, 2, 3, 1}, {0, 3, 1, 2}, {0, 3, 2, 1}};
    const bool renewed = s->reuse == KOKSMA__REUSE_RENEWED;
    if (!s->shuffled && !last) {
        return renewed ? k : k ^ b ^ c;
    }
    const koksma__words r =
        koksma__random(use->seed, KOKSMA__PURPOSE_SHUFFLE, node, last ? KOKSMA__STAGE_LAST : KOKSMA__STAGE_TREE);
    const int *order = orders[koksma__below(r.w[0], 6)];
    return renewed || last ? order[k] ^ (int)koksma__below(r.w[1], 4) : order[k ^ b] ^ c;
}

/* Descends from the root to a stratum in the base use, and also in `use` unless it is NULL. last: whether the stratum
   belongs to the last stage. */
static void walk(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                 const koksma__stratum *stratum, bool last, spot *at_base, spot *at_use)
{
    *at_base = start(s, base, stratum->number);
    if (use) {
        *at_use = start(s, use, stratum->number);
    }
    for (uint32_t level = 0; level < stratum->level; level++) {
        const uint32_t digits = (uint32_t)stratum->digits >> 2 * (stratum->level - level - 1);
        const int k = (int)(digits & 3), b = quarter_of(base, at_base->x), c = use ? quarter_of(use, at_use->x) : 0;
        const uint64_t node = node_of(stratum->number, digits, level + 1);
        const bool kept = s->reuse != KOKSMA__REUSE_RENEWED && k == b;
        if (use && use->split) {
            enter(use, partner(s, use, node_of(stratum->number, digits >> 2, level), last, k, b, c), at_use->cell);
        }
        enter(base, k, at_base->cell);
        if (kept) {
            zoom(base, b, at_base->x);
        } else {
            jitter(base, node, KOKSMA__STAGE_TREE, at_base->x);
        }
        if (use && !kept) {
            jitter(use, node, KOKSMA__STAGE_TREE, at_use->x);
        } else if (use && use->split) {
            zoom(use, c, at_use->x);
        }
    }
}

void koksma__stratum_cell(const koksma__strata *s, const koksma__use_cells *base, const koksma__stratum *stratum,
                          uint32_t cell[2])
{
    spot at;
    walk(s, base, NULL, stratum, false, &at, NULL);
    cell[0] = at.cell[0];
    cell[1] = at.cell[1];
}

void koksma__stratum_cell_in(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                             const koksma__stratum *stratum, uint32_t stage, uint32_t cell[2])
{
    spot at_base, at;
    walk(s, base, use, stratum, stage == KOKSMA__STAGE_LAST, &at_base, &at);
    memcpy(cell, use->use == base->use ? at_base.cell : at.cell, sizeof at.cell);
}

int koksma__stratum_quarter(const koksma__strata *s, const koksma__use_cells *base, const koksma__stratum *stratum)
{
    spot at;
    walk(s, base, NULL, stratum, false, &at, NULL);
    return quarter_of(base, at.x);
}

static float below_one(double x)
{
    const float last = 1 - 0x1p-24f, f = (float)x;
    return f < last ? f : last;
}

void koksma__stratum_place(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                           const koksma__stratum *stratum, uint32_t stage, float place[2])
{
    spot at_base, at;
    walk(s, base, use, stratum, stage == KOKSMA__STAGE_LAST, &at_base, &at);
    if (use->use == base->use) {
        at = at_base;
    }
    if (stage) {
        jitter(use, node_of(stratum->number, stratum->digits, stratum->level), stage, at.x);
    }
    const int level = use->split ? stratum->level : 0;
    const double cells = use->line ? ldexp((double)s->m * s->m, 2 * level) : ldexp(s->m, level);
    double shift[2] = {0, 0};
    if (use->turned) {
        koksma__random_pair(use->seed, KOKSMA__PURPOSE_SHIFT, 0, 0, shift);
    }
    for (int k = 0; k < 2; k++) {
        double x = (at.cell[k] + at.x[k]) / cells + shift[k];
        x -= x >= 1;
        place[k] = below_one(use->turned && s->phase == KOKSMA__PHASE_FOLDED ? fabs(2 * x - 1) : x);
    }
}

void koksma__use_cells_init(const koksma__adaptive *run, size_t pixel, uint32_t use, uint32_t *permutation,
                            koksma__use_cells *out)
{
    const koksma__strata *s = run->state;
    const koksma_render_options *options = run->frame->options;
    const bool one = koksma_use_at((size_t)koksma__use_index(use))->dim == 1;
    const uint32_t base = s->trees[pixel].base;
    *out = (koksma__use_cells){.use = use,
                               .seed = koksma__random_seed(options->seed, pixel, use),
                               .line = one && s->shuffled,
                               .split = use == base || !s->selective,
                               .turned = use != base && !s->shuffled && s->phase != KOKSMA__PHASE_FIXED};
    if (permutation && s->shuffled && use != KOKSMA__USE_PIXEL) {
        koksma__random_permutation(out->seed, KOKSMA__USE_PIXEL, s->m * s->m, permutation);
        out->permutation = permutation;
    }
}

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Computes the position of a stratum's sample in each use by a walk from one of the m x m initial cells down the
 * splits, in the base use and the other use together (adaptive_place.h defines these terms). Every random number is a
 * hash of (seed, pixel, use, node), where a node is a current or former stratum, so that no positions need to be
 * stored.
 *
 * A stratum that is split into four passes its sample on to the part that contains it: part b in the base use, and
 * quarter c in another use. In the other use part k gets quarter k ^ b ^ c (exclusive or), so that part b gets quarter c
 * and the other three parts get the other three quarters. With shuffled pairing those three quarters are permuted at
 * random.
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
static int partner(const koksma__strata *s, const koksma__use_cells *use, uint64_t node, int k, int b, int c)
{
    static const int orders[6][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 1, 3},
                                     {0, 2, 3, 1}, {0, 3, 1, 2}, {0, 3, 2, 1}};
    if (!s->shuffled) {
        return k ^ b ^ c;
    }
    const koksma__words r = koksma__random(use->seed, KOKSMA__PURPOSE_SHUFFLE, node, KOKSMA__STAGE_TREE);
    return orders[koksma__below(r.w[0], 6)][k ^ b] ^ c;
}

/* Descends from the root to a stratum in the base use and in `use`, which may be the same. */
static spot walk(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                 const koksma__stratum *stratum)
{
    spot at_base = start(s, base, stratum->number), at_use = start(s, use, stratum->number);
    for (uint32_t level = 0; level < stratum->level; level++) {
        const uint32_t digits = (uint32_t)stratum->digits >> 2 * (stratum->level - level - 1);
        const int k = (int)(digits & 3), b = quarter_of(base, at_base.x), c = quarter_of(use, at_use.x);
        const uint64_t node = node_of(stratum->number, digits, level + 1);
        if (use->split) {
            enter(use, partner(s, use, node_of(stratum->number, digits >> 2, level), k, b, c), at_use.cell);
        }
        enter(base, k, at_base.cell);
        if (k != b) {
            jitter(base, node, KOKSMA__STAGE_TREE, at_base.x);
            jitter(use, node, KOKSMA__STAGE_TREE, at_use.x);
        } else {
            zoom(base, b, at_base.x);
            if (use->split) {
                zoom(use, c, at_use.x);
            }
        }
    }
    return use->use == base->use ? at_base : at_use;
}

void koksma__stratum_cell(const koksma__strata *s, const koksma__use_cells *base, const koksma__use_cells *use,
                          const koksma__stratum *stratum, uint32_t cell[2])
{
    const spot at = walk(s, base, use, stratum);
    memcpy(cell, at.cell, sizeof at.cell);
}

int koksma__stratum_quarter(const koksma__strata *s, const koksma__use_cells *base, const koksma__stratum *stratum)
{
    const spot at = walk(s, base, base, stratum);
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
    spot at = walk(s, base, use, stratum);
    if (stage) {
        jitter(use, node_of(stratum->number, stratum->digits, stratum->level), stage, at.x);
    }
    const int level = use->split ? stratum->level : 0;
    const double cells = use->line ? ldexp((double)s->m * s->m, 2 * level) : ldexp(s->m, level);
    for (int k = 0; k < 2; k++) {
        place[k] = below_one((at.cell[k] + at.x[k]) / cells);
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
                               .split = use == base || !s->selective};
    if (permutation && s->shuffled && use != KOKSMA__USE_PIXEL) {
        koksma__random_permutation(out->seed, KOKSMA__USE_PIXEL, s->m * s->m, permutation);
        out->permutation = permutation;
    }
}

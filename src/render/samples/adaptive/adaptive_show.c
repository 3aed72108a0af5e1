/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Describes the strata of a pixel in the unit square of each use, for figures such as 5.35 and 5.36 of Shirley 1991,
 * and marks the splits that were needless (adapt_strata.c has the test). Splits are reconstructed from the strata:
 * each stratum stores a digit for each split that led to it. Of all strata that descend from one stratum at depth
 * `level`, exactly one has only zeros among its digits from that depth on; it represents the split of that stratum.
 */
#include "render/samples/adaptive/adaptive.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/status.h"
#include "render/samples/samples.h"
#include "render/vector3.h"

enum { LIGHTS = 4 };

int koksma__list_spaces(const koksma__use_list *there, uint32_t list[KOKSMA_MAX_SPACES])
{
    int n = 0;
    list[n++] = KOKSMA__USE_PIXEL;
    if (there->lens) {
        list[n++] = KOKSMA__USE_LENS;
    }
    if (there->time) {
        list[n++] = KOKSMA__USE_TIME;
    }
    for (uint32_t v = 0; v < 2 && (int)v < there->vertices; v++) {
        for (uint32_t l = 0; l < LIGHTS && (int)l < there->lights; l++) {
            list[n++] = v * KOKSMA__USES_A_BOUNCE + KOKSMA__USE_LIGHT + l;
        }
        if (there->vertices > 1) {
            list[n++] = v * KOKSMA__USES_A_BOUNCE + KOKSMA__USE_LOBE;
        }
    }
    return n;
}

/* The data from which the picture of one use is made. */
typedef struct view {
    const koksma__adaptive *run;
    const koksma__strata *s;
    const koksma__tree *tree;
    koksma__use_cells base, cells;
} view;

/* Computes the box of a stratum in the unit square. */
static void box_of(const view *v, const koksma__stratum *stratum, double *x, double *y, double *width, double *height)
{
    const koksma__strata *s = v->s;
    const int level = v->cells.split ? stratum->level : 0;
    const double side = ldexp(1.0 / s->m, -level);
    uint32_t cell[2];
    koksma__stratum_cell(s, &v->base, &v->cells, stratum, cell);
    *width = v->cells.line ? ldexp(1.0 / ((double)s->m * s->m), -2 * level) : side;
    *height = v->cells.line ? 1 : side;
    *x = cell[0] * *width;
    *y = v->cells.line ? 0 : cell[1] * side;
}

static double value_of(const view *v, const koksma__stratum *stratum)
{
    return (double)koksma__sample_luminance(stratum->value, (size_t)v->run->frame->channels);
}

/* Returns the mean over all parts of the initial stratum that contains stratum i. The parts of an initial stratum
   are adjacent in the list. */
static double mean_of(const view *v, uint32_t i)
{
    const koksma__stratum *list = v->tree->strata;
    const uint32_t number = list[i].number;
    double sum = 0;
    while (i && list[i - 1].number == number) {
        i--;
    }
    for (; i < v->tree->n && list[i].number == number; i++) {
        sum += ldexp(value_of(v, &list[i]), -2 * list[i].level);
    }
    return sum;
}

static void fill_strata(const view *v, koksma_space *space)
{
    for (uint32_t i = 0; i < v->tree->n; i++) {
        const koksma__stratum *from = &v->tree->strata[i];
        koksma_stratum *to = &space->strata[i];
        float place[2];
        koksma__stratum_place(v->s, &v->base, &v->cells, from, KOKSMA__STAGE_TREE, place);
        box_of(v, from, &to->x, &to->y, &to->width, &to->height);
        to->at[0] = (double)place[0];
        to->at[1] = v->cells.line ? 0.5 : (double)place[1];
        to->value = v->cells.split ? value_of(v, from) : mean_of(v, i);
        to->level = v->cells.split ? from->level : 0;
    }
}

/* Lists the strata at depth `level` that were split, with their boxes before the split, and returns their number;
   with `to` NULL it only counts. */
static size_t splits_of(const view *v, uint32_t level, koksma_split *to)
{
    size_t n = 0;
    for (uint32_t i = 0; i < v->tree->n; i++) {
        koksma__stratum at = v->tree->strata[i];
        const uint32_t further = at.level > level ? 2u * (at.level - level) : 0;
        if (!further || (at.digits & ((1u << further) - 1))) {
            continue;
        }
        if (to) {
            at.level = (uint8_t)level;
            at.digits = (uint16_t)(at.digits >> further);
            to[n] = (koksma_split){.level = v->cells.split ? (int)level : 0, .needless = at.needless >> level & 1};
            box_of(v, &at, &to[n].x, &to[n].y, &to[n].width, &to[n].height);
        }
        n++;
    }
    return n;
}

static void name_space(uint32_t use, char *name, size_t size)
{
    const uint32_t number = use % KOKSMA__USES_A_BOUNCE, vertex = use / KOKSMA__USES_A_BOUNCE;
    int length = snprintf(name, size, "%s", koksma_use_at((size_t)koksma__use_index(use))->name);
    if (number > KOKSMA__USE_LIGHT) {
        length += snprintf(name + length, size - (size_t)length, " %u", (unsigned)(number - KOKSMA__USE_LIGHT + 1));
    }
    if (vertex) {
        snprintf(name + length, size - (size_t)length, ", vertex %u", (unsigned)vertex + 1);
    }
}

static koksma_status fill_space(view *v, uint32_t use, size_t n_splits, koksma_space *space)
{
    *space = (koksma_space){.n = v->tree->n,
                            .n_splits = n_splits,
                            .strata = malloc(v->tree->n * sizeof *space->strata),
                            .splits = malloc((n_splits + 1) * sizeof *space->splits)};
    KOKSMA__REQUIRE_MEMORY(space->strata && space->splits, v->tree->n * sizeof *space->strata);
    name_space(use, space->name, sizeof space->name);
    fill_strata(v, space);
    size_t n = 0;
    for (uint32_t level = 0; n_splits && level < v->s->levels; level++) {
        n += splits_of(v, level, space->splits + n);
    }
    return KOKSMA_OK;
}

/* The first entry of out->spaces is for the base use, in which neighbouring strata are compared; the other uses
   follow in the order of koksma__list_spaces. */
koksma_status koksma__strata_show(const koksma__adaptive *run, size_t pixel, koksma_strata *out)
{
    const koksma__strata *s = run->state;
    const koksma__tree *tree = &s->trees[pixel];
    view v = {.run = run, .s = s, .tree = tree};
    uint32_t uses[KOKSMA_MAX_SPACES];
    const int n = koksma__list_spaces(&run->frame->uses, uses);
    const size_t cells = (size_t)s->m * s->m;
    uint32_t *permutations = malloc(2 * cells * sizeof *permutations);
    out->n_spaces = 0;
    out->spaces = calloc((size_t)n, sizeof *out->spaces);
    koksma_status status = permutations && out->spaces ? KOKSMA_OK : koksma__fail_memory(2 * cells * sizeof *uses);
    size_t n_splits = 0;
    for (uint32_t level = 0; run->options->probes && level < s->levels; level++) {
        n_splits += splits_of(&v, level, NULL);
    }
    if (!status) {
        koksma__use_cells_init(run, pixel, tree->base, permutations, &v.base);
    }
    for (int i = -1; !status && i < n; i++) {
        const uint32_t use = i < 0 ? tree->base : uses[i];
        koksma__use_cells_init(run, pixel, use, permutations + cells, &v.cells);
        const bool overlap = koksma_use_at((size_t)koksma__use_index(use))->dim == 1 && !v.cells.line;
        if ((i < 0 || use != tree->base) && !overlap) {
            status = fill_space(&v, use, n_splits, &out->spaces[out->n_spaces++]);
        }
    }
    free(permutations);
    if (status) {
        koksma_strata_fini(out);
    }
    return status;
}

void koksma_strata_fini(koksma_strata *strata)
{
    for (size_t i = 0; strata && strata->spaces && i < strata->n_spaces; i++) {
        free(strata->spaces[i].strata);
        free(strata->spaces[i].splits);
    }
    if (strata) {
        free(strata->spaces);
        *strata = (koksma_strata){0};
    }
}

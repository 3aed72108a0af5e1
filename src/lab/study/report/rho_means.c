/* SPDX-License-Identifier: Apache-2.0 */
/* Sums of rank correlations. A measure has a cell for each scene and number of samples; the cells are few, so linear
   search finds them. */
#include "study/report/rho_means.h"
#include "stats/stats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"

/* Finds or adds the sums of a measure; NULL: no memory. */
static koksma__rho_sums *sums_of(koksma__rho_means *s, const char *measure)
{
    for (size_t m = 0; m < s->n; m++) {
        if (!strcmp(s->of[m].measure, measure)) {
            return &s->of[m];
        }
    }
    koksma__rho_sums *of = koksma__add_one(&s->of, &s->n, sizeof *of);
    if (of) {
        of->measure = measure;
    }
    return of;
}

static koksma_status index_of(const char ***texts, size_t *n, const char *text, size_t *index)
{
    for (*index = 0; *index < *n; ++*index) {
        if (!strcmp((*texts)[*index], text)) {
            return KOKSMA_OK;
        }
    }
    const char **added = koksma__add_one(texts, n, sizeof *added);
    if (!added) {
        return KOKSMA_MEMORY;
    }
    *added = text;
    return KOKSMA_OK;
}

static koksma_status add_size(koksma__rho_means *s, long long spp)
{
    for (size_t i = 0; i < s->n_sizes; i++) {
        if (s->sizes[i] == spp) {
            return KOKSMA_OK;
        }
    }
    long long *size = koksma__add_one(&s->sizes, &s->n_sizes, sizeof *size);
    if (!size) {
        return KOKSMA_MEMORY;
    }
    *size = spp;
    return KOKSMA_OK;
}

/* Finds or adds the cell of a scene and a number of samples; NULL: no memory. */
static koksma__rho_cell *cell_of(koksma__rho_sums *of, size_t scene, long long spp)
{
    for (size_t c = 0; c < of->n_cells; c++) {
        if (of->cells[c].scene == scene && of->cells[c].spp == spp) {
            return &of->cells[c];
        }
    }
    koksma__rho_cell *cell = koksma__add_one(&of->cells, &of->n_cells, sizeof *cell);
    if (!cell) {
        return NULL;
    }
    *cell = (koksma__rho_cell){.scene = scene, .spp = spp, .draws = calloc(KOKSMA__RHO_SAMPLES, sizeof *cell->draws)};
    if (!cell->draws) {
        (void)koksma__fail_memory(KOKSMA__RHO_SAMPLES * sizeof *cell->draws);
        return NULL;
    }
    return cell;
}

koksma__estimate koksma__rho_shown(const koksma__estimate *rho, size_t n_patterns)
{
    const bool says = n_patterns >= KOKSMA__LEAST_PAIRS && rho->low < rho->high;
    return says ? *rho : (koksma__estimate){rho->value, NAN, NAN};
}

koksma_status koksma__rho_add(koksma__rho_means *s, const koksma__rho_source *source, const koksma__estimate *rho,
                              const double draws[KOKSMA__RHO_SAMPLES])
{
    size_t v, scene;
    koksma__rho_sums *of = sums_of(s, source->measure);
    koksma_status status = of ? index_of(&s->variants, &s->n_variants, source->variant, &v) : KOKSMA_MEMORY;
    status = status ? status : index_of(&s->scenes, &s->n_scenes, source->scene, &scene);
    status = status ? status : add_size(s, source->spp);
    koksma__rho_cell *cell = status ? NULL : cell_of(of, scene, source->spp);
    if (!cell) {
        return KOKSMA_MEMORY;
    }
    const bool few = source->n_patterns < KOKSMA__LEAST_PAIRS;
    cell->total += rho->value;
    cell->all++;
    cell->few += few;
    for (size_t i = 0; i < KOKSMA__RHO_SAMPLES; i++) {
        cell->draws[i] += draws[i];
    }
    of->total += rho->value;
    of->all++;
    of->sure += rho->low > 0 || rho->high < 0;
    of->few += few;
    of->perfect += !few && isnan(rho->low);
    if (v < KOKSMA__RHO_VARIANTS) {
        of->rho[v] += rho->value;
        of->cases[v]++;
    }
    return KOKSMA_OK;
}

static double mean_rho(const koksma__rho_sums *m)
{
    return m->all ? m->total / (double)m->all : (double)NAN;
}

/* Uses insertion sort, because measures and numbers of samples are few. */
void koksma__rho_order(koksma__rho_means *s)
{
    for (size_t m = 1; m < s->n; m++) {
        const koksma__rho_sums of = s->of[m];
        size_t at = m;
        for (; at > 0 && koksma__compare(mean_rho(&s->of[at - 1]), mean_rho(&of)) < 0; at--) {
            s->of[at] = s->of[at - 1];
        }
        s->of[at] = of;
    }
    for (size_t k = 1; k < s->n_sizes; k++) {
        const long long size = s->sizes[k];
        size_t at = k;
        for (; at > 0 && s->sizes[at - 1] > size; at--) {
            s->sizes[at] = s->sizes[at - 1];
        }
        s->sizes[at] = size;
    }
}

void koksma__rho_fini(koksma__rho_means *s)
{
    for (size_t m = 0; m < s->n; m++) {
        for (size_t c = 0; c < s->of[m].n_cells; c++) {
            free(s->of[m].cells[c].draws);
        }
        free(s->of[m].cells);
    }
    KOKSMA__FREE(s->of, s->variants, s->scenes, s->sizes);
}

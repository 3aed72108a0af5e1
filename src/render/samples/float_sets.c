/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Generates the point sets of a pixel in single precision. A rendered image needs a point set for each pixel and use,
 * in floats; koksma_generate makes doubles from 53 random bits, one set per call. The patterns in this file have a
 * float form of the same distribution: each coordinate takes one random word, loops run over SIMD lanes, and the
 * points are made in the order that the pairing needs. koksma_generate makes all other patterns, and these patterns
 * with parameters that have no float form.
 *
 * A coordinate is a multiple of 2^-24 below 1, which a float represents exactly. A cell begins at the first multiple
 * that lies in it, and all m cells have the same number of multiples, so that every point lies in its cell; the
 * remaining 2^24 mod m multiples are never drawn, which changes the mean of a coordinate in m cells by less than
 * 2^-24.
 *
 * The patterns `random` and `jittered` compute corner + scale x word in each coordinate. The pattern `n-rooks` takes
 * the same strata in two orders, one per coordinate. Correlated multi-jitter (Kensler 2013) permutes the corners by
 * columns and by rows, then puts the points in a random order. Nets are Owen-scrambled by stochastic generation
 * (patterns/nets/nets.h).
 */
#include "render/samples/samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "patterns/grids/grids.h"
#include "patterns/nets/nets.h"

static const float nowhere[2] = {0, 0};

/* ---- Cells ---------------------------------------------------------------------------------------------------- */

/* Returns the first multiple of 2^-24 in cell c of m. */
static float corner_of(size_t c, size_t m)
{
    return (float)((((uint64_t)c << 24) + m - 1) / m) * 0x1p-24f;
}

/* Returns the factor that maps 24-bit words to offsets within a cell of m: the product stays below the width of
   the cell. */
static float scale_of(size_t m)
{
    const double last = (double)((1u << 24) / m - 1), most = 0x1p24 - 1;
    const float scale = (float)(last / most * 0x1p-24);
    return (double)scale * most > last * 0x1p-24 ? nextafterf(scale, 0) : scale;
}

static koksma_status make_corners(koksma__float_set *set, size_t numbers)
{
    set->corners = calloc(numbers, sizeof *set->corners);
    return set->corners ? KOKSMA_OK : koksma__fail_memory(numbers * sizeof *set->corners);
}

/* Fills the corners for a Latin hypercube pattern: both numbers of pair i are the start of stratum i of n. */
static koksma_status make_strata(koksma__float_set *set)
{
    const koksma_status status = make_corners(set, 2 * set->n);
    for (size_t i = 0; !status && i < 2 * set->n; i++) {
        set->corners[i] = corner_of(i / 2, set->n);
    }
    set->scale[0] = set->scale[1] = scale_of(set->n);
    return status;
}

static void draw_cells(const koksma__float_set *set, const koksma__batch_table *batch, const uint32_t *words,
                       const uint16_t *order, const float offset[2], const koksma__float_scratch *scratch,
                       float *pairs)
{
    batch->jitter(set->corners, words, set->scale, offset, set->n, order ? scratch->pairs : pairs);
    if (order) {
        batch->gather(scratch->pairs, order, set->n, pairs);
    }
}

static koksma_status init_cells(size_t columns, size_t rows, bool plane, koksma__float_set *set)
{
    const koksma_status status = make_corners(set, 2 * set->n);
    for (size_t i = 0; !status && i < set->n && columns * rows > 1; i++) {
        set->corners[2 * i] = corner_of(i / rows, columns);
        set->corners[2 * i + 1] = plane ? corner_of(i % rows, rows) : 0;
    }
    set->scale[0] = scale_of(columns);
    set->scale[1] = plane ? scale_of(rows) : 0;
    set->words = 2 * set->n;
    set->draw = draw_cells;
    return status;
}

static koksma_status init_random(const koksma_spec *spec, int dim, koksma__float_set *set)
{
    (void)spec;
    return init_cells(1, 1, dim == 2, set);
}

static koksma_status init_jittered(const koksma_spec *spec, int dim, koksma__float_set *set)
{
    const koksma_points points = {set->n, dim, NULL};
    size_t columns, rows;
    KOKSMA__TRY(koksma__cells(spec->pattern->name, &points, spec->params[0], &columns, &rows));
    return dim == 2 ? init_cells(columns, rows, true, set) : init_cells(set->n, 1, false, set);
}

/* ---- Latin sets ------------------------------------------------------------------------------------------------- */

static void draw_rooks(const koksma__float_set *set, const koksma__batch_table *batch, const uint32_t *words,
                       const uint16_t *order, const float offset[2], const koksma__float_scratch *scratch,
                       float *pairs)
{
    const size_t n = set->n;
    const float *strata = scratch->pairs;
    batch->jitter(set->corners, words + koksma__order_words(n), set->scale, offset, n, scratch->pairs);
    if (order) {
        batch->gather_both(strata, order, scratch->order, n, pairs);
        return;
    }
    for (size_t i = 0; i < n; i++) {
        pairs[2 * i] = strata[2 * i];
        pairs[2 * i + 1] = strata[2 * (size_t)scratch->order[i] + 1];
    }
}

static koksma_status init_rooks(const koksma_spec *spec, int dim, koksma__float_set *set)
{
    (void)spec;
    if (dim == 1) {
        return init_cells(set->n, 1, false, set);
    }
    set->words = koksma__order_words(set->n) + 2 * set->n;
    set->has_order = true;
    set->draw = draw_rooks;
    return make_strata(set);
}

static void draw_correlated(const koksma__float_set *set, const koksma__batch_table *batch, const uint32_t *words,
                            const uint16_t *order, const float offset[2], const koksma__float_scratch *scratch,
                            float *pairs)
{
    const size_t n = set->n, columns = set->columns, rows = set->rows;
    uint16_t *in_column = scratch->order, *in_row = (uint16_t *)(void *)scratch->fractions;
    float *corner = scratch->pairs;
    batch->order(words, rows, in_column);
    words += koksma__order_words(rows);
    batch->order(words, columns, in_row);
    words += koksma__order_words(columns);
    for (size_t row = 0; row < rows; row++) {
        const float *strata = set->corners + 2 * in_column[row];
        for (size_t column = 0; column < columns; column++) {
            *corner++ = strata[2 * column * rows];
            *corner++ = set->corners[2 * (row * columns + in_row[column])];
        }
    }
    batch->jitter(scratch->pairs, words, set->scale, offset, n, scratch->pairs);
    batch->gather(scratch->pairs, order, n, pairs);
}

static koksma_status init_correlated(const koksma_spec *spec, int dim, koksma__float_set *set)
{
    (void)dim;
    KOKSMA__TRY(koksma__divisors(spec->pattern->name, set->n, spec->params[0], &set->columns, &set->rows));
    set->words = koksma__order_words(set->rows) + koksma__order_words(set->columns) + 2 * set->n;
    set->in_random_order = true;
    set->draw = draw_correlated;
    return make_strata(set);
}

/* ---- Nets ------------------------------------------------------------------------------------------------------- */

static void draw_net(const koksma__float_set *set, const koksma__batch_table *batch, const uint32_t *words,
                     const uint16_t *order, const float offset[2], const koksma__float_scratch *scratch, float *pairs)
{
    batch->net(words, set->partners, set->dim, order ? nowhere : offset, set->n, scratch->fractions,
               order ? scratch->pairs : pairs);
    if (order) {
        batch->gather(scratch->pairs, order, set->n, pairs);
    }
}

static void init_net(koksma__float_set *set)
{
    set->words = (size_t)set->dim * ((set->n + 3) / 4 * 4);
    set->draw = draw_net;
}

static koksma_status init_pmj02(const koksma_spec *spec, int dim, koksma__float_set *set)
{
    (void)dim;
    for (int k = 0; k < 2; k++) {
        memcpy(set->partners[k], koksma__pmj02_partners + 32 * k, 32 * sizeof *koksma__pmj02_partners);
    }
    if (spec->params[0] == 0) { /* not shuffled */
        init_net(set);
    }
    return KOKSMA_OK;
}

static koksma_status init_sobol(const koksma_spec *spec, int dim, koksma__float_set *set)
{
    const koksma_param *scramble = &spec->pattern->params[0];
    if (!strcmp(scramble->choices[(int)spec->params[0]], "owen")) {
        for (int k = 0; k < dim; k++) {
            koksma__partners(koksma__sobol_directions(k, (int)spec->params[1]), 32, set->partners[k]);
        }
        init_net(set);
    }
    return KOKSMA_OK;
}

/* ---- The table -------------------------------------------------------------------------------------------------- */

static const struct {
    const char *pattern;
    koksma_status (*init)(const koksma_spec *spec, int dim, koksma__float_set *set);
} forms[] = {
    {"random", init_random}, {"jittered", init_jittered},
    {"n-rooks", init_rooks}, {"correlated-multi-jittered", init_correlated},
    {"sobol", init_sobol},   {"pmj02", init_pmj02},
};

const char *koksma__float_set_name(size_t i)
{
    return i < sizeof forms / sizeof *forms ? forms[i].pattern : NULL;
}

koksma_status koksma__float_set_init(const koksma_spec *spec, size_t n, int dim, koksma__float_set *set)
{
    const char *name = spec->pattern->alias_of ? spec->pattern->alias_of : spec->pattern->name;
    bool modified = false;
    *set = (koksma__float_set){.n = n, .dim = dim};
    for (int m = 0; m < KOKSMA_MAX_MODIFIERS; m++) {
        modified |= spec->modifiers[m] != 0;
    }
    for (size_t i = 0; i < sizeof forms / sizeof *forms && !modified && n <= KOKSMA__ORDERED; i++) {
        if (!strcmp(name, forms[i].pattern)) {
            const koksma_status status = forms[i].init(spec, dim, set);
            if (status) {
                koksma__float_set_fini(set);
            }
            return status;
        }
    }
    return KOKSMA_OK;
}

void koksma__float_set_fini(koksma__float_set *set)
{
    free(set->corners);
    *set = (koksma__float_set){0};
}

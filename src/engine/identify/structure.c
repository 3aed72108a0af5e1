/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the strata of points tell, if no source that is known here makes them: a sequence in base 2 of other matrices, or
 * behind nested scrambling and perhaps a shuffle of its indices; a Latin hypercube, or one point in each cell of a grid.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/points.h"
#include "core/status.h"
#include "identify/sample.h"

enum { LEAST_POINTS = 32 };

/* ---- Sequences behind scrambling and a shuffle ---- */

/* Whether in each coordinate no two points of an aligned block of 2^level are in one interval of length 2^-level, where
   blocks begin at `offset`, modulo their size. */
static bool is_stratified(const koksma__sample *s, int level, size_t offset, size_t *seen)
{
    const size_t block = (size_t)1 << level;
    memset(seen, 0, block * sizeof *seen);
    for (size_t k = 0; k < (size_t)s->points.dim; k++) {
        for (size_t i = 0; i < s->points.n; i++) {
            const size_t id = (k * s->points.n + i + block - offset) / block + k + 1;
            size_t *cell = &seen[koksma__stratum(koksma__x(s, i, k), block)];
            if (*cell == id) {
                return false;
            }
            *cell = id;
        }
    }
    return true;
}

static koksma_status look_at_blocks(koksma__sample *s)
{
    size_t *seen = malloc(s->points.n * sizeof *seen), offset = 0;
    KOKSMA__REQUIRE_MEMORY(seen, s->points.n * sizeof *seen);
    bool holds = true;
    int level = 1;
    for (; holds && (size_t)1 << level <= s->points.n; level++) {
        const size_t half = (size_t)1 << (level - 1);
        holds = is_stratified(s, level, offset, seen);
        if (!holds && is_stratified(s, level, offset + half, seen)) {
            offset += half;
            holds = true;
        }
    }
    free(seen);
    if (!holds) {
        return KOKSMA_OK;
    }
    return koksma__say(
        s, "sequence", "sequence in base 2 of other matrices, scrambled or shuffled", "", 0,
        "each aligned block of 2^k points has one in each of 2^k intervals of every coordinate; the first "
        "block of %zu points begins at point %zu",
        (size_t)1 << (level - 1), offset);
}

/* ---- Strata ---- */

static int by_value(const void *a, const void *b)
{
    const double *u = a, *v = b;
    return (*u > *v) - (*u < *v);
}

/* Whether the points are a Latin hypercube, up to the tolerance: in order, each is in its interval; and whether all lie in
   the middles of these. Errors: MEMORY. */
static koksma_status find_strata(const koksma__sample *s, bool *latin, bool *centred)
{
    const koksma_points *p = &s->points;
    const double n = (double)p->n;
    double *sorted = malloc(p->n * sizeof *sorted);
    KOKSMA__REQUIRE_MEMORY(sorted, p->n * sizeof *sorted);
    *latin = *centred = true;
    for (size_t k = 0; k < (size_t)p->dim && *latin; k++) {
        for (size_t i = 0; i < p->n; i++) {
            sorted[i] = koksma__x(s, i, k);
        }
        qsort(sorted, p->n, sizeof *sorted, by_value);
        for (size_t i = 0; i < p->n && *latin; i++) {
            const double off = fabs(sorted[i] - ((double)i + .5) / n);
            *latin = off <= .5 / n + s->tolerance;
            *centred = *centred && off < 1e-6 / n + s->tolerance;
        }
    }
    free(sorted);
    return KOKSMA_OK;
}

static koksma_status look_at_strata(koksma__sample *s)
{
    const size_t n = s->points.n, dim = (size_t)s->points.dim;
    bool latin = false, centred = false;
    KOKSMA__TRY(find_strata(s, &latin, &centred));
    if (latin) {
        return koksma__say(s, "stratified",
                           centred ? "centred Latin hypercube (n-rooks)" : "Latin hypercube (n-rooks)", "", 0,
                           "each of n intervals of every coordinate has one point");
    }
    size_t columns = (size_t)nearbyint(koksma__pow((double)n, 1. / (double)dim)), cells = 1;
    for (size_t k = 0; k < dim && cells <= n; k++) {
        cells *= columns;
    }
    if (cells != n || columns < 2) {
        return KOKSMA_OK;
    }
    unsigned char *seen = calloc(n, 1);
    KOKSMA__REQUIRE_MEMORY(seen, n);
    bool each = true;
    for (size_t i = 0; i < n && each; i++) {
        size_t cell = 0;
        for (size_t k = 0; k < dim; k++) {
            cell = cell * columns + koksma__stratum(koksma__x(s, i, k), columns);
        }
        each = !seen[cell];
        seen[cell] = 1;
    }
    free(seen);
    return each ? koksma__say(s, "stratified", "jittered points", "", 0,
                              "each of the %zu^%zu cells of a grid has one point", columns, dim)
                : KOKSMA_OK;
}

koksma_status koksma__identify_structure(koksma__sample *s)
{
    if (s->points.n < LEAST_POINTS) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__ask(s->run));
    KOKSMA__TRY(look_at_blocks(s));
    return s->named ? KOKSMA_OK : look_at_strata(s);
}

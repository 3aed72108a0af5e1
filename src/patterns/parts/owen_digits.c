/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Owen's nested scrambling of radical inverses, exact, without looking at a digit twice (Helmer, Christensen &
 * Kensler 2021). Point r < b^j and its relatives r + d b^j, 0 < d < b, agree in the first j output digits. The digit
 * at place j of r is known from its random fraction; those of its relatives are drawn from the other b - 1 without
 * replacement, and what lies below is uniform. A value is a whole number of b^-M, with b^M just below 2^53.
 */
#include "patterns/parts/owen_digits.h"

#include <stdlib.h>

#include "core/pages.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/parts/columns.h"
#include "patterns/parts/grow.h"
#include "patterns/parts/radical.h"

enum { FEW = 256, MANY = 4096, STREAM = 1 << 20, MAX_BASE = 38880, SMALL_BASE = 13 };

typedef struct job {
    uint64_t seed;
    koksma_points *out;
    double *columns; /* of n values, which become rows together; NULL: each column is stored by itself */
} job;

typedef struct column {
    uint32_t base;
    size_t n;
    double *v;            /* n values: whole numbers below 2^53 */
    const uint32_t *word; /* two for each point */
    uint16_t *order, *picked;
} column;

/* floor, which is a call without SSE 4.1. */
static inline double whole_part(double x)
{
    return (double)(int64_t)x;
}

static inline double below(double width, uint32_t word)
{
    return whole_part(width * (word * 0x1p-32));
}

/* The relatives of point r at the place whose digit has the value `width`, r + step, r + 2 step, … Quotients of whole
   numbers below 2^53 have the right floor. */
static void place_relatives(const column *c, size_t r, size_t step, double width)
{
    const double upper = whole_part(c->v[r] / width), prefix = whole_part(upper / c->base) * c->base;
    const uint32_t own = (uint32_t)(upper - prefix);
    uint32_t d = 1;
    c->order[own] = 0;
    c->order[0] = (uint16_t)own;
    for (size_t i = r + step; d < c->base && i < c->n; i += step, d++) {
        const uint32_t pick = d + koksma__below(c->word[2 * i], c->base - d);
        const uint16_t digit = c->order[pick];
        c->order[pick] = c->order[d];
        c->order[d] = digit;
        c->picked[d] = (uint16_t)pick;
        c->v[i] = (prefix + digit) * width + below(width, c->word[2 * i + 1]);
    }
    while (--d) {
        const uint16_t digit = c->order[d];
        c->order[d] = c->order[c->picked[d]];
        c->order[c->picked[d]] = digit;
    }
    c->order[0] = 0;
    c->order[own] = (uint16_t)own;
}

/* Small bases: the same number of relatives at a time. Base 3 has draws of its own: the others of its digits come in
   their cyclic order or in the opposite one. */
static void place_small(const column *c, size_t step, double width)
{
    size_t first = 0;
    for (uint32_t relatives = c->base - 1; relatives; relatives--) {
        const size_t left = c->n > relatives * step ? c->n - relatives * step : 0, end = left < step ? left : step;
        if (end > first) {
            koksma__kernels()->nested_digits(c->base, relatives, first, end - first, step, width, c->word, c->v);
            first = end;
        }
    }
}

static void place_level(const column *c, size_t step, double width)
{
    if (c->base <= SMALL_BASE) {
        place_small(c, step, width);
        return;
    }
    for (size_t r = 0; r < (c->n - step < step ? c->n - step : step); r++) {
        place_relatives(c, r, step, width);
    }
}

static void place_all(const column *c, double whole)
{
    for (uint32_t a = 0; a < c->base; a++) {
        c->order[a] = (uint16_t)a;
    }
    c->v[0] = below(whole, c->word[0]) + c->word[1] % c->base;
    c->v[0] -= c->v[0] >= whole ? whole : 0;
    double width = whole;
    for (size_t step = 1; step < c->n; step *= c->base) {
        width /= c->base;
        place_level(c, step, width);
    }
}

/* Base 2 by the kernel of the nets in base 2; the digital sequence is the identity. */
static koksma_status fill_base2(const job *j)
{
    const uint32_t partners[32] = {0};
    double few[FEW];
    const size_t n = j->out->n;
    koksma_points line = {n, 1, j->columns ? j->columns : n <= FEW ? few : malloc(n * sizeof *line.xs)};
    if (!line.xs) {
        return koksma__fail_memory(n * sizeof *line.xs);
    }
    const koksma_run one = {.threads = 1};
    const koksma_status status = koksma__grow(j->seed, KOKSMA__PURPOSE_SCRAMBLE, partners, &one, &line);
    if (!j->columns) {
        koksma__store_column(n, line.xs, j->out->dim, 0, j->out->xs);
    }
    if (!j->columns && line.xs != few) {
        free(line.xs);
    }
    return status;
}

static koksma_status fill(void *context, size_t k)
{
    const job *j = context;
    if (k == 0) {
        return fill_base2(j);
    }
    const size_t n = j->out->n;
    double few_values[FEW];
    uint32_t few_words[2 * FEW + 2];
    uint16_t order[MAX_BASE], picked[MAX_BASE];
    column c = {.base = koksma__prime((int)k), .n = n, .v = few_values, .order = order, .picked = picked};
    uint32_t *word = few_words;
    void *memory = NULL;
    if (n > FEW) {
        const size_t bytes = (j->columns ? 0 : n * sizeof *c.v) + (2 * n + 2) * sizeof *word;
        memory = malloc(bytes);
        if (!memory) {
            return koksma__fail_memory(bytes);
        }
        koksma__large_pages(memory, bytes);
        c.v = j->columns ? j->columns + k * n : memory;
        word = j->columns ? memory : (uint32_t *)(c.v + n);
    }
    koksma__kernels()->words(j->seed, KOKSMA__PURPOSE_SCRAMBLE, 0, (uint32_t)k, (n + 1) / 2, word);
    c.word = word;
    double whole = c.base;
    while (whole * c.base <= 0x1p53) {
        whole *= c.base;
    }
    place_all(&c, whole);
    koksma__kernels()->quotients(n, c.v, 0, whole, c.v);
    if (!j->columns) {
        koksma__store_column(n, c.v, j->out->dim, (int)k, j->out->xs);
    }
    free(memory);
    return KOKSMA_OK;
}

koksma_status koksma__owen_digits(uint64_t seed, const koksma_run *run, koksma_points *out)
{
    const size_t n = out->n, dim = (size_t)out->dim;
    job j = {seed, out, NULL};
    koksma_status status = KOKSMA_OK;
    if (n < MANY) {
        for (size_t k = 0; k < dim && !status; k++) {
            status = fill(&j, k);
        }
        return status;
    }
    if (dim == 2 || dim == 4) {
        j.columns = malloc(dim * n * sizeof *j.columns);
        if (!j.columns) {
            return koksma__fail_memory(dim * n * sizeof *j.columns);
        }
        koksma__large_pages(j.columns, dim * n * sizeof *j.columns);
    }
    status = koksma__parallel(run, dim, fill, &j);
    if (!status && j.columns) {
        koksma__kernels()->rows_of_columns(n, out->dim, j.columns, n, dim * n > STREAM, out->xs);
    }
    free(j.columns);
    return status;
}

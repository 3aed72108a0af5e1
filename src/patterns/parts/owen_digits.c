/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Owen's nested scrambling of radical inverses, exact, without looking at a digit twice (Helmer, Christensen &
 * Kensler 2021). Point r < b^j and its relatives r + d b^j, 0 < d < b, agree in the first j output digits. The digit
 * at place j of r is known from its random fraction; those of its relatives are drawn from the other b - 1 without
 * replacement, and what lies below is uniform. A value is a whole number of b^-M, with b^M just below 2^53.
 */
#include "patterns/parts/owen_digits.h"

#include <stdlib.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/parts/radical.h"

enum { FEW = 256, MAX_BASE = 38880 };

typedef struct job {
    uint64_t seed;
    koksma_points *out;
} job;

typedef struct column {
    uint32_t base;
    size_t n;
    uint64_t *v;          /* n values */
    const uint32_t *word; /* two for each point */
    uint16_t *order, *picked;
} column;

static uint64_t below(uint64_t width, uint32_t word)
{
    return (uint64_t)((double)width * (word * 0x1p-32));
}

/* The relatives of point r at the place whose digit has the value `width`, r + step, r + 2 step, … */
static void place_relatives(const column *c, size_t r, size_t step, uint64_t width)
{
    const uint64_t upper = c->v[r] / width, own = upper % c->base, prefix = (upper - own) * width;
    if (c->base == 2) {
        const size_t i = r + step;
        c->v[i] = prefix + (1 - own) * width + below(width, c->word[2 * i + 1]);
        return;
    }
    uint32_t d = 1;
    c->order[own] = 0;
    c->order[0] = (uint16_t)own;
    for (size_t i = r + step; d < c->base && i < c->n; i += step, d++) {
        const uint32_t pick = d + koksma__below(c->word[2 * i], c->base - d);
        const uint16_t digit = c->order[pick];
        c->order[pick] = c->order[d];
        c->order[d] = digit;
        c->picked[d] = (uint16_t)pick;
        c->v[i] = prefix + digit * width + below(width, c->word[2 * i + 1]);
    }
    while (--d) {
        const uint16_t digit = c->order[d];
        c->order[d] = c->order[c->picked[d]];
        c->order[c->picked[d]] = digit;
    }
    c->order[0] = 0;
    c->order[own] = (uint16_t)own;
}

static void place_all(const column *c)
{
    uint64_t whole = c->base;
    while (whole * c->base <= (uint64_t)1 << 53) {
        whole *= c->base;
    }
    for (uint32_t a = 0; a < c->base && c->base > 2; a++) {
        c->order[a] = (uint16_t)a;
    }
    c->v[0] = below(whole, c->word[0]) + c->word[1] % c->base;
    c->v[0] -= c->v[0] >= whole ? whole : 0;
    uint64_t width = whole;
    for (size_t step = 1; step < c->n; step *= c->base) {
        width /= c->base;
        for (size_t r = 0; r < step && r + step < c->n; r++) {
            place_relatives(c, r, step, width);
        }
    }
}

static koksma_status fill(void *context, size_t k)
{
    const job *j = context;
    const size_t n = j->out->n, dim = (size_t)j->out->dim;
    uint64_t few_values[FEW];
    uint32_t few_words[2 * FEW + 2];
    uint16_t order[MAX_BASE], picked[MAX_BASE];
    column c = {.base = koksma__prime((int)k), .n = n, .v = few_values, .order = order, .picked = picked};
    uint32_t *word = few_words;
    void *memory = NULL;
    if (n > FEW) {
        const size_t bytes = n * sizeof *c.v + (2 * n + 2) * sizeof *word;
        memory = malloc(bytes);
        if (!memory) {
            return koksma__fail_memory(bytes);
        }
        c.v = memory;
        word = (uint32_t *)(c.v + n);
    }
    koksma__kernels()->words(j->seed, KOKSMA__PURPOSE_SCRAMBLE, 0, (uint32_t)k, (n + 1) / 2, word);
    c.word = word;
    place_all(&c);
    double whole = c.base;
    while (whole * c.base <= 0x1p53) {
        whole *= c.base;
    }
    double *x = j->out->xs + k;
    for (size_t i = 0; i < n; i++, x += dim) {
        *x = (double)c.v[i] / whole;
    }
    free(memory);
    return KOKSMA_OK;
}

koksma_status koksma__owen_digits(uint64_t seed, const koksma_run *run, koksma_points *out)
{
    job j = {seed, out};
    if (out->n >= 4096) {
        return koksma__parallel(run, (size_t)out->dim, fill, &j);
    }
    koksma_status status = KOKSMA_OK;
    for (int k = 0; k < out->dim && !status; k++) {
        status = fill(&j, (size_t)k);
    }
    return status;
}

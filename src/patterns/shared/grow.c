/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Doubles a set level by level: new point start + i of a level takes the sibling half-stratum of its partner, and
 * the digits below are fresh random bits. O(n) for each coordinate, without a tree and without comparing points
 * (grow.h).
 */
#include "patterns/shared/grow.h"

#include <koksma/sampler.h>
#include <stdlib.h>

#include "core/pages.h"
#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/shared/columns.h"

enum { COLUMNS = 8, FEW = 256, WORDS = 1024, BLOCK = 1 << 16 };

typedef struct growth {
    uint64_t seed;
    uint32_t purpose;
    const uint32_t *partners;
    int dim, k, level; /* dim columns beginning with coordinate k */
    size_t n, count;   /* points in all; new ones at this level */
    uint32_t *v;       /* dim columns of n fractions */
} growth;

static void grow_some(const growth *g, int c, size_t first, size_t count)
{
    const koksma__kernel_table *kernels = koksma__kernels();
    const size_t start = (size_t)1 << g->level;
    uint32_t word[WORDS + 8];
    while (count) {
        const size_t some = count < WORDS ? count : WORDS, skip = (start + first) % 4;
        kernels->words(g->seed, g->purpose, (start + first) / 4, (uint32_t)(g->k + c), (skip + some + 3) / 4, word);
        kernels->grow(g->v + (size_t)c * g->n, g->level, first, some, g->partners[32 * (g->k + c) + g->level],
                      word + skip);
        first += some;
        count -= some;
    }
}

static koksma_status grow_block(void *context, size_t block)
{
    const growth *g = context;
    const size_t blocks = (g->count + BLOCK - 1) / BLOCK, first = block % blocks * BLOCK;
    grow_some(g, (int)(block / blocks), first, g->count - first < BLOCK ? g->count - first : BLOCK);
    return KOKSMA_OK;
}

/* One column of few points: all its random words at once. */
static void grow_few(const growth *g, int c)
{
    const koksma__kernel_table *kernels = koksma__kernels();
    uint32_t word[WORDS + 8], *v = g->v + (size_t)c * g->n;
    kernels->words(g->seed, g->purpose, 0, (uint32_t)(g->k + c), (g->n + 3) / 4, word);
    v[0] = word[0];
    for (int level = 0; (size_t)1 << level < g->n; level++) {
        const size_t start = (size_t)1 << level, count = g->n - start < start ? g->n - start : start;
        kernels->grow(v, level, 0, count, g->partners[32 * (g->k + c) + level], word + start);
    }
}

static koksma_status grow_columns(growth *g, const koksma_run *run)
{
    koksma_status status = KOKSMA_OK;
    if (g->n <= WORDS) {
        for (int c = 0; c < g->dim; c++) {
            grow_few(g, c);
        }
        return KOKSMA_OK;
    }
    for (int c = 0; c < g->dim; c++) {
        uint32_t word[4];
        koksma__kernels()->words(g->seed, g->purpose, 0, (uint32_t)(g->k + c), 1, word);
        g->v[(size_t)c * g->n] = word[0];
    }
    for (g->level = 0; (size_t)1 << g->level < g->n && !status; g->level++) {
        const size_t start = (size_t)1 << g->level;
        g->count = g->n - start < start ? g->n - start : start;
        if (g->count > BLOCK) {
            status = koksma__parallel(run, (g->count + BLOCK - 1) / BLOCK * (size_t)g->dim, grow_block, g);
            continue;
        }
        for (int c = 0; c < g->dim; c++) {
            grow_some(g, c, 0, g->count);
        }
    }
    return status;
}

/* Points first .. first + count - 1 of out: v begins with the fraction of point first, a column every stride words.
 */
static void store(const growth *g, const uint32_t *v, size_t stride, koksma_points *out, size_t first, size_t count)
{
    const koksma__kernel_table *kernels = koksma__kernels();
    double columns[COLUMNS][KOKSMA__COLUMN_BLOCK];
    if (out->dim == 2 || out->dim == 4) {
        kernels->fraction_rows(count, out->dim, v, stride, koksma__is_large(out), out->xs + (size_t)out->dim * first);
        return;
    }
    for (int c = 0; c < g->dim; c++) {
        kernels->fractions(count, v + (size_t)c * stride, columns[c]);
    }
    koksma__store_columns(count, g->dim, columns[0], first, g->k, out);
}

koksma_status koksma__grow(uint64_t seed, uint32_t purpose, const uint32_t *partners, const koksma_run *run,
                           koksma_points *out)
{
    growth g = {.seed = seed, .purpose = purpose, .partners = partners, .n = out->n};
    uint32_t few[COLUMNS * FEW], *memory = NULL;
    const size_t numbers = (size_t)(out->dim < COLUMNS ? out->dim : COLUMNS) * g.n;
    g.v = few;
    if (numbers > COLUMNS * FEW) {
        const size_t bytes = numbers * sizeof *memory;
        memory = g.v = malloc(bytes);
        KOKSMA__REQUIRE_MEMORY(memory, bytes);
        koksma__large_pages(memory, bytes);
    }
    koksma_status status = KOKSMA_OK;
    for (; g.k < out->dim && !status; g.k += COLUMNS) {
        g.dim = out->dim - g.k < COLUMNS ? out->dim - g.k : COLUMNS;
        status = grow_columns(&g, run);
        for (size_t first = 0; first < out->n && !status; first += KOKSMA__COLUMN_BLOCK) {
            const size_t left = out->n - first, count = left < KOKSMA__COLUMN_BLOCK ? left : KOKSMA__COLUMN_BLOCK;
            store(&g, g.v + first, g.n, out, first, count);
        }
    }
    free(memory);
    return status;
}

koksma_status koksma__grow_column(uint64_t seed, uint32_t purpose, const uint32_t *partners, const koksma_run *run,
                                  size_t n, uint32_t *v)
{
    growth g = {.seed = seed, .purpose = purpose, .partners = partners, .dim = 1, .n = n, .v = v};
    return grow_columns(&g, run);
}

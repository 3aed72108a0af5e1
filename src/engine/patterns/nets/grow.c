/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Stochastic generation (grow.h): doubles a set level by level. The new point 2^l + i of level l is put into a half of
 * the stratum of its partner: the half that does not contain the partner. The digits below are new random bits. The
 * method takes O(n) for each coordinate, and needs no tree and no comparisons of points.
 */
#include "patterns/nets/nets.h"

#include <koksma/sampler.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/platform/system.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { COLUMNS = 8, FEW = 256, WORDS = 1024, BLOCK = 1 << 16, LEAST_BLOCK = 64, FAR_BLOCK = 4096 };

typedef struct growth {
    uint64_t seed;
    uint32_t purpose;
    const uint32_t *partners;
    int dim, k, level; /* the number of columns to compute, beginning with coordinate k */
    size_t n, count;   /* total number of points; number of new points at this level */
    uint32_t *v;       /* `dim` columns of n fractions, times 2^32 */
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

/* Makes one column of at most WORDS points, whose random words are drawn at once. */
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

/* Stores points first .. first + count - 1 of `out`. v has their fractions, with a distance of `stride` words between
   columns. */
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

/* ---- Ranges ---------------------------------------------------------------------------------------------- */

/* Computes the points of a part that begin at number `first` of it, in aligned blocks of g->n points, a power of two.
   The index of a partner is an exclusive or with a constant, which maps aligned blocks to aligned blocks.
   grow_columns computes block 0. */
typedef struct range {
    const growth *g; /* its members n and v describe block 0 */
    const koksma__grow_part *part;
    uint64_t first;
    koksma_points *out;
} range;

/* The state of following chains of partners for a whole block of points: the current ancestor of point i of the block
   in which the chains began is point i ^ turn of the block that begins at `block`. */
typedef struct ancestors {
    uint64_t block;
    uint32_t turn;
} ancestors;

/* Follows the chain of column c down to the first 2^32 points. late[i] receives digits 33 to 53 of point i of the block.
   At the end of the chain, below point 2^32, these digits are 0. */
static void grow_late(const range *r, int c, ancestors *chain, uint32_t *late)
{
    const growth *g = r->g;
    const uint64_t *partners = r->part->late_partners + (size_t)KOKSMA__LATE_DIGITS * (size_t)(g->k + c);
    const uint64_t inside = g->n - 1;
    uint32_t word[FAR_BLOCK], above = KOKSMA__LATE_MASK, flips = 0;
    memset(late, 0, g->n * sizeof *late);
    while (chain->block >> 32) {
        const int level = 63 - __builtin_clzll(chain->block), below = KOKSMA__DIGITS - 1 - level;
        const uint32_t own = ((uint32_t)1 << below) - 1, bits = above & own;
        koksma__kernels()->words(g->seed, g->purpose, chain->block / 4, (uint32_t)(g->k + c), g->n / 4, word);
        for (uint32_t i = 0; i <= inside; i++) {
            late[i] ^= word[i ^ chain->turn] >> (32 - below) & bits;
        }
        above &= ~own;
        flips ^= own + 1;
        chain->turn ^= (uint32_t)(partners[level - 32] & inside);
        chain->block = (chain->block ^ (uint64_t)1 << level ^ partners[level - 32]) & ~inside;
    }
    for (uint32_t i = 0; i <= inside; i++) {
        late[i] ^= flips;
    }
}

/* Computes column c of the points block .. block + n - 1. A point takes its upper bits from its partner, which takes
   its upper bits from its own partner, and so on down to block 0; this chain is followed for the whole block at once. */
static void grow_far(const growth *g, int c, ancestors from, uint32_t *v)
{
    const uint32_t *partners = g->partners + 32 * (g->k + c), inside = (uint32_t)g->n - 1;
    uint32_t word[FAR_BLOCK], above = 0xffffffffu, flips = 0, block = (uint32_t)from.block, turn = from.turn;
    memset(v, 0, g->n * sizeof *v);
    while (block) {
        const int level = 31 - __builtin_clz(block);
        const uint32_t own = level < 31 ? 0xffffffffu >> (level + 1) : 0, bits = above & own;
        koksma__kernels()->words(g->seed, g->purpose, block / 4, (uint32_t)(g->k + c), g->n / 4, word);
        for (uint32_t i = 0; i <= inside; i++) {
            v[i] ^= word[i ^ turn] >> level >> 1 & bits;
        }
        above &= ~own;
        flips ^= 0x80000000u >> level;
        turn ^= partners[level] & inside;
        block = (block ^ (uint32_t)1 << level ^ partners[level]) & ~inside;
    }
    const uint32_t *start = g->v + (size_t)c * g->n;
    for (uint32_t i = 0; i <= inside; i++) {
        v[i] ^= (start[i ^ turn] & above) ^ flips;
    }
}

static void add_late(const range *r, int c, const uint32_t *late, uint64_t at, uint64_t stop)
{
    const size_t dim = (size_t)r->out->dim;
    double *x = r->out->xs + (size_t)(at - r->first) * dim + (size_t)(r->g->k + c);
    for (; at < stop; at++, x += dim) {
        *x += late[at % r->g->n] * 0x1p-53;
    }
}

static koksma_status grow_range_block(void *context, size_t b)
{
    const range *r = context;
    const growth *g = r->g;
    const uint64_t block = (r->first / g->n + b) * g->n, end = r->first + r->out->n;
    const uint64_t first = block < r->first ? r->first : block, stop = block + g->n < end ? block + g->n : end;
    uint32_t v[COLUMNS][FAR_BLOCK], late[COLUMNS][FAR_BLOCK];
    for (int c = 0; c < g->dim; c++) {
        ancestors chain = {block, 0};
        if (r->part) {
            chain.block += r->part->part << 32;
            grow_late(r, c, &chain, late[c]);
        }
        grow_far(g, c, chain, v[c]);
    }
    for (uint64_t at = first, count; at < stop; at += count) {
        count = stop - at < KOKSMA__COLUMN_BLOCK ? stop - at : KOKSMA__COLUMN_BLOCK;
        store(g, v[0] + (at - block), FAR_BLOCK, r->out, (size_t)(at - r->first), (size_t)count);
    }
    for (int c = 0; r->part && c < g->dim; c++) {
        add_late(r, c, late[c], first, stop);
    }
    return KOKSMA_OK;
}

koksma_status koksma__grow_range(uint64_t seed, uint32_t purpose, const uint32_t *partners,
                                 const koksma__grow_part *part, const koksma_args *args, koksma_points *out)
{
    growth g = {.seed = seed, .purpose = purpose, .partners = partners, .n = LEAST_BLOCK};
    if (args->first == 0 && !part) {
        return koksma__grow(seed, purpose, partners, args->run, out);
    }
    while (g.n < FAR_BLOCK && g.n < out->n) {
        g.n *= 2;
    }
    g.v = malloc(COLUMNS * g.n * sizeof *g.v);
    KOKSMA__REQUIRE_MEMORY(g.v, COLUMNS * g.n * sizeof *g.v);
    const range r = {&g, part, args->first, out};
    const size_t blocks = (size_t)((args->first + out->n - 1) / g.n - args->first / g.n + 1);
    koksma_status status = KOKSMA_OK;
    for (g.k = 0; g.k < out->dim && !status; g.k += COLUMNS) {
        g.dim = out->dim - g.k < COLUMNS ? out->dim - g.k : COLUMNS;
        status = grow_columns(&g, args->run);
        status = status ? status : koksma__parallel(args->run, blocks, grow_range_block, (void *)&r);
    }
    free(g.v);
    return status;
}

koksma_status koksma__grow_column(uint64_t seed, uint32_t purpose, const uint32_t *partners, const koksma_run *run,
                                  size_t n, uint32_t *v)
{
    growth g = {.seed = seed, .purpose = purpose, .partners = partners, .dim = 1, .n = n, .v = v};
    return grow_columns(&g, run);
}

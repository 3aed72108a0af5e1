/* SPDX-License-Identifier: Apache-2.0 */
/* The bits of doubles >= 0, read as whole numbers, are in the order of the doubles. */
#include "measures/parts/order.h"

#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"

enum { DIGIT_BITS = 11, DIGITS = 6, VALUES = 1 << DIGIT_BITS, BLOCK = 1 << 16 };

typedef struct item {
    uint64_t key;
    uint32_t index;
} item;

/* Blocks of items are counted and moved side by side: where each begins in `to` follows from the counts of all. */
typedef struct sorter {
    size_t n, stride, n_blocks;
    const double *xs;
    uint32_t *order;
    item *from, *to;
    uint32_t (*starts)[VALUES]; /* by block */
    int digit;
} sorter;

static size_t end_of(const sorter *s, size_t block)
{
    return block + 1 < s->n_blocks ? (block + 1) * BLOCK : s->n;
}

static size_t digit_of(const sorter *s, const item *x)
{
    return (x->key >> (s->digit * DIGIT_BITS)) & (VALUES - 1);
}

static koksma_status load(void *context, size_t block)
{
    const sorter *s = context;
    for (size_t i = block * BLOCK; i < end_of(s, block); i++) {
        const double x = s->xs[i * s->stride] + 0.0; /* makes -0 a 0 */
        memcpy(&s->from[i].key, &x, sizeof x);
        s->from[i].index = (uint32_t)i;
    }
    return KOKSMA_OK;
}

static koksma_status count(void *context, size_t block)
{
    const sorter *s = context;
    uint32_t *counts = s->starts[block];
    memset(counts, 0, sizeof s->starts[block]);
    for (size_t i = block * BLOCK; i < end_of(s, block); i++) {
        counts[digit_of(s, &s->from[i])]++;
    }
    return KOKSMA_OK;
}

/* Counts become starts; false if all items have the same digit. */
static bool find_starts(sorter *s)
{
    uint32_t total = 0;
    bool moves = true;
    for (size_t v = 0; v < VALUES; v++) {
        const uint32_t before = total;
        for (size_t block = 0; block < s->n_blocks; block++) {
            const uint32_t items = s->starts[block][v];
            s->starts[block][v] = total;
            total += items;
        }
        moves &= total - before < s->n;
    }
    return moves;
}

static koksma_status move(void *context, size_t block)
{
    const sorter *s = context;
    uint32_t *starts = s->starts[block];
    for (size_t i = block * BLOCK; i < end_of(s, block); i++) {
        s->to[starts[digit_of(s, &s->from[i])]++] = s->from[i];
    }
    return KOKSMA_OK;
}

static koksma_status store(void *context, size_t block)
{
    const sorter *s = context;
    for (size_t i = block * BLOCK; i < end_of(s, block); i++) {
        s->order[i] = s->from[i].index;
    }
    return KOKSMA_OK;
}

/* One stable pass over a digit. */
static koksma_status pass(sorter *s, const koksma_run *run)
{
    koksma_status status = koksma__parallel(run, s->n_blocks, count, s);
    if (!status && find_starts(s)) {
        status = koksma__parallel(run, s->n_blocks, move, s);
        item *const other = s->from;
        s->from = s->to;
        s->to = other;
    }
    return status;
}

static int compare(const void *a, const void *b)
{
    const item *x = a, *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key) : (x->index > y->index) - (x->index < y->index);
}

koksma_status koksma__order(const koksma_run *run, size_t n, const double *xs, size_t stride, uint32_t *order)
{
    sorter s = {.n = n, .stride = stride, .n_blocks = (n + BLOCK - 1) / BLOCK, .xs = xs, .order = order};
    const size_t bytes = 2 * n * sizeof *s.from + s.n_blocks * sizeof *s.starts;
    s.from = malloc(bytes);
    if (!s.from) {
        return koksma__fail_memory(bytes);
    }
    item *const memory = s.from;
    s.to = s.from + n;
    s.starts = (uint32_t(*)[VALUES])(s.to + n);
    koksma_status status = koksma__parallel(run, s.n_blocks, load, &s);
    if (n < VALUES) {
        qsort(s.from, n, sizeof *s.from, compare);
    } else {
        for (s.digit = 0; s.digit < DIGITS && !status; s.digit++) {
            status = pass(&s, run);
        }
    }
    if (!status) {
        status = koksma__parallel(run, s.n_blocks, store, &s);
    }
    free(memory);
    return status;
}

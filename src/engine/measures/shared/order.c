/* SPDX-License-Identifier: Apache-2.0 */
/* Sorts doubles by a radix sort of their first 32 bits after the binary point; numbers that agree in these bits are
   then sorted by comparison. */
#include "measures/shared/shared.h"

#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"

enum { FEW = 32, MANY = 4096, MAX_VALUES = 1 << 11, BLOCK = 1 << 15 };

typedef struct item {
    uint32_t key, index;
} item;

/* Blocks of items are counted and moved in parallel; the counts of all blocks give the position in `to` at which the
   items of a block with a given digit begin. */
typedef struct sorter {
    size_t n, stride, n_blocks;
    const double *xs;
    uint32_t *order;
    item *from, *to;
    uint32_t (*starts)[MAX_VALUES]; /* counts of each block by digit */
    int shift;
    uint32_t mask; /* one less than the number of values of a digit */
} sorter;

/* An item with its number x: items whose keys, the first 32 bits of x, are equal are ordered by x. */
typedef struct exact {
    double x;
    uint32_t index;
} exact;

static size_t end_of(const sorter *s, size_t block)
{
    return block + 1 < s->n_blocks ? (block + 1) * BLOCK : s->n;
}

static uint32_t digit_of(const sorter *s, item x)
{
    return x.key >> s->shift & s->mask;
}

static koksma_status load(void *context, size_t block)
{
    const sorter *s = context;
    for (size_t i = block * BLOCK; i < end_of(s, block); i++) {
        const double x = s->xs[i * s->stride];
        s->from[i].key = x >= 1 ? UINT32_MAX : x > 0 ? (uint32_t)(x * 0x1p32) : 0;
        s->from[i].index = (uint32_t)i;
    }
    return KOKSMA_OK;
}

static koksma_status count(void *context, size_t block)
{
    const sorter *s = context;
    uint32_t *counts = s->starts[block];
    memset(counts, 0, (s->mask + 1) * sizeof *counts);
    for (size_t i = block * BLOCK; i < end_of(s, block); i++) {
        counts[digit_of(s, s->from[i])]++;
    }
    return KOKSMA_OK;
}

/* Replaces the counts by the positions where items begin. Returns false if all items have the same digit and the pass
   can be skipped. */
static bool find_starts(sorter *s)
{
    uint32_t total = 0;
    bool moves = true;
    for (size_t v = 0; v <= s->mask; v++) {
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
        s->to[starts[digit_of(s, s->from[i])]++] = s->from[i];
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

static bool precedes(exact a, exact b)
{
    return a.x < b.x || (a.x == b.x && a.index < b.index);
}

static int compare(const void *a, const void *b)
{
    const exact *x = a, *y = b;
    return precedes(*y, *x) - precedes(*x, *y);
}

/* Sorts items with equal keys by their numbers and writes their indices to `order`. */
static koksma_status settle(const sorter *s, const item *items, size_t n_items, uint32_t *order)
{
    exact few[FEW], *list = n_items <= FEW ? few : malloc(n_items * sizeof *list);
    KOKSMA__REQUIRE_MEMORY(list, n_items * sizeof *list);
    bool sorted = true;
    for (size_t i = 0; i < n_items; i++) {
        list[i] = (exact){s->xs[items[i].index * s->stride], items[i].index};
        sorted &= i == 0 || precedes(list[i - 1], list[i]);
    }
    if (!sorted && n_items > FEW) {
        qsort(list, n_items, sizeof *list, compare);
    }
    for (size_t i = 1; i < n_items && !sorted && n_items <= FEW; i++) {
        const exact moving = list[i];
        size_t j = i;
        for (; j > 0 && precedes(moving, list[j - 1]); j--) {
            list[j] = list[j - 1];
        }
        list[j] = moving;
    }
    for (size_t i = 0; i < n_items; i++) {
        order[i] = list[i].index;
    }
    if (list != few) {
        free(list);
    }
    return KOKSMA_OK;
}

/* Writes to s->order the indices of the items of all keys that first occur in this block. */
static koksma_status store(void *context, size_t block)
{
    const sorter *s = context;
    const item *const items = s->from;
    size_t i = block * BLOCK;
    while (i > 0 && i < end_of(s, block) && items[i].key == items[i - 1].key) {
        i++;
    }
    koksma_status status = KOKSMA_OK;
    while (i < end_of(s, block) && !status) {
        size_t end = i + 1;
        while (end < s->n && items[end].key == items[i].key) {
            end++;
        }
        if (end == i + 1) {
            s->order[i] = items[i].index;
        } else {
            status = settle(s, items + i, end - i, s->order + i);
        }
        i = end;
    }
    return status;
}

koksma_status koksma__order(const koksma_run *run, size_t n, const double *xs, size_t stride, uint32_t *order)
{
    sorter s = {
        .n = n, .stride = stride, .n_blocks = n <= BLOCK ? 1 : (n + BLOCK - 1) / BLOCK, .xs = xs, .order = order};
    if (n <= FEW) {
        item few[FEW];
        s.from = few;
        load(&s, 0);
        return settle(&s, few, n, order);
    }
    const int bits = n < MANY ? 8 : 11;
    const size_t bytes = 2 * n * sizeof *s.from + s.n_blocks * sizeof *s.starts;
    s.from = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(s.from, bytes);
    item *const memory = s.from;
    s.to = s.from + n;
    s.starts = (uint32_t(*)[MAX_VALUES])(s.to + n);
    s.mask = (1u << bits) - 1;
    koksma__phases sorting = {.share = 0}; /* what sorts takes longer after it, and reports its own progress */
    const koksma_run quiet = koksma__phase_run(&sorting, run, 0);
    koksma_status status = koksma__parallel(&quiet, s.n_blocks, load, &s);
    for (s.shift = 0; s.shift < 32 && !status; s.shift += bits) {
        status = pass(&s, &quiet);
    }
    status = status ? status : koksma__parallel(&quiet, s.n_blocks, store, &s);
    free(memory);
    return status;
}

/* SPDX-License-Identifier: Apache-2.0 */
/* The bits of doubles >= 0, read as whole numbers, are in the order of the doubles. */
#include "measures/parts/order.h"

#include <stdlib.h>
#include <string.h>

#include "core/status.h"

enum { DIGIT_BITS = 11, DIGITS = 6, VALUES = 1 << DIGIT_BITS };

typedef struct item {
    uint64_t key;
    uint32_t index;
} item;

static size_t digit_of(const item *x, int digit)
{
    return (x->key >> (digit * DIGIT_BITS)) & (VALUES - 1);
}

/* One stable pass over a digit; false if all have the same. */
static bool pass(size_t n, int digit, const item *from, item *to)
{
    size_t starts[VALUES] = {0}, total = 0;
    for (size_t i = 0; i < n; i++) {
        starts[digit_of(&from[i], digit)]++;
    }
    if (starts[digit_of(&from[0], digit)] == n) {
        return false;
    }
    for (size_t v = 0; v < VALUES; v++) {
        const size_t count = starts[v];
        starts[v] = total;
        total += count;
    }
    for (size_t i = 0; i < n; i++) {
        to[starts[digit_of(&from[i], digit)]++] = from[i];
    }
    return true;
}

static int compare(const void *a, const void *b)
{
    const item *x = a, *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key) : (x->index > y->index) - (x->index < y->index);
}

koksma_status koksma__order(size_t n, const double *xs, size_t stride, uint32_t *order)
{
    item *from = malloc(2 * n * sizeof *from);
    if (!from) {
        return koksma__fail_memory(2 * n * sizeof *from);
    }
    item *const memory = from, *to = from + n;
    for (size_t i = 0; i < n; i++) {
        const double x = xs[i * stride] + 0.0; /* makes -0 a 0 */
        memcpy(&from[i].key, &x, sizeof x);
        from[i].index = (uint32_t)i;
    }
    if (n < VALUES) {
        qsort(from, n, sizeof *from, compare);
    } else {
        for (int digit = 0; digit < DIGITS; digit++) {
            if (pass(n, digit, from, to)) {
                item *const other = from;
                from = to;
                to = other;
            }
        }
    }
    for (size_t i = 0; i < n; i++) {
        order[i] = from[i].index;
    }
    free(memory);
    return KOKSMA_OK;
}

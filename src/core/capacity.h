/* SPDX-License-Identifier: Apache-2.0 */
/* Arrays that grow an item at a time; and the end of several blocks of memory. */
#ifndef KOKSMA_CORE_CAPACITY_H
#define KOKSMA_CORE_CAPACITY_H

#include <stdlib.h>
#include <string.h>

#include "core/status.h"

/* The items with room for one more than n: for `first`, then for twice as many each time. NULL when memory runs out,
   which is the error's text then; the items are as they were. */
static inline void *koksma__room_for_one(void *items, size_t n, size_t *capacity, size_t first, size_t item_size)
{
    if (n < *capacity) {
        return items;
    }
    const size_t more = *capacity ? 2 * *capacity : first;
    void *grown = realloc(items, more * item_size);
    if (!grown) {
        koksma__fail_memory(more * item_size);
        return NULL;
    }
    *capacity = more;
    return grown;
}

/* A new item, all zero, at the end of the array that *array points to, which only this function has lengthened: its
   capacity is the power of two from *n on. NULL when memory runs out, which is the error's text then. */
static inline void *koksma__add_one(void *array, size_t *n, size_t item_size)
{
    char *items;
    memcpy(&items, array, sizeof items);
    if (!(*n & (*n - 1))) {
        const size_t bytes = (*n ? 2 * *n : 1) * item_size;
        items = realloc(items, bytes);
        if (!items) {
            koksma__fail_memory(bytes);
            return NULL;
        }
        memcpy(array, &items, sizeof items);
    }
    return memset(items + (*n)++ * item_size, 0, item_size);
}

/* KOKSMA__FREE(a, b, c) frees each; NULL is allowed. */
#define KOKSMA__FREE(...)                                                                                            \
    koksma__free_all((void *const[]){__VA_ARGS__}, sizeof((void *const[]){__VA_ARGS__}) / sizeof(void *))
static inline void koksma__free_all(void *const *blocks, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        free(blocks[i]);
    }
}

#endif

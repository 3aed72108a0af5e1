/* SPDX-License-Identifier: Apache-2.0 */
/* Arrays that grow by one item at a time, and a macro that frees several blocks of memory. */
#ifndef KOKSMA_CORE_CAPACITY_H
#define KOKSMA_CORE_CAPACITY_H

#include <stdlib.h>
#include <string.h>

#include "core/status.h"

/* Returns the array `items` of n items, moved if needed, with capacity for at least one more item. The first capacity
   is `first` items; later ones are twice the old capacity. When memory runs out it returns NULL and sets the error's
   text; the old array stays valid. */
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

/* Adds an item, all zero, at the end of the array that *array points to and returns the item. The array must have
   been lengthened only by this function, so that its capacity is the smallest power of two >= *n. When memory runs
   out it returns NULL and sets the error's text. */
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

/* KOKSMA__FREE(a, b, c) frees each pointer; NULL is allowed. */
#define KOKSMA__FREE(...)                                                                                            \
    koksma__free_all((void *const[]){__VA_ARGS__}, sizeof((void *const[]){__VA_ARGS__}) / sizeof(void *))
static inline void koksma__free_all(void *const *blocks, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        free(blocks[i]);
    }
}

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Memory: arrays that grow, a macro that frees several blocks, and large pages. */
#ifndef KOKSMA_CORE_CAPACITY_H
#define KOKSMA_CORE_CAPACITY_H

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

/* Gives the array that *array points to capacity for n items: where it has less, for half as many more, so that adding
   items one by one takes constant time each. When memory runs out the old array stays valid. Errors: MEMORY. */
static inline koksma_status koksma__reserve(void *array, size_t *capacity, size_t n, size_t item_size)
{
    if (n > *capacity) {
        char *items;
        memcpy(&items, array, sizeof items);
        const size_t more = n + n / 2 + 16;
        items = realloc(items, more * item_size);
        KOKSMA__REQUIRE_MEMORY(items, more * item_size);
        memcpy(array, &items, sizeof items);
        *capacity = more;
    }
    return KOKSMA_OK;
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

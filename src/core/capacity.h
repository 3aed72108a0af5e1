/* SPDX-License-Identifier: Apache-2.0 */
/* Arrays that grow an item at a time. */
#ifndef KOKSMA_CORE_CAPACITY_H
#define KOKSMA_CORE_CAPACITY_H

#include <stdlib.h>

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

#endif

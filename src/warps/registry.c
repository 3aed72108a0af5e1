/* SPDX-License-Identifier: Apache-2.0 */
#include <string.h>

#include "warps/warps.h"

static const koksma_warp *const warps[] = {
#define WARP(name) &koksma__warp_##name,
#include "warps/warps.def"
#undef WARP
};

const koksma_warp *koksma_warp_at(size_t i)
{
    return i < sizeof warps / sizeof *warps ? warps[i] : NULL;
}

const koksma_warp *koksma_warp_find(const char *name)
{
    for (size_t i = 0; koksma_warp_at(i); i++) {
        if (!strcmp(koksma_warp_at(i)->name, name)) {
            return koksma_warp_at(i);
        }
    }
    return NULL;
}

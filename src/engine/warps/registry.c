/* SPDX-License-Identifier: Apache-2.0 */
/* The table of warps (warps.def) and the public functions that look up a warp by its index or its name. */
#include "core/lookup.h"
#include "warps/warps.h"

static const koksma_warp *const warps[] = {
#define WARP(name) &koksma__warp_##name,
#include "warps/warps.def"
#undef WARP
};

KOKSMA__LOOKUP(koksma_warp, warps)

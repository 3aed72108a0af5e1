/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_WARPS_WARPS_H
#define KOKSMA_WARPS_WARPS_H

#include <koksma/warp.h>

#define WARP(name) extern const koksma_warp koksma__warp_##name;
#include "warps/warps.def"
#undef WARP

#endif

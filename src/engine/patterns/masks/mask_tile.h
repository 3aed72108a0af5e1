/* SPDX-License-Identifier: Apache-2.0 */
/* The points of all pixels of a tile, pixel after pixel: of mask-offset and mask-file. */
#ifndef KOKSMA_PATTERNS_MASKS_MASK_TILE_H
#define KOKSMA_PATTERNS_MASKS_MASK_TILE_H

#include <koksma/koksma.h>

#include <stddef.h>
#include <stdint.h>

enum { KOKSMA__TILE_MASKS = 3 };

/* Fails with N unless out->n is a multiple of the pixels; one: unless it is their number. */
koksma_status koksma__tile_check(const char *pattern, size_t pixels, bool one, const koksma_points *out);

/* Fills `out` with koksma_mask_2d of each pixel; ranks[k * pixels + p] is the rank of pixel p in mask k. Errors:
   INTERRUPTED. */
koksma_status koksma__tile_fill(uint64_t seed, const koksma_run *run, size_t pixels, const uint32_t *ranks,
                                koksma_points *out);

#endif

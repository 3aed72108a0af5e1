/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_MASKS_TILE_SIZE_H
#define KOKSMA_PATTERNS_MASKS_TILE_SIZE_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Sets size[0] x size[1] to the pixels of the tile whose points a pattern makes, pixel after pixel; 0 x 0 for a pattern
   that has no tile. Errors: those of reading the mask of mask-file. */
KOKSMA__LAB koksma_status koksma__tile_size(const koksma_spec *spec, size_t size[2]);

/* Gives a pattern that makes the points of all pixels of an image, by its parameter `width`, an image of `width` pixels a
   side; false: the pattern makes none. */
KOKSMA__LAB bool koksma__fit_image(koksma_spec *spec, int width);

#endif

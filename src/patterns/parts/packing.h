/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_PARTS_PACKING_H
#define KOKSMA_PATTERNS_PARTS_PACKING_H

#include <stdbool.h>
#include <stddef.h>

/* The largest distance that n points of [0,1]^dim can keep from each other, on the square or on the torus.
   Exact for the square up to 30 points; an upper bound elsewhere, within 10 % in 2D and looser above. */
double koksma__packing_distance(size_t n, int dim, bool torus);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_PACKING_H
#define KOKSMA_PATTERNS_SHARED_PACKING_H

#include <stdbool.h>
#include <stddef.h>

/* The largest distance that n points of [0,1]^dim can keep from each other, in the cube or on the torus. It is exact
   for up to 30 points in the square and an upper bound elsewhere: in 2D within 10 % for many points and 20 % too
   large for 3 points on the torus; in more dimensions it is further from the optimum. */
double koksma__packing_distance(size_t n, int dim, bool torus);

#endif

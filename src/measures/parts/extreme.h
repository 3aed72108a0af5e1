/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_PARTS_EXTREME_H
#define KOKSMA_MEASURES_PARTS_EXTREME_H

#include <koksma/koksma.h>

/* The largest |#/n - volume| over all boxes, exactly, with its witness. Errors: N, MEMORY, INTERRUPTED.
   small: 1 to 3 dimensions, O(n^(2d-1)). */
koksma_status koksma__extreme_small(const koksma_points *points, const koksma_run *run, koksma_value *out);

/* plane: 2D, O(n^3) at worst in lanes of 16, most of it skipped by bounds. With a time limit out may hold bounds. */
koksma_status koksma__extreme_plane(const koksma_points *points, const koksma_run *run, koksma_value *out);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_GRID_H
#define KOKSMA_MEASURES_SHARED_EXTREME_GRID_H

#include <koksma/koksma.h>

/* The largest |#/n - area| over half-open boxes with sides at multiples of 1/grid; 2D only. O(n + grid^3). Errors:
   DIM, MEMORY, INTERRUPTED. */
koksma_status koksma__extreme_grid(const koksma_points *points, int grid, const koksma_run *run, koksma_value *out);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_CLOSEST_PAIR_H
#define KOKSMA_CORE_CLOSEST_PAIR_H

#include <koksma/koksma.h>

/* Computes the smallest distance between two of n >= 2 points in the unit square or on the torus, in O(n log n) for
   any points. A distance below 1e-162 is returned as 0. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__closest_pair(const koksma_points *points, bool torus, const koksma_run *run, double *distance);

#endif

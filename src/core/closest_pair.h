/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_CLOSEST_PAIR_H
#define KOKSMA_CORE_CLOSEST_PAIR_H

#include <koksma/koksma.h>

/* The smallest distance of two of n >= 2 points of the plane, in the unit square or around its sides: n log n
   wherever they lie. Below 1e-162 it is 0. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__closest_pair(const koksma_points *points, bool torus, const koksma_run *run, double *distance);

#endif

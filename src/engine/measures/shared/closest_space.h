/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_CLOSEST_SPACE_H
#define KOKSMA_MEASURES_SHARED_CLOSEST_SPACE_H

#include <koksma/koksma.h>

enum { KOKSMA__CLOSEST_DIM = 16 };

/* Computes the smallest distance between two of n >= 2 points of up to KOKSMA__CLOSEST_DIM dimensions, in the unit
   cube or on the torus. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__closest_in_space(const koksma_points *points, bool torus, const koksma_run *run,
                                       double *distance);

#endif

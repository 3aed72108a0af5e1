/* SPDX-License-Identifier: Apache-2.0 */
/* The smallest distance between points. */
#ifndef KOKSMA_MEASURES_SHARED_NEIGHBOURS_H
#define KOKSMA_MEASURES_SHARED_NEIGHBOURS_H

#include <koksma/koksma.h>

/* Computes the smallest distance between two points in up to KOKSMA__CLOSEST_DIM dimensions. In the plane it takes
   O(n) for evenly spread points and O(n log n) for others; in more dimensions it uses a k-d tree. name: the name of
   the measure, for the error message for a single point. Errors: N, MEMORY, INTERRUPTED. */
koksma_status koksma__min_distance(const char *name, const koksma_points *points, bool torus, const koksma_run *run,
                                   double *distance);

#endif

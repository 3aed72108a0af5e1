/* SPDX-License-Identifier: Apache-2.0 */
/* The smallest distance of points. */
#ifndef KOKSMA_MEASURES_SHARED_NEIGHBOURS_H
#define KOKSMA_MEASURES_SHARED_NEIGHBOURS_H

#include <koksma/koksma.h>

/* The smallest distance between two points, up to KOKSMA__CLOSEST_DIM dimensions: in the plane in O(n)
   for evenly spread points, else in O(n log n); in more dimensions by a k-d tree. name: the name of
   the measure, for the error message for a single point. Errors: N, MEMORY, INTERRUPTED. */
koksma_status koksma__min_distance(const char *name, const koksma_points *points, bool torus, const koksma_run *run,
                                   double *distance);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Pairs of points of the plane that are near, by cell lists. */
#ifndef KOKSMA_MEASURES_PARTS_NEIGHBOURS_H
#define KOKSMA_MEASURES_PARTS_NEIGHBOURS_H

#include <koksma/koksma.h>

/* Calls f for every pair i < j at a distance below r <= 1/2, with the squared distance; on the unit torus or in the
   plane. Errors: MEMORY. */
koksma_status koksma__near_pairs(const koksma_points *points, double r, bool torus,
                                 void (*f)(void *context, double distance2), void *context);

/* The smallest distance between two points; infinite for one point. Errors: MEMORY. */
koksma_status koksma__min_distance(const koksma_points *points, bool torus, double *distance);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Pairs of points of the plane that are near, by cell lists. */
#ifndef KOKSMA_MEASURES_SHARED_NEIGHBOURS_H
#define KOKSMA_MEASURES_SHARED_NEIGHBOURS_H

#include <koksma/koksma.h>

/* Of a pair at this squared distance; false: no more pairs are wanted. */
typedef bool (*koksma__near_pair_function)(void *context, double distance2);

/* Calls f for every pair i < j at a distance below r <= 1/2, on the unit torus or in the plane, as long as it wants
   more. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__near_pairs(const koksma_points *points, double r, bool torus, const koksma_run *run,
                                 koksma__near_pair_function f, void *context);

/* The smallest distance between two points: n for spread points, else n log n. name: the measure's, for the error of
   one point. Errors: N, MEMORY, INTERRUPTED. */
koksma_status koksma__min_distance(const char *name, const koksma_points *points, bool torus, const koksma_run *run,
                                   double *distance);

#endif

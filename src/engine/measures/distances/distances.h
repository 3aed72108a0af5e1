/* SPDX-License-Identifier: Apache-2.0 */
/* Nearest neighbours, for measures of distances. Each section is the interface of the file of its name. */
#ifndef KOKSMA_MEASURES_DISTANCES_DISTANCES_H
#define KOKSMA_MEASURES_DISTANCES_DISTANCES_H

#include <koksma/koksma.h>

/* ---- Closest pair ---------------------------------------------------------------------------------------- */

/* Computes the smallest distance between two of n >= 2 points, in the unit cube or on the torus. A distance below 1e-162
   is returned as 0. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__closest_pair(const koksma_points *points, bool torus, const koksma_run *run, double *distance);

/* ---- Neighbours ------------------------------------------------------------------------------------------ */

/* The smallest distance between points. */

/* Computes the smallest distance between two points. In the plane it takes O(n) for evenly spread points; otherwise it is
   koksma__closest_pair. name: the name of
   the measure, for the error message for a single point. Errors: N, MEMORY, INTERRUPTED. */
koksma_status koksma__min_distance(const char *name, const koksma_points *points, bool torus, const koksma_run *run,
                                   double *distance);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* The extreme discrepancy in 2 dimensions. */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_PLANE_H
#define KOKSMA_MEASURES_SHARED_EXTREME_PLANE_H

#include <koksma/koksma.h>

/* Writes the largest |#/n - volume| over all boxes to out, with its witness, in O(n^2 log^2 n) at worst, by branch
   and bound and by a sweep. If a time limit ends the search, out has a lower and an upper bound. Errors: N, MEMORY,
   INTERRUPTED. */
koksma_status koksma__extreme_plane(const koksma_points *points, const koksma_run *run, koksma_value *out);

/* The methods to search the plane, which tests compare: BOUND is branch and bound over strips, SWEEP a sweep from
   each left side; EITHER begins each block with BOUND and changes to SWEEP if BOUND takes too long. */
typedef enum koksma__extreme_method {
    KOKSMA__EXTREME_EITHER,
    KOKSMA__EXTREME_BOUND,
    KOKSMA__EXTREME_SWEEP
} koksma__extreme_method;

/* Does the same as koksma__extreme_plane by the given method. */
koksma_status koksma__extreme_plane_by(koksma__extreme_method method, const koksma_points *points,
                                       const koksma_run *run, koksma_value *out);

#endif

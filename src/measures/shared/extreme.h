/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_H
#define KOKSMA_MEASURES_SHARED_EXTREME_H

#include <koksma/koksma.h>

/* Computes the largest |count/n - volume| over all boxes, exactly, with its witness, in d = 1 to 3 dimensions in
   O(n^(2d-1)). If a time limit ends the search, out has a lower and an upper bound. Errors: N, MEMORY, INTERRUPTED. */
koksma_status koksma__extreme_small(const koksma_points *points, const koksma_run *run, koksma_value *out);

/* Computes the same value in 2 dimensions in O(n^2 log^2 n) at worst, by branch and bound and by a sweep. If a time
   limit ends the search, out has a lower and an upper bound. */
koksma_status koksma__extreme_plane(const koksma_points *points, const koksma_run *run, koksma_value *out);

/* The methods to search the plane, which tests compare: BOUND is branch and bound over strips, SWEEP a sweep from
   each left side; EITHER begins each block with BOUND and changes to SWEEP if BOUND takes too long. */
typedef enum koksma__extreme_method {
    KOKSMA__EXTREME_EITHER,
    KOKSMA__EXTREME_BOUND,
    KOKSMA__EXTREME_SWEEP
} koksma__extreme_method;

koksma_status koksma__extreme_plane_by(koksma__extreme_method method, const koksma_points *points,
                                       const koksma_run *run, koksma_value *out);

/* Finds the best box between x = left and x = right and writes it to out; the points x[i], y[i] are in order of y. */
void koksma__extreme_of_strip(size_t n, const double *x, const double *y, double left, double right, bool closed,
                              koksma_value *out);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_H
#define KOKSMA_MEASURES_SHARED_EXTREME_H

#include <koksma/koksma.h>

/* The largest |#/n - volume| over all boxes, exactly, with its witness. Errors: N, MEMORY, INTERRUPTED.
   small: 1 to 3 dimensions, O(n^(2d-1)). With a time limit out may hold bounds. */
koksma_status koksma__extreme_small(const koksma_points *points, const koksma_run *run, koksma_value *out);

/* plane: 2D, by bounds, O(n^2 log^2 n) at worst. With a time limit out may hold bounds. */
koksma_status koksma__extreme_plane(const koksma_points *points, const koksma_run *run, koksma_value *out);

/* The ways to search the plane, which tests compare: branch and bound over strips, a sweep from each left side, or
   the first where it is quick and the second for the rest. */
typedef enum koksma__extreme_method {
    KOKSMA__EXTREME_EITHER,
    KOKSMA__EXTREME_BOUND,
    KOKSMA__EXTREME_SWEEP
} koksma__extreme_method;

koksma_status koksma__extreme_plane_by(koksma__extreme_method method, const koksma_points *points,
                                       const koksma_run *run, koksma_value *out);

/* Points in order of y; the best box between x = left and right. */
void koksma__extreme_of_strip(size_t n, const double *x, const double *y, double left, double right, bool closed,
                              koksma_value *out);

#endif

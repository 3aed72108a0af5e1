/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_SWEEP_H
#define KOKSMA_MEASURES_SHARED_EXTREME_SWEEP_H

#include <koksma/koksma.h>

/* Points in order of y, and the levels of x: 0, 1 and those of points, without repeats. */
typedef struct koksma__sweep_plane {
    size_t n, n_levels;
    const double *y, *levels;
    const uint32_t *by_x;  /* places in order of y, in order of x */
    const uint32_t *first; /* points of level l: by_x[first[l]] .. by_x[first[l + 1] - 1] */
} koksma__sweep_plane;

/* A strip between two levels, and n times the value of its best box. */
typedef struct koksma__sweep_best {
    double value;
    size_t left, right;
    bool closed;
} koksma__sweep_best;

/* Looks for boxes better than *best whose left sides are levels from .. end - 1; O((end - from) n log^2 n). Sets
   late, and ends, when it is later than deadline_s. Errors: MEMORY. */
koksma_status koksma__extreme_sweep(const koksma__sweep_plane *plane, size_t from, size_t end, double deadline_s,
                                    koksma__sweep_best *best, bool *late);

#endif

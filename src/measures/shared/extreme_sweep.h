/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_SWEEP_H
#define KOKSMA_MEASURES_SHARED_EXTREME_SWEEP_H

#include <koksma/koksma.h>

/* The points in order of y, and the levels: the distinct x coordinates of the points, with 0 and 1. */
typedef struct koksma__sweep_plane {
    size_t n, n_levels;
    const double *y, *levels;
    const uint32_t *by_x;  /* indices of the points in order of x */
    const uint32_t *first; /* the points of level l are by_x[first[l]] .. by_x[first[l + 1] - 1] */
} koksma__sweep_plane;

/* A strip between two levels, and n times the value of its best box. */
typedef struct koksma__sweep_best {
    double value;
    size_t left, right;
    bool closed;
} koksma__sweep_best;

/* Searches for boxes better than *best whose left side is at one of the levels from .. end - 1, in O((end - from) n
   log^2 n). Stops and sets *late when the time deadline_s has passed. Errors: MEMORY. */
koksma_status koksma__extreme_sweep(const koksma__sweep_plane *plane, size_t from, size_t end, double deadline_s,
                                    koksma__sweep_best *best, bool *late);

#endif

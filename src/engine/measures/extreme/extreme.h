/* SPDX-License-Identifier: Apache-2.0 */
/* Algorithms for the extreme discrepancy: few points, the plane by strips and runs, the sweep. */
#ifndef KOKSMA_MEASURES_EXTREME_EXTREME_H
#define KOKSMA_MEASURES_EXTREME_EXTREME_H

#include <stdbool.h>
#include <stddef.h>

#include <koksma/koksma.h>

/* ---- extreme_small.c --------------------------------------------------------------------------------------- */

/* Computes the largest |count/n - volume| over all boxes, exactly, with its witness, in d = 1 to 3 dimensions in
   O(n^(2d-1)). If a time limit ends the search, out has a lower and an upper bound. Errors: N, MEMORY, INTERRUPTED. */
koksma_status koksma__extreme_small(const koksma_points *points, const koksma_run *run, koksma_value *out);

/* ---- extreme_plane.c --------------------------------------------------------------------------------------- */

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

/* ---- extreme_sweep.c --------------------------------------------------------------------------------------- */

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

/* ---- extreme_runs.c ---------------------------------------------------------------------------------------- */

enum { KOKSMA__RUN_CAPACITY = 1024, KOKSMA__RUN_NUMBERS = 9 };

/* A list of points in order of y, as the kernel extreme_runs takes it. The last entry is the upper side of the square
   (x infinite, y = 1). runs[i] summarises the points between entries i - 1 and i, which are in all strips of a set;
   runs is NULL if the list has no runs. */
typedef struct koksma__run_list {
    size_t count;
    double *x, *y, (*runs)[KOKSMA__RUN_NUMBERS];
} koksma__run_list;

/* One entry of a list; the memory of a list is an array of KOKSMA__RUN_CAPACITY of these. */
typedef struct koksma__run_place {
    double x, y, run[KOKSMA__RUN_NUMBERS];
} koksma__run_place;

/* A set of strips: left sides are in [a1, a2], right sides in [b1, b2], and n times the width in [narrow, wide]. */
typedef struct koksma__strip_set {
    double a1, a2, b1, b2, narrow, wide;
} koksma__strip_set;

/* Makes a list in an array of KOKSMA__RUN_CAPACITY entries that the caller owns. */
void koksma__run_list_init(koksma__run_list *list, koksma__run_place *places);

/* Makes the list of a subset of the strips of `from`, in O(count), and writes it to `to`, which koksma__run_list_init
   has made. Returns false if it needs more than KOKSMA__RUN_CAPACITY entries. */
bool koksma__run_list_narrow(const koksma__run_list *from, const koksma__strip_set *set, koksma__run_list *to);

#endif

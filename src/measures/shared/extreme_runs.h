/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_RUNS_H
#define KOKSMA_MEASURES_SHARED_EXTREME_RUNS_H

#include <stddef.h>

enum { KOKSMA__RUN_KNOTS = 4, KOKSMA__RUN_CAPACITY = 1024, KOKSMA__RUN_NUMBERS = 9 };

/* A run is the points between two others in order of y that are in all strips of a set, with its values at each knot;
   every value is a maximum of lines in the width, so a chord between knots is an upper bound. */
typedef struct koksma__run {
    double count;
    double top[KOKSMA__RUN_KNOTS];     /* largest #points up to j - width y_j */
    double bottom[KOKSMA__RUN_KNOTS];  /* largest width y_i - #points before i */
    double excess[KOKSMA__RUN_KNOTS];  /* largest of a closed box within the run */
    double deficit[KOKSMA__RUN_KNOTS]; /* largest of an open box within the run */
} koksma__run;

/* Points in order of y, the last of which is the upper side of the square (x infinite, y = 1); below each the run of
   those that are in all strips. A list without runs has NULL there. Widths are times n. */
typedef struct koksma__run_list {
    size_t count;
    double *x, *y;
    koksma__run *runs;
    double (*lines)[KOKSMA__RUN_NUMBERS]; /* the runs as the kernel extreme_runs takes them */
    double knots[KOKSMA__RUN_KNOTS];
} koksma__run_list;

/* What a list needs for each of its KOKSMA__RUN_CAPACITY points. */
typedef struct koksma__run_place {
    koksma__run run;
    double x, y, lines[KOKSMA__RUN_NUMBERS];
} koksma__run_place;

/* Makes a list in KOKSMA__RUN_CAPACITY places that the caller owns. */
void koksma__run_list_init(koksma__run_list *list, koksma__run_place *places);

/* Strips whose left sides are in [a1, a2] and whose right sides are in [b1, b2], with widths times n in [narrow, wide]. */
typedef struct koksma__strip_set {
    double a1, a2, b1, b2, narrow, wide;
} koksma__strip_set;

/* Writes to `to`, which has KOKSMA__RUN_CAPACITY places, the list of a subset of the strips of `from`, in O(count).
   Returns false if the places are too few. */
_Bool koksma__run_list_narrow(const koksma__run_list *from, const koksma__strip_set *set, koksma__run_list *to);

#endif

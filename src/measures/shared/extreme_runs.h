/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_RUNS_H
#define KOKSMA_MEASURES_SHARED_EXTREME_RUNS_H

#include <stdbool.h>
#include <stddef.h>

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

/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_EXTREME_RUNS_H
#define KOKSMA_MEASURES_SHARED_EXTREME_RUNS_H

#include <stdbool.h>
#include <stddef.h>

enum { KOKSMA__RUN_CAPACITY = 1024, KOKSMA__RUN_NUMBERS = 9 };

/* Points in order of y, the last of which is the upper side of the square (x infinite, y = 1), and below each the run of
   those that are in all strips of a set, as the kernel extreme_runs takes it. A list without runs has NULL there. */
typedef struct koksma__run_list {
    size_t count;
    double *x, *y, (*runs)[KOKSMA__RUN_NUMBERS];
} koksma__run_list;

/* What a list needs for each of its KOKSMA__RUN_CAPACITY points. */
typedef struct koksma__run_place {
    double x, y, run[KOKSMA__RUN_NUMBERS];
} koksma__run_place;

/* Strips whose left sides are in [a1, a2] and whose right sides are in [b1, b2], with n times widths in [narrow, wide]. */
typedef struct koksma__strip_set {
    double a1, a2, b1, b2, narrow, wide;
} koksma__strip_set;

/* Makes a list in KOKSMA__RUN_CAPACITY places that the caller owns. */
void koksma__run_list_init(koksma__run_list *list, koksma__run_place *places);

/* Writes to `to`, a list that was made with koksma__run_list_init, the list of a subset of the strips of `from`, in
   O(count). Returns false if its places are too few. */
bool koksma__run_list_narrow(const koksma__run_list *from, const koksma__strip_set *set, koksma__run_list *to);

#endif

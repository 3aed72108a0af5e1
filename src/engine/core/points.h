/* SPDX-License-Identifier: Apache-2.0 */
/* What several patterns, measures and properties ask of a set of points. */
#ifndef KOKSMA_CORE_POINTS_H
#define KOKSMA_CORE_POINTS_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Fails unless dim is a valid number of dimensions and n points of that dimension fit into one set. Errors: ARGUMENT,
   DIM. */
KOKSMA__LAB koksma_status koksma__points_fit(size_t n, int dim);

/* Allocates points as koksma_points_init does, with coordinates that the caller sets: whoever reads a large file need not
   clear them. */
koksma_status koksma__points_room(koksma_points *points, size_t n, int dim);

/* Fails unless the set has points, its size is within the limits, and each coordinate is in [0,1] (NaN is not). Every
   public function that takes points, unless it documents another rule, makes this check first. Errors: ARGUMENT, DIM. */
KOKSMA__LAB koksma_status koksma__points_check(const koksma_points *points);

/* ---- Strata of the unit interval, and the quality parameter t of points as a net ---- */

/* Returns the index of the stratum of x among m equal strata, whose bounds are the doubles nearest to j/m. x = 1 is
   in the last stratum. */
size_t koksma__stratum(double x, size_t m);

/* The digits of points in a base, the input of koksma__net_quality. */
typedef struct koksma__net {
    size_t base, n, row; /* row: number of coordinates of a point */
    int digits;          /* the largest exponent with base^digits <= n */
    uint32_t powers[33]; /* base^k */
    /* strata: index of each coordinate's stratum among base^digits, point by point; counts: capacity n */
    uint32_t *strata, *counts;
} koksma__net;

/* Prepares a net for base >= 2 and points that koksma__points_check accepts; koksma__net_fini frees it. Errors:
   MEMORY. */
koksma_status koksma__net_init(const koksma_points *points, size_t base, koksma__net *net);
void koksma__net_fini(koksma__net *net);

/* Returns the least t for which the first base^m points, m <= digits, form a (t,m,dim)-net in the coordinates
   use[0..dim).
   Errors: INTERRUPTED. */
koksma_status koksma__net_quality(const koksma__net *net, int m, const int *use, int dim, const koksma_run *run,
                                  int *t);

#endif

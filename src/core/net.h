/* SPDX-License-Identifier: Apache-2.0 */
/* Strata of the unit interval, and the quality of points as nets: for koksma_verify and the measure t-value. */
#ifndef KOKSMA_CORE_NET_H
#define KOKSMA_CORE_NET_H

#include <koksma/koksma.h>

/* The stratum of x among m, bounded by the doubles nearest to j/m. x = 1 is in the last. */
size_t koksma__stratum(double x, size_t m);

/* Points by their digits in a base: what koksma__net_quality searches. */
typedef struct koksma__net {
    size_t base, n, row;       /* row: coordinates of a point */
    int digits;                /* the most with base^digits <= n */
    uint32_t powers[33];       /* base^k */
    uint32_t *strata, *counts; /* strata among base^digits, point by point; room for n counts */
} koksma__net;

/* base >= 2; points that koksma__points_check accepts. koksma__net_fini frees. Errors: MEMORY. */
koksma_status koksma__net_init(const koksma_points *points, size_t base, koksma__net *net);
void koksma__net_fini(koksma__net *net);

/* The least t with which the first base^m points, m <= digits, are a (t,m,dim)-net in coordinates use[0..dim).
   Errors: INTERRUPTED. */
koksma_status koksma__net_quality(const koksma__net *net, int m, const int *use, int dim, const koksma_run *run,
                                  int *t);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Swaps of one coordinate of two points, and the change of an L2 discrepancy of boxes by one, from stored kernels. */
#ifndef KOKSMA_OPTIMISE_SWAPS_H
#define KOKSMA_OPTIMISE_SWAPS_H

#include "measures/l2_boxes.h"
#include "optimise/methods.h"

typedef struct koksma__swaps {
    const koksma__l2_row *row;
    size_t n, dim, stride;
    double *kernels;        /* K_k(i, j) at (k n + i) stride + j; the columns from n on are 0 */
    double *linear;         /* a_k of point i at k n + i */
    double *products;       /* two rows: R_p and R_q */
    double *before;         /* capacity for a set that the caller wants to restore */
    uint32_t *order, *rank; /* for each axis: the points in order, and the rank of each point */
    koksma__stream random;
    void *memory;
} koksma__swaps;

/* The largest n^2 dim whose kernels are stored. */
enum { KOKSMA__MOST_KERNELS = 1 << 21 };

/* Allocates for sets of the size of `points`; free(s->memory) releases. Errors: MEMORY. */
koksma_status koksma__swaps_init(koksma__swaps *s, const koksma__l2_row *row, const koksma_points *points,
                                 uint64_t seed);

/* Computes orders, kernels and integrals of the points. Errors: MEMORY. */
koksma_status koksma__swaps_prepare(koksma__swaps *s, const double *xs);

/* Returns the change of n^2 times the squared discrepancy when points p and q swap coordinate k. */
double koksma__swaps_change(const koksma__swaps *s, size_t k, size_t p, size_t q);

/* Swaps coordinate k of points p and q, and updates orders, kernels and integrals. */
void koksma__swaps_swap(koksma__swaps *s, double *xs, size_t k, size_t p, size_t q);

#endif

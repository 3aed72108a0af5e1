/* SPDX-License-Identifier: Apache-2.0 */
/* Points of the 2D torus sorted into cells, for sums over neighbours: the points near a position are a few contiguous
   runs in memory. */
#ifndef KOKSMA_PATTERNS_SHARED_TORUS_ROWS_H
#define KOKSMA_PATTERNS_SHARED_TORUS_ROWS_H

#include <koksma/koksma.h>

typedef struct koksma__torus_rows {
    uint32_t cells;  /* number of cells on a side; a cell has about one point */
    uint32_t *start; /* index of each cell's first sorted point, row by row; cells^2 + 1 numbers */
    uint32_t *order; /* the original number of each sorted point */
    double *xs, *ys; /* the sorted points, followed by eight elements that kernels may read */
} koksma__torus_rows;

/* A run of sorted points, numbers first .. end - 1. */
typedef struct koksma__run_of_points {
    uint32_t first, end;
} koksma__run_of_points;

koksma_status koksma__torus_rows_init(koksma__torus_rows *rows, size_t n);
void koksma__torus_rows_fini(koksma__torus_rows *rows);

/* Sorts n points, each a pair of coordinates in [0, 1). */
void koksma__torus_rows_sort(koksma__torus_rows *rows, size_t n, const double *points);

/* Returns the largest number of runs that koksma__torus_rows_near can return for a radius of at most 1/2. */
size_t koksma__torus_rows_most(const koksma__torus_rows *rows, double radius);

/* Finds runs that contain all points within the radius of (x, y), and some points further away; no point is in two
   runs. Returns the number of runs. */
size_t koksma__torus_rows_near(const koksma__torus_rows *rows, double x, double y, double radius,
                               koksma__run_of_points *runs);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Points of the 2D torus sorted into cells, for sums over neighbours: what is near a place is a few runs in memory.
 */
#ifndef KOKSMA_PATTERNS_SHARED_TORUS_ROWS_H
#define KOKSMA_PATTERNS_SHARED_TORUS_ROWS_H

#include <koksma/koksma.h>

typedef struct koksma__torus_rows {
    uint32_t cells;  /* a side, about one point in each */
    uint32_t *start; /* of each cell, row by row, in the sorted points; cells^2 + 1 */
    uint32_t *order; /* of each sorted point: its number before */
    double *xs, *ys; /* sorted; past the last there are eight that may be read */
} koksma__torus_rows;

/* Points number first .. end - 1. */
typedef struct koksma__run_of_points {
    uint32_t first, end;
} koksma__run_of_points;

koksma_status koksma__torus_rows_init(koksma__torus_rows *rows, size_t n);
void koksma__torus_rows_fini(koksma__torus_rows *rows);

/* Sorts n points, pairs in [0, 1). */
void koksma__torus_rows_sort(koksma__torus_rows *rows, size_t n, const double *points);

/* The most runs there are for a radius of at most 1/2. */
size_t koksma__torus_rows_most(const koksma__torus_rows *rows, double radius);

/* Runs that hold all points within the radius of (x, y), and others near, each once. Returns their number. */
size_t koksma__torus_rows_near(const koksma__torus_rows *rows, double x, double y, double radius,
                               koksma__run_of_points *runs);

#endif

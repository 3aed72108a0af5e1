/* SPDX-License-Identifier: Apache-2.0 */
/* Points of the plane sorted into square cells, row by row: the points near a position are a few contiguous runs in
   memory. */
#ifndef KOKSMA_CORE_TORUS_ROWS_H
#define KOKSMA_CORE_TORUS_ROWS_H

#include <koksma/koksma.h>

typedef struct koksma__torus_rows {
    uint32_t cells;  /* number of cells on a side */
    uint32_t *start; /* index of each cell's first sorted point, row by row; cells^2 + 1 numbers */
    uint32_t *order; /* the original number of each sorted point */
    double *xs, *ys; /* the sorted points, followed by eight elements that kernels may read */
} koksma__torus_rows;

/* A run of sorted points, numbers first .. end - 1. */
typedef struct koksma__run_of_points {
    uint32_t first, end;
} koksma__run_of_points;

/* Makes room for n points in cells x cells cells, cells >= 1. Errors: MEMORY. */
koksma_status koksma__torus_rows_init(koksma__torus_rows *rows, size_t n, size_t cells);
void koksma__torus_rows_fini(koksma__torus_rows *rows);

/* Sorts n points, each a pair of coordinates in [0, 1]; in a cell they keep their order. wrap: the coordinate 1 becomes
   0, as on the torus; otherwise it is in the last cell. */
void koksma__torus_rows_sort(koksma__torus_rows *rows, size_t n, const double *points, bool wrap);

/* Returns the largest number of runs that koksma__torus_rows_near can return for a radius of at most 1/2. */
size_t koksma__torus_rows_most(const koksma__torus_rows *rows, double radius);

/* Finds runs that contain all points within the radius of (x, y), and some points further away; no point is in two
   runs. Returns the number of runs. */
size_t koksma__torus_rows_near(const koksma__torus_rows *rows, double x, double y, double radius,
                               koksma__run_of_points *runs);

#endif

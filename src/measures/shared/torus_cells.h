/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_TORUS_CELLS_H
#define KOKSMA_MEASURES_SHARED_TORUS_CELLS_H

#include <koksma/koksma.h>

/* The points by coordinate, in cells: the points of cell c are start[c] .. start[c+1]-1, cells row by row. */
typedef struct koksma__torus_cells {
    size_t n, columns; /* columns x columns cells */
    double *xs, *ys;   /* in the order of the cells; within a cell in the order of the points */
    size_t *start;
} koksma__torus_cells;

/* Whole columns, at least 1; wrap: the coordinate 1 becomes 0, as it is on the torus. Errors: MEMORY. */
koksma_status koksma__torus_cells_init(koksma__torus_cells *cells, const koksma_points *points, double columns,
                                       bool wrap);
void koksma__torus_cells_fini(koksma__torus_cells *cells);

#endif

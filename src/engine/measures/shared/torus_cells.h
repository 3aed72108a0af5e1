/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_TORUS_CELLS_H
#define KOKSMA_MEASURES_SHARED_TORUS_CELLS_H

#include <koksma/koksma.h>

/* Points sorted into cells, which are numbered row by row. The points of cell c are start[c] .. start[c+1]-1. */
typedef struct koksma__torus_cells {
    size_t n, columns; /* columns x columns cells */
    double *xs, *ys;   /* coordinates in order of the cells; within a cell in the original order */
    size_t *start;
} koksma__torus_cells;

/* Sorts points into columns x columns cells; columns is a whole number and at least 1. wrap: the coordinate 1 becomes
   0, as on the torus. Errors: MEMORY. */
koksma_status koksma__torus_cells_init(koksma__torus_cells *cells, const koksma_points *points, double columns,
                                       bool wrap);
void koksma__torus_cells_fini(koksma__torus_cells *cells);

#endif

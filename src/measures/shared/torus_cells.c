/* SPDX-License-Identifier: Apache-2.0 */
/* Points of the plane sorted into square cells by counting sort, O(n + cells): the points of a cell, and those of a
   row of cells, are neighbours in memory. Patterns that put points in one by one use patterns/shared/torus_grid.c,
   whose cells are lists; those that sort again and again patterns/shared/torus_rows.c, which keeps its memory and
   which point is where. */
#include "measures/shared/torus_cells.h"

#include <stdlib.h>

#include "core/status.h"

static size_t cell_of(const koksma__torus_cells *cells, double x, double y)
{
    const double columns = (double)cells->columns;
    const size_t last = cells->columns - 1, column = (size_t)(x * columns), row = (size_t)(y * columns);
    return (row < last ? row : last) * cells->columns + (column < last ? column : last);
}

koksma_status koksma__torus_cells_init(koksma__torus_cells *cells, const koksma_points *points, double columns,
                                       bool wrap)
{
    const size_t n = points->n;
    const double outside = wrap ? 1 : 2; /* from here on a coordinate is 0 on the torus */
    *cells = (koksma__torus_cells){.n = n, .columns = columns > 1 ? (size_t)columns : 1};
    const size_t n_cells = cells->columns * cells->columns;
    cells->xs = malloc(2 * n * sizeof(double));
    cells->start = calloc(n_cells + 2, sizeof(size_t));
    if (!cells->xs || !cells->start) {
        koksma__torus_cells_fini(cells);
        return koksma__fail_memory(2 * n * sizeof(double) + (n_cells + 2) * sizeof(size_t));
    }
    cells->ys = cells->xs + n;
    size_t *fill = cells->start + 1; /* start of the next cell while counting, of this one after filling */
    for (size_t i = 0; i < n; i++) {
        const double *x = points->xs + 2 * i;
        fill[cell_of(cells, x[0] < outside ? x[0] : 0, x[1] < outside ? x[1] : 0) + 1]++;
    }
    for (size_t c = 0; c < n_cells; c++) {
        fill[c + 1] += fill[c];
    }
    for (size_t i = 0; i < n; i++) {
        const double x = points->xs[2 * i] < outside ? points->xs[2 * i] : 0;
        const double y = points->xs[2 * i + 1] < outside ? points->xs[2 * i + 1] : 0;
        const size_t at = fill[cell_of(cells, x, y)]++;
        cells->xs[at] = x;
        cells->ys[at] = y;
    }
    return KOKSMA_OK;
}

void koksma__torus_cells_fini(koksma__torus_cells *cells)
{
    free(cells->xs);
    free(cells->start);
    *cells = (koksma__torus_cells){0};
}

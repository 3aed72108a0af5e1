/* SPDX-License-Identifier: Apache-2.0 */
/* Sorts points of the plane into square cells by a counting sort, O(n + cells): the points of a cell, and those of a
   row of cells, are contiguous in memory. Patterns that insert points one by one use patterns/spacing/torus_grid.c,
   whose cells are lists. Patterns that sort repeatedly use patterns/spacing/torus_rows.c, which reuses its memory and
   stores the index of each point. */
#include "measures/distances/distances.h"

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
    const double outside = wrap ? 1 : 2; /* coordinates of at least this value become 0 */
    *cells = (koksma__torus_cells){.n = n, .columns = columns > 1 ? (size_t)columns : 1};
    const size_t n_cells = cells->columns * cells->columns;
    cells->xs = malloc(2 * n * sizeof(double));
    cells->start = calloc(n_cells + 2, sizeof(size_t));
    if (!cells->xs || !cells->start) {
        koksma__torus_cells_fini(cells);
        return koksma__fail_memory(2 * n * sizeof(double) + (n_cells + 2) * sizeof(size_t));
    }
    cells->ys = cells->xs + n;
    size_t *fill = cells->start + 1; /* fill[c]: the end of cell c once it is filled */
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

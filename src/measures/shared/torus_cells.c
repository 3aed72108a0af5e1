/* SPDX-License-Identifier: Apache-2.0 */
#include "measures/shared/torus_cells.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"

static double on_torus(double x)
{
    return x < 1 ? x : 0;
}

static size_t cell_of(const koksma__torus_cells *cells, const double *point)
{
    const double columns = (double)cells->columns;
    const size_t last = cells->columns - 1;
    size_t column = (size_t)(on_torus(point[0]) * columns), row = (size_t)(on_torus(point[1]) * columns);
    column = column < last ? column : last;
    row = row < last ? row : last;
    return row * cells->columns + column;
}

koksma_status koksma__torus_cells_init(koksma__torus_cells *cells, const koksma_points *points, double side)
{
    const size_t n = points->n;
    const double most = fmin(floor(1 / side), floor(sqrt((double)n)));
    *cells = (koksma__torus_cells){.n = n, .columns = most > 1 ? (size_t)most : 1};
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
        fill[cell_of(cells, points->xs + 2 * i) + 1]++;
    }
    for (size_t c = 0; c < n_cells; c++) {
        fill[c + 1] += fill[c];
    }
    for (size_t i = 0; i < n; i++) {
        const double *point = points->xs + 2 * i;
        const size_t place = fill[cell_of(cells, point)]++;
        cells->xs[place] = on_torus(point[0]);
        cells->ys[place] = on_torus(point[1]);
    }
    return KOKSMA_OK;
}

void koksma__torus_cells_fini(koksma__torus_cells *cells)
{
    free(cells->xs);
    free(cells->start);
    *cells = (koksma__torus_cells){0};
}

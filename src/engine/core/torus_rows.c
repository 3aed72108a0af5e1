/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sorts points of the torus into square cells, row by row, by counting sort, in O(n); repeated sorts use the same
 * memory. In each row of cells the points near a position are one run of consecutive points, or two runs if the row
 * wraps around the torus. Kernels sum over these runs and need not know the cells.
 */
#include "core/torus_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "core/vector.h"

enum { SPARE = 8 };

/* Copies a point and returns the index of its cell. */
static size_t place_of(const koksma__torus_rows *r, const double *point, bool wrap, double at[2])
{
    for (int k = 0; k < 2; k++) {
        at[k] = wrap && !(point[k] < 1) ? 0 : point[k];
    }
    return (size_t)koksma__cell_along(at[1], r->cells) * r->cells + koksma__cell_along(at[0], r->cells);
}

koksma_status koksma__torus_rows_init(koksma__torus_rows *r, size_t n, size_t cells)
{
    *r = (koksma__torus_rows){.cells = (uint32_t)cells};
    const size_t starts = cells * cells + 1;
    const size_t bytes = (starts + n) * sizeof *r->start + 2 * (n + SPARE) * sizeof *r->xs;
    r->xs = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(r->xs, bytes);
    r->ys = r->xs + n + SPARE;
    r->start = (uint32_t *)(r->ys + n + SPARE);
    r->order = r->start + starts;
    for (size_t i = 0; i < SPARE; i++) {
        r->xs[n + i] = r->ys[n + i] = 0;
    }
    return KOKSMA_OK;
}

void koksma__torus_rows_fini(koksma__torus_rows *r)
{
    free(r->xs);
    r->xs = NULL;
}

/* Counting sort: first counts the points of each cell, then stores them; within a cell they keep their order. */
void koksma__torus_rows_sort(koksma__torus_rows *r, size_t n, const double *points, bool wrap)
{
    double point[2];
    const size_t cells = (size_t)r->cells * r->cells;
    memset(r->start, 0, (cells + 1) * sizeof *r->start);
    for (size_t i = 0; i < n; i++) {
        r->start[place_of(r, points + 2 * i, wrap, point) + 1]++;
    }
    for (size_t c = 0; c < cells; c++) {
        r->start[c + 1] += r->start[c];
    }
    for (size_t i = n; i-- > 0;) {
        const uint32_t at = --r->start[place_of(r, points + 2 * i, wrap, point) + 1];
        r->order[at] = (uint32_t)i;
        r->xs[at] = point[0];
        r->ys[at] = point[1];
    }
    memmove(r->start, r->start + 1, cells * sizeof *r->start);
    r->start[cells] = (uint32_t)n;
}

/* Returns how many rows above and below the row of a point can contain its neighbours within the radius. */
static long reach_of(const koksma__torus_rows *r, double radius)
{
    return (long)ceil(radius * r->cells);
}

size_t koksma__torus_rows_most(const koksma__torus_rows *r, double radius)
{
    const size_t count = 2 * (size_t)reach_of(r, radius) + 1;
    return 2 * (count < r->cells ? count : r->cells);
}

/* Adds the runs of cells `first` to `last` of a row; column indices may be outside the grid by up to one period. No
   cell is added twice. Returns the number of runs. */
static size_t add_row(const koksma__torus_rows *r, long row, long first, long last, koksma__run_of_points *runs)
{
    const long cells = (long)r->cells;
    const uint32_t *start = r->start + row * cells;
    if (last - first + 1 >= cells) {
        runs[0] = (koksma__run_of_points){start[0], start[cells]};
        return 1;
    }
    first = (first + cells) % cells;
    last = (last + cells) % cells;
    if (first <= last) {
        runs[0] = (koksma__run_of_points){start[first], start[last + 1]};
        return 1;
    }
    runs[0] = (koksma__run_of_points){start[first], start[cells]};
    runs[1] = (koksma__run_of_points){start[0], start[last + 1]};
    return 2;
}

size_t koksma__torus_rows_near(const koksma__torus_rows *r, double x, double y, double radius,
                               koksma__run_of_points *runs)
{
    const long cells = (long)r->cells, reach = reach_of(r, radius);
    const long count = 2 * reach + 1 < cells ? 2 * reach + 1 : cells, own = (long)koksma__cell_along(y, r->cells);
    const double inside = y * (double)cells - (double)own; /* position of y in its row, in cells */
    size_t n = 0;
    for (long v = own - reach; v < own - reach + count; v++) {
        const double gap = (v < own ? (double)(own - v - 1) + inside : v > own ? (double)(v - own) - inside : 0);
        const double height = gap / (double)cells, left = radius * radius - height * height;
        if (count == cells) { /* every row, with its periodic images, is within the radius, so whole rows are added */
            n += add_row(r, (v + cells) % cells, 0, cells - 1, runs + n);
        } else if (left > -1e-12) {
            const double half = sqrt(fmax(left, 0)) + 1e-9;
            n += add_row(r, (v + cells) % cells, (long)floor((x - half) * (double)cells),
                         (long)floor((x + half) * (double)cells), runs + n);
        }
    }
    return n;
}

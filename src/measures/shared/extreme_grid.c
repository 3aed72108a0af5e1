/* SPDX-License-Identifier: Apache-2.0 */
/* For each pair of columns, one pass along the rows keeps the lowest and the highest of
   #points so far / n - area so far; the best box that ends here is the difference to them. */
#include "measures/shared/extreme_grid.h"

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"

/* The cell of x: the largest c with c/grid <= x, as doubles; `grid` for x = 1, which no half-open box holds. */
static int cell_of(double x, int grid)
{
    int c = (int)(x * grid);
    while (c < grid && (double)(c + 1) / grid <= x) {
        c++;
    }
    while ((double)c / grid > x) {
        c--;
    }
    return c;
}

static void keep(koksma_value *out, double value, size_t count, const int box[4], int grid)
{
    if (value <= out->value) {
        return;
    }
    out->value = value;
    out->witness = (koksma_witness){.kind = KOKSMA_WITNESS_BOX, .dim = 2, .count = count, .closed = true};
    for (int k = 0; k < 2; k++) {
        out->witness.lo[k] = (double)box[k] / grid;
        out->witness.hi[k] = nextafter((double)box[2 + k] / grid, 0); /* boxes are half-open */
    }
    out->witness.volume = (double)(box[2] - box[0]) * (box[3] - box[1]) / ((double)grid * grid);
}

/* The best box between columns a and b. */
static void best_of_columns(const size_t *counts, int grid, double n, int a, int b, koksma_value *out)
{
    const size_t m = (size_t)grid;
    const double cell_area = 1.0 / ((double)grid * grid);
    size_t total = 0, low_total = 0, high_total = 0;
    double low = 0, high = 0;
    int low_row = 0, high_row = 0;
    for (int r = 1; r <= grid; r++) {
        total += counts[(size_t)b * m + (size_t)r - 1] - counts[(size_t)a * m + (size_t)r - 1];
        const double f = (double)total / n - (double)(b - a) * r * cell_area;
        keep(out, f - low, total - low_total, (int[]){a, low_row, b, r}, grid);
        keep(out, high - f, total - high_total, (int[]){a, high_row, b, r}, grid);
        if (f < low) {
            low = f;
            low_row = r;
            low_total = total;
        }
        if (f > high) {
            high = f;
            high_row = r;
            high_total = total;
        }
    }
}

koksma_status koksma__extreme_grid(const koksma_points *points, int grid, const koksma_run *run, koksma_value *out)
{
    KOKSMA__FAIL_IF(points->dim != 2, KOKSMA_DIM, "extreme:grid: it has no %d-dimensional form, only dim = 2",
                    points->dim);
    const size_t m = (size_t)grid;
    size_t *counts =
        calloc((m + 1) * (m + 1), sizeof *counts); /* column by column: points with x below, in each row */
    KOKSMA__REQUIRE_MEMORY(counts, (m + 1) * (m + 1) * sizeof *counts);
    for (size_t i = 0; i < points->n; i++) {
        const int cx = cell_of(points->xs[2 * i], grid), cy = cell_of(points->xs[2 * i + 1], grid);
        if (cx < grid && cy < grid) {
            counts[((size_t)cx + 1) * m + (size_t)cy]++;
        }
    }
    for (size_t c = m; c < m * (m + 1); c++) {
        counts[c] += counts[c - m];
    }
    const double n = (double)points->n;
    out->value = -1;
    bool stopped = false;
    for (int a = 0; a < grid && !stopped; a++) {
        for (int b = a + 1; b <= grid; b++) {
            best_of_columns(counts, grid, n, a, b, out);
        }
        stopped = !koksma__keep_going(run, (double)(a + 1) / grid);
    }
    free(counts);
    return stopped ? koksma__fail_interrupted() : KOKSMA_OK;
}

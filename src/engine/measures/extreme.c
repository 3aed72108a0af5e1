/* SPDX-License-Identifier: Apache-2.0 */
/*
 * extreme: the largest absolute difference, over all axis-parallel boxes, between the share of points in the box and
 * its volume. The value is T ("Stroud's discrepancy") in Shirley 1991. Rotating the points by 90 degrees does not
 * change the value.
 *
 * Formula: T = sup over boxes of |#{x_i in box}/n - volume|. The largest excess is reached at a closed box whose
 * sides are at coordinates of points, the largest deficit at an open box whose sides are at coordinates of points, 0
 * or 1. A point with a coordinate of exactly 0 is outside an open box that starts at 0.
 * Source: Stroud 1971; Shirley 1991, section 5.5.7. With grid=20 only half-open boxes with sides at multiples of 1/20
 * are tried; this seems to be the procedure of Shirley's table 5.7, whose value for the regular grid is 0.3600, while
 * the supremum is 0.4375.
 * Known exactly: 4 x 4 cell centres have T = 7/16 (0.36 with grid=20); a single point has T = 1; Hammersley 1024
 * 0.006079674.
 * Limits: counts are exact, volumes are rounded products: errors of a few 1e-16. If a
 * time limit ends the search, the result is a lower and an upper bound; in 3D the upper bound is 1.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/extreme/extreme.h"
#include "measures/measures.h"

/* With `grid`, there is one pass along the rows of the grid for each pair of columns. The pass stores the lowest and
   the highest value so far of (number of points below the row) / n - area below the row; the best box that ends at a
   row has the value of that row minus one of these two. */

/* Returns the index of the cell of x: the largest c with c/grid <= x, compared as doubles. For x = 1, which no
   half-open box contains, it returns `grid`. */
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
        out->witness.hi[k] = nextafter((double)box[2 + k] / grid, 0); /* the box is half-open: its upper side is
                                                                         excluded */
    }
    out->witness.volume = (double)(box[2] - box[0]) * (box[3] - box[1]) / ((double)grid * grid);
}

/* Finds the best box with its left side at a/grid and its right side at b/grid. */
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

/* Computes the largest |count/n - area| over half-open boxes with sides at multiples of 1/grid; only in 2D. O(n +
   grid^3). Errors: DIM, MEMORY, INTERRUPTED. */
static koksma_status extreme_grid(const koksma_points *points, int grid, const koksma_run *run, koksma_value *out)
{
    KOKSMA__FAIL_IF(points->dim != 2, KOKSMA_DIM, "extreme:grid: it has no %d-dimensional form, only dim = 2",
                    points->dim);
    const size_t m = (size_t)grid;
    size_t *counts = calloc((m + 1) * (m + 1), sizeof *counts); /* counts[c * m + r]: number of points in row r left
                                                                   of line c */
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

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    if (args->params[0] > 0) {
        return extreme_grid(points, (int)args->params[0], args->run, out);
    }
    return (points->dim == 2 ? koksma__extreme_plane : koksma__extreme_small)(points, args->run, out);
}

static const koksma_param params[] = {
    {"grid", "use only half-open boxes with sides at multiples of 1/grid (2D); 0: use all boxes", 0, 0, 4096, NULL,
     true},
    {0},
};

const koksma_measure koksma__measure_extreme = {
    .name = "extreme",
    .title = "Stroud's discrepancy (all axis-parallel boxes)",
    .cite = "stroud1971 shirley1991",
    .cost = "n^2 log^2 n at worst in 2D, n^5 in 3D",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = 3,
    .params = params,
    .eval = eval,
};

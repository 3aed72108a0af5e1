/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The local discrepancy of points at x: D(x) = #{i : p_i in [0, x)} / n - x_1 ... x_d, with its sign. The star
 * discrepancy is the supremum of |D|, the L2 star discrepancy the root mean square of D (Mitchell 1992, first
 * equation, and Niederreiter 1992, section 2.1). For a grid of x, each point is counted at the first grid corner
 * whose box contains it, and the counts are summed along both axes: O(n + side^2).
 */
#include <stdlib.h>

#include "core/points.h"
#include "core/status.h"

koksma_status koksma_local_discrepancy(const koksma_points *points, const double *x, double *out)
{
    KOKSMA__REQUIRE(points, x, out);
    double volume = 1;
    size_t inside = 0;
    KOKSMA__TRY(koksma__points_check(points));
    for (int k = 0; k < points->dim; k++) {
        KOKSMA__FAIL_IF(!(x[k] >= 0 && x[k] <= 1), KOKSMA_ARGUMENT, "the corner has a coordinate outside [0,1]");
        volume *= x[k];
    }
    for (size_t i = 0; i < points->n; i++) {
        const double *p = points->xs + i * (size_t)points->dim;
        int k = 0;
        while (k < points->dim && p[k] < x[k]) {
            k++;
        }
        inside += k == points->dim;
    }
    *out = (double)inside / (double)points->n - volume;
    return KOKSMA_OK;
}

/* Returns the first k for which the corner coordinate (k + 1/2) / side is above x, or `side` if there is none. */
static size_t first_corner(double coordinate, size_t side)
{
    const double at = coordinate * (double)side - 0.5;
    size_t k = at < 0 ? 0 : (size_t)at;
    while (k < side && ((double)k + 0.5) / (double)side <= coordinate) {
        k++;
    }
    return k;
}

koksma_status koksma_local_discrepancy_grid(const koksma_points *points, size_t side, double *out)
{
    KOKSMA__REQUIRE(points, out);
    KOKSMA__FAIL_IF(side < 1 || side > KOKSMA_MAX_LOCAL_GRID, KOKSMA_ARGUMENT,
                    "a grid of local discrepancies has a side of 1 to %d", KOKSMA_MAX_LOCAL_GRID);
    KOKSMA__TRY(koksma__points_check(points));
    KOKSMA__FAIL_IF(points->dim != 2, KOKSMA_DIM,
                    "a grid of local discrepancies takes points of 2 dimensions, not %d", points->dim);
    for (size_t i = 0; i < side * side; i++) {
        out[i] = 0;
    }
    for (size_t i = 0; i < points->n; i++) {
        const size_t column = first_corner(points->xs[2 * i], side), row = first_corner(points->xs[2 * i + 1], side);
        if (column < side && row < side) {
            out[row * side + column] += 1;
        }
    }
    for (size_t row = 0; row < side; row++) { /* sums of whole numbers, which are exact */
        for (size_t column = 1; column < side; column++) {
            out[row * side + column] += out[row * side + column - 1];
        }
        for (size_t column = 0; row && column < side; column++) {
            out[row * side + column] += out[(row - 1) * side + column];
        }
    }
    for (size_t i = 0; i < side * side; i++) {
        const double x = ((double)(i % side) + 0.5) / (double)side, y = ((double)(i / side) + 0.5) / (double)side;
        out[i] = out[i] / (double)points->n - x * y;
    }
    return KOKSMA_OK;
}

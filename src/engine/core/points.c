/* SPDX-License-Identifier: Apache-2.0 */
/* Sets of points: memory, limits of n and dim, and the check that coordinates are in [0,1]. */
#include "core/points.h"

#include <stdlib.h>

#include "core/capacity.h"
#include "core/platform/system.h"
#include "core/status.h"

koksma_status koksma__points_fit(size_t n, int dim)
{
    KOKSMA__FAIL_IF(dim < 1 || dim > KOKSMA_MAX_DIM, KOKSMA_DIM, "dim = %d: the number of dimensions is 1 to %d", dim,
                    KOKSMA_MAX_DIM);
    const size_t most = KOKSMA_MAX_COORDINATES / (size_t)dim;
    return n <= most ? KOKSMA_OK
                     : koksma__fail(KOKSMA_ARGUMENT, "n = %zu: at most %zu points of %d dimensions fit into one set",
                                    n, most, dim);
}

static bool counts_rows(const koksma_points *points, size_t column)
{
    const double *x = points->xs + column;
    size_t i = 0;
    while (i < points->n && x[i * (size_t)points->dim] == x[0] + (double)i) {
        i++;
    }
    return points->dim > 1 && i > 2 && i == points->n;
}

koksma_status koksma__points_check(const koksma_points *points)
{
    KOKSMA__FAIL_IF(!points->xs || points->n == 0, KOKSMA_ARGUMENT, "no points: a set has at least 1 point");
    const koksma_status status = koksma__points_fit(points->n, points->dim);
    const size_t n = status ? 0 : points->n * (size_t)points->dim;
    for (size_t i = 0; i < n; i++) {
        const size_t dim = (size_t)points->dim, column = i % dim;
        KOKSMA__FAIL_IF(!(points->xs[i] >= 0 && points->xs[i] <= 1), KOKSMA_ARGUMENT,
                        "point %zu: coordinate %.17g is outside [0,1]%s", i / dim, points->xs[i],
                        counts_rows(points, column) ? "; its column counts the rows: leave it out" : "");
    }
    return status;
}

static koksma_status make_room(koksma_points *points, size_t n, int dim, bool clear)
{
    *points = (koksma_points){0};
    KOKSMA__FAIL_IF(n == 0, KOKSMA_ARGUMENT, "n = 0: a set has at least 1 point");
    KOKSMA__TRY(koksma__points_fit(n, dim));
    points->xs = clear ? calloc(n * (size_t)dim, sizeof *points->xs) : malloc(n * (size_t)dim * sizeof *points->xs);
    KOKSMA__REQUIRE_MEMORY(points->xs, n * (size_t)dim * sizeof *points->xs);
    koksma__large_pages(points->xs, n * (size_t)dim * sizeof *points->xs);
    points->n = n;
    points->dim = dim;
    return KOKSMA_OK;
}

koksma_status koksma__points_room(koksma_points *points, size_t n, int dim)
{
    return make_room(points, n, dim, false);
}

koksma_status koksma_points_init(koksma_points *points, size_t n, int dim)
{
    KOKSMA__REQUIRE(points);
    return make_room(points, n, dim, true);
}

void koksma_points_fini(koksma_points *points)
{
    if (points) {
        free(points->xs);
        *points = (koksma_points){0};
    }
}

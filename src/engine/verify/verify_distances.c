/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The properties distinct, distance-square and distance-torus, and the public koksma_smallest_distance. Findings also
 * give the smallest distance divided by that of the densest packing of n points (patterns/spacing/spacing.h); the
 * latter is exact for up to 30 points in the square, and an upper bound otherwise.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/points.h"
#include "core/status.h"
#include "measures/distances/distances.h"
#include "patterns/spacing/spacing.h"
#include "verify/verify.h"

typedef struct point {
    const double *xs;
    int dim;
} point;

/* Compares coordinates as numbers, so that 0 equals -0. */
static int compare_positions(const point *p, const point *q)
{
    for (int k = 0; k < p->dim; k++) {
        if (p->xs[k] != q->xs[k]) {
            return p->xs[k] < q->xs[k] ? -1 : 1;
        }
    }
    return 0;
}

static int compare(const void *a, const void *b)
{
    const point *p = a, *q = b;
    const int order = compare_positions(p, q);
    return order ? order : p->xs < q->xs ? -1 : p->xs > q->xs;
}

static point *sort_points(const koksma_points *points)
{
    point *sorted = malloc(points->n * sizeof *sorted);
    for (size_t i = 0; i < points->n && sorted; i++) {
        sorted[i] = (point){points->xs + i * (size_t)points->dim, points->dim};
    }
    if (sorted) {
        qsort(sorted, points->n, sizeof *sorted, compare);
    } else {
        koksma__fail_memory(points->n * sizeof *sorted);
    }
    return sorted;
}

koksma_status koksma_smallest_distance(const koksma_points *points, bool torus, const koksma_run *run,
                                       double *distance)
{
    KOKSMA__REQUIRE(points, distance);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__TRY(koksma__points_check(points));
    return koksma__min_distance("koksma_smallest_distance", points, torus, run, distance);
}

static koksma_status look_distance(koksma__verification *v)
{
    const koksma_points *points = v->points;
    const bool torus = v->property == &koksma__property_distance_torus;
    double distance;
    if (points->n == 1 || (points->dim != 2 && points->n > 20000)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma_smallest_distance(points, torus, v->run, &distance));
    return koksma__add_finding(v, "-", distance, distance > 0, "%.4f of the densest packing's",
                               distance / koksma__packing_distance(points->n, points->dim, torus));
}

static koksma_status look_distinct(koksma__verification *v)
{
    const size_t n = v->points->n;
    point *sorted = sort_points(v->points);
    KOKSMA__TRY(sorted ? KOKSMA_OK : KOKSMA_MEMORY);
    size_t repeated = 0;
    for (size_t i = 1; i < n; i++) {
        repeated += compare_positions(&sorted[i], &sorted[i - 1]) == 0;
    }
    free(sorted);
    return koksma__add_finding(v, "-", (double)repeated, repeated == 0, "%zu of %zu points repeat another", repeated,
                               n);
}

const koksma__property koksma__property_distinct = {
    .public = {.name = "distinct", .meaning = "no two points are equal; value: number of points that repeat another"},
    .look = look_distinct,
};

const koksma__property koksma__property_distance_square = {
    .public = {.name = "distance-square",
               .meaning = "the smallest distance in the cube, which is the value, is above 0; detail: this distance "
                          "divided by that of the densest packing"},
    .look = look_distance,
};

const koksma__property koksma__property_distance_torus = {
    .public = {.name = "distance-torus",
               .meaning = "the smallest distance on the torus, which is the value, is above 0; detail: this distance "
                          "divided by that of the densest packing"},
    .look = look_distance,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * star-space: the star discrepancy in three dimensions, by descent of the excesses over a target f,
 *
 *     E = sum over all corners (X_i, Y_j, Z_k) of max(0, c/n - X_i Y_j Z_k - f)^2 + max(0, X_i Y_j Z_k - o/n - f)^2,
 *
 * c and o the numbers of points in the closed and in the open box of the corner, X, Y, Z the coordinates of the points and 1
 * in order. For fixed ranks its gradient is that of the volumes. L-BFGS from the starts of descent.c; where E gets to 0, and
 * else when it does not fall any more, f falls to a little below the set's value and the descent goes on, as long as the
 * value of the set, which koksma_evaluate finds, falls. Counts are of one x after the other: 2 (n + 1)^3 corners a gradient.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "measures/measures.h"
#include "measures/shared/order.h"
#include "optimise/descent.h"

enum { MAX_N = 512, ITERATIONS = 40 };

typedef struct job {
    size_t n;
    double target;
    uint32_t *order;    /* of each axis */
    double *x, *slopes; /* coordinates in order, then 1; the derivatives by them, of each axis n + 1 */
    double *counts;     /* of points so far with ranks up to (j, k), (n + 1)^2, from 1 on */
} job;

/* Corners (i, j, k) for all k: adds to the slopes of Z, returns those by area = X_i Y_j. */
static double row(const job *j, double area, const double *counts, double open, double *value)
{
    const size_t n = j->n;
    const double f = j->target, share = 1 / (double)n;
    const double *restrict z = j->x + 2 * (n + 1);
    double *restrict slopes = j->slopes + 2 * (n + 1);
    double by_area = 0, sum = 0;
    for (size_t k = 0; k <= n; k++) {
        const double difference = area * z[k] - counts[k + (open > 0 ? 0 : 1)] * share;
        const double excess = fmax(0, (open > 0 ? difference : -difference) - f);
        const double slope = (open > 0 ? 2 : -2) * excess;
        sum += excess * excess;
        by_area += slope * z[k];
        slopes[k] += slope * area;
    }
    *value += sum;
    return by_area;
}

static void add_corners(const job *j, size_t i, double open, double *value)
{
    const size_t n = j->n, side = n + 2;
    const double *x = j->x, *y = x + n + 1;
    for (size_t b = 0; b <= n; b++) {
        const double by_area = row(j, x[i] * y[b], j->counts + (b + (open > 0 ? 0 : 1)) * side, open, value);
        j->slopes[i] += by_area * y[b];
        j->slopes[n + 1 + b] += by_area * x[i];
    }
}

static koksma_status excesses(const void *context, const koksma_points *points, double *value, double *gradient)
{
    const job *j = context;
    const size_t n = j->n, side = n + 2;
    const koksma_run one_thread = {.threads = 1};
    uint32_t *rank = j->order + 3 * n; /* by y and by z */
    for (size_t k = 0; k < 3; k++) {
        const koksma_status status = koksma__order(&one_thread, n, points->xs + k, 3, j->order + k * n);
        if (status) {
            return status;
        }
        for (size_t i = 0; i < n; i++) {
            j->x[k * (n + 1) + i] = points->xs[3 * j->order[k * n + i] + k];
            rank[k * n + j->order[k * n + i]] = (uint32_t)i;
        }
        j->x[k * (n + 1) + n] = 1;
    }
    memset(j->slopes, 0, 3 * (n + 1) * sizeof(double));
    memset(j->counts, 0, side * side * sizeof(double));
    *value = 0;
    for (size_t i = 0; i <= n; i++) {
        add_corners(j, i, 1, value); /* the open boxes, before the point at x_i */
        for (size_t b = i < n ? rank[n + j->order[i]] + 1 : side; b < side; b++) {
            for (size_t c = rank[2 * n + j->order[i]] + 1; c < side; c++) {
                j->counts[b * side + c]++;
            }
        }
        add_corners(j, i, -1, value);
    }
    for (size_t k = 0; k < 3; k++) {
        for (size_t i = 0; i < n; i++) {
            gradient[3 * j->order[k * n + i] + k] = j->slopes[k * (n + 1) + i];
        }
    }
    return KOKSMA_OK;
}

/* Descends at falling targets while the value falls; `least` and points have the best. */
static koksma_status follow(const koksma_spec *measure, koksma__descent *d, job *j, double *least,
                            koksma_points *points)
{
    const koksma_run one_thread = {.threads = 1};
    koksma_value value;
    koksma_status status = koksma_evaluate(measure, &d->points, &one_thread, &value);
    for (int failures = 0; !status && failures < 3 && d->work < d->budget;) {
        const double before = value.value;
        double left;
        j->target = before * (failures == 0 ? 0.8 : failures == 1 ? 0.9 : 0.96);
        status = koksma__descend(d, ITERATIONS, &left);
        status = status ? status : koksma_evaluate(measure, &d->points, &one_thread, &value);
        failures = value.value < before * (1 - 1e-4) ? 0 : failures + 1;
        if (!status && value.value < *least) {
            *least = value.value;
            memcpy(points->xs, d->points.xs, d->count * sizeof(double));
        }
    }
    return status;
}

static koksma_status search(const koksma_spec *measure, koksma_keep keep, uint64_t seed, double value,
                            koksma_points *points)
{
    koksma__stream random = {.seed = seed};
    koksma__descent d;
    const size_t n = points->n, sides = 6 * (n + 1) + (n + 2) * (n + 2);
    const size_t bytes = sides * sizeof(double) + 6 * n * sizeof(uint32_t);
    job j = {.n = n, .x = malloc(bytes)};
    if (!j.x) {
        return koksma__fail_memory(bytes);
    }
    j.slopes = j.x + 3 * (n + 1);
    j.counts = j.slopes + 3 * (n + 1);
    j.order = (uint32_t *)(j.x + sides);
    koksma_status status = koksma__descent_init(&d, points, keep, true, 2 * pow((double)n + 1, 3) + 1000);
    d.function = excesses;
    d.context = &j;
    d.budget *= 3;
    while (!status && d.work < d.budget) {
        koksma__descent_start(&d, points, keep, &random);
        status = follow(measure, &d, &j, &value, points);
    }
    koksma__descent_fini(&d);
    free(j.x);
    return status;
}

static int serves(const koksma_spec *measure, size_t n, int dim, koksma_keep keep)
{
    return measure->measure == &koksma__measure_star && dim == 3 && n <= MAX_N && keep != KOKSMA_KEEP_LATIN ? 10 : 0;
}

const koksma_method koksma__method_star_space = {
    .name = "star-space",
    .title = "descent of the excesses of all corners (star, 3D)",
    .cite = "nocedal2006",
    .serves = serves,
    .search = search,
};

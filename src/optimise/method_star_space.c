/* SPDX-License-Identifier: Apache-2.0 */
/*
 * star-space: the star discrepancy in three dimensions, by descent of the excesses over a target f,
 *
 *     E = sum over all corners (X_i, Y_j, Z_k) of max(0, c - n X_i Y_j Z_k - n f)^2 + max(0, n X_i Y_j Z_k - o - n f)^2,
 *
 * c and o the numbers of points in the closed and in the open box of the corner, X, Y, Z the coordinates of the points and 1
 * in order. For fixed ranks its gradient is that of the volumes, and in log X, log Y, log Z the sets with E = 0 are convex.
 * L-BFGS at f a little below the set's value; where that, which koksma_evaluate finds, does not fall, at f nearer to it. Half
 * of the searches walk from the best set, the others from the best by E of some starts of descent.c, anew after STALE kicks
 * without a gain. A kick draws one to three points anew, or swaps coordinates of points of near ranks. The walk goes on from
 * what a descent finds if its value is not more than a threshold above. Counts are of one x after the other: (n + 1)^3
 * corners a gradient, in lanes.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/measures.h"
#include "measures/shared/order.h"
#include "optimise/descent.h"

enum { MAX_N = 512, ITERATIONS = 30, DRAWS = 16, STALE = 40 };

typedef struct job {
    size_t n, stride; /* stride: more than n + 2, a multiple of 8 */
    double target;
    uint32_t *order;       /* of each axis, then ranks by each axis */
    double *x, *slopes;    /* coordinates in order, then 1, then 0; the derivatives by them; of each axis a stride */
    double *open, *closed; /* points before x_i, and up to it, with ranks below (j, k): rows of a stride */
} job;

/* Adds the corners (i, j, k) for all j, k: to the slopes, and to the value. */
static void add_corners(const job *j, size_t i, double *value)
{
    const size_t n = j->n, stride = j->stride;
    const double *x = j->x, *y = x + stride, *z = y + stride, share = (double)n;
    for (size_t b = 0; b <= n; b++) {
        double sums[2];
        koksma__kernels()->corner_excesses((n + 8) / 8, share * x[i] * y[b], share * j->target, z,
                                           j->open + b * stride, j->closed + (b + 1) * stride + 1,
                                           j->slopes + 2 * stride, sums);
        *value += sums[0];
        j->slopes[i] += sums[1] * y[b];
        j->slopes[stride + b] += sums[1] * x[i];
    }
}

/* Counts the i-th point by x. */
static void count(const job *j, size_t i, double *counts)
{
    const size_t n = j->n, point = j->order[i];
    const uint32_t *rank = j->order + 3 * n;
    for (size_t b = rank[n + point] + 1; b < n + 2; b++) {
        for (size_t c = rank[2 * n + point] + 1; c < n + 2; c++) {
            counts[b * j->stride + c]++;
        }
    }
}

static koksma_status excesses(const void *context, const koksma_points *points, double *value, double *gradient)
{
    const job *j = context;
    const size_t n = j->n, stride = j->stride;
    const koksma_run one_thread = {.threads = 1};
    for (size_t k = 0; k < 3; k++) {
        const koksma_status status = koksma__order(&one_thread, n, points->xs + k, 3, j->order + k * n);
        if (status) {
            return status;
        }
        for (size_t i = 0; i < n; i++) {
            j->x[k * stride + i] = points->xs[3 * j->order[k * n + i] + k];
            j->order[(3 + k) * n + j->order[k * n + i]] = (uint32_t)i;
        }
        j->x[k * stride + n] = 1;
    }
    memset(j->slopes, 0, 3 * stride * sizeof(double));
    memset(j->open, 0, 2 * stride * stride * sizeof(double));
    *value = 0;
    for (size_t i = 0; i <= n; i++) {
        if (i > 0) {
            count(j, i - 1, j->open);
        }
        if (i < n) {
            count(j, i, j->closed);
        }
        add_corners(j, i, value);
    }
    const double scale = 2 * (double)n;
    for (size_t k = 0; k < 3; k++) {
        for (size_t i = 0; i < n; i++) {
            gradient[3 * j->order[k * n + i] + k] = (k < 2 ? scale : 2) * j->slopes[k * stride + i];
        }
    }
    return KOKSMA_OK;
}

/* The point that is `steps` ranks after point i along axis k, or the last one. */
static size_t after(const koksma_points *points, size_t i, size_t k, size_t steps)
{
    size_t at = i;
    while (steps-- > 0) {
        size_t next = at;
        for (size_t p = 0; p < points->n; p++) {
            const double x = points->xs[3 * p + k];
            if (x > points->xs[3 * at + k] && (next == at || x < points->xs[3 * next + k])) {
                next = p;
            }
        }
        at = next;
    }
    return at;
}

static void kick(koksma__descent *d, koksma_keep keep, koksma__stream *random)
{
    const bool swaps = keep == KOKSMA_KEEP_NONE && koksma__next_unit(random) < 0.7;
    for (size_t m = 1 + koksma__next_below(random, swaps ? 4 : 3); m-- > 0;) {
        const size_t i = koksma__next_below(random, d->points.n), k = koksma__next_below(random, 3);
        double *x = d->points.xs + 3 * i;
        for (size_t c = 0; c < 3 && !swaps; c++) {
            x[c] = d->low[3 * i + c] + d->length * koksma__next_unit(random);
        }
        if (swaps) {
            double *other = d->points.xs + 3 * after(&d->points, i, k, 1 + koksma__next_below(random, 3));
            const double swapped = x[k];
            x[k] = other[k];
            other[k] = swapped;
        }
    }
}

/* Leaves in d->points, of some starts, the one with the smallest E at the target. */
static koksma_status start(koksma__descent *d, const koksma_points *points, koksma_keep keep, double *best,
                           koksma__stream *random)
{
    double least = HUGE_VAL, value;
    koksma_status status = KOKSMA_OK;
    for (int draw = 0; draw < DRAWS && !status; draw++) {
        koksma__descent_start(d, points, keep, random);
        status = excesses(d->context, &d->points, &value, d->gradient);
        d->work += d->cost;
        if (value < least) {
            least = value;
            memcpy(best, d->points.xs, d->count * sizeof(double));
        }
    }
    memcpy(d->points.xs, best, d->count * sizeof(double));
    return status;
}

/* Descends at targets below the value; `lowest` and best have what was least. Ends early where that stays above cut. */
static koksma_status follow(const koksma_spec *measure, koksma__descent *d, job *j, double cut, double *best,
                            double *lowest)
{
    static const double shares[] = {0.95, 0.98, 0.99};
    const koksma_run one_thread = {.threads = 1};
    koksma_value value;
    koksma_status status = koksma_evaluate(measure, &d->points, &one_thread, &value);
    *lowest = value.value;
    memcpy(best, d->points.xs, d->count * sizeof(double));
    for (int failures = 0; !status && failures < 3 && (failures < 2 || *lowest <= cut) && d->work < d->budget;) {
        double left;
        j->target = fmin(*lowest, cut) * shares[failures];
        status = koksma__descend(d, ITERATIONS, &left);
        status = status ? status : koksma_evaluate(measure, &d->points, &one_thread, &value);
        const bool falls = !status && value.value < *lowest * (1 - 1e-4);
        failures = !falls ? failures + 1 : failures > 1 ? failures - 1 : 0;
        if (!status && value.value < *lowest) {
            *lowest = value.value;
            memcpy(best, d->points.xs, d->count * sizeof(double));
        }
    }
    return status;
}

/* The walk; points has the best set, and then what is better. */
static koksma_status wander(const koksma_spec *measure, koksma_keep keep, koksma__descent *d, job *j,
                            koksma__stream *random, double value, double *best, koksma_points *points)
{
    const bool anew = koksma__next(random) % 2;
    const double threshold = 1 + 0.01 * koksma__next_unit(random);
    const size_t bytes = d->count * sizeof(double);
    double *at = best + d->count, current = anew ? HUGE_VAL : value, lowest;
    koksma_status status = KOKSMA_OK;
    memcpy(at, points->xs, bytes);
    for (int stale = 0; !status && d->work < d->budget; stale++) {
        if (anew && (current == HUGE_VAL || stale > STALE)) {
            stale = 0;
            current = HUGE_VAL;
            j->target = value;
            status = start(d, points, keep, best, random);
        } else {
            memcpy(d->points.xs, at, bytes);
            kick(d, keep, random);
        }
        status = status ? status : follow(measure, d, j, current * threshold, best, &lowest);
        if (!status && lowest <= current * threshold) {
            stale = lowest < current * (1 - 1e-4) ? 0 : stale;
            current = lowest;
            memcpy(at, best, bytes);
        }
        if (!status && lowest < value) {
            value = lowest;
            memcpy(points->xs, best, bytes);
        }
    }
    return status;
}

static koksma_status search(const koksma_spec *measure, koksma_keep keep, uint64_t seed, double value,
                            koksma_points *points)
{
    koksma__stream random = {.seed = seed};
    koksma__descent d;
    const size_t n = points->n, stride = (n + 3 + 7) / 8 * 8 + 8;
    const size_t bytes = ((6 + 2 * stride) * stride + 6 * n) * sizeof(double) + 6 * n * sizeof(uint32_t);
    job j = {.n = n, .stride = stride, .x = calloc(1, bytes)};
    if (!j.x) {
        return koksma__fail_memory(bytes);
    }
    j.slopes = j.x + 3 * stride;
    j.open = j.slopes + 3 * stride;
    j.closed = j.open + stride * stride;
    double *best = j.closed + stride * stride; /* of a descent; then the walk's set */
    j.order = (uint32_t *)(best + 6 * n);
    koksma_status status = koksma__descent_init(&d, points, keep, true, pow((double)n + 1, 3) / 4 + 1000);
    d.function = excesses;
    d.context = &j;
    d.budget *= 3;
    status = status ? status : wander(measure, keep, &d, &j, &random, value, best, points);
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

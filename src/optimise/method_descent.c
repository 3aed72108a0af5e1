/* SPDX-License-Identifier: Apache-2.0 */
/*
 * descent: for measures with a gradient, from many starts, L-BFGS (Nocedal 1980; Nocedal & Wright 2006, algorithm 7.4) of
 * the square of the measure with a backtracking line search.
 *
 * Coordinates move on the whole axis for measures on the torus, and are taken back to [0,1) in the end; else they are
 * projected to their intervals: [0,1], or with keep=net those of length 1/n. Starts: half of the searches begin with the
 * best set in which some points are drawn anew or all are moved a little; the others with points {i a + s}, a and s random
 * vectors, or with random points.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/spec.h"
#include "core/status.h"
#include "optimise/methods.h"

enum { MEMORY = 10, ITERATIONS = 300, HALVINGS = 20 };

typedef struct descent {
    koksma_points points; /* x */
    const koksma_measure *measure;
    koksma_args args;
    bool bounded;
    size_t count;                       /* of coordinates */
    double *low, *gradient, *direction; /* low: of the intervals */
    double *before, *gradient_before;
    double *steps, *changes;                       /* MEMORY of them: of x, of the gradient */
    double length, products[MEMORY], work, budget; /* pairs times coordinates of all gradients */
    size_t kept;                                   /* steps so far */
} descent;

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

static koksma_status value_at(descent *d, double *square)
{
    const double n = (double)d->points.n;
    d->work += n * n * (double)d->points.dim + 1000;
    if (!d->bounded) {
        for (size_t c = 0; c < d->count; c++) {
            d->points.xs[c] -= floor(d->points.xs[c]);
            d->points.xs[c] *= d->points.xs[c] < 1;
        }
    }
    return d->measure->gradient(&d->points, &d->args, square, d->gradient);
}

/* direction = - H gradient, H the inverse Hessian that the last steps tell of (two-loop recursion). */
static void find_direction(descent *d)
{
    const size_t n = d->count, kept = d->kept < MEMORY ? d->kept : MEMORY;
    double alpha[MEMORY];
    for (size_t c = 0; c < n; c++) {
        d->direction[c] = -d->gradient[c];
    }
    for (size_t k = 0; k < kept; k++) {
        const size_t at = (d->kept - 1 - k) % MEMORY;
        alpha[at] = dot(n, d->steps + at * n, d->direction) / d->products[at];
        for (size_t c = 0; c < n; c++) {
            d->direction[c] -= alpha[at] * d->changes[at * n + c];
        }
    }
    if (kept) {
        const size_t last = (d->kept - 1) % MEMORY;
        const double scale = d->products[last] / dot(n, d->changes + last * n, d->changes + last * n);
        for (size_t c = 0; c < n; c++) {
            d->direction[c] *= scale;
        }
    }
    for (size_t k = kept; k-- > 0;) {
        const size_t at = (d->kept - 1 - k) % MEMORY;
        const double beta = dot(n, d->changes + at * n, d->direction) / d->products[at];
        for (size_t c = 0; c < n; c++) {
            d->direction[c] += (alpha[at] - beta) * d->steps[at * n + c];
        }
    }
}

/* x = before + t direction, in its intervals; what it is moved by is left in `steps`. */
static void move_by(descent *d, double t, double *step)
{
    for (size_t c = 0; c < d->count; c++) {
        double x = d->before[c] + t * d->direction[c];
        if (d->bounded) {
            x = fmin(fmax(x, d->low[c]), d->low[c] + d->length);
        }
        step[c] = x - d->before[c];
        d->points.xs[c] = x;
    }
}

/* Keeps a step if the curvature along it is positive. */
static void keep_step(descent *d, const double *step)
{
    const size_t n = d->count, at = d->kept % MEMORY;
    double *s = d->steps + at * n, *y = d->changes + at * n;
    for (size_t c = 0; c < n; c++) {
        y[c] = d->gradient[c] - d->gradient_before[c];
        s[c] = step[c];
    }
    d->products[at] = dot(n, s, y);
    d->kept += d->products[at] > 1e-10 * sqrt(dot(n, s, s) * dot(n, y, y));
}

/* Leaves the points at the least square found from where they are. */
static koksma_status descend(descent *d, double *step, double *least)
{
    const size_t n = d->count;
    double square, next = 0;
    koksma_status status = value_at(d, &square);
    d->kept = 0;
    for (int k = 0; k < ITERATIONS && !status && d->work < d->budget; k++) {
        find_direction(d);
        double slope = dot(n, d->gradient, d->direction);
        if (!(slope < 0)) { /* the curvature is not that of before */
            d->kept = 0;
            find_direction(d);
            slope = dot(n, d->gradient, d->direction);
        }
        memcpy(d->before, d->points.xs, n * sizeof(double));
        memcpy(d->gradient_before, d->gradient, n * sizeof(double));
        /* The first step is a tenth of the mean spacing. */
        double t = d->kept ? 1 : 0.1 * pow((double)d->points.n, -1.0 / d->points.dim) / sqrt(-slope / (double)n);
        int halvings = 0;
        for (; halvings < HALVINGS && !status; halvings++, t /= 2) {
            move_by(d, t, step);
            status = value_at(d, &next);
            if (next <= square + 1e-4 * dot(n, d->gradient_before, step)) {
                break;
            }
        }
        if (status || halvings == HALVINGS) {
            move_by(d, 0, step);
            break;
        }
        const bool ends = square - next <= 1e-12 * square;
        square = next;
        keep_step(d, step);
        if (ends) {
            break;
        }
    }
    *least = square;
    return status;
}

/* The best set, from which some points are drawn anew, or all are moved by up to a third of the mean spacing. */
static void kick(descent *d, koksma__stream *random)
{
    const size_t n = d->points.n, dim = (size_t)d->points.dim;
    const double spacing = d->length * pow((double)n, -1.0 / d->points.dim);
    const double reach = koksma__next(random) % 2 ? spacing / 3 * koksma__next_unit(random) : 0;
    const size_t most = (size_t)1 << koksma__next_below(random, 5), some = 1 + koksma__next_below(random, most);
    for (size_t m = 0; m < (reach > 0 ? n : some); m++) {
        const size_t i = reach > 0 ? m : koksma__next_below(random, n);
        for (size_t c = i * dim; c < (i + 1) * dim; c++) {
            const double u = koksma__next_unit(random);
            const double x = reach > 0 ? d->points.xs[c] + reach * (2 * u - 1) : d->low[c] + u * d->length;
            d->points.xs[c] = d->bounded ? fmin(fmax(x, d->low[c]), d->low[c] + d->length) : x;
        }
    }
}

/* {i a + s}: half of them with an axis i / n + s, of these half with multiples of 1/n as a, which are lattices of rank 1. */
static void draw_kronecker(descent *d, koksma__stream *random)
{
    const double n = (double)d->points.n;
    const uint32_t kind = koksma__next(random) % 4;
    for (int k = 0; k < d->points.dim; k++) {
        const double u = koksma__next_unit(random), shift = koksma__next_unit(random);
        const double a = kind > 1 && k == 0 ? 1 / n : kind == 3 ? floor(n * u) / n : u;
        for (size_t i = 0; i < d->points.n; i++) {
            const double x = (double)i * a + shift;
            d->points.xs[i * (size_t)d->points.dim + (size_t)k] = (x - floor(x)) * d->length;
        }
    }
}

static void draw_start(descent *d, koksma__stream *random, koksma_keep keep)
{
    const double u = koksma__next_unit(random);
    if (u < 0.5) {
        kick(d, random);
    } else if (keep == KOKSMA_KEEP_NONE && u < 0.9) {
        draw_kronecker(d, random);
    } else {
        for (size_t c = 0; c < d->count; c++) {
            d->points.xs[c] = d->low[c] + d->length * koksma__next_unit(random);
        }
    }
}

static koksma_status descent_init(descent *d, const koksma_spec *measure, koksma_keep keep,
                                  const koksma_points *points)
{
    const size_t n = points->n * (size_t)points->dim, bytes = (7 + 2 * MEMORY) * n * sizeof(double);
    static const koksma_run one_thread = {.threads = 1};
    *d = (descent){.measure = measure->measure, .args = koksma__spec_arguments(measure, &one_thread), .count = n};
    d->points = (koksma_points){points->n, points->dim, malloc(bytes)};
    if (!d->points.xs) {
        return koksma__fail_memory(bytes);
    }
    d->low = d->points.xs + n;
    d->gradient = d->low + n;
    d->direction = d->gradient + n;
    d->before = d->direction + n;
    d->gradient_before = d->before + n;
    d->steps = d->gradient_before + 2 * n; /* the last step, not yet kept, lies before them */
    d->changes = d->steps + MEMORY * n;
    d->bounded = keep == KOKSMA_KEEP_NET || !measure->measure->on_torus;
    d->budget = 3e7 + ITERATIONS * (double)points->n * (double)n; /* some tenths of a second, or one descent */
    d->length = keep == KOKSMA_KEEP_NET ? (1 - 2e-9) / (double)points->n : 1 - 0x1p-53;
    for (size_t c = 0; c < n; c++) {
        d->low[c] =
            keep == KOKSMA_KEEP_NET ? (floor(points->xs[c] * (double)points->n) + 1e-9) / (double)points->n : 0;
    }
    return KOKSMA_OK;
}

static koksma_status search(const koksma_spec *measure, koksma_keep keep, uint64_t seed, double value,
                            koksma_points *points)
{
    koksma__stream random = {.seed = seed};
    descent d;
    koksma_status status = descent_init(&d, measure, keep, points);
    double best = value * value;
    while (!status && d.work < d.budget) {
        memcpy(d.points.xs, points->xs, d.count * sizeof(double));
        draw_start(&d, &random, keep);
        double square;
        status = descend(&d, d.steps - d.count, &square);
        if (!status && square < best) {
            best = square;
            memcpy(points->xs, d.points.xs, d.count * sizeof(double));
        }
    }
    free(d.points.xs);
    return status;
}

static int serves(const koksma_spec *measure, size_t n, int dim, koksma_keep keep)
{
    (void)n, (void)dim;
    return measure->measure->gradient && keep != KOKSMA_KEEP_LATIN ? 5 : 0;
}

const koksma_method koksma__method_descent = {
    .name = "descent",
    .title = "L-BFGS from many starts (measures with a gradient)",
    .cite = "nocedal1980 nocedal2006",
    .serves = serves,
    .search = search,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * L-BFGS (Nocedal 1980, and Nocedal & Wright 2006, algorithm 7.4) with a backtracking line search. For functions on
 * the torus, coordinates are reduced modulo 1 after each step; for other functions each coordinate is projected to
 * its interval, which is [0,1] or has length 1/n.
 *
 * Four of five descents start from the best set after a random change (kick); the others start from the points {i a +
 * s} (fractional parts) with random vectors a and s, or from random points. On the torus, where lattices are among the
 * best sets, the best of many such vectors a is taken.
 */
#include "optimise/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "core/vector.h"

enum { HALVINGS = 20, STRETCH = 10, HOPE = 4 };

static koksma_status value_at(koksma__descent *d, double *square)
{
    KOKSMA__TRY(koksma__ask(d->run));
    d->work += d->cost;
    if (!d->bounded) {
        for (size_t c = 0; c < d->count; c++) {
            d->points.xs[c] -= floor(d->points.xs[c]);
            d->points.xs[c] *= d->points.xs[c] < 1;
        }
    }
    return d->function(d->context, &d->points, square, d->gradient);
}

/* direction = - H gradient, where H is the inverse Hessian estimated from the last steps (two-loop recursion). */
static void find_direction(koksma__descent *d)
{
    const size_t n = d->count, kept = d->kept < KOKSMA__MEMORY ? d->kept : KOKSMA__MEMORY;
    double alpha[KOKSMA__MEMORY];
    for (size_t c = 0; c < n; c++) {
        d->direction[c] = -d->gradient[c];
    }
    for (size_t k = 0; k < kept; k++) {
        const size_t at = (d->kept - 1 - k) % KOKSMA__MEMORY;
        alpha[at] = koksma__dot_of(n, d->steps + at * n, d->direction) / d->products[at];
        for (size_t c = 0; c < n; c++) {
            d->direction[c] -= alpha[at] * d->changes[at * n + c];
        }
    }
    if (kept) {
        const size_t last = (d->kept - 1) % KOKSMA__MEMORY;
        const double scale = d->products[last] / koksma__dot_of(n, d->changes + last * n, d->changes + last * n);
        for (size_t c = 0; c < n; c++) {
            d->direction[c] *= scale;
        }
    }
    for (size_t k = kept; k-- > 0;) {
        const size_t at = (d->kept - 1 - k) % KOKSMA__MEMORY;
        const double beta = koksma__dot_of(n, d->changes + at * n, d->direction) / d->products[at];
        for (size_t c = 0; c < n; c++) {
            d->direction[c] += (alpha[at] - beta) * d->steps[at * n + c];
        }
    }
}

/* x = before + t direction, projected to its intervals; the actual displacement is stored in `step`. */
static void move_by(koksma__descent *d, double t, double *step)
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

/* Stores a step for the inverse Hessian if the curvature along it is positive. */
static void keep_step(koksma__descent *d, const double *step)
{
    const size_t n = d->count, at = d->kept % KOKSMA__MEMORY;
    double *s = d->steps + at * n, *y = d->changes + at * n;
    for (size_t c = 0; c < n; c++) {
        y[c] = d->gradient[c] - d->gradient_before[c];
        s[c] = step[c];
    }
    d->products[at] = koksma__dot_of(n, s, y);
    d->kept += d->products[at] > 1e-10 * sqrt(koksma__dot_of(n, s, s) * koksma__dot_of(n, y, y));
}

koksma_status koksma__descend(koksma__descent *d, int iterations, double *least)
{
    double *step = d->steps - d->count;
    const size_t n = d->count;
    double square = INFINITY, next = 0;
    koksma_status status = value_at(d, &square);
    double mark = square;
    d->kept = 0;
    for (int k = 0; k < iterations && !status && d->work < d->budget; k++) {
        find_direction(d);
        double slope = koksma__dot_of(n, d->gradient, d->direction);
        /* the direction does not descend, because the stored steps no longer describe the curvature */
        if (!(slope < 0)) {
            d->kept = 0;
            find_direction(d);
            slope = koksma__dot_of(n, d->gradient, d->direction);
        }
        if (!(slope < 0)) { /* the gradient is 0 */
            break;
        }
        memcpy(d->before, d->points.xs, n * sizeof(double));
        memcpy(d->gradient_before, d->gradient, n * sizeof(double));
        /* The first step is a tenth of the mean spacing. */
        double t =
            d->kept ? 1 : 0.1 * koksma__pow((double)d->points.n, -1.0 / d->points.dim) / sqrt(-slope / (double)n);
        int halvings = 0;
        for (; halvings < HALVINGS && !status; halvings++, t /= 2) {
            move_by(d, t, step);
            status = value_at(d, &next);
            if (next <= square + 1e-4 * koksma__dot_of(n, d->gradient_before, step)) {
                break;
            }
        }
        if (status || halvings == HALVINGS) {
            move_by(d, 0, step);
            break;
        }
        bool ends = square - next <= 1e-12 * square;
        square = next;
        /* stop if the goal would not be reached after HOPE more stretches of STRETCH iterations that each gain as
           much as the last stretch */
        if (k % STRETCH == STRETCH - 1) {
            ends = ends || HOPE * (mark - square) < square - d->goal;
            mark = square;
        }
        keep_step(d, step);
        if (ends) {
            break;
        }
    }
    *least = square;
    return status;
}

/* Takes some random pairs of points that are close to each other in one coordinate, and exchanges another coordinate of
   the two points. */
static void exchange(koksma__descent *d, koksma__stream *random, size_t pairs)
{
    const size_t n = d->points.n, dim = (size_t)d->points.dim;
    for (size_t m = 0; m < pairs; m++) {
        const size_t k = koksma__next_below(random, dim), l = (k + 1 + koksma__next_below(random, dim)) % dim;
        double *x = d->points.xs + koksma__next_below(random, n) * dim, *nearest = x, least = INFINITY;
        for (size_t t = 0; t < n / 4 + 1; t++) {
            double *y = d->points.xs + koksma__next_below(random, n) * dim;
            if (y != x && fabs(y[l] - x[l]) < least) {
                nearest = y;
                least = fabs(y[l] - x[l]);
            }
        }
        const double swapped = x[k];
        x[k] = nearest[k];
        nearest[k] = swapped;
    }
}

/* Changes the best set in one of these ways: up to 16 points are drawn anew; pairs of points exchange a coordinate;
   the points in a window of up to four mean spacings are moved by up to a third of the mean spacing. */
static void kick(koksma__descent *d, koksma__stream *random)
{
    const size_t n = d->points.n, dim = (size_t)d->points.dim, kind = koksma__next_below(random, 3);
    const double spacing = d->length * koksma__pow((double)n, -1.0 / d->points.dim),
                 reach = spacing / 3 * koksma__next_unit(random);
    const double width = spacing * (1 + 3 * koksma__next_unit(random));
    const double *centre = d->points.xs + dim * koksma__next_below(random, n);
    const size_t most = (size_t)1 << koksma__next_below(random, 5), some = 1 + koksma__next_below(random, most);
    if (kind == 1 && d->length > 0.5) {
        exchange(d, random, some);
        return;
    }
    for (size_t m = 0; m < (kind ? n : some); m++) {
        double *x = d->points.xs + (kind ? m : koksma__next_below(random, n)) * dim;
        bool moves = true;
        for (size_t k = 0; k < dim && kind; k++) {
            moves = moves && fabs(x[k] - centre[k]) < width;
        }
        for (size_t k = 0; k < dim && moves; k++) {
            const double low = d->low[(size_t)(x - d->points.xs) + k], u = koksma__next_unit(random);
            const double to = kind ? x[k] + reach * (2 * u - 1) : low + u * d->length;
            x[k] = d->bounded ? fmin(fmax(to, low), low + d->length) : to;
        }
    }
}

/* Sets point i to {i a + s} (fractional parts) with random vectors a and s. With a kind above 1, the first entry of a
   is 1/n; with 3, the other entries are multiples of 1/n, which makes the set a shifted rank-1 lattice. */
static void kronecker(koksma__descent *d, uint32_t kind, koksma__stream *random)
{
    const double n = (double)d->points.n;
    for (int k = 0; k < d->points.dim; k++) {
        const double u = koksma__next_unit(random), shift = koksma__next_unit(random);
        const double a = kind > 1 && k == 0 ? 1 / n : kind == 3 ? floor(n * u) / n : u;
        for (size_t i = 0; i < d->points.n; i++) {
            const double x = (double)i * a + shift;
            d->points.xs[i * (size_t)d->points.dim + (size_t)k] = (x - floor(x)) * d->length;
        }
    }
}

void koksma__descent_kronecker(koksma__descent *d, koksma__stream *random)
{
    kronecker(d, koksma__next(random) % 4, random);
}

/* The best of n such sets of one kind, or of as many as a quarter of the work allows. d->before keeps it. */
static koksma_status best_kronecker(koksma__descent *d, koksma__stream *random)
{
    const uint32_t kind = koksma__next(random) % 4;
    const double tries = fmin((double)d->points.n, d->budget / 4 / d->cost);
    double least = INFINITY;
    koksma_status status = KOKSMA_OK;
    for (double i = 0; !status && i < tries; i++) {
        double square;
        kronecker(d, kind, random);
        status = value_at(d, &square);
        if (!status && square < least) {
            least = square;
            memcpy(d->before, d->points.xs, d->count * sizeof(double));
        }
    }
    memcpy(d->points.xs, d->before, d->count * sizeof(double));
    return status;
}

koksma_status koksma__descent_start(koksma__descent *d, const koksma_points *best, koksma_keep keep,
                                    koksma__stream *random)
{
    memcpy(d->points.xs, best->xs, d->count * sizeof(double));
    const double u = koksma__next_unit(random);
    if (u < 0.8) {
        kick(d, random);
    } else if (keep == KOKSMA_KEEP_NONE && u < 0.96) {
        if (!d->bounded) {
            return best_kronecker(d, random);
        }
        koksma__descent_kronecker(d, random);
    } else {
        for (size_t c = 0; c < d->count; c++) {
            d->points.xs[c] = d->low[c] + d->length * koksma__next_unit(random);
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__descent_init(koksma__descent *d, const koksma_points *points, koksma_keep keep, bool bounded,
                                   double cost)
{
    const size_t n = points->n * (size_t)points->dim, bytes = (7 + 2 * KOKSMA__MEMORY) * n * sizeof(double);
    *d = (koksma__descent){.bounded = bounded, .count = n, .cost = cost, .goal = INFINITY};
    d->points = (koksma_points){points->n, points->dim, malloc(bytes)};
    KOKSMA__REQUIRE_MEMORY(d->points.xs, bytes);
    d->low = d->points.xs + n;
    d->gradient = d->low + n;
    d->direction = d->gradient + n;
    d->before = d->direction + n;
    d->gradient_before = d->before + n;
    d->steps = d->gradient_before + 2 * n; /* the `count` doubles before d->steps hold the current step */
    d->changes = d->steps + KOKSMA__MEMORY * n;
    /* the limit of work: some tenths of a second, but at least one descent */
    d->budget = fmax(1.5e7, KOKSMA__ITERATIONS * cost);
    d->length = keep == KOKSMA_KEEP_NET ? (1 - 2e-9) / (double)points->n : 1 - 0x1p-53;
    for (size_t c = 0; c < n; c++) {
        d->low[c] =
            keep == KOKSMA_KEEP_NET ? (floor(points->xs[c] * (double)points->n) + 1e-9) / (double)points->n : 0;
    }
    return KOKSMA_OK;
}

void koksma__descent_fini(koksma__descent *d)
{
    free(d->points.xs);
}

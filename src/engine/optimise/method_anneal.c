/* SPDX-License-Identifier: Apache-2.0 */
/*
 * anneal: minimises the L2 discrepancies of boxes by a search over the orders of the points along the axes, to which
 * the coordinates are then fitted.
 *
 * While the order of the points along each axis is fixed, the squared discrepancy is a smooth function, and nearly
 * all of its local minima have different orders. So a search anneals the orders: two points swap one coordinate, and
 * the swap is accepted if the squared discrepancy grows by less than a random threshold, whose mean falls from round
 * to round. Half of the swaps are between points that are close to each other in the order along another axis. After
 * each round a few iterations of L-BFGS fit the coordinates to the new orders. The last rounds accept only swaps that
 * reduce the value. Finally the search tries single swaps that raise the squared value by at most 2 %, runs L-BFGS
 * after each, and keeps a swap if the value is then lower than before it. With 64 points this lowers l2-star from
 * .00691 to .00677. Half of the searches start from random orders of the centres (i + 1/2)/n, the others from the best set
 * at a lower threshold.
 *
 * swaps.c has the change of the discrepancy by a swap.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "optimise/search.h"

/* LEAST_N: for fewer points the method `descent` is used, which finds the best sets at once. In each of ROUNDS rounds
   there are SWAPS n proposals; searches from the best set leave out the first WARM rounds. The last COLD rounds
   accept only swaps that reduce the value. The run is asked after ASKED swaps. */
enum {
    LEAST_N = 10,
    ROUNDS = 100,
    WARM = 40,
    COLD = 6,
    SWAPS = 100,
    FIT = 8,
    SETTLE = 30,
    NEAR = 4,
    TRIAL = 10,
    STALE = 2,
    ASKED = 256
};

/* FIRST: the mean threshold in the first round, as a fraction of the squared discrepancy after a first descent. FALL:
   the factor by which the mean threshold falls from each round to the next. */
static const double FIRST = 0.1, FALL = 0.96;

/* LEAP: single swaps are tried if they raise the squared discrepancy by at most this share. POLISH: limit of the work
   spent on such trials, as a number of coordinates read. */
static const double LEAP = 0.02, POLISH = 1e8;

static void exchange(double *a, double *b)
{
    const double was = *a;
    *a = *b;
    *b = was;
}

/* Proposes SWAPS n swaps; each is accepted if the change is below a random threshold whose mean is `threshold`. */
static koksma_status propose(koksma__swaps *j, double *xs, double threshold, const koksma_run *run)
{
    const size_t n = j->n;
    for (size_t m = 0; m < SWAPS * n; m++) {
        if (m % ASKED == 0) {
            KOKSMA__TRY(koksma__ask(run));
        }
        const size_t k = koksma__next_below(&j->random, j->dim), p = koksma__next_below(&j->random, n);
        size_t q = koksma__next_below(&j->random, 2 * n);
        if (q >= n) {
            const size_t l = (k + 1 + koksma__next_below(&j->random, j->dim - 1)) % j->dim;
            const size_t at = j->rank[l * n + p] + 1 + q % NEAR;
            q = at < n ? j->order[l * n + at] : p;
        }
        const double u = koksma__next_unit(&j->random), v = koksma__next_unit(&j->random);
        if (p != q && koksma__swaps_change(j, k, p, q) < 4 * threshold * u * v) {
            koksma__swaps_swap(j, xs, k, p, q);
        }
    }
    return KOKSMA_OK;
}

/* Gives the points the coordinates (i + 1/2)/n along each axis, in random order. */
static void shuffle(koksma__swaps *j, double *xs)
{
    for (size_t k = 0; k < j->dim; k++) {
        for (size_t i = 0; i < j->n; i++) {
            const size_t at = koksma__next_below(&j->random, i + 1);
            xs[i * j->dim + k] = xs[at * j->dim + k];
            xs[at * j->dim + k] = ((double)i + 0.5) / (double)j->n;
        }
    }
}

/* Keeps the points of a descent, which may have been interrupted, if they are better than the best set so far. */
static void keep_better(const koksma__descent *d, double square, double *least, koksma_points *best)
{
    if (square < *least) {
        *least = square;
        memcpy(best->xs, d->points.xs, d->count * sizeof(double));
    }
}

typedef struct measured {
    const koksma_spec *measure;
    const koksma_optimise_options *options;
    const koksma_run *run;
} measured;

static koksma_status square_of(const void *context, const koksma_points *points, double *value, double *gradient)
{
    const measured *m = context;
    return koksma__search_square(m->measure, m->options, points, m->run, value, gradient);
}

/* Tries random swaps, each followed by a descent, until STALE n^2 swaps in a row gain nothing or the work is used
   up. */
static koksma_status improve(koksma__swaps *j, koksma__descent *d, double *square)
{
    const size_t bytes = d->count * sizeof(double), n = j->n, dim = j->dim;
    const double reach = LEAP * *square * (double)(n * n);
    double next, *before = j->before;
    koksma_status status = koksma__swaps_prepare(j, d->points.xs);
    memcpy(before, d->points.xs, bytes);
    for (size_t stale = 0; stale < STALE * n * n && d->work < d->budget && !status; stale++) {
        const size_t k = koksma__next_below(&j->random, dim), p = koksma__next_below(&j->random, n),
                     q = koksma__next_below(&j->random, n);
        if (p == q || koksma__swaps_change(j, k, p, q) > reach) {
            status = stale % ASKED ? KOKSMA_OK : koksma__ask(d->run);
            continue;
        }
        exchange(d->points.xs + p * dim + k, d->points.xs + q * dim + k);
        d->goal = *square;
        status = koksma__descend(d, TRIAL, &next);
        if (!status && next < *square * (1 - 1e-9)) {
            *square = next;
            stale = 0;
            memcpy(before, d->points.xs, bytes);
            status = koksma__swaps_prepare(j, before);
        } else {
            memcpy(d->points.xs, before, bytes);
        }
    }
    d->budget = INFINITY;
    d->goal = INFINITY;
    return status;
}

static koksma_status search(const koksma_spec *measure, const koksma_optimise_options *o, uint64_t seed, double value,
                            const koksma_run *run, koksma_points *points)
{
    const measured context = {measure, o, run};
    const size_t n = points->n;
    koksma__descent d;
    koksma__swaps j;
    KOKSMA__TRY(koksma__swaps_init(&j, koksma__l2_row_of(measure->measure), points, seed));
    koksma_status status = koksma__descent_init(&d, points, o->keep, true, 0);
    if (status) {
        free(j.memory);
        return status;
    }
    d.function = square_of;
    d.context = &context;
    d.run = run;
    const bool again = koksma__next_below(&j.random, 2) == 0;
    double square = INFINITY, least = value * value;
    memcpy(d.points.xs, points->xs, d.count * sizeof(double));
    if (!again) {
        shuffle(&j, d.points.xs);
    }
    status = koksma__descend(&d, SETTLE, &square);
    keep_better(&d, square, &least, points);
    double threshold = status ? 0 : FIRST * fmin(square, value * value) * (double)(n * n);
    for (int round = 0; round < ROUNDS + COLD && !status; round++, threshold *= FALL) {
        if (round < WARM && again) {
            continue;
        }
        status = koksma__swaps_prepare(&j, d.points.xs);
        if (!status) {
            status = propose(&j, d.points.xs, round < ROUNDS ? threshold : 0, run);
            status = status ? status : koksma__descend(&d, FIT, &square);
            keep_better(&d, status ? (double)INFINITY : square, &least, points);
        }
    }
    status = status ? status : koksma__descend(&d, KOKSMA__ITERATIONS, &square);
    keep_better(&d, status ? (double)INFINITY : square, &least, points);
    d.cost = (double)(n * d.count);
    d.work = 0;
    d.budget = POLISH;
    status = status ? status : improve(&j, &d, &square);
    status = status ? status : koksma__descend(&d, KOKSMA__ITERATIONS, &square);
    keep_better(&d, status ? (double)INFINITY : square, &least, points);
    koksma__descent_fini(&d);
    free(j.memory);
    return status;
}

static int serves(const koksma_spec *measure, const koksma_optimise_options *o)
{
    return koksma__l2_row_of(measure->measure) && !measure->measure->on_torus && o->keep == KOKSMA_KEEP_NONE &&
                   !o->n_projections && o->dim > 1 && o->n >= LEAST_N &&
                   o->n * o->n * (size_t)o->dim <= KOKSMA__MOST_KERNELS
               ? 7
               : 0;
}

const koksma_method koksma__method_anneal = {
    .name = "anneal",
    .title = "simulated annealing of the points' orders, with coordinates fitted to them (L2 family)",
    .cite = "jin2005 dueck1990 nocedal1980",
    .serves = serves,
    .search = search,
};

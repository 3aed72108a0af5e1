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
 * A swap of coordinate k of points p and q changes n^2 times the squared discrepancy by (Jin, Chen & Sudjianto 2005)
 *
 *     2 sum_(j != p, q) (R_pj - R_qj) (K_k(q, j) - K_k(p, j)) + (R_pp - R_qq) (K_k(q, q) - K_k(p, p))
 *     - 2 n (B_p - B_q) (a_k(q) - a_k(p)),
 *
 * where R is the product of the kernels K_l, and B the product of their integrals a_l, over the coordinates l != k.
 * The kernels of all pairs are stored, one matrix for each coordinate: a change is a sum along rows, in fixed order,
 * and a swap of coordinate k exchanges two rows and two columns of matrix k.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/l2_boxes.h"
#include "measures/shared/order.h"
#include "optimise/descent.h"
#include "optimise/value.h"

/* LEAST_N: for fewer points the method `descent` is used, which finds the best sets at once. In each of ROUNDS rounds
   there are SWAPS n proposals; searches from the best set leave out the first WARM rounds. The last COLD rounds
   accept only swaps that reduce the value. The run is asked after ASKED swaps. */
enum {
    LEAST_N = 10,
    MOST_NUMBERS = 1 << 21,
    LANES = 8,
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

typedef struct job {
    const koksma__l2_row *row;
    size_t n, dim, stride;
    double *kernels;        /* K_k(i, j) at (k n + i) stride + j; the columns from n on are 0 */
    double *linear;         /* a_k of point i at k n + i */
    double *products;       /* two rows: R_p and R_q */
    double *before;         /* the set to restore if a trial swap gains nothing */
    uint32_t *order, *rank; /* for each axis: the points in order, and the rank of each point */
    koksma__stream random;
    void *memory;
} job;

static koksma_status job_init(job *j, const koksma__l2_row *row, const koksma_points *points, uint64_t seed)
{
    const size_t n = points->n, dim = (size_t)points->dim, stride = (n + LANES - 1) / LANES * LANES;
    const size_t numbers = (dim * n + 2) * stride + 2 * dim * n,
                 bytes = numbers * sizeof(double) + 2 * dim * n * sizeof(uint32_t);
    *j =
        (job){.row = row, .n = n, .dim = dim, .stride = stride, .random = {.seed = seed}, .memory = calloc(1, bytes)};
    KOKSMA__REQUIRE_MEMORY(j->memory, bytes);
    j->kernels = j->memory;
    j->products = j->kernels + dim * n * stride;
    j->linear = j->products + 2 * stride;
    j->before = j->linear + dim * n;
    j->order = (uint32_t *)(j->before + dim * n);
    j->rank = j->order + dim * n;
    return KOKSMA_OK;
}

/* Computes orders, kernels and integrals of the points. */
static koksma_status prepare(job *j, const double *xs)
{
    const koksma_run one_thread = {.threads = 1};
    const koksma__l2_row *row = j->row;
    const size_t n = j->n, dim = j->dim;
    for (size_t k = 0; k < dim; k++) {
        uint32_t *order = j->order + k * n;
        KOKSMA__TRY(koksma__order(&one_thread, n, xs + k, dim, order));
        double *g = j->products; /* the part g(x_i) of the kernel */
        for (size_t i = 0; i < n; i++) {
            j->rank[k * n + order[i]] = (uint32_t)i;
            j->linear[k * n + i] = koksma__l2_polynomial(row->a24, xs[i * dim + k]) / 24;
            g[i] = koksma__l2_polynomial(row->g, xs[i * dim + k]);
        }
        for (size_t i = 0; i < n; i++) {
            double *to = j->kernels + (k * n + i) * j->stride;
            for (size_t l = 0; l < n; l++) {
                const double t = fabs(xs[i * dim + k] - xs[l * dim + k]);
                to[l] = g[i] + g[l] + t * (row->q + row->r * t);
            }
        }
    }
    return KOKSMA_OK;
}

/* Returns the kernels of point p with all points, without the factor of coordinate k. */
static const double *others(const job *j, size_t k, size_t p, double *room)
{
    if (j->dim == 2) {
        return j->kernels + ((1 - k) * j->n + p) * j->stride;
    }
    for (size_t i = 0; i < j->n; i++) {
        room[i] = 1;
    }
    for (size_t l = 0; l < j->dim; l++) {
        const double *restrict factor = j->kernels + (l * j->n + p) * j->stride;
        for (size_t i = 0; i < j->n && l != k; i++) {
            room[i] *= factor[i];
        }
    }
    return room;
}

/* Returns the change of n^2 times the squared discrepancy when points p and q swap coordinate k. */
static double change(const job *j, size_t k, size_t p, size_t q)
{
    const double *restrict rp = others(j, k, p, j->products), *restrict rq = others(j, k, q, j->products + j->stride);
    const double *restrict kp = j->kernels + (k * j->n + p) * j->stride, *restrict kq =
                                                                             j->kernels + (k * j->n + q) * j->stride;
    double sums[LANES] = {0}, pairs = 0, linear_p = 1, linear_q = 1;
    for (size_t i = 0; i < j->stride; i += LANES) {
        for (size_t l = 0; l < LANES; l++) {
            sums[l] += (rp[i + l] - rq[i + l]) * (kq[i + l] - kp[i + l]);
        }
    }
    for (size_t l = 0; l < LANES; l++) {
        pairs += sums[l];
    }
    pairs -= (rp[p] - rq[p]) * (kq[p] - kp[p]) + (rp[q] - rq[q]) * (kq[q] - kp[q]);
    for (size_t l = 0; l < j->dim; l++) {
        linear_p *= l == k ? 1 : j->linear[l * j->n + p];
        linear_q *= l == k ? 1 : j->linear[l * j->n + q];
    }
    return 2 * pairs + (rp[p] - rq[q]) * (kq[q] - kp[p]) -
           2 * (double)j->n * (linear_p - linear_q) * (j->linear[k * j->n + q] - j->linear[k * j->n + p]);
}

static void exchange(double *a, double *b)
{
    const double was = *a;
    *a = *b;
    *b = was;
}

/* Swaps coordinate k of points p and q, and updates orders, kernels and integrals. */
static void swap(job *j, double *xs, size_t k, size_t p, size_t q)
{
    const size_t n = j->n;
    double *matrix = j->kernels + k * n * j->stride;
    uint32_t *order = j->order + k * n, *rank = j->rank + k * n;
    for (size_t i = 0; i < n; i++) {
        exchange(matrix + p * j->stride + i, matrix + q * j->stride + i);
    }
    for (size_t i = 0; i < n; i++) {
        exchange(matrix + i * j->stride + p, matrix + i * j->stride + q);
    }
    exchange(j->linear + k * n + p, j->linear + k * n + q);
    exchange(xs + p * j->dim + k, xs + q * j->dim + k);
    const uint32_t was = rank[p];
    rank[p] = rank[q];
    rank[q] = was;
    order[rank[p]] = (uint32_t)p;
    order[rank[q]] = (uint32_t)q;
}

/* Proposes SWAPS n swaps; each is accepted if the change is below a random threshold whose mean is `threshold`. */
static koksma_status propose(job *j, double *xs, double threshold, const koksma_run *run)
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
        if (p != q && change(j, k, p, q) < 4 * threshold * u * v) {
            swap(j, xs, k, p, q);
        }
    }
    return KOKSMA_OK;
}

/* Gives the points the coordinates (i + 1/2)/n along each axis, in random order. */
static void shuffle(job *j, double *xs)
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
static koksma_status improve(job *j, koksma__descent *d, double *square)
{
    const size_t bytes = d->count * sizeof(double), n = j->n, dim = j->dim;
    const double reach = LEAP * *square * (double)(n * n);
    double next, *before = j->before;
    koksma_status status = prepare(j, d->points.xs);
    memcpy(before, d->points.xs, bytes);
    for (size_t stale = 0; stale < STALE * n * n && d->work < d->budget && !status; stale++) {
        const size_t k = koksma__next_below(&j->random, dim), p = koksma__next_below(&j->random, n),
                     q = koksma__next_below(&j->random, n);
        if (p == q || change(j, k, p, q) > reach) {
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
            status = prepare(j, before);
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
    job j;
    KOKSMA__TRY(job_init(&j, koksma__l2_row_of(measure->measure), points, seed));
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
        status = prepare(&j, d.points.xs);
        if (!status) {
            status = propose(&j, d.points.xs, round < ROUNDS ? threshold : 0, run);
            status = status ? status : koksma__descend(&d, FIT, &square);
            keep_better(&d, status ? INFINITY : square, &least, points);
        }
    }
    status = status ? status : koksma__descend(&d, KOKSMA__ITERATIONS, &square);
    keep_better(&d, status ? INFINITY : square, &least, points);
    d.cost = (double)(n * d.count);
    d.work = 0;
    d.budget = POLISH;
    status = status ? status : improve(&j, &d, &square);
    status = status ? status : koksma__descend(&d, KOKSMA__ITERATIONS, &square);
    keep_better(&d, status ? INFINITY : square, &least, points);
    koksma__descent_fini(&d);
    free(j.memory);
    return status;
}

static int serves(const koksma_spec *measure, const koksma_optimise_options *o)
{
    return koksma__l2_row_of(measure->measure) && !measure->measure->on_torus && o->keep == KOKSMA_KEEP_NONE &&
                   !o->n_projections && o->dim > 1 && o->n >= LEAST_N && o->n * o->n * (size_t)o->dim <= MOST_NUMBERS
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

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * exchange: minimises the L2 discrepancies of boxes. A move swaps one coordinate of two points, which preserves a
 * Latin hypercube, and the change of the value is computed in O(n d) instead of O(n^2 d) (Jin, Chen & Sudjianto
 * 2005).
 *
 * Let K = prod_k K_k be the kernel, a = prod_k a_k its integral, and let R_ij and B_i be these products without
 * factor k. When points p and q swap coordinate k, n^2 times the squared discrepancy changes by
 *
 *     2 sum_(j != p, q) (R_pj - R_qj) (K_k(q, j) - K_k(p, j)) + (R_pp - R_qq) (K_k(q, q) - K_k(p, p))
 *     - 2 n (B_p - B_q) (a_k(q) - a_k(p)),
 *
 * with the coordinates before the swap. Simulated annealing (Kirkpatrick, Gelatt & Vecchi 1983): a swap is accepted if
 * the squared discrepancy grows by less than -T log u, u uniform, with a temperature T that falls geometrically. The
 * first temperature differs between searches. For small sets the kernels of all pairs are stored (swaps.c).
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "optimise/search.h"

/* The number of coordinates that one search reads, with stored kernels and without: some hundredths and some tenths of
   a second. The temperature is that of ROUND proposals. */
static const double WORK = 1e8, SLOW_WORK = 3e7;
enum { ROUND = 64 };

/* WARMEST: the highest temperature at first, as a share of n^2 times the squared discrepancy. COLDEST: by how much it
   falls, and the span of first temperatures. */
static const double WARMEST = 3e-3, COLDEST = 0.03;

static double kernel(const koksma__l2_row *row, double u, double v)
{
    const double t = fabs(u - v);
    return koksma__l2_polynomial(row->g, u) + koksma__l2_polynomial(row->g, v) + t * (row->q + row->r * t);
}

/* Returns the kernel of two points without the factor of coordinate k. */
static double others(const koksma__l2_row *row, size_t dim, size_t k, const double *x, const double *y)
{
    double product = 1;
    for (size_t l = 0; l < dim; l++) {
        product *= l == k ? 1 : kernel(row, x[l], y[l]);
    }
    return product;
}

/* Returns the change of n^2 times the squared discrepancy when points p and q swap coordinate k. */
static double change(const koksma__l2_row *row, const koksma_points *points, size_t k, size_t p, size_t q)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    const double *x = points->xs + p * dim, *y = points->xs + q * dim;
    double pairs = 0, linear_p = 1, linear_q = 1;
    for (size_t j = 0; j < n; j++) {
        const double *z = points->xs + j * dim;
        if (j != p && j != q) {
            pairs += (others(row, dim, k, x, z) - others(row, dim, k, y, z)) *
                     (kernel(row, y[k], z[k]) - kernel(row, x[k], z[k]));
        }
    }
    for (size_t l = 0; l < dim; l++) {
        linear_p *= l == k ? 1 : koksma__l2_polynomial(row->a24, x[l]) / 24;
        linear_q *= l == k ? 1 : koksma__l2_polynomial(row->a24, y[l]) / 24;
    }
    const double selves =
        (others(row, dim, k, x, x) - others(row, dim, k, y, y)) * (kernel(row, y[k], y[k]) - kernel(row, x[k], x[k]));
    const double slope = (koksma__l2_polynomial(row->a24, y[k]) - koksma__l2_polynomial(row->a24, x[k])) / 24;
    return 2 * pairs + selves - 2 * (double)n * (linear_p - linear_q) * slope;
}

/* A walk over Latin hypercubes. The change by a swap comes from stored kernels where there is memory for them. */
typedef struct walk {
    koksma__swaps swaps; /* memory NULL: not stored */
    const koksma__l2_row *row;
    koksma_points points;
    koksma__stream random;
} walk;

static koksma_status walk_init(walk *w, const koksma_points *points, const koksma__l2_row *row, uint64_t seed)
{
    const size_t dim = (size_t)points->dim;
    *w = (walk){.row = row, .random = {.seed = seed}};
    KOKSMA__TRY(koksma_points_init(&w->points, points->n, points->dim));
    memcpy(w->points.xs, points->xs, points->n * dim * sizeof(double));
    if (points->n * points->n > KOKSMA__MOST_KERNELS / dim) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__swaps_init(&w->swaps, row, points, seed));
    return koksma__swaps_prepare(&w->swaps, points->xs);
}

static double change_of(const walk *w, size_t k, size_t p, size_t q)
{
    return w->swaps.memory ? koksma__swaps_change(&w->swaps, k, p, q) : change(w->row, &w->points, k, p, q);
}

static void swap(walk *w, size_t k, size_t p, size_t q)
{
    double *x = w->points.xs + p * (size_t)w->points.dim + k, *y = w->points.xs + q * (size_t)w->points.dim + k;
    const double swapped = *x;
    if (w->swaps.memory) {
        koksma__swaps_swap(&w->swaps, w->points.xs, k, p, q);
        return;
    }
    *x = *y;
    *y = swapped;
}

/* Anneals for a number of proposals from a temperature that falls geometrically. `sum`, n^2 times the squared
   discrepancy less a constant, follows the walk; `best` receives the set of its least value. */
static koksma_status anneal(walk *w, double temperature, size_t proposals, const koksma_run *run, koksma_points *best)
{
    const size_t n = w->points.n, dim = (size_t)w->points.dim, bytes = n * dim * sizeof(double);
    const double fall = koksma__pow(COLDEST, (double)ROUND / (double)proposals);
    double sum = 0, least = -1e-9 * temperature;
    koksma_status status = KOKSMA_OK;
    bool lower = false; /* the walk's set is the least, and not yet copied */
    for (size_t m = 0; m < proposals && !status; m++) {
        if (m % ROUND == 0) {
            status = koksma__ask(run);
            temperature *= fall;
        }
        const size_t k = koksma__next_below(&w->random, dim), p = koksma__next_below(&w->random, n),
                     q = koksma__next_below(&w->random, n);
        const double most = -temperature * koksma__log(koksma__next_unit(&w->random) + 0x1p-33);
        const double by = p == q ? (double)INFINITY : change_of(w, k, p, q);
        if (by < most) {
            if (lower && by > 0) {
                memcpy(best->xs, w->points.xs, bytes);
                lower = false;
            }
            swap(w, k, p, q);
            sum += by;
            lower = lower || sum < least;
            least = fmin(sum, least);
        }
    }
    if (lower) {
        memcpy(best->xs, w->points.xs, bytes);
    }
    return status;
}

static koksma_status search(const koksma_spec *measure, const koksma_optimise_options *o, uint64_t seed, double value,
                            const koksma_run *run, koksma_points *points)
{
    (void)o;
    const double n = (double)points->n;
    walk w;
    koksma_status status = walk_init(&w, points, koksma__l2_row_of(measure->measure), seed);
    const double hot = WARMEST * koksma__pow(COLDEST, koksma__next_unit(&w.random)) * value * value * n * n;
    const size_t proposals = (size_t)((w.swaps.memory ? WORK : SLOW_WORK) / (n * points->dim + 400));
    status = status ? status : anneal(&w, hot, proposals, run, points);
    free(w.swaps.memory);
    koksma_points_fini(&w.points);
    return status;
}

static int serves(const koksma_spec *measure, const koksma_optimise_options *o)
{
    return o->keep == KOKSMA_KEEP_LATIN && !o->n_projections && koksma__l2_row_of(measure->measure) ? 5 : 0;
}

const koksma_method koksma__method_exchange = {
    .name = "exchange",
    .title = "swaps of one coordinate of two points, which keep a Latin hypercube (L2 family)",
    .cite = "jin2005 kirkpatrick1983",
    .serves = serves,
    .search = search,
};

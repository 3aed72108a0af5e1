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
 * with the coordinates before the swap. Threshold accepting (Dueck & Scheuer 1990): a swap is accepted if the squared
 * discrepancy grows by less than a threshold that falls to 0.
 */
#include <math.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/l2_boxes.h"
#include "optimise/methods.h"

/* The number of coordinates that one search reads; this takes some tenths of a second. */
static const double WORK = 3e7;

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

static koksma_status search(const koksma_spec *measure, const koksma_optimise_options *o, uint64_t seed, double value,
                            const koksma_run *run, koksma_points *points)
{
    (void)o;
    koksma__stream random = {.seed = seed};
    const koksma__l2_row *row = koksma__l2_row_of(measure->measure);
    const size_t n = points->n, dim = (size_t)points->dim;
    const double threshold = value * value * (double)(n * n) * 0.01 * koksma__next_unit(&random);
    const size_t swaps = (size_t)(WORK / ((double)n * (double)dim + 50));
    for (size_t m = 0; m < swaps; m++) {
        KOKSMA__TRY(koksma__ask(run));
        const size_t k = koksma__next_below(&random, dim), p = koksma__next_below(&random, n),
                     q = koksma__next_below(&random, n);
        double *x = points->xs + p * dim + k, *y = points->xs + q * dim + k;
        if (p != q && change(row, points, k, p, q) < threshold * (1 - (double)(m + 1) / (double)swaps)) {
            const double swapped = *x;
            *x = *y;
            *y = swapped;
        }
    }
    return KOKSMA_OK;
}

static int serves(const koksma_spec *measure, const koksma_optimise_options *o)
{
    return o->keep == KOKSMA_KEEP_LATIN && !o->n_projections && koksma__l2_row_of(measure->measure) ? 5 : 0;
}

const koksma_method koksma__method_exchange = {
    .name = "exchange",
    .title = "swaps of one coordinate of two points, which keep a Latin hypercube (L2 family)",
    .cite = "jin2005 dueck1990",
    .serves = serves,
    .search = search,
};

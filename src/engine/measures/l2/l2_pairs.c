/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The L2 discrepancies by sums over all pairs, O(n^2 d), and the terms that all methods share. A kernel sums the pairs
 * in blocks of rows, and the blocks are added in order. The three terms of the square, which cancel, are added in
 * double-double arithmetic.
 */
#include "measures/l2/l2.h"

#include <math.h>
#include <stdlib.h>

#include "core/double_double.h"
#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "kernels/kernels.h"

enum { ROWS_PER_BLOCK = 128 };

double koksma__l2_polynomial(const double f[4], double u)
{
    const double z = u - 0.5;
    return f[0] + f[1] * z + f[2] * z * z + f[3] * fabs(z);
}

typedef struct pairs {
    const koksma__l2_row *row;
    size_t n;
    int dim;
    double *u, *g;   /* u[k n + j] is coordinate k of point j, and g[k n + j] the function g of the kernel at this
                          coordinate */
    double *hi, *lo; /* hi[j] + lo[j]: prod_k a(x_jk), for which doubles would not do: their rounding errors would all
                          have the same sign for points on a grid */
    koksma__sum *sums; /* the sum of each block of rows */
} pairs;

static koksma_status sum_block(void *context, size_t block)
{
    const pairs *p = context;
    const size_t first = block * ROWS_PER_BLOCK;
    const size_t end = first + ROWS_PER_BLOCK < p->n ? first + ROWS_PER_BLOCK : p->n;
    double sum[2];
    koksma__kernels()->l2_pairs(first, end, p->n, p->dim, p->u, p->g, p->row->q, p->row->r, sum);
    p->sums[block] = (koksma__sum){sum[0], sum[1]};
    return KOKSMA_OK;
}

/* Computes sum_i prod_k a(x_ik) and sum_i prod_k K(x_ik, x_ik), and fills u and g. */
static void sum_points(const pairs *p, const koksma_points *points, koksma__dd *linear, koksma__sum *self)
{
    for (size_t i = 0; i < p->n; i++) {
        double k_ii = 1;
        for (size_t k = 0; k < (size_t)p->dim; k++) {
            const double x = points->xs[i * (size_t)p->dim + k];
            p->u[k * p->n + i] = x;
            p->g[k * p->n + i] = koksma__l2_polynomial(p->row->g, x);
            k_ii *= 2 * p->g[k * p->n + i];
        }
        koksma__sum_add(self, k_ii);
    }
    koksma__kernels()->l2_linear(p->n, p->dim, p->u, p->n, p->row->a24, p->hi, p->lo);
    for (size_t i = 0; i < p->n; i++) {
        *linear = koksma__dd_add(*linear, (koksma__dd){p->hi[i], p->lo[i]});
    }
}

/* Adds the three terms of the square, which cancel, in 106 bits. */
double koksma__l2_combine(const koksma__l2_row *row, int dim, size_t n, koksma__dd linear,
                          const koksma__sum *over_pairs)
{
    const double count = (double)n;
    const koksma__dd c = koksma__dd_divide((koksma__dd){row->c12, 0}, 12);
    koksma__dd total = c;
    for (int k = 1; k < dim; k++) {
        total = koksma__dd_mul(total, c);
    }
    const koksma__dd pair_sum = koksma__dd_quick_sum(over_pairs->total, over_pairs->lost);
    total = koksma__dd_add(total, koksma__dd_divide(koksma__dd_scale(linear, -2), count));
    return koksma__dd_add(total, koksma__dd_divide(koksma__dd_divide(pair_sum, count), count)).hi;
}

koksma_status koksma__l2_by_pairs(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                  double *square)
{
    const size_t n = points->n, coordinates = n * (size_t)points->dim;
    const size_t n_blocks = (n + ROWS_PER_BLOCK - 1) / ROWS_PER_BLOCK;
    const size_t bytes = 2 * (coordinates + n) * sizeof(double) + n_blocks * sizeof(koksma__sum);
    pairs p = {.row = row, .n = n, .dim = points->dim, .u = malloc(bytes)};
    KOKSMA__REQUIRE_MEMORY(p.u, bytes);
    p.g = p.u + coordinates;
    p.hi = p.g + coordinates;
    p.lo = p.hi + n;
    p.sums = (koksma__sum *)(p.lo + n);
    koksma__dd linear = {0, 0};
    koksma__sum both = {0};
    sum_points(&p, points, &linear, &both);
    const koksma_status status = koksma__parallel(run, n_blocks, sum_block, &p);
    for (size_t block = 0; block < n_blocks && !status; block++) {
        koksma__sum_add(&both, 2 * p.sums[block].total);
        koksma__sum_add(&both, 2 * p.sums[block].lost);
    }
    *square = koksma__l2_combine(row, points->dim, n, linear, &both);
    free(p.u);
    return status;
}

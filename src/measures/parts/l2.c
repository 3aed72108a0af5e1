/* SPDX-License-Identifier: Apache-2.0 */
#include "measures/parts/l2.h"

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "kernels/kernels.h"

enum { MERGE_FROM = 256, ROWS_PER_BLOCK = 128 };

const koksma__l2_row koksma__l2_rows[KOKSMA__L2_KINDS] = {
    /* 1 - max(u, v) */
    [KOKSMA__L2_STAR] = {4, {9, -12, -12, 0}, {0.25, -0.5, 0, 0}, -0.5, 0},
    /* (1 - max(u, v)) min(u, v) */
    [KOKSMA__L2_EXTREME] = {1, {3, 0, -12, 0}, {0.125, 0, -0.5, 0}, -0.5, 0.5},
    /* 1/2 - t + t^2, t = |u - v| */
    [KOKSMA__L2_PERIODIC] = {4, {8, 0, 0, 0}, {0.25, 0, 0, 0}, -1, 1},
    /* 3/2 - t + t^2 */
    [KOKSMA__L2_WRAPAROUND] = {16, {32, 0, 0, 0}, {0.75, 0, 0, 0}, -1, 1},
    /* 2 - max(u, v) */
    [KOKSMA__L2_MODIFIED] = {16, {33, -12, -12, 0}, {0.75, -0.5, 0, 0}, -0.5, 0},
    /* 1 + |z_u|/2 + |z_v|/2 - t/2 */
    [KOKSMA__L2_CENTERED] = {13, {24, 0, -12, 12}, {0.5, 0, 0, 0.5}, -0.5, 0},
    /* 15/8 - |z_u|/4 - |z_v|/4 - 3t/4 + t^2/2 */
    [KOKSMA__L2_MIXTURE] = {19, {40, 0, -6, -6}, {0.9375, 0, 0, -0.25}, -0.75, 0.5},
    /* 2 (1 - t) */
    [KOKSMA__L2_SYMMETRIC] = {16, {36, 0, -48, 0}, {1, 0, 0, 0}, -2, 0},
};

double koksma__l2_polynomial(const double f[4], double u)
{
    const double z = u - 0.5;
    return f[0] + f[1] * z + f[2] * z * z + f[3] * fabs(z);
}

typedef struct pairs {
    const koksma__l2_row *row;
    size_t n;
    int dim;
    double *u, *g;     /* coordinate by coordinate */
    koksma__sum *sums; /* one a block of rows */
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

/* sum_i prod a(x_i) and sum_i prod K(x_i, x_i). */
static void sum_points(const pairs *p, const koksma_points *points, koksma__sum *linear, koksma__sum *self)
{
    for (size_t i = 0; i < p->n; i++) {
        double a = 1, k_ii = 1;
        for (size_t k = 0; k < (size_t)p->dim; k++) {
            const double x = points->xs[i * (size_t)p->dim + k];
            p->u[k * p->n + i] = x;
            p->g[k * p->n + i] = koksma__l2_polynomial(p->row->g, x);
            a *= koksma__l2_polynomial(p->row->a24, x) / 24;
            k_ii *= 2 * p->g[k * p->n + i];
        }
        koksma__sum_add(linear, a);
        koksma__sum_add(self, k_ii);
    }
}

koksma_status koksma__l2_by_pairs(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                  double *square)
{
    const size_t n = points->n, coordinates = n * (size_t)points->dim;
    const size_t n_blocks = (n + ROWS_PER_BLOCK - 1) / ROWS_PER_BLOCK;
    const size_t bytes = 2 * coordinates * sizeof(double) + n_blocks * sizeof(koksma__sum);
    pairs p = {.row = row, .n = n, .dim = points->dim, .u = malloc(bytes)};
    if (!p.u) {
        return koksma__fail_memory(bytes);
    }
    p.g = p.u + coordinates;
    p.sums = (koksma__sum *)(p.g + coordinates);
    koksma__sum linear = {0}, both = {0}, total = {0};
    sum_points(&p, points, &linear, &both);
    const koksma_status status = koksma__parallel(run, n_blocks, sum_block, &p);
    for (size_t block = 0; block < n_blocks && !status; block++) {
        koksma__sum_add(&both, 2 * p.sums[block].total);
        koksma__sum_add(&both, 2 * p.sums[block].lost);
    }
    const double count = (double)n;
    koksma__sum_add(&total, pow(row->c12 / 12, points->dim));
    koksma__sum_add(&total, -2 * koksma__sum_value(&linear) / count);
    koksma__sum_add(&total, koksma__sum_value(&both) / count / count);
    *square = koksma__sum_value(&total);
    free(p.u);
    return status;
}

koksma_status koksma__l2(koksma__l2_kind kind, const koksma_points *points, const koksma_run *run, koksma_value *out)
{
    const bool merge = points->dim <= 2 && points->n >= MERGE_FROM && points->n < (size_t)1 << 28;
    const koksma_status status =
        (merge ? koksma__l2_by_merging : koksma__l2_by_pairs)(&koksma__l2_rows[kind], points, run, &out->square);
    out->square = fmax(out->square, 0);
    out->value = sqrt(out->square);
    return status;
}

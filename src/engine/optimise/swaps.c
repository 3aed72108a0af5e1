/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Swaps of one coordinate of two points. A swap of coordinate k of points p and q changes n^2 times the squared
 * discrepancy by (Jin, Chen & Sudjianto 2005)
 *
 *     2 sum_(j != p, q) (R_pj - R_qj) (K_k(q, j) - K_k(p, j)) + (R_pp - R_qq) (K_k(q, q) - K_k(p, p))
 *     - 2 n (B_p - B_q) (a_k(q) - a_k(p)),
 *
 * where R is the product of the kernels K_l, and B the product of their integrals a_l, over the coordinates l != k.
 * The kernels of all pairs are stored, one matrix for each coordinate: a change is a sum along rows, in fixed order,
 * and a swap of coordinate k exchanges two rows and two columns of matrix k.
 */
#include "optimise/search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "measures/shared/shared.h"

enum { LANES = 8 };

koksma_status koksma__swaps_init(koksma__swaps *j, const koksma__l2_row *row, const koksma_points *points,
                                 uint64_t seed)
{
    const size_t n = points->n, dim = (size_t)points->dim, stride = (n + LANES - 1) / LANES * LANES;
    const size_t numbers = (dim * n + 2) * stride + 2 * dim * n,
                 bytes = numbers * sizeof(double) + 2 * dim * n * sizeof(uint32_t);
    *j = (koksma__swaps){
        .row = row, .n = n, .dim = dim, .stride = stride, .random = {.seed = seed}, .memory = calloc(1, bytes)};
    KOKSMA__REQUIRE_MEMORY(j->memory, bytes);
    j->kernels = j->memory;
    j->products = j->kernels + dim * n * stride;
    j->linear = j->products + 2 * stride;
    j->before = j->linear + dim * n;
    j->order = (uint32_t *)(j->before + dim * n);
    j->rank = j->order + dim * n;
    return KOKSMA_OK;
}

koksma_status koksma__swaps_prepare(koksma__swaps *j, const double *xs)
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
static const double *others(const koksma__swaps *j, size_t k, size_t p, double *room)
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

double koksma__swaps_change(const koksma__swaps *j, size_t k, size_t p, size_t q)
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

void koksma__swaps_swap(koksma__swaps *j, double *xs, size_t k, size_t p, size_t q)
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

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Computes the square of an L2 discrepancy and its gradient by sums over pairs. With K = prod_k K_k,
 *
 *     d square / d x_ik = (2/n^2) sum_(j != i) K_k'(x_ik, x_jk) prod_(l != k) K_l + (1/n^2) d K(x_i, x_i) / d x_ik
 *                         - (2/n) a'(x_ik) prod_(l != k) a(x_il),
 *     K_k'(u, v) = g'(u) + sign(u - v) (q + 2 r |u - v|).
 *
 * To leave out one factor of a product, multiply the product of the factors before it by the product of the factors
 * after it. For point i the factors with all other points are stored in one row for each coordinate, so that the
 * compiler can vectorise over points; sums are in index order.
 */
#include "measures/l2/l2.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"

/* Returns the derivative of koksma__l2_polynomial. */
static double slope(const double f[4], double u)
{
    const double z = u - 0.5;
    return f[1] + 2 * f[2] * z + (z > 0 ? f[3] : z < 0 ? -f[3] : 0);
}

typedef struct job {
    const koksma__l2_row *row;
    size_t n, dim;
    double *u, *g;            /* u[k n + j] is coordinate k of point j, g[k n + j] the function g of it */
    double *factors, *behind; /* kernel K_k of point i and each other point; product of the factors after k */
} job;

/* Adds to gradient, for each coordinate k of point i, the sum over j != i of K_k' times the other factors, without
   the factor 2 / n^2. Returns the sum of K over all j. */
static double pairs_of(const job *p, size_t i, double *gradient)
{
    const size_t n = p->n, dim = p->dim;
    const double q = p->row->q, r = p->row->r;
    double *product = p->behind + dim * n, sum = 0;
    for (size_t j = 0; j < n; j++) {
        product[j] = 1;
    }
    for (size_t k = dim; k-- > 0;) {
        const double *restrict u = p->u + k * n, *restrict g = p->g + k * n;
        double *restrict factor = p->factors + k * n, *restrict behind = p->behind + k * n;
        for (size_t j = 0; j < n; j++) {
            const double t = fabs(u[i] - u[j]);
            factor[j] = (g[i] + g[j]) + t * (q + r * t);
            behind[j] = product[j];
            product[j] *= factor[j];
        }
    }
    for (size_t j = 0; j < n; j++) {
        sum += product[j];
        product[j] = j == i ? 0 : 1;
    }
    for (size_t k = 0; k < dim; k++) {
        const double *restrict u = p->u + k * n, *restrict factor = p->factors + k * n;
        const double *restrict behind = p->behind + k * n, own = slope(p->row->g, u[i]);
        for (size_t j = 0; j < n; j++) {
            const double d = u[i] - u[j], sign = (d > 0) - (d < 0);
            gradient[k] += (own + sign * q + 2 * r * d) * product[j] * behind[j];
            product[j] *= factor[j];
        }
    }
    return sum;
}

/* Adds scale times the derivatives of prod_k f(x_k) to gradient. Returns the product. */
static double add_product(const double f[4], const double *x, size_t dim, double scale, double *gradient)
{
    double all = 1;
    for (size_t k = 0; k < dim; k++) {
        double others = scale;
        for (size_t l = 0; l < dim; l++) {
            others *= l == k ? 1 : koksma__l2_polynomial(f, x[l]);
        }
        gradient[k] += others * slope(f, x[k]);
        all *= koksma__l2_polynomial(f, x[k]);
    }
    return all;
}

koksma_status koksma__l2_gradient(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                  double *square, double *gradient)
{
    const size_t n = points->n, dim = (size_t)points->dim, bytes = (4 * dim + 1) * n * sizeof(double);
    job p = {.row = row, .n = n, .dim = dim, .u = malloc(bytes)};
    KOKSMA__REQUIRE_MEMORY(p.u, bytes);
    p.g = p.u + dim * n;
    p.factors = p.g + dim * n;
    p.behind = p.factors + dim * n;
    double a[4], twice[4], linear = 0, all_pairs = 0;
    const double count = (double)n;
    for (int c = 0; c < 4; c++) {
        a[c] = row->a24[c] / 24;
        twice[c] = 2 * row->g[c];
    }
    for (size_t i = 0; i < n * dim; i++) {
        p.u[i % dim * n + i / dim] = points->xs[i];
        p.g[i % dim * n + i / dim] = koksma__l2_polynomial(row->g, points->xs[i]);
    }
    const size_t asked = KOKSMA__ASKED / (n * dim) + 1; /* points between two questions */
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < n && !status; i++) {
        double *own = gradient + i * dim;
        status = i % asked ? KOKSMA_OK : koksma__ask(run);
        for (size_t k = 0; k < dim; k++) {
            own[k] = 0;
        }
        all_pairs += pairs_of(&p, i, own);
        for (size_t k = 0; k < dim; k++) {
            own[k] *= 2 / (count * count);
        }
        add_product(twice, points->xs + i * dim, dim, 1 / (count * count), own);
        linear += add_product(a, points->xs + i * dim, dim, -2 / count, own);
    }
    *square = koksma__pow(row->c12 / 12, (double)dim) - 2 * linear / count + all_pairs / (count * count);
    free(p.u);
    return status;
}

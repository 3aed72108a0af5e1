/* SPDX-License-Identifier: Apache-2.0 */
/* Computes the products over single points and the sums over pairs of points in the L2 discrepancies. The pairs of a
   point i with all j < i (row i) are summed in a fixed number of lanes, so that every instruction set adds in the same
   order and gives the same bits. The row sums are added with compensation. */
#include <math.h>

#include "core/double_double.h"
#include "core/sum.h"
#include "kernels/kernels.h"

enum { LANES = 16, CHUNK = 64 };

typedef struct shape {
    size_t n;
    int dim;
    const double *u, *g;
    double q, r;
} shape;

/* Computes the factors that coordinate k contributes to the pairs of point i with points j .. j + count - 1 (l2_pairs
   in kernels.def): stores them in out[0 .. count) for k = 0, and multiplies out[0 .. count) by them for other k. */
static inline void multiply(const shape *s, size_t k, size_t i, size_t j, size_t count, double *restrict out)
{
    const double *restrict u = s->u + k * s->n + j, *restrict g = s->g + k * s->n + j;
    const double u_i = s->u[k * s->n + i], g_i = s->g[k * s->n + i], q = s->q, r = s->r;
    if (k == 0) {
        for (size_t l = 0; l < count; l++) {
            const double t = fabs(u_i - u[l]);
            out[l] = (g_i + g[l]) + t * (q + r * t);
        }
    } else {
        for (size_t l = 0; l < count; l++) {
            const double t = fabs(u_i - u[l]);
            out[l] *= (g_i + g[l]) + t * (q + r * t);
        }
    }
}

/* Returns the sum over all j < i of the product, over the coordinates, of these factors for points i and j. */
static double row(const shape *s, size_t i)
{
    double lanes[LANES] = {0}, products[CHUNK];
    size_t j = 0;
    for (; j + CHUNK <= i; j += CHUNK) {
        for (size_t k = 0; k < (size_t)s->dim; k++) {
            multiply(s, k, i, j, CHUNK, products);
        }
        for (size_t c = 0; c < CHUNK; c += LANES) {
            for (size_t l = 0; l < LANES; l++) {
                lanes[l] += products[c + l];
            }
        }
    }
    for (size_t k = 0; k < (size_t)s->dim; k++) {
        multiply(s, k, i, j, i - j, products);
    }
    for (size_t c = 0; c < i - j; c++) {
        lanes[c % LANES] += products[c];
    }
    for (size_t half = LANES / 2; half > 0; half /= 2) {
        for (size_t l = 0; l < half; l++) {
            lanes[l] += lanes[l + half];
        }
    }
    return lanes[0];
}

void KERNEL_NAME(l2_pairs)(size_t first, size_t end, size_t n, int dim, const double *u, const double *g, double q,
                           double r, double sum[2])
{
    const shape s = {n, dim, u, g, q, r};
    koksma__sum pairs = {0};
    for (size_t i = first; i < end; i++) {
        koksma__sum_add(&pairs, row(&s, i));
    }
    sum[0] = pairs.total;
    sum[1] = pairs.lost;
}

/* Multiplies double-doubles by a(u[i]) / 24, i < count: the loop of the reference, which the compiler vectorises. */
static inline void multiply_linear(const double f[4], size_t count, const double *restrict u, double *restrict hi,
                                   double *restrict lo)
{
    for (size_t i = 0; i < count; i++) {
        const double z = u[i] - 0.5;
        koksma__dd a = {f[0], 0};
        a = f[1] != 0 ? koksma__dd_add(a, koksma__dd_product(f[1], z)) : a;
        a = f[2] != 0 ? koksma__dd_add(a, koksma__dd_scale(koksma__dd_product(z, z), f[2])) : a;
        a = f[3] != 0 ? koksma__dd_add(a, koksma__dd_product(f[3], fabs(z))) : a;
        const koksma__dd product = koksma__dd_mul((koksma__dd){hi[i], lo[i]}, koksma__dd_divide(a, 24));
        hi[i] = product.hi;
        lo[i] = product.lo;
    }
}

void KERNEL_NAME(l2_linear)(size_t count, int dim, const double *u, size_t stride, const double f[4], double *hi,
                            double *lo)
{
    for (size_t i = 0; i < count; i++) {
        hi[i] = 1;
        lo[i] = 0;
    }
    for (size_t i = 0; i < count; i += CHUNK) {
        for (size_t k = 0; k < (size_t)dim; k++) {
            multiply_linear(f, count - i < CHUNK ? count - i : CHUNK, u + k * stride + i, hi + i, lo + i);
        }
    }
}

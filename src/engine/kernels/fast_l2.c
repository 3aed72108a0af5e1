/* SPDX-License-Identifier: Apache-2.0 */
/* Computes the sums over points and over pairs of points in the L2 discrepancies. The pairs of a point i with all j < i (row i) are
   summed in a fixed number of lanes, so that every instruction set adds in the same order and gives the same bits.
   The row sums are added with compensation. */
#include <math.h>
#include <string.h>

#include "core/double_double.h"
#include "core/sum.h"
#include "kernels/kernels.h"

enum { LANES = 16, CHUNK = 64 };

void KERNEL_NAME(l2_pairs)(size_t first, size_t end, size_t n, int dim, const double *u, const double *g, double q,
                           double r, double sum[2]);
void KERNEL_NAME(l2_linear)(size_t count, int dim, const double *u, size_t stride, const double f[4], double *hi,
                            double *lo);

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

/* LANES double-doubles. The loops have no branches, so that the compiler makes vectors of them. */
typedef struct lanes_dd {
    double hi[LANES], lo[LANES];
} lanes_dd;

static inline koksma__dd get(const lanes_dd *a, size_t l)
{
    return (koksma__dd){a->hi[l], a->lo[l]};
}

static inline void put(lanes_dd *a, size_t l, koksma__dd x)
{
    a->hi[l] = x.hi;
    a->lo[l] = x.lo;
}

/* Multiplies by a(u) / 24 of LANES coordinates. */
static inline void multiply_linear(const double f[4], const double u[LANES], lanes_dd *product)
{
    lanes_dd a;
    double z[LANES];
    for (size_t l = 0; l < LANES; l++) {
        z[l] = u[l] - 0.5;
        put(&a, l, (koksma__dd){f[0], 0});
    }
    if (f[1] != 0) {
        for (size_t l = 0; l < LANES; l++) {
            put(&a, l, koksma__dd_add(get(&a, l), koksma__dd_product(f[1], z[l])));
        }
    }
    if (f[2] != 0) {
        for (size_t l = 0; l < LANES; l++) {
            put(&a, l, koksma__dd_add(get(&a, l), koksma__dd_scale(koksma__dd_product(z[l], z[l]), f[2])));
        }
    }
    if (f[3] != 0) {
        for (size_t l = 0; l < LANES; l++) {
            put(&a, l, koksma__dd_add(get(&a, l), koksma__dd_product(f[3], fabs(z[l]))));
        }
    }
    for (size_t l = 0; l < LANES; l++) {
        put(product, l, koksma__dd_mul(get(product, l), koksma__dd_divide(get(&a, l), 24)));
    }
}

void KERNEL_NAME(l2_linear)(size_t count, int dim, const double *u, size_t stride, const double f[4], double *hi,
                            double *lo)
{
    for (size_t i = 0; i < count; i += LANES) {
        const size_t some = count - i < LANES ? count - i : LANES;
        lanes_dd product;
        for (size_t l = 0; l < LANES; l++) {
            put(&product, l, (koksma__dd){1, 0});
        }
        for (size_t k = 0; k < (size_t)dim; k++) {
            double rest[LANES] = {0};
            memcpy(rest, u + k * stride + i, some * sizeof *u);
            multiply_linear(f, rest, &product);
        }
        memcpy(hi + i, product.hi, some * sizeof *hi);
        memcpy(lo + i, product.lo, some * sizeof *lo);
    }
}

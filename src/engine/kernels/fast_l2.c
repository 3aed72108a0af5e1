/* SPDX-License-Identifier: Apache-2.0 */
/* Computes the products over single points and the sums over pairs of points in the L2 discrepancies. The pairs of a
   point i with all j < i (row i) are summed in a fixed number of lanes, so that every instruction set adds in the same
   order and gives the same bits. The row sums are added with compensation. */
#include <math.h>
#include <string.h>

#include "core/sum.h"
#include "kernels/kernels.h"
#include "kernels/lanes64.h"

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

/* The double-doubles of core/double_double.h in lanes, operation by operation. */
typedef struct lanes_dd {
    lanes64_d hi, lo;
} lanes_dd;

static inline lanes_dd lanes_sum(lanes64_d a, lanes64_d b)
{
    const lanes64_d s = a + b, t = s - a;
    return (lanes_dd){s, (a - (s - t)) + (b - t)};
}

static inline lanes_dd lanes_quick_sum(lanes64_d a, lanes64_d b)
{
    const lanes64_d s = a + b;
    return (lanes_dd){s, b - (s - a)};
}

static inline lanes_dd lanes_product(lanes64_d a, lanes64_d b)
{
    const lanes64_d p = a * b, sa = a * 134217729.0, sb = b * 134217729.0;
    const lanes64_d ah = sa - (sa - a), al = a - ah, bh = sb - (sb - b), bl = b - bh;
    return (lanes_dd){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

static inline lanes_dd lanes_add(lanes_dd a, lanes_dd b)
{
    const lanes_dd s = lanes_sum(a.hi, b.hi), t = lanes_sum(a.lo, b.lo);
    const lanes_dd v = lanes_quick_sum(s.hi, s.lo + t.hi);
    return lanes_quick_sum(v.hi, v.lo + t.lo);
}

static inline lanes_dd lanes_mul(lanes_dd a, lanes_dd b)
{
    const lanes_dd p = lanes_product(a.hi, b.hi);
    return lanes_quick_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static inline lanes_dd lanes_scale(lanes_dd a, lanes64_d b)
{
    const lanes_dd p = lanes_product(a.hi, b);
    return lanes_quick_sum(p.hi, p.lo + a.lo * b);
}

static inline lanes_dd lanes_divide(lanes_dd a, lanes64_d b)
{
    const lanes64_d q = a.hi / b;
    const lanes_dd p = lanes_product(q, b), rest = lanes_add(a, (lanes_dd){-p.hi, -p.lo});
    return lanes_quick_sum(q, rest.hi / b);
}

/* a(u) / 24 */
static inline lanes_dd linear(const double f[4], lanes64_d u)
{
    const lanes64_d z = u - 0.5;
    lanes_dd a = {lanes64_splat_d(f[0]), lanes64_splat_d(0)};
    if (f[1] != 0) {
        a = lanes_add(a, lanes_product(lanes64_splat_d(f[1]), z));
    }
    if (f[2] != 0) {
        a = lanes_add(a, lanes_scale(lanes_product(z, z), lanes64_splat_d(f[2])));
    }
    if (f[3] != 0) {
        a = lanes_add(a, lanes_product(lanes64_splat_d(f[3]), lanes64_abs(z)));
    }
    return lanes_divide(a, lanes64_splat_d(24));
}

void KERNEL_NAME(l2_linear)(size_t count, int dim, const double *u, size_t stride, const double f[4], double *hi,
                            double *lo)
{
    for (size_t i = 0; i < count; i += LANES64) {
        const size_t some = count - i < LANES64 ? count - i : LANES64;
        lanes_dd product = {lanes64_splat_d(1), lanes64_splat_d(0)};
        for (size_t k = 0; k < (size_t)dim; k++) {
            double rest[LANES64] = {0};
            memcpy(rest, u + k * stride + i, some * sizeof *u);
            product = lanes_mul(product, linear(f, lanes64_load_d(rest)));
        }
        memcpy(hi + i, &product.hi, some * sizeof *hi);
        memcpy(lo + i, &product.lo, some * sizeof *lo);
    }
}

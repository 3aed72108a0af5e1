/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Computes the L2 discrepancies of the line and the plane in O(n log n) with more than 100 bits. The kernels are
 * split: with G(z) = g(z) + r z^2, K = G(z_u) + G(z_v) - 2 r z_u z_v + q t, where t = |u - v|. In a product of two
 * kernels all factors except t separate into functions of u and of v. Sums with one factor t need the points in order
 * of one coordinate. The sum over pairs of t_x t_y is the same for every kernel; it needs the pairs in which one
 * point is below the other in both coordinates (l2_below.c). With t_y,i = sum_j |y_i - y_j|, and the points in x
 * order,
 *
 *     sum_ij t_x t_y = 4 sum_i x_i (sum over j < i with y_j < y_i of (y_i - y_j))
 *                      + 2 sum_i x_i sum_{j < i} (y_j - y_i) - 2 sum_i x_i t_y,i.
 *
 * Coordinates are rounded to whole numbers z of units 2^-bits, and all sums over points are sums of whole numbers.
 * Two kinds of term in these sums are rounded: a moment of more than 112 bits is cut to 112 bits; and in a product of
 * two such factors, each split into halves of 56 bits, the product of the low halves is dropped. The sums are then
 * combined as double-doubles. For n <= 2^21 the unit is 2^-53, which is the spacing of doubles near 1. Moving a point
 * by such a distance changes the square by less than 1e-16/n.
 */
#include "measures/l2/l2.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/double_double.h"
#include "core/parallel.h"
#include "core/status.h"
#include "measures/shared/shared.h"

#ifndef __SIZEOF_INT128__
/* Compilers for 32-bit processors have no 128-bit integers. With these compilers the pairs are summed in O(n^2). */
koksma_status koksma__l2_by_sorting(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                    double *square)
{
    return koksma__l2_by_pairs(row, points, run, square);
}

#else

enum { POINTS_PER_BLOCK = 4096, LOW_BITS = 56, FACTOR_BITS = 112, G_SCALE = 16 };

typedef koksma__int128 wide;
typedef koksma__dd dd;
typedef koksma__l2_point point;

/* A factor of a product: high 2^LOW_BITS + low, with 0 <= low < 2^LOW_BITS; it is below 2^(FACTOR_BITS + 1). */
typedef struct factor {
    int64_t high, low;
} factor;

/* An exact sum of products: (high 2^LOW_BITS + low) in units of the last bit of a product. */
typedef struct products {
    wide high, low;
} products;

/* The polynomial constant + linear x + absolute |x| + square x^2, in units of 2^-2bits / scale. */
typedef struct polynomial {
    wide constant;
    int64_t linear, absolute, square;
} polynomial;

/* Sums of x, y and x y over the points of a block, or, after add_up, over all points before the block. */
typedef struct partial {
    wide x, y, xy;
} partial;

enum { LINEAR, G, H, GH, G_TY, H_TX, CROSS, X_TY, GW, HZ, MOMENT_X, MOMENT_Y, T_X, SUMS };

typedef struct plane {
    const koksma__l2_row *row;
    size_t n;
    int dim, bits, t_shift, moment_shift;
    polynomial a, g;
    const double *xs;
    uint32_t *order;
    double *ys; /* the y coordinates in x order, for sorting */
    point *by_x, *by_y;
    partial *before_x, *before_y; /* the sums of each block, in x order and in y order */
    partial all;
    dd (*sums)[SUMS]; /* for each block */
} plane;

static factor factor_of(wide v)
{
    return (factor){(int64_t)(v >> LOW_BITS), (int64_t)(v & (((wide)1 << LOW_BITS) - 1))};
}

/* Adds a b to s, whose unit is 2^LOW_BITS times the unit of the product. The product of the low halves, which is
   below 2^(2 LOW_BITS), is ignored. */
static void add_product(products *s, factor a, factor b)
{
    s->high += (wide)a.high * b.high;
    s->low += (wide)a.high * b.low + (wide)a.low * b.high;
}

static void add_multiple(products *s, factor a, int64_t b)
{
    s->high += (wide)a.high * b;
    s->low += (wide)a.low * b;
}

/* Returns v 2^exponent as a double-double. */
static dd dd_of_wide(wide v, int exponent)
{
    const dd whole = koksma__dd_of_int(v);
    return (dd){ldexp(whole.hi, exponent), ldexp(whole.lo, exponent)};
}

static dd dd_of_sum(const products *s, int exponent)
{
    return koksma__dd_add(dd_of_wide(s->high, LOW_BITS + exponent), dd_of_wide(s->low, exponent));
}

static polynomial polynomial_of(const double f[4], double scale, int bits)
{
    return (polynomial){.constant = (wide)ldexp(f[0] * scale, 2 * bits),
                        .linear = (int64_t)(f[1] * scale),
                        .absolute = (int64_t)(f[3] * scale),
                        .square = (int64_t)(f[2] * scale)};
}

static factor evaluate(const polynomial *f, int64_t x, int bits)
{
    const int64_t first = f->linear * x + f->absolute * (x < 0 ? -x : x);
    return factor_of(f->constant + (wide)first * ((int64_t)1 << bits) + (wide)(f->square * x) * x);
}

static size_t end_of(const plane *p, size_t block)
{
    return p->n - block * POINTS_PER_BLOCK < POINTS_PER_BLOCK ? p->n : (block + 1) * POINTS_PER_BLOCK;
}

static void add_point(partial *to, const point *p)
{
    to->x += p->x;
    to->y += p->y;
    to->xy += (wide)p->x * p->y;
}

static koksma_status load_by_x(void *context, size_t block)
{
    const plane *p = context;
    partial here = {0, 0, 0};
    for (size_t i = block * POINTS_PER_BLOCK; i < end_of(p, block); i++) {
        const double *at = p->xs + p->order[i] * (size_t)p->dim, unit = ldexp(1, p->bits);
        p->ys[i] = p->dim == 2 ? at[1] : 0.5;
        p->by_x[i] = (point){llrint((at[0] - 0.5) * unit), llrint((p->ys[i] - 0.5) * unit), (uint32_t)i};
        add_point(&here, &p->by_x[i]);
    }
    p->before_x[block] = here;
    return KOKSMA_OK;
}

static koksma_status load_by_y(void *context, size_t block)
{
    const plane *p = context;
    partial here = {0, 0, 0};
    for (size_t j = block * POINTS_PER_BLOCK; j < end_of(p, block); j++) {
        p->by_y[j] = p->by_x[p->order[j]];
        add_point(&here, &p->by_y[j]);
    }
    p->before_y[block] = here;
    return KOKSMA_OK;
}

/* Replaces the sum of each block by the sum over all earlier blocks. Returns the sum over all blocks. */
static partial add_up(partial *sums, size_t n_blocks)
{
    partial total = {0, 0, 0};
    for (size_t block = 0; block < n_blocks; block++) {
        const partial here = sums[block];
        sums[block] = total;
        total = (partial){total.x + here.x, total.y + here.y, total.xy + here.xy};
    }
    return total;
}

/* Returns sum_j |u - u_j| for the number u of rank i. before: the sum of the numbers of lower rank; all: the sum of
   all numbers. */
static wide sum_of_distances(const plane *p, size_t i, int64_t u, wide before, wide all)
{
    return u * ((wide)2 * (wide)i + 1 - (wide)p->n) - 2 * before + all - u;
}

/* Computes the sums that need no order, and those that need for each point the sums over the points before it in x
   order. */
static koksma_status sum_by_x(void *context, size_t block)
{
    const plane *p = context;
    const int bits = p->bits, poly = -2 * bits, g_unit = poly - 4, t_unit = -bits - p->t_shift;
    partial before = p->before_x[block];
    products linear = {0, 0}, gh = {0, 0}, h_tx = {0, 0}, cross = {0, 0}, gw = {0, 0}, hz = {0, 0}, moment = {0, 0};
    wide all_g = 0, all_h = 0;
    for (size_t i = block * POINTS_PER_BLOCK; i < end_of(p, block); i++) {
        const point *at = &p->by_x[i];
        const factor g = evaluate(&p->g, at->x, bits), h = evaluate(&p->g, at->y, bits);
        const wide t_x = sum_of_distances(p, i, at->x, before.x, p->all.x);
        add_product(&linear, evaluate(&p->a, at->x, bits), evaluate(&p->a, at->y, bits));
        add_product(&gh, g, h);
        add_product(&h_tx, h, factor_of(t_x * ((wide)1 << p->t_shift)));
        add_multiple(&cross, factor_of(before.y - (wide)i * at->y), at->x);
        all_g += ((wide)g.high << LOW_BITS) + g.low;
        all_h += ((wide)h.high << LOW_BITS) + h.low;
        if (p->row->r != 0) {
            add_multiple(&gw, g, at->y);
            add_multiple(&hz, h, at->x);
            add_multiple(&moment, factor_of((at->x * before.y - before.xy) >> p->moment_shift), at->y);
        }
        add_point(&before, at);
    }
    dd *s = p->sums[block];
    s[LINEAR] = dd_of_sum(&linear, LOW_BITS + 2 * poly);
    s[G] = dd_of_wide(all_g, g_unit);
    s[H] = dd_of_wide(all_h, g_unit);
    s[GH] = dd_of_sum(&gh, LOW_BITS + 2 * g_unit);
    s[H_TX] = dd_of_sum(&h_tx, LOW_BITS + g_unit + t_unit);
    s[CROSS] = dd_of_sum(&cross, poly);
    s[GW] = dd_of_sum(&gw, g_unit - bits);
    s[HZ] = dd_of_sum(&hz, g_unit - bits);
    s[MOMENT_X] = dd_of_sum(&moment, poly - bits + p->moment_shift);
    return KOKSMA_OK;
}

/* Computes the sums that need for each point the sums over the points before it in y order. */
static koksma_status sum_by_y(void *context, size_t block)
{
    const plane *p = context;
    const int bits = p->bits, poly = -2 * bits, g_unit = poly - 4, t_unit = -bits - p->t_shift;
    partial before = p->before_y[block];
    products g_ty = {0, 0}, x_ty = {0, 0}, moment = {0, 0};
    for (size_t j = block * POINTS_PER_BLOCK; j < end_of(p, block); j++) {
        const point *at = &p->by_y[j];
        const wide t_y = sum_of_distances(p, j, at->y, before.y, p->all.y);
        const factor t = factor_of(t_y * ((wide)1 << p->t_shift));
        add_product(&g_ty, evaluate(&p->g, at->x, bits), t);
        add_multiple(&x_ty, t, at->x);
        if (p->row->r != 0) {
            add_multiple(&moment, factor_of((at->y * before.x - before.xy) >> p->moment_shift), at->x);
        }
        add_point(&before, at);
    }
    dd *s = p->sums[block];
    s[G_TY] = dd_of_sum(&g_ty, LOW_BITS + g_unit + t_unit);
    s[X_TY] = dd_of_sum(&x_ty, t_unit - bits);
    s[MOMENT_Y] = dd_of_sum(&moment, poly - bits + p->moment_shift);
    return KOKSMA_OK;
}

static koksma_status sum_line(void *context, size_t block)
{
    const plane *p = context;
    wide before = p->before_x[block].x, linear = 0, g = 0, t = 0;
    for (size_t i = block * POINTS_PER_BLOCK; i < end_of(p, block); i++) {
        const int64_t x = p->by_x[i].x;
        const factor a = evaluate(&p->a, x, p->bits), g_x = evaluate(&p->g, x, p->bits);
        linear += ((wide)a.high << LOW_BITS) + a.low;
        g += ((wide)g_x.high << LOW_BITS) + g_x.low;
        t += sum_of_distances(p, i, x, before, p->all.x);
        before += x;
    }
    p->sums[block][LINEAR] = dd_of_wide(linear, -2 * p->bits);
    p->sums[block][G] = dd_of_wide(g, -2 * p->bits - 4);
    p->sums[block][T_X] = dd_of_wide(t, -p->bits);
    return KOKSMA_OK;
}

/* Returns the sum over all i and j of the products of the two kernels in the plane. below: the result of
   koksma__l2_sum_below. */
static dd pair_sum_plane(const plane *p, const dd s[SUMS], dd below)
{
    const double n = (double)p->n, q = p->row->q, r = p->row->r;
    const dd z = dd_of_wide(p->all.x, -p->bits), w = dd_of_wide(p->all.y, -p->bits);
    const dd zw = dd_of_wide(p->all.xy, -2 * p->bits);
    /* sum_ij (G_i + G_j - 2 r z_i z_j) (H_i + H_j - 2 r w_i w_j) */
    dd sum = koksma__dd_add(koksma__dd_scale(s[GH], 2 * n), koksma__dd_scale(koksma__dd_mul(s[G], s[H]), 2));
    dd mixed = koksma__dd_add(koksma__dd_mul(s[GW], w), koksma__dd_mul(s[HZ], z));
    sum = koksma__dd_add(sum, koksma__dd_scale(mixed, -4 * r));
    sum = koksma__dd_add(sum, koksma__dd_scale(koksma__dd_scale(koksma__dd_mul(zw, zw), 4 * r), r));
    /* add q sum_ij (G_i + G_j - 2 r z_i z_j) t_y, and the same term with the coordinates exchanged */
    dd single = koksma__dd_scale(koksma__dd_add(s[G_TY], s[H_TX]), 2);
    const dd moments = koksma__dd_scale(koksma__dd_add(s[MOMENT_X], s[MOMENT_Y]), -4 * r);
    sum = koksma__dd_add(sum, koksma__dd_scale(koksma__dd_add(single, moments), q));
    /* q^2 sum_ij t_x t_y */
    dd both = koksma__dd_add(koksma__dd_scale(below, 2), s[CROSS]);
    both = koksma__dd_add(koksma__dd_scale(both, 2), koksma__dd_scale(s[X_TY], -1));
    return koksma__dd_add(sum, koksma__dd_scale(koksma__dd_scale(both, 2 * q), q));
}

static dd pair_sum_line(const plane *p, const dd s[SUMS])
{
    const dd z = dd_of_wide(p->all.x, -p->bits);
    dd sum = koksma__dd_scale(s[G], 2 * (double)p->n);
    sum = koksma__dd_add(sum, koksma__dd_scale(koksma__dd_mul(z, z), -2 * p->row->r));
    return koksma__dd_add(sum, koksma__dd_scale(s[T_X], p->row->q));
}

static double finish(const plane *p, size_t n_blocks, dd below)
{
    const double n = (double)p->n, power24 = p->dim == 2 ? 576 : 24, power12 = p->dim == 2 ? 144 : 12;
    dd s[SUMS];
    memset(s, 0, sizeof s);
    for (size_t block = 0; block < n_blocks; block++) {
        for (int k = 0; k < SUMS; k++) {
            s[k] = koksma__dd_add(s[k], p->sums[block][k]);
        }
    }
    const dd pair_sum = p->dim == 2 ? pair_sum_plane(p, s, below) : pair_sum_line(p, s);
    const double c = p->row->c12;
    const dd power = p->dim == 2 ? koksma__dd_product(c, c) : (dd){c, 0};
    dd square = koksma__dd_divide(power, power12);
    const dd linear = koksma__dd_divide(koksma__dd_divide(s[LINEAR], power24), n);
    square = koksma__dd_add(square, koksma__dd_scale(linear, -2));
    return koksma__dd_add(square, koksma__dd_divide(koksma__dd_divide(pair_sum, n), n)).hi;
}

/* Fills the points in both orders, with coordinates as whole numbers, and the sums before each block. */
static koksma_status prepare(plane *p, const koksma_run *run, size_t n_blocks)
{
    koksma_status status = koksma__order(run, p->n, p->xs, (size_t)p->dim, p->order);
    status = status ? status : koksma__parallel(run, n_blocks, load_by_x, p);
    if (!status) {
        p->all = add_up(p->before_x, n_blocks);
    }
    if (p->dim == 2) {
        status = status ? status : koksma__order(run, p->n, p->ys, 1, p->order);
        status = status ? status : koksma__parallel(run, n_blocks, load_by_y, p);
        add_up(p->before_y, status ? 0 : n_blocks);
    }
    return status;
}

static koksma_status evaluate_all(plane *p, const koksma_run *run, size_t n_blocks, double *square)
{
    dd below = {0, 0};
    koksma__phases phases = {.share = 0};
    koksma_run phase = koksma__phase_run(&phases, run, 0.2);
    koksma_status status = prepare(p, &phase, n_blocks);
    phase = koksma__phase_run(&phases, run, p->dim == 1 ? 0.8 : 0.1);
    if (p->dim == 1) {
        status = status ? status : koksma__parallel(&phase, n_blocks, sum_line, p);
    } else {
        status = status ? status : koksma__parallel(&phase, n_blocks, sum_by_x, p);
        phase = koksma__phase_run(&phases, run, 0.1);
        status = status ? status : koksma__parallel(&phase, n_blocks, sum_by_y, p);
        phase = koksma__phase_run(&phases, run, 0.6);
        status = status ? status : koksma__l2_sum_below(&phase, p->n, p->by_y, p->by_x, &below);
    }
    if (!status) {
        below = (dd){ldexp(below.hi, -2 * p->bits), ldexp(below.lo, -2 * p->bits)};
        *square = finish(p, n_blocks, below);
    }
    return status;
}

koksma_status koksma__l2_by_sorting(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                    double *square)
{
    const size_t n = points->n, n_blocks = (n + POINTS_PER_BLOCK - 1) / POINTS_PER_BLOCK;
    plane p = {.row = row, .n = n, .dim = points->dim, .bits = 53, .xs = points->xs};
    int n_bits = 0;
    for (; n > (size_t)1 << n_bits; n_bits++) {
    }
    while (2 * p.bits - 2 + n_bits > 125) {
        p.bits--;
    }
    p.t_shift = FACTOR_BITS - p.bits - n_bits;
    p.moment_shift = 2 * p.bits - 1 + n_bits > FACTOR_BITS ? 2 * p.bits - 1 + n_bits - FACTOR_BITS : 0;
    p.a = polynomial_of(row->a24, 1, p.bits);
    p.g = polynomial_of((double[4]){row->g[0], row->g[1], row->g[2] + row->r, row->g[3]}, G_SCALE, p.bits);
    const size_t bytes = n_blocks * (2 * sizeof(partial) + sizeof *p.sums) +
                         n * (2 * sizeof(point) + sizeof(double) + sizeof(uint32_t));
    p.before_x = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(p.before_x, bytes);
    p.before_y = p.before_x + n_blocks;
    p.sums = (dd(*)[SUMS])(p.before_y + n_blocks);
    p.by_x = (point *)(p.sums + n_blocks);
    p.by_y = p.by_x + n;
    p.ys = (double *)(p.by_y + n);
    p.order = (uint32_t *)(p.ys + n);
    memset(p.sums, 0, n_blocks * sizeof *p.sums);
    const koksma_status status = evaluate_all(&p, run, n_blocks, square);
    free(p.before_x);
    return status;
}

#endif

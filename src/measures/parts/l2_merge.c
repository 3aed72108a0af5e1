/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The L2 discrepancies of the line and the plane in O(n log n) and 106 bits, by splitting the kernels: with
 * G(z) = g(z) + r z^2, K = G(z_u) + G(z_v) - 2 r z_u z_v + q t. All of a product of two kernels separates but the t:
 * sums with one t need the points in order of one coordinate, and sum_ij t_x t_y, the same for every kernel, needs
 * for each point how many points are below it in both coordinates, and the sum of their y. A merge sort by y of the
 * points in order of x counts both.
 *
 * Coordinates are z in units of 2^-bits, so that these sums are whole numbers and exact. For n < 2^22 the unit is
 * 2^-53, as coarse as doubles near 1; moving a point by so little changes the square by less than 1e-16/n.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/parts/double_double.h"
#include "measures/parts/l2.h"
#include "measures/parts/order.h"

enum { POINTS_PER_BLOCK = 4096, LEAF = 1 << 14 };

typedef koksma__int128 wide;
typedef koksma__dd dd;

typedef struct item {
    int64_t y;
    uint32_t at_x, below; /* place in x order; points before it in x and in y order */
    wide sum_below;       /* the sum of their y */
} item;

/* What the sums need of a point, from prefix sums in x order and in y order; whole numbers. */
typedef struct place {
    int64_t x, y;
    wide cross;    /* sum over the other points of +-(y - y') that makes sum_ij t_x t_y = sum x cross */
    wide t_x, t_y; /* sum_j |x - x_j|, sum_j |y - y_j| */
    wide moment_x; /* sum over j before in x order of (x - x_j) y_j */
    wide moment_y; /* sum over j before in y order of (y - y_j) x_j */
} place;

enum { LINEAR, G, H, GH, G_TY, H_TX, CROSS, T_X, T_Y, Z, W, ZW, GW, HZ, Y_MOMENT, X_MOMENT, SUMS };

typedef struct plane {
    const koksma__l2_row *row;
    size_t n;
    int dim;
    double unit;
    int64_t *x; /* in x order */
    item *items, *spare;
    place *places; /* in y order */
    size_t width, segments;
    dd (*sums)[SUMS]; /* one a block */
} plane;

/* Merges [0, middle) and [middle, n), of lower and of higher x, by y; what lies below the right ones grows. */
static void merge(const item *from, size_t middle, size_t n, item *to)
{
    const item *l = from, *const l_end = from + middle, *r = l_end, *const r_end = from + n;
    uint32_t count = 0;
    wide sum = 0;
    while (l < l_end && r < r_end) {
        if (l->y <= r->y) {
            count++;
            sum += l->y;
            *to++ = *l++;
        } else {
            *to = *r++;
            to->below += count;
            to->sum_below += sum;
            to++;
        }
    }
    memcpy(to, l, (size_t)(l_end - l) * sizeof *to);
    for (; r < r_end; r++, to++) {
        *to = *r;
        to->below += count;
        to->sum_below += sum;
    }
}

/* Sorts [0, n) with the same room in spare; the result lies in items. */
static void sort(item *items, item *spare, size_t n)
{
    if (n <= 8) {
        for (size_t i = 1; i < n; i++) {
            item moving = items[i];
            size_t j = i;
            for (size_t k = 0; k < i; k++) {
                if (items[k].y <= moving.y) {
                    moving.below++;
                    moving.sum_below += items[k].y;
                }
            }
            for (; j > 0 && items[j - 1].y > moving.y; j--) {
                items[j] = items[j - 1];
            }
            items[j] = moving;
        }
        return;
    }
    const size_t middle = n / 2;
    sort(items, spare, middle);
    sort(items + middle, spare + middle, n - middle);
    memcpy(spare, items, n * sizeof *items);
    merge(spare, middle, n, items);
}

static koksma_status sort_leaf(void *context, size_t block)
{
    const plane *p = context;
    const size_t first = block * LEAF, count = p->n - first < LEAF ? p->n - first : LEAF;
    sort(p->items + first, p->spare + first, count);
    return KOKSMA_OK;
}

static koksma_status merge_pair(void *context, size_t block)
{
    const plane *p = context;
    const size_t first = 2 * block * p->width, rest = p->n - first;
    merge(p->items + first, rest < p->width ? rest : p->width, rest < 2 * p->width ? rest : 2 * p->width,
          p->spare + first);
    return KOKSMA_OK;
}

static koksma_status sort_all(plane *p, const koksma_run *run)
{
    koksma_status status = koksma__parallel(run, (p->n + LEAF - 1) / LEAF, sort_leaf, p);
    for (p->width = LEAF; p->width < p->n && !status; p->width *= 2) {
        status = koksma__parallel(run, (p->n + 2 * p->width - 1) / (2 * p->width), merge_pair, p);
        item *const other = p->items;
        p->items = p->spare;
        p->spare = other;
    }
    return status;
}

/* The prefix sums in both orders. */
static void find_places(plane *p, wide *before_x)
{
    const size_t n = p->n;
    wide total_x = 0, total_y = 0, sum_y = 0, sum_x = 0, sum_xy = 0;
    uint32_t *at_y = (uint32_t *)p->spare; /* by place in x order: the place in y order */
    for (size_t j = 0; j < n; j++) {
        at_y[p->items[j].at_x] = (uint32_t)j;
        total_y += p->items[j].y;
        total_x += p->x[j];
    }
    for (size_t i = 0; i < n; i++) { /* in x order: sums of x, y and xy before */
        place *at = &p->places[at_y[i]];
        const int64_t x = p->x[i], y = p->items[at_y[i]].y;
        before_x[i] = sum_y;
        at->t_x = x * ((wide)2 * (wide)i + 1 - (wide)n) - 2 * sum_x + total_x - x;
        at->moment_x = x * sum_y - sum_xy;
        sum_x += x;
        sum_y += y;
        sum_xy += (wide)x * y;
    }
    sum_x = sum_y = sum_xy = 0;
    for (size_t j = 0; j < n; j++) { /* in y order */
        const item *it = &p->items[j];
        place *at = &p->places[j];
        const wide i = it->at_x, above = (wide)n - 1 - i - ((wide)j - it->below);
        at->x = p->x[it->at_x];
        at->y = it->y;
        at->t_y = it->y * ((wide)2 * (wide)j + 1 - (wide)n) - 2 * sum_y + total_y - it->y;
        at->moment_y = it->y * sum_x - sum_xy;
        at->cross = it->y * (it->below + above) - 2 * it->sum_below - (total_y - sum_y - it->y) + before_x[it->at_x];
        sum_y += it->y;
        sum_x += at->x;
        sum_xy += (wide)at->x * it->y;
    }
}

static koksma_status sum_places(void *context, size_t block)
{
    const plane *p = context;
    const koksma__l2_row *row = p->row;
    const size_t first = block * POINTS_PER_BLOCK;
    const size_t end = first + POINTS_PER_BLOCK < p->n ? first + POINTS_PER_BLOCK : p->n;
    const double big_g[4] = {row->g[0], row->g[1], row->g[2] + row->r, row->g[3]};
    dd *s = p->sums[block];
#define ADD(sum, term) s[sum] = koksma__dd_add(s[sum], term)
    for (size_t i = first; i < end; i++) {
        const place *at = &p->places[i];
        const double z = (double)at->x * p->unit, w = (double)at->y * p->unit;
        const dd t_x = koksma__dd_of_int(at->t_x), t_y = koksma__dd_of_int(at->t_y);
        const dd g = koksma__l2_polynomial_dd(big_g, z), h = koksma__l2_polynomial_dd(big_g, w);
        const dd a = koksma__l2_polynomial_dd(row->a24, z), b = koksma__l2_polynomial_dd(row->a24, w);
        ADD(LINEAR, p->dim == 2 ? koksma__dd_mul(a, b) : a);
        ADD(G, g);
        ADD(T_X, t_x);
        ADD(Z, ((dd){z, 0}));
        if (p->dim < 2) {
            continue;
        }
        ADD(H, h);
        ADD(T_Y, t_y);
        ADD(W, ((dd){w, 0}));
        ADD(GH, koksma__dd_mul(g, h));
        ADD(G_TY, koksma__dd_mul(g, t_y));
        ADD(H_TX, koksma__dd_mul(h, t_x));
        ADD(CROSS, koksma__dd_scale(koksma__dd_of_int(at->cross), z));
        ADD(ZW, koksma__dd_product(z, w));
        if (row->r != 0) {
            ADD(GW, koksma__dd_scale(g, w));
            ADD(HZ, koksma__dd_scale(h, z));
            ADD(Y_MOMENT, koksma__dd_scale(koksma__dd_of_int(at->moment_x), w));
            ADD(X_MOMENT, koksma__dd_scale(koksma__dd_of_int(at->moment_y), z));
        }
    }
#undef ADD
    return KOKSMA_OK;
}

/* sum_ij K K in the plane. The sums with whole numbers are still in their units. */
static dd pair_sum_plane(const plane *p, const dd s[SUMS])
{
    const double n = (double)p->n, q = p->row->q, r = p->row->r, u = p->unit;
    /* sum_ij (G_i + G_j - 2 r z_i z_j) (H_i + H_j - 2 r w_i w_j) */
    dd sum = koksma__dd_add(koksma__dd_scale(s[GH], 2 * n), koksma__dd_scale(koksma__dd_mul(s[G], s[H]), 2));
    dd mixed = koksma__dd_add(koksma__dd_mul(s[GW], s[W]), koksma__dd_mul(s[HZ], s[Z]));
    sum = koksma__dd_add(sum, koksma__dd_scale(mixed, -4 * r));
    sum = koksma__dd_add(sum, koksma__dd_scale(koksma__dd_mul(s[ZW], s[ZW]), 4 * r * r));
    /* q sum_ij (G_i + G_j - 2 r z_i z_j) t_y and the same with the coordinates exchanged */
    dd single = koksma__dd_scale(koksma__dd_add(s[G_TY], s[H_TX]), 2 * u);
    const dd moments = koksma__dd_scale(koksma__dd_add(s[X_MOMENT], s[Y_MOMENT]), -4 * r);
    single = koksma__dd_add(single, koksma__dd_scale(koksma__dd_scale(moments, u), u));
    sum = koksma__dd_add(sum, koksma__dd_scale(single, q));
    /* q^2 sum_ij t_x t_y = 2 q^2 (2 sum over pairs in the same order of t_x t_y - (n sum zw - sum z sum w)) */
    dd both = koksma__dd_scale(s[CROSS], 2 * u);
    both = koksma__dd_add(both, koksma__dd_scale(s[ZW], -n));
    both = koksma__dd_add(both, koksma__dd_mul(s[Z], s[W]));
    return koksma__dd_add(sum, koksma__dd_scale(both, 2 * q * q));
}

static dd pair_sum_line(const plane *p, const dd s[SUMS])
{
    dd sum = koksma__dd_scale(s[G], 2 * (double)p->n);
    sum = koksma__dd_add(sum, koksma__dd_scale(koksma__dd_mul(s[Z], s[Z]), -2 * p->row->r));
    return koksma__dd_add(sum, koksma__dd_scale(s[T_X], p->row->q * p->unit));
}

static double finish(const plane *p, size_t n_blocks)
{
    const double n = (double)p->n, power24 = p->dim == 2 ? 576 : 24, power12 = p->dim == 2 ? 144 : 12;
    dd s[SUMS];
    memset(s, 0, sizeof s);
    for (size_t block = 0; block < n_blocks; block++) {
        for (int k = 0; k < SUMS; k++) {
            s[k] = koksma__dd_add(s[k], p->sums[block][k]);
        }
    }
    const dd pair_sum = p->dim == 2 ? pair_sum_plane(p, s) : pair_sum_line(p, s);
    const double c = p->row->c12;
    dd square = koksma__dd_divide((dd){p->dim == 2 ? c * c : c, 0}, power12);
    const dd linear = koksma__dd_divide(koksma__dd_divide(s[LINEAR], power24), n);
    square = koksma__dd_add(square, koksma__dd_scale(linear, -2));
    return koksma__dd_add(square, koksma__dd_divide(koksma__dd_divide(pair_sum, n), n)).hi;
}

static koksma_status prepare(plane *p, const koksma_points *points, uint32_t *order)
{
    const size_t dim = (size_t)points->dim;
    const koksma_status status = koksma__order(p->n, points->xs, dim, order);
    for (size_t i = 0; i < p->n && !status; i++) {
        const double *point = points->xs + order[i] * dim;
        const double y = dim == 2 ? (point[1] - 0.5) / p->unit : 0;
        p->x[i] = llrint((point[0] - 0.5) / p->unit);
        p->items[i] = (item){.y = llrint(y), .at_x = (uint32_t)i};
    }
    return status;
}

koksma_status koksma__l2_by_merging(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                    double *square)
{
    const size_t n = points->n, n_blocks = (n + POINTS_PER_BLOCK - 1) / POINTS_PER_BLOCK;
    int bits = 53;
    while (ldexp((double)n, 2 * bits - 2) > 0x1p125) {
        bits--;
    }
    plane p = {.row = row, .n = n, .dim = points->dim, .unit = ldexp(1, -bits)};
    const size_t bytes =
        n * (sizeof(place) + 2 * sizeof(item) + sizeof(wide) + sizeof(int64_t)) + n_blocks * sizeof *p.sums;
    p.places = malloc(bytes);
    if (!p.places) {
        return koksma__fail_memory(bytes);
    }
    p.items = (item *)(p.places + n);
    p.spare = p.items + n;
    wide *before_x = (wide *)(p.spare + n);
    p.sums = (dd(*)[SUMS])(before_x + n);
    p.x = (int64_t *)(p.sums + n_blocks);
    memset(p.sums, 0, n_blocks * sizeof *p.sums);
    koksma_status status = prepare(&p, points, (uint32_t *)p.places);
    if (!status) {
        status = sort_all(&p, run);
    }
    if (!status) {
        find_places(&p, before_x);
        status = koksma__parallel(run, n_blocks, sum_places, &p);
    }
    if (!status) {
        *square = finish(&p, n_blocks);
    }
    free(p.places);
    return status;
}

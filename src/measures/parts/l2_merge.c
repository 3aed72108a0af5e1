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

enum { POINTS_PER_BLOCK = 4096, LEAF = 1 << 14, SEGMENTS = 8 };

typedef koksma__int128 wide;
typedef koksma__dd dd;

typedef struct item {
    int64_t y;
    uint32_t at_x, below; /* place in x order; points before it in x and in y order */
    wide sum_below;       /* the sum of their y */
} item;

/* A point, and what the sums need of those before and after it in x order; whole numbers. A line of the cache. */
typedef struct place {
    int64_t x, y;
    wide t_x;      /* sum_j |x - x_j| */
    wide moment_x; /* sum over j before of (x - x_j) y_j */
    wide before;   /* sum over j before of y_j */
} place;

/* The same in y order, and both together. */
typedef struct point {
    int64_t x, y;
    wide t_x, t_y, moment_x, moment_y;
    wide cross; /* sum over the other points of +-(y - y') that makes sum_ij t_x t_y = sum x cross */
} point;

/* Over the points of a block, and once added up over those before it. */
typedef struct partial {
    wide x, y, xy;
} partial;

enum { LINEAR, G, H, GH, G_TY, H_TX, CROSS, T_X, T_Y, Z, W, ZW, GW, HZ, Y_MOMENT, X_MOMENT, SUMS };

typedef struct plane {
    const koksma__l2_row *row;
    size_t n;
    int dim;
    double unit;
    const double *xs;
    const uint32_t *order;
    int64_t *x; /* in x order */
    item *items, *spare;
    place *places;        /* in x order */
    partial *by_x, *by_y; /* one a block, in either order */
    wide total_x, total_y;
    size_t width, segments; /* of merges: how many each is cut into */
    dd (*sums)[SUMS];       /* one a block */
} plane;

/* Merges l .. l_end and r .. r_end, of lower and of higher x, by y; what lies below the right ones grows: count
   points with sum as their y lie before l. */
static void merge(const item *l, const item *l_end, const item *r, const item *r_end, uint32_t count, wide sum,
                  item *to)
{
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
    merge(spare, spare + middle, spare + middle, spare + n, 0, 0, items);
}

static koksma_status sort_leaf(void *context, size_t block)
{
    const plane *p = context;
    const size_t first = block * LEAF, count = p->n - first < LEAF ? p->n - first : LEAF;
    sort(p->items + first, p->spare + first, count);
    return KOKSMA_OK;
}

/* How many of the first k of the merged lists come from the left one. */
static size_t split(const item *l, size_t n_l, const item *r, size_t n_r, size_t k)
{
    size_t low = k > n_r ? k - n_r : 0, high = k < n_l ? k : n_l;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (l[middle].y <= r[k - middle - 1].y) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* One segment of the merge of one pair of runs. */
static koksma_status merge_segment(void *context, size_t block)
{
    const plane *p = context;
    const size_t first = 2 * (block / p->segments) * p->width, rest = p->n - first, segment = block % p->segments;
    const size_t n_l = rest < p->width ? rest : p->width, count = rest < 2 * p->width ? rest : 2 * p->width;
    const item *l = p->items + first, *r = l + n_l;
    const size_t from = count * segment / p->segments, end = count * (segment + 1) / p->segments;
    const size_t l_from = split(l, n_l, r, count - n_l, from), l_end = split(l, n_l, r, count - n_l, end);
    wide sum = 0;
    for (size_t i = 0; i < l_from; i++) {
        sum += l[i].y;
    }
    merge(l + l_from, l + l_end, r + (from - l_from), r + (end - l_end), (uint32_t)l_from, sum,
          p->spare + first + from);
    return KOKSMA_OK;
}

static koksma_status sort_all(plane *p, const koksma_run *run)
{
    koksma_status status = koksma__parallel(run, (p->n + LEAF - 1) / LEAF, sort_leaf, p);
    for (p->width = LEAF; p->width < p->n && !status; p->width *= 2) {
        const size_t merges = (p->n + 2 * p->width - 1) / (2 * p->width);
        p->segments = merges < SEGMENTS ? SEGMENTS : 1;
        status = koksma__parallel(run, merges * p->segments, merge_segment, p);
        item *const other = p->items;
        p->items = p->spare;
        p->spare = other;
    }
    return status;
}

static size_t end_of(const plane *p, size_t block)
{
    return p->n - block * POINTS_PER_BLOCK < POINTS_PER_BLOCK ? p->n : (block + 1) * POINTS_PER_BLOCK;
}

static void add_point(partial *sum, int64_t x, int64_t y)
{
    sum->x += x;
    sum->y += y;
    sum->xy += (wide)x * y;
}

static koksma_status load(void *context, size_t block)
{
    const plane *p = context;
    partial sum = {0, 0, 0};
    for (size_t i = block * POINTS_PER_BLOCK; i < end_of(p, block); i++) {
        const double *at = p->xs + p->order[i] * (size_t)p->dim;
        p->x[i] = llrint((at[0] - 0.5) / p->unit);
        p->items[i] = (item){.y = p->dim == 2 ? llrint((at[1] - 0.5) / p->unit) : 0, .at_x = (uint32_t)i};
        p->places[i].x = p->x[i];
        p->places[i].y = p->items[i].y;
        add_point(&sum, p->x[i], p->items[i].y);
    }
    p->by_x[block] = sum;
    return KOKSMA_OK;
}

static koksma_status sum_block_by_y(void *context, size_t block)
{
    const plane *p = context;
    partial sum = {0, 0, 0};
    for (size_t j = block * POINTS_PER_BLOCK; j < end_of(p, block); j++) {
        add_point(&sum, p->x[p->items[j].at_x], p->items[j].y);
    }
    p->by_y[block] = sum;
    return KOKSMA_OK;
}

/* Sums over blocks become sums over all before; the sum of all. */
static partial add_up(partial *sums, size_t n_blocks)
{
    partial total = {0, 0, 0};
    for (size_t block = 0; block < n_blocks; block++) {
        const partial sum = sums[block];
        sums[block] = total;
        total = (partial){total.x + sum.x, total.y + sum.y, total.xy + sum.xy};
    }
    return total;
}

static koksma_status find_places(void *context, size_t block)
{
    const plane *p = context;
    partial sum = p->by_x[block];
    for (size_t i = block * POINTS_PER_BLOCK; i < end_of(p, block); i++) {
        const int64_t x = p->places[i].x;
        p->places[i].t_x = x * ((wide)2 * (wide)i + 1 - (wide)p->n) - 2 * sum.x + p->total_x - x;
        p->places[i].moment_x = x * sum.y - sum.xy;
        p->places[i].before = sum.y;
        add_point(&sum, x, p->places[i].y);
    }
    return KOKSMA_OK;
}

/* Point j in y order; sum: over the points before it in that order. */
static point find_point(const plane *p, size_t j, const partial *sum)
{
    const item *it = &p->items[j];
    const place *at = &p->places[it->at_x];
    const int64_t y = it->y;
    const wide n = (wide)p->n, rank = (wide)j, above = n - 1 - (wide)it->at_x - (rank - it->below);
    return (point){.x = at->x,
                   .y = y,
                   .t_x = at->t_x,
                   .t_y = y * (2 * rank + 1 - n) - 2 * sum->y + p->total_y - y,
                   .moment_x = at->moment_x,
                   .moment_y = y * sum->x - sum->xy,
                   .cross = y * (it->below + above) - 2 * it->sum_below - (p->total_y - sum->y - y) + at->before};
}

static koksma_status sum_places(void *context, size_t block)
{
    const plane *p = context;
    const koksma__l2_row *row = p->row;
    const double big_g[4] = {row->g[0], row->g[1], row->g[2] + row->r, row->g[3]};
    dd *s = p->sums[block];
    partial sum = p->by_y[block];
#define ADD(sum, term) s[sum] = koksma__dd_add(s[sum], term)
    for (size_t j = block * POINTS_PER_BLOCK; j < end_of(p, block); j++) {
        const point at = find_point(p, j, &sum);
        const double z = (double)at.x * p->unit, w = (double)at.y * p->unit;
        const dd t_x = koksma__dd_of_int(at.t_x), t_y = koksma__dd_of_int(at.t_y);
        add_point(&sum, at.x, at.y);
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
        ADD(CROSS, koksma__dd_scale(koksma__dd_of_int(at.cross), z));
        ADD(ZW, koksma__dd_product(z, w));
        if (row->r != 0) {
            ADD(GW, koksma__dd_scale(g, w));
            ADD(HZ, koksma__dd_scale(h, z));
            ADD(Y_MOMENT, koksma__dd_scale(koksma__dd_of_int(at.moment_x), w));
            ADD(X_MOMENT, koksma__dd_scale(koksma__dd_of_int(at.moment_y), z));
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

/* The points as whole numbers in x order, sorted by y, and what prefix sums in x order say of each. */
static koksma_status prepare(plane *p, uint32_t *order, const koksma_run *run, size_t n_blocks)
{
    koksma_status status = koksma__order(run, p->n, p->xs, (size_t)p->dim, order);
    p->order = order;
    status = status ? status : koksma__parallel(run, n_blocks, load, p);
    status = status ? status : sort_all(p, run);
    status = status ? status : koksma__parallel(run, n_blocks, sum_block_by_y, p);
    if (!status) {
        const partial total = add_up(p->by_x, n_blocks);
        add_up(p->by_y, n_blocks);
        p->total_x = total.x;
        p->total_y = total.y;
        status = koksma__parallel(run, n_blocks, find_places, p);
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
    plane p = {.row = row, .n = n, .dim = points->dim, .unit = ldexp(1, -bits), .xs = points->xs};
    const size_t bytes =
        n * (sizeof(place) + 2 * sizeof(item) + sizeof(int64_t)) + n_blocks * (sizeof *p.sums + 2 * sizeof(partial));
    p.places = aligned_alloc(sizeof(place), (bytes + sizeof(place) - 1) / sizeof(place) * sizeof(place));
    if (!p.places) {
        return koksma__fail_memory(bytes);
    }
    p.items = (item *)(p.places + n);
    p.spare = p.items + n;
    p.by_x = (partial *)(p.spare + n);
    p.by_y = p.by_x + n_blocks;
    p.sums = (dd(*)[SUMS])(p.by_y + n_blocks);
    p.x = (int64_t *)(p.sums + n_blocks);
    memset(p.sums, 0, n_blocks * sizeof *p.sums);
    koksma_status status = prepare(&p, (uint32_t *)p.spare, run, n_blocks);
    if (!status) {
        status = koksma__parallel(run, n_blocks, sum_places, &p);
    }
    if (!status) {
        *square = finish(&p, n_blocks);
    }
    free(p.places);
    return status;
}

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * sample-elimination: from `factor` times as many uniform points, the one with the heaviest neighbourhood on the
 * torus is taken out until n are left.
 *
 *     weight of i = sum over j with d_ij < 2 r of (1 - d_ij / (2 r))^8,   r = sqrt(1 / (2 sqrt3 n))
 *
 * Source: Yuksel 2015, in 2D. 2 r is the distance of the densest packing of n points.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/parts/fill.h"
#include "patterns/parts/torus_grid.h"
#include "patterns/patterns.h"

typedef struct heap {
    size_t count;
    uint32_t *item, *place; /* the points in order of the heap, and where each is */
    double *weight;
    double radius;
} heap;

static bool heavier(const heap *h, uint32_t a, uint32_t b)
{
    return h->weight[a] > h->weight[b] || (h->weight[a] == h->weight[b] && a < b);
}

static void put(heap *h, size_t at, uint32_t item)
{
    h->item[at] = item;
    h->place[item] = (uint32_t)at;
}

static void sink(heap *h, size_t at)
{
    const uint32_t item = h->item[at];
    for (size_t child; (child = 2 * at + 1) < h->count; at = child) {
        child += child + 1 < h->count && heavier(h, h->item[child + 1], h->item[child]);
        if (!heavier(h, h->item[child], item)) {
            break;
        }
        put(h, at, h->item[child]);
    }
    put(h, at, item);
}

static double load_of(const heap *h, double dx, double dy)
{
    const double t = 1 - sqrt(dx * dx + dy * dy) / h->radius, t2 = t * t, t4 = t2 * t2;
    return t4 * t4;
}

typedef struct visit {
    heap *h;
    uint32_t self;
} visit;

static void weigh(void *context, uint32_t point, double dx, double dy)
{
    const visit *v = context;
    if (point != v->self) {
        v->h->weight[v->self] += load_of(v->h, dx, dy);
    }
}

static void relieve(void *context, uint32_t point, double dx, double dy)
{
    const visit *v = context;
    if (point != v->self) {
        v->h->weight[point] -= load_of(v->h, dx, dy);
        sink(v->h, v->h->place[point]);
    }
}

static koksma_status eliminate(heap *h, koksma__torus_grid *grid, const double *xs, size_t n, const koksma_run *run)
{
    const size_t all = h->count;
    for (uint32_t i = 0; i < all; i++) {
        koksma__torus_grid_add(grid, i);
    }
    for (uint32_t i = 0; i < all; i++) {
        visit v = {h, i};
        h->weight[i] = 0;
        koksma__torus_grid_each(grid, xs[2 * (size_t)i], xs[2 * (size_t)i + 1], h->radius, weigh, &v);
        put(h, i, i);
        if (i % 4096 == 0 && !koksma__keep_going(run, 0)) {
            return koksma__fail_interrupted();
        }
    }
    for (size_t at = all / 2; at-- > 0;) {
        sink(h, at);
    }
    while (h->count > n) {
        const uint32_t out = h->item[0];
        h->count--;
        put(h, 0, h->item[h->count]);
        sink(h, 0);
        koksma__torus_grid_remove(grid, out);
        visit v = {h, out};
        koksma__torus_grid_each(grid, xs[2 * (size_t)out], xs[2 * (size_t)out + 1], h->radius, relieve, &v);
        if (h->count % 4096 == 0 && !koksma__keep_going(run, (double)(all - h->count) / (double)(all - n))) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t n = out->n, all = (size_t)args->params[0] * n;
    if (all > KOKSMA_MAX_COORDINATES / 2) {
        return koksma__fail(KOKSMA_N, "sample-elimination: n = %zu is too large; n = %zu or less would do", n,
                            KOKSMA_MAX_COORDINATES / 2 / (size_t)args->params[0]);
    }
    heap h = {.count = all, .radius = fmin(sqrt(2 / (sqrt(3) * (double)n)), 0.5)};
    double *xs = calloc(3 * all, sizeof *xs);
    h.item = malloc(2 * all * sizeof *h.item);
    koksma__torus_grid grid = {0};
    koksma_status status = xs && h.item ? koksma__torus_grid_init(&grid, all, xs) : koksma__fail_memory(32 * all);
    if (!status) {
        h.weight = xs + 2 * all;
        h.place = h.item + all;
        status = koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, 2 * all, xs);
    }
    if (!status) {
        status = eliminate(&h, &grid, xs, n, args->run);
    }
    size_t kept = 0;
    for (uint32_t i = 0; i < all && !status; i++) {
        if (h.place[i] < h.count && h.item[h.place[i]] == i) {
            out->xs[2 * kept] = xs[2 * (size_t)i];
            out->xs[2 * kept++ + 1] = xs[2 * (size_t)i + 1];
        }
    }
    koksma__torus_grid_fini(&grid);
    free(h.item);
    free(xs);
    return status;
}

static const koksma_param params[] = {
    {"factor", "points to begin with, for each that is kept", 5, 2, 20, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_sample_elimination = {
    .name = "sample-elimination",
    .title = "the points left when the most crowded are taken out",
    .cite = "yuksel2015",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_BLUE | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};

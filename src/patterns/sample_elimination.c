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
#include <string.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/parts/fill.h"
#include "patterns/parts/torus_grid.h"
#include "patterns/patterns.h"

typedef struct entry {
    double weight;
    uint32_t point;
} entry;

/* The heaviest first. Points are numbered cell by cell of a grid. */
typedef struct heap {
    size_t count;
    entry *entry;
    uint32_t *place;  /* of each point in the heap */
    uint32_t *origin; /* its number as it was drawn */
    double radius;
} heap;

static bool heavier(const heap *h, const entry *a, const entry *b)
{
    return a->weight > b->weight || (a->weight == b->weight && h->origin[a->point] < h->origin[b->point]);
}

static void put(heap *h, size_t at, entry e)
{
    h->entry[at] = e;
    h->place[e.point] = (uint32_t)at;
}

static void sink(heap *h, size_t at)
{
    const entry e = h->entry[at];
    for (size_t child; (child = 2 * at + 1) < h->count; at = child) {
        child += child + 1 < h->count && heavier(h, &h->entry[child + 1], &h->entry[child]);
        if (!heavier(h, &h->entry[child], &e)) {
            break;
        }
        put(h, at, h->entry[child]);
    }
    put(h, at, e);
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

/* While entries are in the order of their points. */
static void weigh(void *context, uint32_t point, double dx, double dy)
{
    const visit *v = context;
    if (point != v->self) {
        v->h->entry[v->self].weight += load_of(v->h, dx, dy);
    }
}

static void relieve(void *context, uint32_t point, double dx, double dy)
{
    const visit *v = context;
    if (point != v->self) {
        const size_t at = v->h->place[point];
        v->h->entry[at].weight -= load_of(v->h, dx, dy);
        sink(v->h, at);
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
        put(h, i, (entry){0, i});
        koksma__torus_grid_each(grid, xs[2 * (size_t)i], xs[2 * (size_t)i + 1], h->radius, weigh, &v);
        if (i % 4096 == 0 && !koksma__keep_going(run, 0)) {
            return koksma__fail_interrupted();
        }
    }
    for (size_t at = all / 2; at-- > 0;) {
        sink(h, at);
    }
    while (h->count > n) {
        const uint32_t out = h->entry[0].point;
        h->count--;
        put(h, 0, h->entry[h->count]);
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

/* The points that are left, in the order in which they were drawn. */
static void keep(heap *h, size_t all, const double *drawn, double *xs)
{
    uint32_t *left = h->place; /* no more needed */
    memset(left, 0, all * sizeof *left);
    for (size_t at = 0; at < h->count; at++) {
        left[h->origin[h->entry[at].point]] = 1;
    }
    for (size_t i = 0; i < all; i++) {
        if (left[i]) {
            memcpy(xs, drawn + 2 * i, 2 * sizeof *xs);
            xs += 2;
        }
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t n = out->n, all = (size_t)args->params[0] * n;
    if (all > KOKSMA_MAX_COORDINATES / 2) {
        return koksma__fail(KOKSMA_N, "sample-elimination: n = %zu is too large; n = %zu or less would do", n,
                            KOKSMA_MAX_COORDINATES / 2 / (size_t)args->params[0]);
    }
    heap h = {.count = all, .radius = fmin(sqrt(2 / (sqrt(3) * (double)n)), 0.5)};
    double *drawn = malloc(4 * all * sizeof *drawn), *xs = NULL; /* as they are numbered */
    h.entry = malloc(all * sizeof *h.entry);
    h.place = malloc(2 * all * sizeof *h.place);
    koksma__torus_grid grid = {0};
    koksma_status status = drawn && h.entry && h.place ? KOKSMA_OK : koksma__fail_memory(56 * all);
    status = status ? status : koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, 2 * all, drawn);
    if (!status) {
        xs = drawn + 2 * all;
        h.origin = h.place + all;
        status = koksma__torus_grid_order(all, drawn, h.origin);
    }
    for (size_t i = 0; i < all && !status; i++) {
        memcpy(xs + 2 * i, drawn + 2 * (size_t)h.origin[i], 2 * sizeof *xs);
    }
    status = status ? status : koksma__torus_grid_init(&grid, all, xs);
    status = status ? status : eliminate(&h, &grid, xs, n, args->run);
    if (!status) {
        keep(&h, all, drawn, out->xs);
    }
    koksma__torus_grid_fini(&grid);
    free(h.place);
    free(h.entry);
    free(drawn);
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

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Bundles of the shapes of a list: boxes that hold some shapes each, so that a block of rays tests the shapes of a box only
 * with those rays that meet it (batch_shapes.c). All shapes at rest and of finite size are halved where that makes the
 * product of the surface of the box and the number of its shapes smallest, in both halves together, and so on; then each
 * half is one bundle, or stays cut, or its shapes stay alone, whichever costs least if a ray meets a box with a probability
 * proportional to its surface (MacDonald & Booth 1990).
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "render/accel/accel.h"

/* Costs in tests of a shape: to prepare the rays, to test a box, and to copy the rays that meet it if all do */
#define PREPARE 3
#define BOX 0.8
#define COPY 5

enum { ALONE = -1 };

typedef struct box {
    double low[3], high[3];
} box;

typedef struct entry {
    box bounds;
    double key, after; /* after: the surface of the box of this entry and those behind it */
    uint32_t shape;
    int group; /* of its bundle, or ALONE */
} entry;

static bool is_bounded(const koksma__batch_shape *s)
{
    return !s->moves && !s->turns && (!s->is_flat || s->half_u < INFINITY);
}

static box box_of(const koksma__batch_shape *s)
{
    box b;
    for (int k = 0; k < 3; k++) {
        const double flat =
            fabs((double)s->axis_u[k]) * (double)s->half_u + fabs((double)s->axis_v[k]) * (double)s->half_v;
        const double reach = s->is_flat ? flat : sqrt((double)s->radius2);
        b.low[k] = (double)s->centre[k] - reach;
        b.high[k] = (double)s->centre[k] + reach;
    }
    return b;
}

static void widen(box *b, const box *by)
{
    for (int k = 0; k < 3; k++) {
        b->low[k] = fmin(b->low[k], by->low[k]);
        b->high[k] = fmax(b->high[k], by->high[k]);
    }
}

/* Half of the box's surface. */
static double surface(const box *b)
{
    const double x = b->high[0] - b->low[0], y = b->high[1] - b->low[1], z = b->high[2] - b->low[2];
    return x * y + y * z + z * x;
}

static box box_of_all(const entry *e, size_t n)
{
    box b = e[0].bounds;
    for (size_t i = 1; i < n; i++) {
        widen(&b, &e[i].bounds);
    }
    return b;
}

static int by_key(const void *a, const void *b)
{
    const entry *x = a, *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key) : (x->shape > y->shape) - (x->shape < y->shape);
}

static int by_shape(const void *a, const void *b)
{
    const entry *x = a, *y = b;
    return (x->shape > y->shape) - (x->shape < y->shape);
}

static void sort(entry *e, size_t n, int axis)
{
    for (size_t i = 0; i < n; i++) {
        e[i].key = e[i].bounds.low[axis] + e[i].bounds.high[axis];
    }
    qsort(e, n, sizeof *e, by_key);
}

/* Sorts n > 1 entries along the axis of the best cut and returns how many are before it. */
static size_t cut(entry *e, size_t n)
{
    double least = (double)INFINITY;
    size_t at = 1;
    int along = 0;
    for (int axis = 0; axis < 3; axis++) {
        sort(e, n, axis);
        box all = e[n - 1].bounds;
        for (size_t i = n; i-- > 0;) {
            widen(&all, &e[i].bounds);
            e[i].after = surface(&all);
        }
        all = e[0].bounds;
        for (size_t i = 1; i < n; i++) {
            widen(&all, &e[i - 1].bounds);
            const double cost = surface(&all) * (double)i + e[i].after * (double)(n - i);
            if (cost < least) {
                least = cost;
                at = i;
                along = axis;
            }
        }
    }
    sort(e, n, along);
    return at;
}

/* The surface of the part of the scene that most rays are taken to meet: the smallest that has 4 of 5 shapes. */
static double busy(entry *e, size_t n)
{
    size_t first = 0, end = n;
    for (bool smaller = n > 1; smaller;) {
        const size_t at = first + cut(e + first, end - first), low = at - first > end - at ? first : at;
        const size_t high = low == first ? at : end;
        smaller = high - low > 1 && 5 * (high - low) >= 4 * n;
        first = smaller ? low : first;
        end = smaller ? high : end;
    }
    const box all = box_of_all(e + first, end - first);
    return surface(&all);
}

/* Sets the groups of n entries and returns their cost for a ray. */
static double group(entry *e, size_t n, double total, int *groups)
{
    const box all = box_of_all(e, n);
    const double hit = total > surface(&all) ? surface(&all) / total : 1, one = BOX + hit * (double)(n + COPY),
                 alone = (double)n;
    const size_t half = n > 1 ? cut(e, n) : 0;
    const double apart =
        half ? group(e, half, total, groups) + group(e + half, n - half, total, groups) : (double)INFINITY;
    if (apart <= one && apart <= alone) {
        return apart;
    }
    const int mine = one < alone ? (*groups)++ : ALONE;
    for (size_t i = 0; i < n; i++) {
        e[i].group = mine;
    }
    return one < alone ? one : alone;
}

/* Adds the bundle of n entries, the first of which is order[first]. */
static void add(koksma__batch_shapes *to, koksma__batch_bundle *bundle, entry *e, size_t n, size_t first)
{
    const box all = box_of_all(e, n);
    double size = 0;
    qsort(e, n, sizeof *e, by_shape);
    *bundle = (koksma__batch_bundle){.first = first, .end = first + n};
    for (int k = 0; k < 3; k++) {
        bundle->low[k] = (float)all.low[k];
        bundle->high[k] = (float)all.high[k];
        size += fmax(fabs(all.low[k]), fabs(all.high[k]));
    }
    to->size = (float)fmax((double)to->size, size);
}

koksma_status koksma__bundle(koksma__batch_shapes *to, koksma__batch_bundle *bundles, uint32_t *order)
{
    entry *e = malloc((to->n + 1) * sizeof *e);
    int groups = 0;
    size_t n = 0, at = 0;
    KOKSMA__REQUIRE_MEMORY(e, (to->n + 1) * sizeof *e);
    for (size_t i = 0; i < to->n; i++) {
        if (is_bounded(&to->shapes[i])) {
            e[n++] = (entry){.bounds = box_of(&to->shapes[i]), .shape = (uint32_t)i};
        } else {
            order[to->n_alone++] = (uint32_t)i;
        }
    }
    if (n) {
        const double total = busy(e, n), cost = PREPARE + group(e, n, total, &groups);
        for (size_t i = 0; i < n && cost > n; i++) {
            e[i].group = ALONE;
        }
    }
    for (size_t i = 0; i < n; i++) {
        if (e[i].group == ALONE) {
            order[to->n_alone++] = e[i].shape;
        }
    }
    at = to->n_alone;
    for (size_t i = 0, end = 0; i < n; i = end) {
        for (end = i; end < n && e[end].group == e[i].group; end++) {
        }
        if (e[i].group != ALONE) {
            add(to, &bundles[to->n_bundles++], e + i, end - i, at);
            for (; i < end; i++) {
                order[at++] = e[i].shape;
            }
        }
    }
    to->bundles = bundles;
    to->order = order;
    free(e);
    return KOKSMA_OK;
}

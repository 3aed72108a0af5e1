/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The smallest distance between two points of a set in the plane, by divide and conquer (Shamos & Hoey 1975): the
 * closest pair lies in the left half of the points, in the right half, or across the line between the halves. A pair
 * across the line can be closer than d, the smallest distance so far, only if both points are less than d from the
 * line and their y differ by less than d; few pairs meet these conditions. On the torus a second search covers the
 * points near a side together with copies of the points near the opposite side.
 */
#include "core/points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/vector.h"

enum { PAIRS_AT_ONCE = 1 << 20 };

/* A point or its copy in a neighbouring tile; its coordinates have rounding errors of less than ROUNDED. */
typedef struct place {
    double x, y;
    const double *point;
} place;

static const double ROUNDED = 0x1p-51;

typedef struct search {
    const koksma_run *run;
    bool torus, stopped;
    /* best: the least squared distance so far; reach: a pair whose x or y differ by more than this is not closer */
    double best, reach;
    size_t pairs, n_done, n;
} search;

static int compare_x(const void *a, const void *b)
{
    const place *p = a, *q = b;
    return p->x < q->x ? -1 : p->x > q->x;
}

static void set_best(search *s, double square)
{
    s->best = square;
    s->reach = sqrt(square) + (s->torus ? ROUNDED : 0);
}

static void try_pair(search *s, const double *p, const double *q)
{
    const double dx = s->torus ? koksma__torus_difference(p[0], q[0]) : p[0] - q[0];
    const double dy = s->torus ? koksma__torus_difference(p[1], q[1]) : p[1] - q[1];
    if (p != q && dx * dx + dy * dy < s->best) {
        set_best(s, dx * dx + dy * dy);
    }
    if (++s->pairs % PAIRS_AT_ONCE == 0) {
        s->stopped = s->stopped || !koksma__keep_going(s->run, (double)s->n_done / (double)s->n);
    }
}

/* Finds the closest pair among n points that are sorted by x, and sorts them by y at the same time. scratch: capacity
   n. */
static void divide(search *s, place *at, place *scratch, size_t n)
{
    if (n < 2 || s->stopped || !(s->best > 0)) {
        s->n_done += n;
        return;
    }
    const size_t half = n / 2;
    const double middle = at[half].x;
    divide(s, at, scratch, half);
    divide(s, at + half, scratch, n - half);
    for (size_t i = 0, a = 0, b = half; i < n; i++) {
        scratch[i] = b == n || (a < half && at[a].y <= at[b].y) ? at[a++] : at[b++];
    }
    memcpy(at, scratch, n * sizeof *at);
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
        if (fabs(at[i].x - middle) <= s->reach) {
            scratch[m++] = at[i];
        }
    }
    for (size_t i = 0; i < m; i++) {
        for (size_t j = i + 1; j < m && scratch[j].y - scratch[i].y <= s->reach && s->best > 0 && !s->stopped; j++) {
            try_pair(s, scratch[i].point, scratch[j].point);
        }
    }
}

static koksma_status find(search *s, place *places, size_t n)
{
    place *scratch = malloc(n * sizeof *scratch);
    KOKSMA__REQUIRE_MEMORY(scratch, n * sizeof *scratch);
    qsort(places, n, sizeof *places, compare_x);
    s->n = n;
    s->n_done = 0;
    s->stopped = !koksma__keep_going(s->run, 0);
    divide(s, places, scratch, n);
    free(scratch);
    return s->stopped ? koksma__fail_interrupted() : KOKSMA_OK;
}

/* Collects in `out` the points less than `margin` from a side of the square, and their copies on the torus less than
   `margin` beyond a side. Returns the number of both; out may be NULL. */
static size_t lay_out_sides(const koksma_points *points, double margin, place *out)
{
    size_t m = 0;
    for (size_t i = 0; i < points->n; i++) {
        const double *p = points->xs + 2 * i;
        if (p[0] >= margin && p[0] <= 1 - margin && p[1] >= margin && p[1] <= 1 - margin) {
            continue;
        }
        for (int tile = 0; tile < 9; tile++) {
            const place copy = {p[0] + (tile % 3 - 1), p[1] + (tile / 3 - 1), p};
            if (tile == 4 || (copy.x > -margin && copy.x < 1 + margin && copy.y > -margin && copy.y < 1 + margin)) {
                if (out) {
                    out[m] = copy;
                }
                m++;
            }
        }
    }
    return m;
}

koksma_status koksma__closest_pair(const koksma_points *points, bool torus, const koksma_run *run, double *distance)
{
    search s = {.run = run, .best = INFINITY, .reach = INFINITY};
    place *places = malloc(points->n * sizeof *places);
    KOKSMA__REQUIRE_MEMORY(places, points->n * sizeof *places);
    for (size_t i = 0; i < points->n; i++) {
        const double *p = points->xs + 2 * i;
        places[i] = (place){p[0], p[1], p};
    }
    koksma_status status = find(&s, places, points->n);
    free(places);
    if (!status && torus) {
        s.torus = true;
        set_best(&s, s.best);
        const double margin = s.reach;
        const size_t n = lay_out_sides(points, margin, NULL);
        places = malloc((n ? n : 1) * sizeof *places);
        KOKSMA__REQUIRE_MEMORY(places, n * sizeof *places);
        lay_out_sides(points, margin, places);
        status = n ? find(&s, places, n) : KOKSMA_OK;
        free(places);
    }
    *distance = sqrt(s.best);
    return status;
}

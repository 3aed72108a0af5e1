/* SPDX-License-Identifier: Apache-2.0 */
/* Pairs of points nearer than r, by cells at least r wide: a point's partners are in its cell and the eight around
   it. O(n + pairs) for spread points; where points crowd in few cells the smallest distance is found by halving
   (core/closest_pair.c), O(n log n). Both ways square the same differences, so that their bits are equal. */
#include "measures/shared/neighbours.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/spectrum.h>

#include "core/closest_pair.h"
#include "core/parallel.h"
#include "core/points_io.h"
#include "core/status.h"
#include "measures/shared/torus_cells.h"

/* Cells at least r wide, and about one point a cell at the least; 1 or 2 columns: every cell is a neighbour. */
static koksma_status open_grid(const koksma_points *p, double r, koksma__torus_cells *g)
{
    const size_t most = (size_t)sqrt((double)p->n) + 1, wanted = r > 0 ? (size_t)fmin(1 / r, 1e6) : most;
    return koksma__torus_cells_init(g, p, (double)(wanted < most ? wanted : most), false);
}

static double distance2(double dx, double dy, bool torus)
{
    dx = fabs(dx);
    dy = fabs(dy);
    if (torus) {
        dx = dx < 1 - dx ? dx : 1 - dx;
        dy = dy < 1 - dy ? dy : 1 - dy;
    }
    return dx * dx + dy * dy;
}

enum { PAIRS_PER_QUESTION = 1 << 16 };

typedef struct visit {
    const koksma__torus_cells *g;
    double r2;
    bool torus;
    const koksma_run *run;
    koksma__near_pair_function f;
    void *context;
    size_t unasked; /* pairs since run was asked whether to go on */
    bool stopped;   /* by run */
} visit;

/* Points of cell c with those of cell d that come later; false: no more are wanted. */
static bool pairs_of_cells(visit *v, size_t c, size_t d)
{
    const koksma__torus_cells *g = v->g;
    for (size_t i = g->start[c]; i < g->start[c + 1]; i++) {
        for (size_t j = d == c ? i + 1 : g->start[d]; j < g->start[d + 1]; j++) {
            const double d2 = distance2(g->xs[i] - g->xs[j], g->ys[i] - g->ys[j], v->torus);
            if (d2 < v->r2 && !v->f(v->context, d2)) {
                return false;
            }
        }
        v->unasked += 1 + g->start[d + 1] - g->start[d];
        if (v->unasked > PAIRS_PER_QUESTION) {
            v->unasked = 0;
            v->stopped = !koksma__keep_going(v->run, (double)c / (double)(g->columns * g->columns));
            if (v->stopped) {
                return false;
            }
        }
    }
    return true;
}

/* Points of cell c with those of the neighbours, each once, that do not come before. */
static bool pairs_of_cell(visit *v, size_t c)
{
    const size_t m = v->g->columns;
    size_t seen[9], n_seen = 0;
    bool wanted = true;
    for (int k = 0; k < 9 && wanted; k++) {
        const size_t x = (c % m + m + (size_t)(k % 3) - 1) % m, y = (c / m + m + (size_t)(k / 3) - 1) % m;
        const size_t d = y * m + x;
        bool is_new = d >= c;
        for (size_t i = 0; i < n_seen; i++) {
            is_new = is_new && seen[i] != d;
        }
        if (is_new) {
            seen[n_seen++] = d;
            wanted = pairs_of_cells(v, c, d);
        }
    }
    return wanted;
}

static koksma_status visit_pairs(visit *v)
{
    for (size_t c = 0; c < v->g->columns * v->g->columns && pairs_of_cell(v, c); c++) {
    }
    return v->stopped ? koksma__fail_interrupted() : KOKSMA_OK;
}

koksma_status koksma__near_pairs(const koksma_points *points, double r, bool torus, const koksma_run *run,
                                 koksma__near_pair_function f, void *context)
{
    koksma__torus_cells g;
    koksma_status status = open_grid(points, r, &g);
    if (status) {
        return status;
    }
    visit v = {.g = &g, .r2 = r * r, .torus = torus, .run = run, .f = f, .context = context};
    status = visit_pairs(&v);
    koksma__torus_cells_fini(&g);
    return status;
}

/* No distance is below 0. */
static bool keep_least(void *context, double d2)
{
    double *least = context;
    *least = d2 < *least ? d2 : *least;
    return *least > 0;
}

enum { CROWD = 64 };

/* Whether the pairs within cells are few; those with the neighbours are then no more than nine times as many. */
static bool is_spread(const koksma__torus_cells *g, size_t n)
{
    double pairs = 0;
    for (size_t c = 0; c < g->columns * g->columns; c++) {
        const double count = (double)(g->start[c + 1] - g->start[c]);
        pairs += count * count;
    }
    return pairs <= CROWD * (double)n;
}

/* Of crowded points the cells are of no help. Both ways square the same differences, so that the bits are equal. */
static koksma_status least_of_many(const koksma_points *points, double r, bool torus, const koksma_run *run,
                                   double *distance)
{
    koksma__torus_cells g;
    double least = HUGE_VAL;
    koksma_status status = open_grid(points, r, &g);
    if (status) {
        return status;
    }
    const bool spread = is_spread(&g, points->n);
    if (spread) {
        visit v = {.g = &g, .r2 = r * r, .torus = torus, .run = run, .f = keep_least, .context = &least};
        status = visit_pairs(&v);
        *distance = sqrt(least);
    }
    koksma__torus_cells_fini(&g);
    return spread ? status : koksma__closest_pair(points, torus, run, distance);
}

koksma_status koksma__min_distance(const char *name, const koksma_points *points, bool torus, const koksma_run *run,
                                   double *distance)
{
    if (points->n < 2) {
        return koksma__fail(KOKSMA_N, "%s: n = 1: one point has no distance; two points or more have", name);
    }
    double least = HUGE_VAL, r = fmin(1.1 / sqrt((double)points->n), 0.5); /* no n points are further apart */
    if (points->n < 16) {
        for (size_t i = 0; i < points->n; i++) {
            for (size_t j = 0; j < i; j++) {
                const double *a = points->xs + 2 * i, *b = points->xs + 2 * j;
                keep_least(&least, distance2(a[0] - b[0], a[1] - b[1], torus));
            }
        }
    } else {
        r = torus ? r : fmin(1.5 * r, 0.5);
        return least_of_many(points, r, torus, run, distance);
    }
    *distance = sqrt(least);
    return KOKSMA_OK;
}

typedef struct histogram {
    double scale;
    size_t bins;
    double *counts;
} histogram;

static bool count_pair(void *context, double d2)
{
    const histogram *h = context;
    const size_t bin = (size_t)(sqrt(d2) * h->scale);
    h->counts[bin < h->bins ? bin : h->bins - 1] += 1;
    return true;
}

koksma_status koksma_pair_correlation(const koksma_points *points, double r_max, size_t bins, const koksma_run *run,
                                      double *values)
{
    KOKSMA__REQUIRE(points, values);
    KOKSMA__REQUIRE_RUN(run);
    if (points->dim != 2) {
        return koksma__fail(KOKSMA_DIM, "pair correlation: it has no %d-dimensional form, only dim = 2", points->dim);
    }
    if (!(r_max > 0 && r_max <= 0.5) || bins == 0) {
        return koksma__fail(KOKSMA_ARGUMENT, "pair correlation: r_max = %g: it takes 0 < r_max <= 1/2, and bins",
                            r_max);
    }
    koksma_status checked = koksma__points_check(points);
    checked = checked ? checked : koksma__array_check("bins", values, bins, sizeof *values);
    if (checked) {
        return checked;
    }
    histogram h = {(double)bins / r_max, bins, values};
    memset(values, 0, bins * sizeof *values);
    const koksma_status status = koksma__near_pairs(points, r_max, true, run, count_pair, &h);
    const double pairs = (double)points->n * ((double)points->n - 1) / 2, width = r_max / (double)bins;
    for (size_t b = 0; b < bins && !status; b++) {
        const double share = M_PI * width * width * (2 * (double)b + 1);
        values[b] = pairs > 0 ? values[b] / (pairs * share) : (double)NAN;
    }
    return status;
}

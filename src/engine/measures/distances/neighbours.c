/* SPDX-License-Identifier: Apache-2.0 */
/* Visits all pairs of points with a distance below r. In a grid of cells at least r wide, the partners of a point are
   in its own cell and in the eight cells around it. This takes O(n + pairs) for evenly spread points. If many points
   share few cells or are not in the plane, closest_pair.c finds the smallest distance. Both methods square the same
   differences, so that they give the same bits. */
#include "measures/distances/distances.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/spectrum.h>

#include "core/parallel.h"
#include "core/points.h"
#include "core/status.h"
#include "core/torus_rows.h"
#include "kernels/kernels.h"

/* Makes cells at least r wide with about one point or more on average. With 1 or 2 columns every cell is a neighbour
   of every other. */
static koksma_status open_grid(const koksma_points *p, double r, koksma__torus_rows *g)
{
    const size_t most = (size_t)sqrt((double)p->n) + 1, wanted = r > 0 ? (size_t)fmin(1 / r, 1e6) : most;
    KOKSMA__TRY(koksma__torus_rows_init(g, p->n, wanted > most ? most : wanted ? wanted : 1));
    koksma__torus_rows_sort(g, p->n, p->xs, false);
    return KOKSMA_OK;
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
    const koksma__torus_rows *g;
    double r2;
    bool torus;
    const koksma_run *run;
    double least; /* the smallest squared distance found so far, below r2; unused if counts is not NULL */
    double scale; /* number of bins per unit of distance */
    size_t bins;
    uint64_t *counts; /* number of pairs in each bin of distances, followed by eight spare entries; or NULL */
    size_t unasked;   /* number of pairs visited since the last call of koksma__keep_going */
    bool stopped;     /* true when the caller asked to stop */
} visit;

/* Visits the pairs of point i with points first .. end - 1. */
static void pairs_of_point(visit *v, size_t i, size_t first, size_t end)
{
    const koksma__torus_rows *g = v->g;
    if (v->counts && first < end) {
        koksma__kernels()->pair_counts(end - first, g->xs + first, g->ys + first, g->xs[i], g->ys[i], v->r2, v->scale,
                                       v->bins, v->counts);
        return;
    }
    for (size_t j = first; j < end; j++) {
        const double d2 = distance2(g->xs[i] - g->xs[j], g->ys[i] - g->ys[j], v->torus);
        v->least = d2 < v->r2 && d2 < v->least ? d2 : v->least;
    }
}

/* Visits the pairs of a point of cell c and a later point of cells d .. last. Returns false to end the search. */
static bool pairs_of_cells(visit *v, size_t c, size_t d, size_t last)
{
    const koksma__torus_rows *g = v->g;
    for (size_t i = g->start[c]; i < g->start[c + 1]; i++) {
        pairs_of_point(v, i, d == c ? i + 1 : g->start[d], g->start[last + 1]);
        if (!v->counts && v->least == 0) { /* stop: no distance can be smaller */
            return false;
        }
        v->unasked += 1 + g->start[last + 1] - g->start[d];
        if (v->unasked > PAIRS_PER_QUESTION) {
            v->unasked = 0;
            v->stopped = !koksma__keep_going(v->run, (double)c / (double)g->cells / (double)g->cells);
            if (v->stopped) {
                return false;
            }
        }
    }
    return true;
}

/* Visits the pairs of points within cell c, and the pairs of a point in c and a point in a later neighbour cell.
   Adjacent neighbour cells are visited together, because their points are contiguous in memory. */
static bool pairs_of_cell(visit *v, size_t c)
{
    const size_t m = v->g->cells;
    size_t cells[10], n = 0;
    for (int k = 0; k < 9; k++) {
        const size_t x = (c % m + m + (size_t)(k % 3) - 1) % m, y = (c / m + m + (size_t)(k / 3) - 1) % m;
        const size_t d = y * m + x;
        size_t at = n;
        while (at > 0 && cells[at - 1] > d) {
            at--;
        }
        if (d >= c && (at == 0 || cells[at - 1] != d)) {
            memmove(cells + at + 1, cells + at, (n++ - at) * sizeof *cells);
            cells[at] = d;
        }
    }
    for (size_t first = 0, end; first < n; first = end) {
        end = first + 1;
        while (end < n && cells[end] == cells[end - 1] + 1) {
            end++;
        }
        if (!pairs_of_cells(v, c, cells[first], cells[end - 1])) {
            return false;
        }
    }
    return true;
}

static koksma_status visit_pairs(visit *v)
{
    for (size_t c = 0; c < (size_t)v->g->cells * v->g->cells && pairs_of_cell(v, c); c++) {
    }
    return v->stopped ? koksma__fail_interrupted() : KOKSMA_OK;
}

enum { CROWD = 64 };

/* Returns whether there are few pairs within cells. The pairs of points in neighbouring cells are then at most nine
   times as many. */
static bool is_spread(const koksma__torus_rows *g, size_t n)
{
    double pairs = 0;
    for (size_t c = 0; c < (size_t)g->cells * g->cells; c++) {
        const double count = (double)(g->start[c + 1] - g->start[c]);
        pairs += count * count;
    }
    return pairs <= CROWD * (double)n;
}

/* Computes the smallest distance with cells of width r or, for crowded points, by the k-d tree. */
static koksma_status least_of_many(const koksma_points *points, double r, bool torus, const koksma_run *run,
                                   double *distance)
{
    koksma__torus_rows g;
    KOKSMA__TRY(open_grid(points, r, &g));
    koksma_status status = KOKSMA_OK;
    const bool spread = is_spread(&g, points->n);
    if (spread) {
        visit v = {.g = &g, .r2 = r * r, .torus = torus, .run = run, .least = HUGE_VAL};
        status = visit_pairs(&v);
        *distance = sqrt(v.least);
    }
    koksma__torus_rows_fini(&g);
    return spread ? status : koksma__closest_pair(points, torus, run, distance);
}

koksma_status koksma__min_distance(const char *name, const koksma_points *points, bool torus, const koksma_run *run,
                                   double *distance)
{
    KOKSMA__FAIL_IF(points->n < 2, KOKSMA_N, "%s: n = 1: the smallest distance needs at least two points", name);
    if (!koksma__keep_going(run, 0)) {
        return koksma__fail_interrupted();
    }
    if (points->dim != 2) {
        return koksma__closest_pair(points, torus, run, distance);
    }
    double least = HUGE_VAL,
           r = fmin(1.1 / sqrt((double)points->n), 0.5); /* upper bound of the smallest distance of n points */
    if (points->n < 16) {
        for (size_t i = 0; i < points->n; i++) {
            for (size_t j = 0; j < i; j++) {
                const double *a = points->xs + 2 * i, *b = points->xs + 2 * j;
                least = fmin(least, distance2(a[0] - b[0], a[1] - b[1], torus));
            }
        }
    } else {
        r = torus ? r : fmin(1.5 * r, 0.5);
        return least_of_many(points, r, torus, run, distance);
    }
    *distance = sqrt(least);
    return KOKSMA_OK;
}

koksma_status koksma_pair_correlation(const koksma_points *points, double r_max, size_t bins, const koksma_run *run,
                                      double *values)
{
    KOKSMA__REQUIRE(points, values);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(points->dim != 2, KOKSMA_DIM, "pair correlation: it has no %d-dimensional form, only dim = 2",
                    points->dim);
    KOKSMA__FAIL_IF(!(r_max > 0 && r_max <= 0.5) || bins == 0, KOKSMA_ARGUMENT,
                    "pair correlation: r_max = %g, %zu bins: it takes 0 < r_max <= 1/2 and at least 1 bin", r_max,
                    bins);
    koksma_status checked = koksma__points_check(points);
    checked = checked ? checked : koksma__array_check("bins", values, bins, sizeof *values);
    if (checked) {
        return checked;
    }
    koksma__torus_rows g;
    KOKSMA__TRY(open_grid(points, r_max, &g));
    visit v = {.g = &g,
               .r2 = r_max * r_max,
               .run = run,
               .scale = (double)bins / r_max,
               .bins = bins,
               .counts = calloc(bins + 8, sizeof *v.counts)};
    const koksma_status status = v.counts ? visit_pairs(&v) : koksma__fail_memory((bins + 8) * sizeof *v.counts);
    koksma__torus_rows_fini(&g);
    const double pairs = (double)points->n * ((double)points->n - 1) / 2, width = r_max / (double)bins;
    for (size_t b = 0; b < bins && !status; b++) {
        const double share = M_PI * width * width * (2 * (double)b + 1);
        values[b] = pairs > 0 ? (double)v.counts[b] / (pairs * share) : (double)NAN;
    }
    free(v.counts);
    return status;
}

/* SPDX-License-Identifier: Apache-2.0 */
/* Threshold accepting over corners (after Gnewuch, Wahlstrom and Winzen 2012). A step moves some coordinates by a
   bounded number of ranks and then snaps: a closed box shrinks to its points, an open one grows until points stop it;
   both only gain. The moves get smaller and the thresholds, first the spread of random corners, go to zero. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "measures/parts/clock.h"
#include "measures/parts/order.h"
#include "measures/parts/star.h"

typedef struct walk {
    const koksma_points *points;
    size_t n, dim;
    double *levels; /* dim rows of n + 1: coordinates in order, then 1 */
    uint64_t seed, index;
    uint32_t lane, n_walks; /* lane: which walk this is */
    const koksma_run *run;
    double deadline_s;
    bool stopped, late;
} walk;

static double draw(walk *w)
{
    double pair[2];
    koksma__random_pair(w->seed, KOKSMA__PURPOSE_SEARCH, w->index++, w->lane, pair);
    return pair[0];
}

static size_t rank_of(const walk *w, size_t k, double x)
{
    size_t low = 0, high = w->n;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (w->levels[k * (w->n + 1) + middle] < x) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* The value of the closed box that just holds the points in corner; corner becomes it. */
static double shrink(const walk *w, double *corner)
{
    double tight[KOKSMA__STAR_MAX_DIM] = {0}, volume = 1;
    size_t count = 0;
    for (size_t i = 0; i < w->n; i++) {
        const double *x = w->points->xs + i * w->dim;
        bool in = true;
        for (size_t k = 0; k < w->dim && in; k++) {
            in = x[k] <= corner[k];
        }
        for (size_t k = 0; k < w->dim && in; k++) {
            tight[k] = x[k] > tight[k] ? x[k] : tight[k];
        }
        count += in;
    }
    for (size_t k = 0; k < w->dim; k++) {
        corner[k] = tight[k];
        volume *= tight[k];
    }
    return (double)count / (double)w->n - volume;
}

/* Grows the open box in coordinates first, first + 1, .. (around) as far as no point comes in. */
static double grow(const walk *w, double *corner, size_t first)
{
    double volume = 1;
    size_t count = 0;
    for (size_t step = 0; step < w->dim; step++) {
        const size_t free_k = (first + step) % w->dim;
        double end = 1;
        count = 0;
        for (size_t i = 0; i < w->n; i++) {
            const double *x = w->points->xs + i * w->dim;
            bool in = true;
            for (size_t k = 0; k < w->dim && in; k++) {
                in = k == free_k || x[k] < corner[k];
            }
            if (in && x[free_k] < corner[free_k]) {
                count++;
            } else if (in && x[free_k] < end) {
                end = x[free_k];
            }
        }
        corner[free_k] = end;
        volume *= end;
    }
    return volume - (double)count / (double)w->n;
}

static double snap(walk *w, double *corner, bool closed)
{
    return closed ? shrink(w, corner) : grow(w, corner, (size_t)(draw(w) * (double)w->dim));
}

static void random_corner(walk *w, double *corner)
{
    for (size_t k = 0; k < w->dim; k++) {
        const double u = pow(draw(w), 1.0 / (double)w->dim);
        corner[k] = w->levels[k * (w->n + 1) + rank_of(w, k, u)];
    }
}

/* From corner: each of m coordinates goes to a level within `reach` ranks. */
static void move(walk *w, const double *corner, size_t m, size_t reach, double *to)
{
    memcpy(to, corner, w->dim * sizeof *to);
    for (size_t c = 0; c < m; c++) {
        const size_t k = (size_t)(draw(w) * (double)w->dim);
        const size_t rank = rank_of(w, k, corner[k]), low = rank > reach ? rank - reach : 0;
        const size_t high = rank + reach < w->n ? rank + reach : w->n;
        to[k] = w->levels[k * (w->n + 1) + low + (size_t)(draw(w) * (double)(high - low + 1))];
    }
}

static void keep_best(const walk *w, double value, const double *corner, bool closed, koksma_value *out)
{
    if (!(value <= out->value)) {
        koksma__star_keep(w->points, corner, closed, out);
    }
}

/* True when the walk is to end: out of time, or told to stop. */
static bool ends(walk *w, double fraction_done)
{
    w->stopped = w->stopped || !koksma__keep_going(w->run, (w->lane + fraction_done) / w->n_walks);
    w->late = w->late || koksma__now_s() > w->deadline_s;
    return w->stopped || w->late;
}

/* One corner is looked at in any case. */
static void run_walk(walk *w, size_t steps, bool closed, koksma_value *out)
{
    double corner[KOKSMA__STAR_MAX_DIM], other[KOKSMA__STAR_MAX_DIM], spread = 0;
    random_corner(w, corner);
    double value = snap(w, corner, closed);
    for (int i = 0; i < 8 && !(i > 0 && ends(w, 0)); i++) {
        random_corner(w, other);
        const double gained = snap(w, other, closed);
        keep_best(w, gained, other, closed, out);
        spread += fabs(gained - value) / 8;
        if (gained > value) {
            value = gained;
            memcpy(corner, other, sizeof corner);
        }
    }
    for (size_t step = 0; step < steps && !ends(w, (double)step / (double)steps); step++) {
        const double left = 1 - (double)step / (double)steps;
        const size_t reach = 1 + (size_t)((double)w->n / 8 * left);
        const size_t m = 1 + (size_t)(draw(w) * (double)(w->dim < 2 ? 1 : w->dim));
        move(w, corner, m, reach, other);
        const double next = snap(w, other, closed);
        if (next >= value - spread * left * left / 4) {
            value = next;
            memcpy(corner, other, sizeof corner);
            keep_best(w, value, corner, closed, out);
        }
    }
}

koksma_status koksma__star_search(const koksma_points *points, const koksma_run *run, uint64_t seed, size_t steps,
                                  size_t restarts, double deadline_s, koksma_value *out)
{
    const size_t n = points->n, dim = (size_t)points->dim, bytes = dim * (n + 1) * sizeof(double) + n * 4;
    walk w = {.points = points,
              .n = n,
              .dim = dim,
              .levels = malloc(bytes),
              .seed = seed,
              .n_walks = 2 * (uint32_t)restarts,
              .run = run,
              .deadline_s = deadline_s};
    if (!w.levels) {
        return koksma__fail_memory(bytes);
    }
    uint32_t *order = (uint32_t *)(w.levels + dim * (n + 1));
    koksma_status status = KOKSMA_OK;
    for (size_t k = 0; k < dim && !status; k++) {
        status = koksma__order(run, n, points->xs + k, dim, order);
        for (size_t i = 0; i < n && !status; i++) {
            w.levels[k * (n + 1) + i] = points->xs[order[i] * dim + k];
        }
        w.levels[k * (n + 1) + n] = 1;
    }
    if (!status) { /* the whole cube, to have a box in any case */
        double ones[KOKSMA__STAR_MAX_DIM];
        for (size_t k = 0; k < dim; k++) {
            ones[k] = 1;
        }
        koksma__star_keep(points, ones, true, out);
    }
    for (size_t r = 0; r < 2 * restarts && !status && !w.late; r++) {
        w.lane = (uint32_t)r;
        w.index = 0;
        run_walk(&w, steps, r % 2, out);
        status = w.stopped ? koksma__fail_interrupted() : KOKSMA_OK;
    }
    free(w.levels);
    return status;
}

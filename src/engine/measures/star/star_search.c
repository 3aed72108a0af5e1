/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A lower bound of the star discrepancy by threshold accepting over corners (Gnewuch, Wahlstrom and Winzen 2012),
 * with separate walks for closed boxes (excess) and open boxes (deficit).
 *
 * In the paper a corner moves to the nearest critical corner. Here a step instead climbs to a corner that no change
 * of a single coordinate improves. With the other coordinates fixed, one pass over the points in order of coordinate
 * k counts the points that are inside in the other coordinates. This gives the value of the box for every end along
 * k, and the best end is taken. This is repeated until a round over all coordinates brings no improvement. The search
 * stores for each point the number of coordinates in which it is outside. A pass therefore reads each point once, and
 * moving an end updates only the points between the old and the new end.
 *
 * A step moves some coordinates by a bounded number of ranks and climbs. The step is undone if the new value is less
 * than the old value minus a threshold. The moves get smaller and the threshold goes to zero.
 */
#include "measures/star/star.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "measures/shared/shared.h"

enum { DIMS = KOKSMA__STAR_MAX_DIM, MANY = 1 << 14 };

typedef struct walk {
    const koksma_points *points;
    size_t n, dim;
    double *levels;   /* dim rows of n + 1 numbers: the coordinates of the points in order, then 1 */
    uint32_t *orders; /* dim rows of n numbers: the indices of the points in order of each coordinate */
    /* The box: corner[k] is one of the levels. cut[k] is the number of points whose coordinate k is below corner[k]
       (for closed boxes: at most corner[k]); outside[i] is the number of coordinates in which point i is outside. */
    bool closed;
    double corner[DIMS];
    size_t cut[DIMS];
    uint8_t *outside;
    uint64_t seed, index;
    uint32_t lane, n_walks; /* index of this walk among n_walks */
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

static size_t draw_below(walk *w, size_t n)
{
    return (size_t)(draw(w) * (double)n);
}

/* Returns the first level of coordinate k that is not below x. */
static size_t rank_of(const walk *w, size_t k, double x)
{
    const double *levels = w->levels + k * (w->n + 1);
    size_t low = 0, high = w->n;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (levels[middle] < x) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* Moves the end of the box along coordinate k to level `rank`. */
static void set_end(walk *w, size_t k, size_t rank)
{
    const double *levels = w->levels + k * (w->n + 1);
    const uint32_t *order = w->orders + k * w->n;
    size_t cut = rank;
    w->corner[k] = levels[rank];
    while (!w->closed && cut > 0 && levels[cut - 1] == levels[rank]) {
        cut--;
    }
    while (w->closed && cut < w->n && levels[cut] == levels[rank]) {
        cut++;
    }
    for (size_t p = w->cut[k]; p < cut; p++) {
        w->outside[order[p]]--;
    }
    for (size_t p = cut; p < w->cut[k]; p++) {
        w->outside[order[p]]++;
    }
    w->cut[k] = cut;
}

/* Moves the end of the box along coordinate k to the level with the largest value. Returns n times this value. */
static double best_end(walk *w, size_t k)
{
    const double *levels = w->levels + k * (w->n + 1);
    const uint32_t *order = w->orders + k * w->n;
    const size_t cut = w->cut[k];
    double scale = (double)w->n, best = -INFINITY, count = 0;
    size_t at = w->n;
    for (size_t j = 0; j < w->dim; j++) {
        scale *= j == k ? 1 : w->corner[j];
    }
    for (size_t p = 0; p < w->n; p++) {
        if (w->outside[order[p]] == (p >= cut)) {
            const double value = w->closed ? count + 1 - scale * levels[p] : scale * levels[p] - count;
            count++;
            at = value > best ? p : at;
            best = value > best ? value : best;
        }
    }
    const double last = w->closed ? count - scale : scale - count;
    if (last > best) {
        at = w->n;
        best = last;
    }
    set_end(w, k, at);
    return best;
}

/* Returns whether the walk must end, because the deadline has passed or the caller asked to stop. */
static bool ends(walk *w, double fraction_done)
{
    w->stopped = w->stopped || !koksma__keep_going(w->run, (w->lane + fraction_done) / w->n_walks);
    w->late = w->late || koksma__now_s() > w->deadline_s;
    return w->stopped || w->late;
}

/* Climbs to a box that no change of a single coordinate improves, or until the walk must end. Returns its value. */
static double climb(walk *w, double fraction_done)
{
    const size_t first = draw_below(w, w->dim);
    double value = -INFINITY;
    for (size_t pass = 0, without_gain = 0; without_gain < w->dim; pass++) {
        if (pass > 0 && w->n > MANY && ends(w, fraction_done)) {
            break;
        }
        const double next = best_end(w, (first + pass) % w->dim);
        without_gain = next > value + 1e-12 * (double)w->n ? 1 : without_gain + 1;
        value = next;
    }
    return value / (double)w->n;
}

static double random_box(walk *w)
{
    for (size_t k = 0; k < w->dim; k++) {
        set_end(w, k, rank_of(w, k, koksma__pow(draw(w), 1.0 / (double)w->dim)));
    }
    return climb(w, 0);
}

/* Moves the end of the box in m random coordinates, in each to a random level at most `reach` ranks away. */
static void move(walk *w, size_t m, size_t reach)
{
    for (size_t c = 0; c < m; c++) {
        const size_t k = draw_below(w, w->dim);
        const size_t rank = rank_of(w, k, w->corner[k]), low = rank > reach ? rank - reach : 0;
        const size_t high = rank + reach < w->n ? rank + reach : w->n;
        set_end(w, k, low + draw_below(w, high - low + 1));
    }
}

static void keep_best(const walk *w, double value, koksma_value *out)
{
    if (!(value <= out->value)) {
        koksma__star_keep(w->points, w->corner, w->closed, out);
    }
}

/* Does one walk, which evaluates at least one box even after the deadline. */
static void run_walk(walk *w, size_t steps, koksma_value *out)
{
    double kept[DIMS];
    for (size_t k = 0; k < w->dim; k++) {
        w->cut[k] = w->n;
    }
    memset(w->outside, 0, w->n);
    double value = random_box(w);
    keep_best(w, value, out);
    const double threshold = value / 10;
    for (size_t step = 0; step < steps && !ends(w, (double)step / (double)steps); step++) {
        const double done = (double)step / (double)steps, left = 1 - done;
        memcpy(kept, w->corner, sizeof kept);
        move(w, 1 + draw_below(w, w->dim), 1 + (size_t)((double)w->n / 2 * left));
        const double next = climb(w, done);
        if (next >= value - threshold * left) {
            value = next;
            keep_best(w, value, out);
        } else {
            for (size_t k = 0; k < w->dim; k++) {
                set_end(w, k, rank_of(w, k, kept[k]));
            }
        }
    }
}

koksma_status koksma__star_search(const koksma_points *points, const koksma_run *run, uint64_t seed, size_t steps,
                                  size_t restarts, double deadline_s, koksma_value *out)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    const size_t bytes = dim * (n + 1) * sizeof(double) + dim * n * sizeof(uint32_t) + n;
    walk w = {.points = points,
              .n = n,
              .dim = dim,
              .levels = malloc(bytes),
              .seed = seed,
              .n_walks = 2 * (uint32_t)restarts,
              .run = run,
              .deadline_s = deadline_s};
    KOKSMA__REQUIRE_MEMORY(w.levels, bytes);
    w.orders = (uint32_t *)(w.levels + dim * (n + 1));
    w.outside = (uint8_t *)(w.orders + dim * n);
    koksma_status status = KOKSMA_OK;
    for (size_t k = 0; k < dim && !status; k++) {
        uint32_t *order = w.orders + k * n;
        status = koksma__order(run, n, points->xs + k, dim, order);
        for (size_t i = 0; i < n && !status; i++) {
            w.levels[k * (n + 1) + i] = points->xs[order[i] * dim + k];
        }
        w.levels[k * (n + 1) + n] = 1;
    }
    if (!status) { /* start with the whole cube, so that there is always a witness */
        double ones[DIMS];
        for (size_t k = 0; k < dim; k++) {
            ones[k] = 1;
        }
        koksma__star_keep(points, ones, true, out);
    }
    for (size_t r = 0; r < 2 * restarts && !status && !w.late; r++) {
        w.lane = (uint32_t)r;
        w.index = 0;
        w.closed = r % 2;
        run_walk(&w, steps, out);
        status = w.stopped ? koksma__fail_interrupted() : KOKSMA_OK;
    }
    free(w.levels);
    return status;
}

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds the best box in the plane by branch and bound over the left and right sides of boxes. A strip is the part of
 * the square between a left and a right side; one pass over its points in order of y finds its best box. A tile is
 * the set of strips whose left side is one of the levels a1 .. a2 of x and whose right side is one of b1 .. b2. The
 * same pass gives a bound for a tile: the excess is bounded by the points of the widest strip with the width of the
 * narrowest, the deficit by the points of the narrowest strip with the width of the widest. Tiles whose bound does
 * not exceed the best box are dropped, others are cut into 4 x 4 tiles, down to single strips. Passes are done for 16
 * tiles at once. Each block of left sides is a separate job with its own best box, so that the result does not depend
 * on the number of threads. A block for which bounding has cost as much as a sweep from each of its left sides would
 * is swept instead; counted work decides this, not a clock.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/shared/deadline.h"
#include "measures/shared/extreme.h"
#include "measures/shared/extreme_sweep.h"
#include "measures/shared/order.h"

enum { LANES = 16, COARSE = 32, DEPTH = 4, GROUPS = 8, FIRST_LEVELS = 48, MAX_ROWS = 64 };

#define SWEEP_COST 20.0

/* The number of levels in the side of a tile at each depth of the search. */
static const size_t tile_sides[DEPTH] = {COARSE, 8, 2, 1};

typedef struct tile {
    size_t a, b;  /* first levels; the last ones are a + side - 1 and b + side - 1, or the last level of all */
    double bound; /* bound of the tile from which this one was cut; infinite at first */
} tile;

typedef struct best_strip {
    double value; /* times n */
    tile strip;
    bool closed;
} best_strip;

typedef struct plane {
    size_t n, n_levels;
    double *x, *y;     /* points in order of y */
    double *levels;    /* the distinct values of x, with 0 and 1 */
    best_strip *best;  /* for each block of left sides */
    double *upper;     /* for each block, the bound of tiles left at the deadline; infinite if some have none */
    double *row_upper; /* for each row of wide tiles, of row_side left sides each, its bound after the deadline */
    size_t row_side;
    double deadline_s;
    koksma__extreme_method method;
    koksma__sweep_plane sweep;
} plane;

typedef struct searcher {
    const plane *p;
    double *x, *y; /* the points of the current group of tiles */
    size_t count;
    tile waiting[DEPTH][LANES];
    int n_waiting[DEPTH];
    best_strip best;
    double upper, work, budget; /* points passed so far; number of points passed that costs as much as a sweep */
    bool late;
} searcher;

static size_t last(const plane *p, size_t first, size_t side)
{
    return first + side < p->n_levels ? first + side - 1 : p->n_levels - 1;
}

static void set_sides(const plane *p, tile t, size_t side, double sides[6][LANES], int lane)
{
    const double *x = p->levels, n = (double)p->n;
    const size_t a2 = last(p, t.a, side), b2 = last(p, t.b, side);
    sides[0][lane] = x[t.a];
    sides[1][lane] = x[b2];
    sides[2][lane] = x[t.b] > x[a2] ? n * (x[t.b] - x[a2]) : 0;
    sides[3][lane] = x[a2];
    sides[4][lane] = x[t.b];
    sides[5][lane] = n * (x[b2] - x[t.a]);
}

static void add_tile(searcher *s, int depth, tile t);

static void add_children(searcher *s, int depth, tile t)
{
    const size_t side = tile_sides[depth], child = tile_sides[depth + 1];
    for (size_t a = t.a; a < t.a + side && a < s->p->n_levels; a += child) {
        for (size_t b = t.b; b < t.b + side && b < s->p->n_levels; b += child) {
            if (last(s->p, b, child) >= a) {
                add_tile(s, depth + 1, (tile){a, b, t.bound});
            }
        }
    }
}

static void flush(searcher *s, int depth)
{
    double sides[6][LANES] = {{0}}, excess[LANES], deficit[LANES];
    const int count = s->n_waiting[depth];
    tile tiles[LANES];
    memcpy(tiles, s->waiting[depth], sizeof tiles);
    for (int l = 0; l < LANES; l++) {
        set_sides(s->p, tiles[l < count ? l : 0], tile_sides[depth], sides, l);
    }
    s->n_waiting[depth] = 0;
    if (s->work > s->budget) {
        return;
    }
    for (int l = 0; l < count && s->late; l++) {
        s->upper = fmax(s->upper, tiles[l].bound);
    }
    if (s->late) {
        return;
    }
    s->work += (double)s->count + 32;
    koksma__kernels()->extreme_strips(s->count, s->x, s->y, (const double(*)[LANES])sides, excess, deficit);
    s->late = s->late || koksma__now_s() > s->p->deadline_s;
    for (int l = 0; l < count; l++) {
        const double bound = tiles[l].bound = fmax(excess[l], deficit[l]);
        if (bound <= s->best.value) {
            continue;
        }
        if (depth == DEPTH - 1) {
            s->best = (best_strip){bound, tiles[l], excess[l] > deficit[l]};
        } else if (s->late) {
            s->upper = fmax(s->upper, bound);
        } else {
            add_children(s, depth, tiles[l]);
        }
    }
}

static void add_tile(searcher *s, int depth, tile t)
{
    s->waiting[depth][s->n_waiting[depth]++] = t;
    if (s->n_waiting[depth] == LANES) {
        flush(s, depth);
    }
}

static void flush_all(searcher *s)
{
    for (int depth = 0; depth < DEPTH; depth++) {
        while (s->n_waiting[depth] > 0) {
            flush(s, depth);
        }
    }
}

/* Collects the points between two levels, in order of y. */
static void gather(searcher *s, size_t from, size_t to)
{
    const plane *p = s->p;
    s->count = 0;
    for (size_t i = 0; i < p->n; i++) {
        s->x[s->count] = p->x[i];
        s->y[s->count] = p->y[i];
        s->count += p->x[i] >= p->levels[from] && p->x[i] <= p->levels[to];
    }
}

static bool open_searcher(const plane *p, searcher *s)
{
    *s = (searcher){.p = p, .x = malloc(2 * (p->n + 1) * sizeof(double)), .upper = -1, .budget = HUGE_VAL};
    if (!s->x) {
        koksma__fail_memory(2 * (p->n + 1) * sizeof(double));
        return false;
    }
    s->y = s->x + p->n + 1;
    return true;
}

/* The work of bounding that costs as much as sweeping the block. The unit is one point passed for 16 tiles; in a
   sweep a point costs SWEEP_COST units for each of the log2 n nodes on its path. */
static double budget_of(const plane *p, size_t a)
{
    const double left = fmin(COARSE, (double)(p->n_levels - a));
    const double points = (double)p->n * (1 - (double)a / (double)p->n_levels);
    return p->method == KOKSMA__EXTREME_BOUND   ? HUGE_VAL
           : p->method == KOKSMA__EXTREME_SWEEP ? -1
                                                : SWEEP_COST * left * points * log2((double)p->n + 2);
}

/* Finds the exact maximum of a block of strips by a sweep; for blocks where bounding would take longer. */
static koksma_status sweep_block(const plane *p, size_t a, searcher *s)
{
    koksma__sweep_best best = {s->best.value, s->best.strip.a, s->best.strip.b, s->best.closed};
    const koksma_status status =
        koksma__extreme_sweep(&p->sweep, a, last(p, a, COARSE) + 1, p->deadline_s, &best, &s->late);
    s->best = (best_strip){best.value, {best.left, best.right, 0}, best.closed};
    if (s->late) {
        s->upper = HUGE_VAL;
    }
    return status;
}

static koksma_status search_block(void *context, size_t block)
{
    const plane *p = context;
    searcher s;
    p->upper[block] = HUGE_VAL;
    if (koksma__now_s() > p->deadline_s) {
        return KOKSMA_OK;
    }
    if (!open_searcher(p, &s)) {
        return KOKSMA_MEMORY;
    }
    s.best = p->best[block];
    s.budget = budget_of(p, block * COARSE);
    const size_t a = block * COARSE, tiles = (p->n_levels - a + COARSE - 1) / COARSE;
    for (size_t group = 0; group < GROUPS; group++) {
        const size_t first = tiles * group / GROUPS, end = tiles * (group + 1) / GROUPS;
        if (first < end && !s.late) {
            gather(&s, a, last(p, a + first * COARSE, (end - first) * COARSE));
        }
        for (size_t t = first; t < end; t++) {
            add_tile(&s, 0, (tile){a, a + t * COARSE, HUGE_VAL});
        }
        flush_all(&s);
    }
    koksma_status status = KOKSMA_OK;
    if (s.work > s.budget) {
        status = sweep_block(p, a, &s);
    }
    p->best[block] = s.best;
    p->upper[block] = s.upper;
    free(s.x);
    return status;
}

/* Bounds a row of wide tiles, so that strips that were not searched before the deadline have a bound too. */
static koksma_status bound_row(void *context, size_t row)
{
    const plane *p = context;
    searcher s;
    if (!open_searcher(p, &s)) {
        return KOKSMA_MEMORY;
    }
    const size_t a = row * p->row_side;
    gather(&s, a, p->n_levels - 1);
    for (size_t b = a; b < p->n_levels; b += LANES * p->row_side) {
        double sides[6][LANES] = {{0}}, excess[LANES], deficit[LANES];
        for (size_t l = 0; l < LANES; l++) {
            const size_t right = b + l * p->row_side;
            set_sides(p, (tile){a, right < p->n_levels ? right : b, 0}, p->row_side, sides, (int)l);
        }
        koksma__kernels()->extreme_strips(s.count, s.x, s.y, (const double(*)[LANES])sides, excess, deficit);
        for (int l = 0; l < LANES; l++) {
            s.upper = fmax(s.upper, fmax(excess[l], deficit[l]));
        }
    }
    p->row_upper[row] = s.upper;
    free(s.x);
    return KOKSMA_OK;
}

/* Bounds the blocks that were unfinished at the deadline. The more points, the fewer rows of tiles are used, as this
   step has no time limit. */
static koksma_status bound_rest(plane *p, size_t n_blocks, const koksma_run *run)
{
    bool all = true;
    for (size_t block = 0; block < n_blocks; block++) {
        all &= p->upper[block] < 0;
    }
    const size_t rows = p->n <= (size_t)1 << 17 ? MAX_ROWS : p->n <= (size_t)1 << 20 ? MAX_ROWS / 2 : MAX_ROWS / 4;
    double row_upper[MAX_ROWS];
    p->row_side = COARSE * ((n_blocks + rows - 1) / rows);
    p->row_upper = row_upper;
    const size_t n_rows = (p->n_levels + p->row_side - 1) / p->row_side;
    const koksma_status status = all ? KOKSMA_OK : koksma__parallel(run, n_rows, bound_row, p);
    for (size_t block = 0; block < n_blocks && !all && !status; block++) {
        p->upper[block] = fmin(p->upper[block], row_upper[block * COARSE / p->row_side]);
    }
    p->row_upper = NULL;
    return status;
}

/* Searches some strips first, so that pruning starts with a good value whatever the order of the search. */
static koksma_status first_value(plane *p)
{
    searcher s;
    if (!open_searcher(p, &s)) {
        return KOKSMA_MEMORY;
    }
    s.best.value = -1;
    gather(&s, 0, p->n_levels - 1);
    const size_t step = 1 + (p->n_levels - 1) / FIRST_LEVELS;
    for (size_t a = 0; a < p->n_levels && !s.late; a += step) {
        for (size_t b = a; b < p->n_levels && !s.late; b += step) {
            add_tile(&s, DEPTH - 1, (tile){a, b, HUGE_VAL});
        }
        add_tile(&s, DEPTH - 1, (tile){a, p->n_levels - 1, HUGE_VAL});
    }
    flush_all(&s);
    p->best[0] = s.best;
    free(s.x);
    return KOKSMA_OK;
}

/* Fills by_x, the indices of the points in order of x (the points are in order of y), and first, where each level
   begins in by_x. */
static koksma_status prepare_sweep(plane *p, const koksma_run *run, uint32_t *by_x, uint32_t *first)
{
    const koksma_status status = koksma__order(run, p->n, p->x, 1, by_x);
    size_t i = 0;
    for (size_t level = 0; level < p->n_levels && !status; level++) {
        first[level] = (uint32_t)i;
        while (i < p->n && p->x[by_x[i]] <= p->levels[level]) {
            i++;
        }
    }
    first[p->n_levels] = (uint32_t)i;
    p->sweep = (koksma__sweep_plane){p->n, p->n_levels, p->y, p->levels, by_x, first};
    return status;
}

static koksma_status prepare(plane *p, const koksma_points *points, const koksma_run *run, uint32_t *order)
{
    koksma_status status = koksma__order(run, p->n, points->xs, 2, order);
    double *levels = p->levels;
    size_t count = 0;
    levels[count++] = 0;
    for (size_t i = 0; i < p->n && !status; i++) {
        const double x = points->xs[2 * (size_t)order[i]];
        if (x > levels[count - 1]) {
            levels[count++] = x;
        }
    }
    if (levels[count - 1] < 1) {
        levels[count++] = 1;
    }
    p->n_levels = count;
    if (!status) {
        status = koksma__order(run, p->n, points->xs + 1, 2, order);
    }
    for (size_t i = 0; i < p->n && !status; i++) {
        p->x[i] = points->xs[2 * (size_t)order[i]];
        p->y[i] = points->xs[2 * (size_t)order[i] + 1];
    }
    return status ? status : prepare_sweep(p, run, order, order + p->n);
}

koksma_status koksma__extreme_plane(const koksma_points *points, const koksma_run *run, koksma_value *out)
{
    return koksma__extreme_plane_by(KOKSMA__EXTREME_EITHER, points, run, out);
}

koksma_status koksma__extreme_plane_by(koksma__extreme_method method, const koksma_points *points,
                                       const koksma_run *run, koksma_value *out)
{
    const size_t n = points->n, max_blocks = (n + 2) / COARSE + 1;
    const size_t bytes =
        max_blocks * (sizeof(best_strip) + sizeof(double)) + (3 * n + 4) * sizeof(double) + (2 * n + 4) * 4;
    plane p = {.n = n, .best = malloc(bytes), .deadline_s = koksma__deadline_s(run, 0.8), .method = method};
    KOKSMA__REQUIRE_MEMORY(p.best, bytes);
    p.upper = (double *)(p.best + max_blocks);
    p.levels = p.upper + max_blocks;
    p.x = p.levels + n + 2;
    p.y = p.x + n;
    koksma_status status = prepare(&p, points, run, (uint32_t *)(p.y + n));
    if (!status) {
        status = first_value(&p);
    }
    const size_t n_blocks = (p.n_levels + COARSE - 1) / COARSE;
    for (size_t block = 1; block < n_blocks && !status; block++) {
        p.best[block] = p.best[0];
    }
    if (!status) {
        status = koksma__parallel(run, n_blocks, search_block, &p);
    }
    status = status ? status : bound_rest(&p, n_blocks, run);
    if (!status) {
        best_strip best = p.best[0];
        double upper = -1;
        for (size_t block = 0; block < n_blocks; block++) {
            best = p.best[block].value > best.value ? p.best[block] : best;
            upper = fmax(upper, p.upper[block]);
        }
        koksma__extreme_of_strip(n, p.x, p.y, p.levels[best.strip.a], p.levels[best.strip.b], best.closed, out);
        out->exact = upper <= best.value;
        out->lower = out->value;
        out->upper = fmax(out->value, upper / (double)n);
    }
    free(p.best);
    return status;
}

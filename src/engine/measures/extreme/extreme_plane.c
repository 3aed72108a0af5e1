/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds the best box in the plane by branch and bound over the left and right sides of boxes. A strip is the part of
 * the square between a left and a right side; one pass over its points in order of y finds its best box. A tile is
 * the set of strips whose left side is one of the levels a1 .. a2 of x and whose right side is one of b1 .. b2. The
 * same pass gives a bound for a tile: the excess is bounded by the points of the widest strip with the width of the
 * narrowest, the deficit by the points of the narrowest strip with the width of the widest. Tiles whose bound does
 * not exceed the best box are dropped; the others are cut into 4 x 4 tiles, down to single strips. One pass handles
 * 16 tiles at once. Before the parts of a tile are searched, the points that all its strips share are joined to runs
 * (extreme_runs.c), so that a pass takes time proportional to the number of sides in the tile, not to the number of
 * points. Strips that no bound excludes are then measured with all their points. Each block of left sides is a
 * separate job with its own best box, so that the result does not depend on the number of threads. If bounding a
 * block has cost as much as sweeping it from each of its left sides would cost, the block is swept instead. The cost
 * is a count of operations, not a time, so that results are reproducible.
 */
#include "measures/extreme/extreme.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/shared/shared.h"

enum { LANES = 16, COARSE = 32, DEPTH = 4, GROUPS = 8, FIRST_LEVELS = 48, MAX_ROWS = 64 };

#define SWEEP_COST 20.0
#define ROUNDING 1e-12 /* larger than the error per point of the bounds from runs */

/* The number of levels in the side of a tile at each depth of the search. */
static const size_t tile_sides[DEPTH] = {COARSE, 8, 2, 1};

typedef struct tile {
    size_t a, b;  /* first levels of the left and of the right sides; the last levels are a + side - 1 and b + side -
                     1, or the last level that exists */
    double bound; /* bound of the tile from which this one was cut; infinity for the first tiles */
} tile;

typedef struct best_strip {
    double value; /* times n */
    tile strip;
    bool closed;
} best_strip;

typedef struct plane {
    size_t n, n_levels;
    double *x, *y;     /* coordinates of the points in order of y */
    double *levels;    /* the distinct values of x, with 0 and 1 */
    best_strip *best;  /* best strip of each block of left sides */
    double *upper;     /* for each block, an upper bound of the tiles that remained at the deadline; infinity: not
                       computed yet */
    double *row_upper; /* computed after the deadline: an upper bound for each row of wide tiles, which have row_side
                          left sides each */
    size_t row_side;
    double deadline_s;
    koksma__extreme_method method;
    koksma__sweep_plane sweep;
} plane;

typedef struct searcher {
    const plane *p;
    koksma__run_list lists[DEPTH]; /* the points of [0] a group of tiles, [1] up to LANES tiles at depth 0, [2] one
                                      tile at depth 0, [3] one tile at depth 1 */
    tile waiting[LANES];           /* strips to measure */
    size_t n_waiting;
    best_strip best;
    void *memory;
    double upper, work, budget; /* work: number of points visited; budget: visits that cost as much as a sweep */
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

/* Computes bounds of up to 16 tiles from the points of a list. For single strips and a list without runs the bounds
   are the exact values. */
static void bound_tiles(searcher *s, const koksma__run_list *list, size_t side, const tile *tiles, size_t count,
                        double excess[LANES], double deficit[LANES])
{
    double sides[6][LANES];
    for (size_t l = 0; l < LANES; l++) {
        set_sides(s->p, tiles[l < count ? l : 0], side, sides, (int)l);
    }
    s->work += (double)list->count + 32;
    const double(*const lanes)[LANES] = (const double(*)[LANES])sides;
    if (list->runs) {
        koksma__kernels()->extreme_runs(list->count, list->x, list->y,
                                        (const double(*)[KOKSMA__RUN_NUMBERS])list->runs, lanes, excess, deficit);
    } else {
        koksma__kernels()->extreme_strips(list->count - 1, list->x, list->y, lanes, excess, deficit);
    }
}

static void check_time(searcher *s)
{
    s->late = s->late || (s->p->deadline_s < HUGE_VAL && koksma__now_s() > s->p->deadline_s);
}

/* Measures the strips that no bound excludes, in the order in which they were found. */
static void flush(searcher *s)
{
    const size_t count = s->n_waiting;
    double excess[LANES], deficit[LANES];
    s->n_waiting = 0;
    if (count == 0 || s->work > s->budget) {
        return;
    }
    for (size_t l = 0; l < count && s->late; l++) {
        s->upper = fmax(s->upper, s->waiting[l].bound);
    }
    if (s->late) {
        return;
    }
    bound_tiles(s, &s->lists[0], 1, s->waiting, count, excess, deficit);
    check_time(s);
    for (size_t l = 0; l < count; l++) {
        const double value = fmax(excess[l], deficit[l]);
        if (value > s->best.value) {
            s->best = (best_strip){value, s->waiting[l], excess[l] > deficit[l]};
        }
    }
}

static void add_strip(searcher *s, tile t)
{
    s->waiting[s->n_waiting++] = t;
    if (s->n_waiting == LANES) {
        flush(s);
    }
}

/* Writes to *to the run list for the strips of tile t, or of all tiles from t to the one that begins at `end`.
   Returns `from` if the new list would not be shorter. */
static const koksma__run_list *narrowed(searcher *s, const koksma__run_list *from, tile t, size_t end, size_t side,
                                        koksma__run_list *to)
{
    const plane *p = s->p;
    const double *x = p->levels, n = (double)p->n;
    const size_t a2 = last(p, t.a, side), b2 = last(p, end, side);
    if (from->count < 2 * (a2 - t.a + b2 - t.b + 2)) {
        return from;
    }
    const koksma__strip_set set = {
        x[t.a], x[a2], x[t.b], x[b2], x[t.b] > x[a2] ? n * (x[t.b] - x[a2]) : 0, n * (x[b2] - x[t.a])};
    s->work += 2 * (double)from->count;
    return koksma__run_list_narrow(from, &set, to) ? to : from;
}

static void search(searcher *s, const koksma__run_list *list, int depth, const tile *tiles, size_t count);

/* Cuts a tile and adds its parts to parts[0 .. *count - 1], which the caller fills from several tiles with the same
   list. As soon as there are LANES parts it searches them together; the rest is left to the caller. */
static void search_parts(searcher *s, const koksma__run_list *list, int depth, tile t, tile *parts, size_t *count)
{
    const size_t side = tile_sides[depth], part = tile_sides[depth + 1];
    for (size_t a = t.a; a < t.a + side && a < s->p->n_levels; a += part) {
        for (size_t b = t.b; b < t.b + side && b < s->p->n_levels; b += part) {
            if (last(s->p, b, part) >= a) {
                parts[(*count)++] = (tile){a, b, t.bound};
            }
            if (*count == LANES) {
                search(s, list, depth + 1, parts, LANES);
                *count = 0;
            }
        }
    }
}

/* Bounds up to LANES tiles of one depth at once, then searches the parts of those that may hold a better box. At depth 0
   the tiles have the same left sides and increasing right sides. The bounds from runs are raised by more than their
   rounding errors. */
static void search(searcher *s, const koksma__run_list *list, int depth, const tile *tiles, size_t count)
{
    double excess[LANES], deficit[LANES];
    tile open[LANES], parts[LANES];
    size_t n_open = 0, n_parts = 0;
    if (count == 0 || s->work > s->budget) {
        return;
    }
    for (size_t l = 0; l < count && s->late; l++) {
        s->upper = fmax(s->upper, tiles[l].bound);
    }
    if (s->late) {
        return;
    }
    bound_tiles(s, list, tile_sides[depth], tiles, count, excess, deficit);
    for (size_t l = 0; l < count; l++) {
        open[n_open] = tiles[l];
        open[n_open].bound = fmax(excess[l], deficit[l]) + (list->runs ? ROUNDING * (double)s->p->n : 0);
        n_open += open[n_open].bound > s->best.value;
    }
    if (depth < 2) {
        check_time(s);
    }
    const koksma__run_list *wide = list;
    if (depth == 0 && n_open > 1) {
        wide = narrowed(s, list, open[0], open[n_open - 1].b, COARSE, &s->lists[1]);
    }
    for (size_t l = 0; l < n_open; l++) {
        if (open[l].bound <= s->best.value) {
            continue;
        }
        if (s->late) {
            s->upper = fmax(s->upper, open[l].bound);
        } else if (depth == DEPTH - 1) {
            add_strip(s, open[l]);
        } else {
            const koksma__run_list *own =
                depth < 2 ? narrowed(s, wide, open[l], open[l].b, tile_sides[depth], &s->lists[2 + depth]) : wide;
            search_parts(s, own, depth, open[l], parts, &n_parts);
            if (depth < 2) {
                search(s, own, depth + 1, parts, n_parts);
                n_parts = 0;
            }
        }
    }
    search(s, wide, depth + 1, parts, n_parts);
}

/* Collects the points between two levels, in order of y, followed by the upper side of the square. */
static void gather(searcher *s, size_t from, size_t to)
{
    const plane *p = s->p;
    koksma__run_list *all = &s->lists[0];
    all->count = 0;
    for (size_t i = 0; i < p->n; i++) {
        all->x[all->count] = p->x[i];
        all->y[all->count] = p->y[i];
        all->count += p->x[i] >= p->levels[from] && p->x[i] <= p->levels[to];
    }
    all->x[all->count] = HUGE_VAL;
    all->y[all->count++] = 1;
}

/* n_lists: DEPTH, or 1 for a searcher of single strips or whole rows, which has no lists with runs. */
static bool open_searcher(const plane *p, int n_lists, searcher *s)
{
    const size_t n = p->n + 1, size = KOKSMA__RUN_CAPACITY;
    const size_t bytes = 2 * n * sizeof(double) + (size_t)(n_lists - 1) * size * sizeof(koksma__run_place);
    *s = (searcher){.p = p, .memory = malloc(bytes), .upper = -1, .budget = HUGE_VAL};
    if (!s->memory) {
        koksma__fail_memory(bytes);
        return false;
    }
    s->lists[0].x = s->memory;
    s->lists[0].y = s->lists[0].x + n;
    koksma__run_place *places = (koksma__run_place *)(s->lists[0].y + n);
    for (int i = 1; i < n_lists; i++) {
        koksma__run_list_init(&s->lists[i], places + size * (size_t)(i - 1));
    }
    return true;
}

/* Returns the amount of bounding work that costs as much as sweeping the block. The unit is one point visited for 16
   tiles; in a sweep a point costs SWEEP_COST units for each of the log2 n nodes on its path. */
static double budget_of(const plane *p, size_t a)
{
    const double left = fmin(COARSE, (double)(p->n_levels - a));
    const double points = (double)p->n * (1 - (double)a / (double)p->n_levels);
    return p->method == KOKSMA__EXTREME_BOUND   ? HUGE_VAL
           : p->method == KOKSMA__EXTREME_SWEEP ? -1
                                                : SWEEP_COST * left * points * koksma__log2((double)p->n + 2);
}

/* Finds the exact maximum of a block of strips by a sweep; used for blocks for which bounding would take longer. */
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
    if (!open_searcher(p, DEPTH, &s)) {
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
        tile waiting[LANES];
        size_t count = 0;
        for (size_t t = first; t < end; t++) {
            waiting[count++] = (tile){a, a + t * COARSE, HUGE_VAL};
            if (count == LANES || t + 1 == end) {
                search(&s, &s.lists[0], 0, waiting, count);
                count = 0;
            }
        }
        flush(&s);
    }
    koksma_status status = KOKSMA_OK;
    if (s.work > s.budget) {
        status = sweep_block(p, a, &s);
    }
    p->best[block] = s.best;
    p->upper[block] = s.upper;
    free(s.memory);
    return status;
}

/* Bounds a row of wide tiles, so that strips that were not searched before the deadline also have a bound. */
static koksma_status bound_row(void *context, size_t row)
{
    const plane *p = context;
    searcher s;
    if (!open_searcher(p, 1, &s)) {
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
        koksma__kernels()->extreme_strips(s.lists[0].count - 1, s.lists[0].x, s.lists[0].y,
                                          (const double(*)[LANES])sides, excess, deficit);
        for (int l = 0; l < LANES; l++) {
            s.upper = fmax(s.upper, fmax(excess[l], deficit[l]));
        }
    }
    p->row_upper[row] = s.upper;
    free(s.memory);
    return KOKSMA_OK;
}

/* Bounds the blocks that were unfinished at the deadline. This step has no time limit, so the number of rows of tiles
   decreases with the number of points. */
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

/* Returns whether a strip may be better than the best: its excess is at most the number of its points, its deficit at
   most its area. */
static bool may_be_better(const searcher *s, size_t a, size_t b)
{
    const plane *p = s->p;
    const double n = (double)p->n, points = (double)(p->sweep.first[b + 1] - p->sweep.first[a]);
    return fmax(points, n * (p->levels[b] - p->levels[a])) + ROUNDING * n > s->best.value;
}

static void try_strip(searcher *s, size_t a, size_t b)
{
    if (may_be_better(s, a, b)) {
        add_strip(s, (tile){a, b, HUGE_VAL});
    }
}

/* Measures some strips first, so that pruning starts with a good value for any order of the search: those between
   every `step`-th level. With few levels these are all strips, and *complete becomes true: there is nothing to search. */
static koksma_status first_value(plane *p, bool *complete)
{
    searcher s;
    if (!open_searcher(p, 1, &s)) {
        return KOKSMA_MEMORY;
    }
    s.best.value = -1;
    gather(&s, 0, p->n_levels - 1);
    const size_t step = 1 + (p->n_levels - 1) / FIRST_LEVELS;
    for (size_t a = 0; a < p->n_levels && !s.late; a += step) {
        for (size_t b = a; b < p->n_levels && !s.late; b += step) {
            try_strip(&s, a, b);
        }
        if (step > 1) {
            try_strip(&s, a, p->n_levels - 1);
        }
    }
    flush(&s);
    p->best[0] = s.best;
    *complete = step == 1 && !s.late;
    free(s.memory);
    return KOKSMA_OK;
}

/* Searches all blocks. If the strips measured first were all strips (`complete`), only the methods BOUND and SWEEP,
   which tests ask for, search the blocks as well. */
static koksma_status search_blocks(plane *p, size_t n_blocks, bool complete, const koksma_run *run)
{
    for (size_t block = 0; block < n_blocks; block++) {
        p->best[block] = p->best[0];
        p->upper[block] = -1;
    }
    if (!complete || p->method != KOKSMA__EXTREME_EITHER) {
        koksma__phases phases = {.share = 0};
        koksma_run phase = koksma__phase_run(&phases, run, 0.95);
        KOKSMA__TRY(koksma__parallel(&phase, n_blocks, search_block, p));
        phase = koksma__phase_run(&phases, run, 0.05);
        return bound_rest(p, n_blocks, &phase);
    }
    return koksma__keep_going(run, 1) ? KOKSMA_OK : koksma__fail_interrupted();
}

/* Fills by_x with the indices of the points in order of x (the points themselves are in order of y), and `first` with
   the position at which each level begins in by_x. */
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
    status = status ? status : koksma__order(run, p->n, points->xs + 1, 2, order);
    for (size_t i = 0; i < p->n && !status; i++) {
        p->x[i] = points->xs[2 * (size_t)order[i]];
        p->y[i] = points->xs[2 * (size_t)order[i] + 1];
    }
    return status ? status : prepare_sweep(p, run, order, order + p->n);
}

/* Finds the best box between x = left and x = right again, with its value and witness; the points are in order of y. */
static void box_of_strip(size_t n, const double *x, const double *y, double left, double right, bool closed,
                         koksma_value *out)
{
    double low = 0, low_at = 0;
    size_t inside = 0, low_inside = 0;
    bool any = !closed;
    out->value = -1;
    for (size_t i = 0; i < n + !closed; i++) {
        const double up = i < n ? y[i] : 1, area = (right - left) * up;
        const bool in = i < n && (closed ? x[i] >= left && x[i] <= right : x[i] > left && x[i] < right);
        if (closed && in && (!any || (double)inside / (double)n - area < low)) {
            low = (double)inside / (double)n - area;
            low_at = up;
            low_inside = inside;
            any = true;
        }
        inside += closed && in;
        const size_t count = inside - low_inside;
        const double volume = (right - left) * (up - low_at), share = (double)count / (double)n;
        const double value = closed ? share - volume : volume - share;
        if (any && value > out->value) {
            out->value = value;
            out->witness = (koksma_witness){.kind = KOKSMA_WITNESS_BOX,
                                            .dim = 2,
                                            .closed = closed,
                                            .count = count,
                                            .volume = volume,
                                            .lo = {left, low_at},
                                            .hi = {right, up}};
        }
        inside += !closed && in;
        if (!closed && area - (double)inside / (double)n < low) {
            low = area - (double)inside / (double)n;
            low_at = up;
            low_inside = inside;
        }
    }
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
    bool complete = false;
    koksma_status status = prepare(&p, points, run, (uint32_t *)(p.y + n));
    status = status ? status : first_value(&p, &complete);
    const size_t n_blocks = (p.n_levels + COARSE - 1) / COARSE;
    status = status ? status : search_blocks(&p, n_blocks, complete, run);
    if (!status) {
        best_strip best = p.best[0];
        double upper = -1;
        for (size_t block = 0; block < n_blocks; block++) {
            best = p.best[block].value > best.value ? p.best[block] : best;
            upper = fmax(upper, p.upper[block]);
        }
        box_of_strip(n, p.x, p.y, p.levels[best.strip.a], p.levels[best.strip.b], best.closed, out);
        out->exact = upper <= best.value;
        out->lower = out->value;
        out->upper = fmax(out->value, upper / (double)n);
    }
    free(p.best);
    return status;
}

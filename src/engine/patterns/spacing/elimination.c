/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Weighted sample elimination on the torus, in any dimension. Source: Yuksel 2015.
 *
 *     weight of i = sum over j with d_ij < d_max of (1 - max(d_ij, d_min) / d_max)^8
 *     d_max = 2 r_max,  r_max = the largest Poisson disk radius of n points:
 *         1 / (2 n)                      dim 1
 *         sqrt(1 / (2 sqrt3 n))          dim 2, the hexagonal packing
 *         (1 / (4 sqrt2 n))^(1/3)        dim 3, the face-centred cubic packing
 *         (1 / (V_dim n))^(1/dim)        dim > 3, V_dim the volume of the unit ball
 *     d_min = d_max (1 - (n/m)^1.5) 0.65, the weight limit, where n of m points are kept; 0 in dim > 3
 *
 * Without weight limiting, two points that happen to be close have more weight than a point among many neighbours,
 * and the last removals pick the wrong points. For n = 1024 of 5120 points the relative radius is 0.635 without and
 * 0.696 with weight limiting. In more than 3 dimensions, where the paper has the same limit, d_max is so large that
 * d_min is above the distances that are reached: nothing would keep a pair apart that is closer than d_min.
 *
 * A heap has the heaviest point on top. When that point is removed, its contribution to its neighbours' weights is
 * subtracted. The remaining points are sorted into a grid of cells that are about d_max / 2 wide in up to 3
 * dimensions, else d_max. The search for the neighbours of a point therefore visits a bounded number of cells. The
 * cost is O(m log m) in few dimensions, and O(m^2) if d_max spans the torus. Memory: 16 dim + 44 bytes for each
 * point. Points are renumbered cell by cell so that neighbours are near in memory.
 *
 * If d_max is above 1/2, several periodic images of one point are within d_max, and each contributes to the weight.
 * Yuksel's implementation does the same: from equal candidates both programs keep the same points (tested for n = 64
 * in 2 to 6 dimensions). A ball of radius d_max contains 2^dim m/n points and images, which is too many above 8
 * dimensions. Below 4 dimensions only sets of at most 11 points have such a d_max. In both cases only the nearest
 * image contributes. This changes which points remain, but hardly their evenness.
 */
#include "patterns/spacing/spacing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "core/vector.h"
#include "patterns/grids/grids.h"

enum { MAX_LIMITED_DIM = 3, GRID_DIMS = 8, MIN_IMAGE_DIMS = 4, MAX_IMAGE_DIMS = 8, LOOKS = 1 << 22, SINK = 32 };

#define BETA 0.65 /* beta of the paper; its other constant, the exponent gamma = 1.5, is applied by sqrt() */

typedef struct entry {
    double weight;
    uint32_t point;
} entry;

typedef struct elimination {
    int dim, grid_dims;
    size_t all, keep, count; /* numbers of points: at the beginning, at the end, and in the heap */
    double d_max, d_min;
    bool all_images;        /* true: all images of a point contribute, not only the nearest */
    double *xs;             /* coordinates of the renumbered points */
    uint32_t *origin;       /* the original number of a point */
    entry *heap;            /* heaviest point first */
    uint32_t *heap_place;   /* index of a point in the heap */
    uint32_t cells;         /* cells on a side */
    size_t reach;           /* largest number of cells that d_max extends over */
    uint32_t *cell_start;   /* where each cell's points begin in `members` */
    uint32_t *cell_count;   /* number of points left in each cell */
    uint32_t *members;      /* the points of all cells, cell by cell, those left in a cell first */
    uint32_t *member_place; /* index of a point in `members` */
    size_t looks;           /* number of cells visited and distances computed since the last check of `run` */
} elimination;

double koksma__elimination_radius(size_t n, int dim)
{
    const double area = 1 / (double)n;
    if (dim == 1) {
        return area;
    }
    if (dim == 2) {
        return 2 * sqrt(area / (2 * sqrt(3)));
    }
    if (dim == 3) {
        return 2 * koksma__cbrt(area / (4 * sqrt(2)));
    }
    double ball = dim % 2 ? 2 : M_PI; /* volume of the unit ball, computed from that in dim - 2 dimensions */
    for (int d = dim % 2 ? 3 : 4; d <= dim; d += 2) {
        ball *= 2 * M_PI / d;
    }
    return 2 * koksma__pow(area / ball, 1.0 / dim);
}

double koksma__elimination_limit(size_t n, size_t m, int dim)
{
    const double ratio = (double)n / (double)m;
    return dim > MAX_LIMITED_DIM ? 0 : (1 - ratio * sqrt(ratio)) * BETA;
}

/* ---- The heap -------------------------------------------------------------------------------------------- */

static bool heavier(const elimination *e, const entry *a, const entry *b)
{
    return a->weight > b->weight || (a->weight == b->weight && e->origin[a->point] < e->origin[b->point]);
}

static void put(elimination *e, size_t at, entry one)
{
    e->heap[at] = one;
    e->heap_place[one.point] = (uint32_t)at;
}

static void sink(elimination *e, size_t at)
{
    const entry one = e->heap[at];
    for (size_t child; (child = 2 * at + 1) < e->count; at = child) {
        child += child + 1 < e->count && heavier(e, &e->heap[child + 1], &e->heap[child]);
        if (!heavier(e, &e->heap[child], &one)) {
            break;
        }
        put(e, at, e->heap[child]);
    }
    put(e, at, one);
}

/* ---- The cells ------------------------------------------------------------------------------------------- */

/* Chooses the number of cells on a side: as many as d_max allows, but no more cells than points. Returns the number of
   cells. */
static size_t size_cells(elimination *e)
{
    e->grid_dims = e->dim < GRID_DIMS ? e->dim : GRID_DIMS;
    e->reach = e->dim <= 3 ? 2 : 1;
    const double wanted = floor((double)e->reach / e->d_max * (1 - 1e-9));
    e->cells = 1;
    for (;;) {
        size_t count = 1;
        for (int k = 0; k < e->grid_dims && count <= e->all; k++) {
            count *= (size_t)e->cells + 1;
        }
        if (count > e->all || (double)(e->cells + 1) > wanted) {
            break;
        }
        e->cells++;
    }
    size_t count = 1;
    for (int k = 0; k < e->grid_dims; k++) {
        count *= e->cells;
    }
    return count;
}

/* Renumbers the points cell by cell; within a cell they keep their order. */
static koksma_status sort_into_cells(elimination *e, const double *points, size_t cells, const koksma_run *run)
{
    const size_t dim = (size_t)e->dim;
    memset(e->cell_count, 0, cells * sizeof *e->cell_count);
    for (size_t i = 0; i < e->all; i++) {
        KOKSMA__TRY(koksma__look(run, i, 0));
        e->cell_count[koksma__cell_index(points + i * dim, e->grid_dims, e->cells)]++;
    }
    for (size_t c = 0, start = 0; c < cells; c++) {
        e->cell_start[c] = (uint32_t)start;
        start += e->cell_count[c];
        e->cell_count[c] = 0;
    }
    for (size_t i = 0; i < e->all; i++) {
        KOKSMA__TRY(koksma__look(run, i, 0));
        const size_t c = koksma__cell_index(points + i * dim, e->grid_dims, e->cells);
        const uint32_t at = e->cell_start[c] + e->cell_count[c]++;
        memcpy(e->xs + at * dim, points + i * dim, dim * sizeof *points);
        e->origin[at] = (uint32_t)i;
        e->members[at] = e->member_place[at] = at;
    }
    return KOKSMA_OK;
}

static void leave_cell(elimination *e, uint32_t point)
{
    const size_t cell = koksma__cell_index(e->xs + (size_t)point * (size_t)e->dim, e->grid_dims, e->cells);
    const uint32_t at = e->member_place[point], last = e->cell_start[cell] + --e->cell_count[cell];
    e->members[at] = e->members[last];
    e->member_place[e->members[at]] = at;
}

/* ---- Weights --------------------------------------------------------------------------------------------- */

static double weight_at(const elimination *e, double square)
{
    const double t = 1 - fmax(sqrt(square), e->d_min) / e->d_max, t2 = t * t, t4 = t2 * t2;
    return t4 * t4;
}

/* Returns the sum of the weights of all images of another point within d_max, by recursion over the axes. across: for
   each axis the difference to the nearest image. square: the squared distance to the image that the callers have chosen
   along the axes before k, and that is the nearest one along the other axes. Along each axis images are visited from
   the nearest to the farthest. */
static double weight_of_images(elimination *e, const double *across, int k, double square)
{
    if (k == e->dim) {
        e->looks++;
        return weight_at(e, square);
    }
    const double d_max2 = e->d_max * e->d_max, nearest = fabs(across[k]);
    double weight = weight_of_images(e, across, k + 1, square);
    for (int side = 1;; side++) {
        const double far = side % 2 ? 0.5 * (side + 1) - nearest : 0.5 * side + nearest;
        const double moved = square + (far * far - nearest * nearest);
        if (!(moved < d_max2)) {
            return weight;
        }
        weight += weight_of_images(e, across, k + 1, moved);
    }
}

/* Visits the neighbours of `point` in one cell. With relieve = false it adds their contributions to the weight of
   `point`; the heap is then still in the order of the points. With relieve = true, when `point` was removed from the
   heap, it subtracts the contributions of `point` from the weights of its neighbours. */
static void weigh_cell(elimination *e, size_t cell, uint32_t point, bool relieve)
{
    const size_t dim = (size_t)e->dim;
    const double *x = e->xs + point * dim, d_max2 = e->d_max * e->d_max;
    double across[MAX_IMAGE_DIMS];
    const uint32_t *member = e->members + e->cell_start[cell];
    e->looks += 1 + e->cell_count[cell];
    for (uint32_t m = 0; m < e->cell_count[cell]; m++) {
        const double *y = e->xs + member[m] * dim;
        double square = 0;
        for (size_t k = 0; k < dim && square < d_max2; k++) {
            const double t = koksma__torus_difference(x[k], y[k]);
            square += t * t;
            if (e->all_images) {
                across[k] = t;
            }
        }
        if (!(square < d_max2) || member[m] == point) {
            continue;
        }
        const double weight = e->all_images ? weight_of_images(e, across, 0, square) : weight_at(e, square);
        if (relieve) {
            const size_t at = e->heap_place[member[m]];
            e->heap[at].weight -= weight;
            sink(e, at);
            e->looks += SINK; /* most of it waits for memory */
        } else {
            e->heap[point].weight += weight;
        }
    }
}

/* Calls weigh_cell for each cell that can contain neighbours of `point`, by recursion over the dimensions. */
static void weigh_from(elimination *e, int k, size_t row, uint32_t point, bool relieve)
{
    if (k == e->grid_dims) {
        weigh_cell(e, row, point, relieve);
        return;
    }
    const size_t own = koksma__cell_along(e->xs[(size_t)point * (size_t)e->dim + (size_t)k], e->cells);
    const size_t reach = e->reach, some = 2 * reach + 1 < e->cells ? 2 * reach + 1 : e->cells;
    size_t cell = some < e->cells ? (own + e->cells - reach) % e->cells : 0;
    for (size_t i = 0; i < some; i++) {
        weigh_from(e, k + 1, row * e->cells + cell, point, relieve);
        cell = cell + 1 < e->cells ? cell + 1 : 0;
    }
}

static bool goes_on(elimination *e, size_t done, const koksma_run *run)
{
    if (e->looks * (size_t)e->dim < LOOKS) {
        return true;
    }
    e->looks = 0;
    return koksma__keep_going(run, (double)done / (double)(2 * e->all - e->keep));
}

static koksma_status take_out(elimination *e, const koksma_run *run, uint32_t *order)
{
    for (uint32_t i = 0; i < e->all; i++) {
        put(e, i, (entry){0, i});
        weigh_from(e, 0, 0, i, false);
        if (!goes_on(e, i, run)) {
            return koksma__fail_interrupted();
        }
    }
    e->count = e->all;
    for (size_t at = e->all / 2; at-- > 0;) {
        KOKSMA__TRY(koksma__look(run, at, (double)e->all / (double)(2 * e->all - e->keep)));
        sink(e, at);
    }
    while (e->count > e->keep) {
        const uint32_t out = e->heap[0].point;
        e->count--;
        put(e, 0, e->heap[e->count]);
        sink(e, 0);
        leave_cell(e, out);
        weigh_from(e, 0, 0, out, true);
        order[e->count] = e->origin[out];
        if (!goes_on(e, 2 * e->all - e->count, run)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

/* Lists the original numbers of the remaining points in ascending order. */
static void list_kept(const elimination *e, uint32_t *order)
{
    uint32_t *left = e->member_place; /* reuses an array that is no longer needed for the places of members: 1 marks a
                                         remaining point */
    memset(left, 0, e->all * sizeof *left);
    for (size_t at = 0; at < e->keep; at++) {
        left[e->origin[e->heap[at].point]] = 1;
    }
    for (uint32_t i = 0; i < e->all; i++) {
        if (left[i]) {
            *order++ = i;
        }
    }
}

koksma_status koksma__eliminate(size_t count, int dim, const double *points, size_t keep, double d_max, double d_min,
                                const koksma_run *run, uint32_t *order)
{
    elimination e = {.dim = dim, .all = count, .keep = keep, .d_max = d_max, .d_min = d_min};
    e.all_images = dim >= MIN_IMAGE_DIMS && dim <= MAX_IMAGE_DIMS && d_max > 0.5;
    const size_t cells = size_cells(&e), words = 4 * count + 2 * cells;
    const size_t bytes = count * ((size_t)dim * sizeof *e.xs + sizeof *e.heap) + words * sizeof *e.members;
    e.xs = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(e.xs, bytes);
    e.heap = (entry *)(e.xs + count * (size_t)dim);
    e.origin = (uint32_t *)(e.heap + count);
    e.heap_place = e.origin + count;
    e.members = e.heap_place + count;
    e.member_place = e.members + count;
    e.cell_start = e.member_place + count;
    e.cell_count = e.cell_start + cells;
    koksma_status status = sort_into_cells(&e, points, cells, run);
    status = status ? status : take_out(&e, run, order);
    if (!status) {
        list_kept(&e, order);
    }
    free(e.xs);
    return status;
}

/* ---- Sets ------------------------------------------------------------------------------------------------ */

static void pick(size_t n, size_t dim, const double *from, const uint32_t *order, double *to)
{
    for (size_t i = 0; i < n; i++) {
        memcpy(to + i * dim, from + order[i] * dim, dim * sizeof *to);
    }
}

/* Puts points into Yuksel's progressive order, in which every prefix is blue noise: elimination halves the set again and
   again, and each point comes after those that remain when it is removed. Each halving has a d_max that grows with the
   volume available to each point. d_min is always that of the whole set, as in Yuksel's implementation. */
static koksma_status order_set(size_t n, int dim, double d_max, double d_min, const koksma_run *run, double *xs)
{
    const size_t width = (size_t)dim;
    const double growth = dim == 2 ? sqrt(2) : koksma__pow(2, 1.0 / dim);
    double *points = malloc(n * (2 * width * sizeof *points + 3 * sizeof(uint32_t)));
    KOKSMA__REQUIRE_MEMORY(points, n * (2 * width * sizeof *points + 3 * sizeof(uint32_t)));
    double *left_points = points + n * width;
    uint32_t *order = (uint32_t *)(left_points + n * width), *before = order + n, *picked = before + n;
    memcpy(points, xs, n * width * sizeof *xs);
    for (size_t i = 0; i < n; i++) {
        order[i] = (uint32_t)i;
    }
    koksma_status status = KOKSMA_OK;
    for (size_t left = n; left >= 3 && !status; left /= 2) {
        d_max *= growth;
        memcpy(before, order, left * sizeof *order);
        pick(left, width, points, before, left_points);
        status = koksma__eliminate(left, dim, left_points, left / 2, d_max, d_min, run, picked);
        for (size_t i = 0; i < left && !status; i++) {
            order[i] = before[picked[i]];
        }
    }
    if (!status) {
        pick(n, width, points, order, xs);
    }
    free(points);
    return status;
}

/* Points of a finished set that are close together should be removed first; therefore weights are not limited (d_min
   = 0). With d_min = 0.65 d_max the first half of 64 points of gaussian-blue-noise in 6 dimensions had a relative
   radius of 0.54 in place of 0.66. */
koksma_status koksma__order_progressively(const koksma_run *run, koksma_points *points)
{
    const double d_max = koksma__elimination_radius(points->n, points->dim);
    return order_set(points->n, points->dim, d_max, 0, run, points->xs);
}

koksma_status koksma__eliminated_set(const char *name, uint64_t seed, size_t n, int dim, size_t factor,
                                     bool progressive, const koksma_run *run, double *xs)
{
    const size_t all = factor * n, width = (size_t)dim, most = KOKSMA_MAX_COORDINATES / width / factor;
    KOKSMA__FAIL_IF(n > most, KOKSMA_N, "%s: n = %zu is too large; n = %zu or less would do", name, n, most);
    const double d_max = koksma__elimination_radius(n, dim), d_min = d_max * koksma__elimination_limit(n, all, dim);
    double *drawn = malloc(all * (width * sizeof *drawn + sizeof(uint32_t)));
    KOKSMA__REQUIRE_MEMORY(drawn, all * (width * sizeof *drawn + sizeof(uint32_t)));
    uint32_t *order = (uint32_t *)(drawn + all * width);
    koksma_status status = koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, run, all * width, drawn);
    status = status ? status : koksma__eliminate(all, dim, drawn, n, d_max, d_min, run, order);
    if (!status) {
        pick(n, width, drawn, order, xs);
    }
    if (!status && progressive) {
        status = order_set(n, dim, d_max, d_min, run, xs);
    }
    free(drawn);
    return status;
}

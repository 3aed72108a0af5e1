/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Computes the exact discrepancy by the partition of the space of box corners of Dobkin, Eppstein and Mitchell, after
 * Overmars and Yap. One coordinate after the other is cut into slabs. For corners in a slab (a, b] of coordinate k, a
 * point with x_k <= a is inside in this coordinate, a point with x_k >= b is outside the box, and a point between
 * becomes undecided in k. A point that is undecided in an earlier coordinate cannot become undecided again, because
 * each later coordinate is cut at this point. In a leaf every point is therefore undecided in at most one coordinate.
 * So for each coordinate and each count c it suffices to know the largest (smallest) side of an open (closed) box
 * that contains c of the points undecided in this coordinate. The slabs of the first coordinate are separate blocks
 * of work, each with its own best box, so that the result does not depend on the number of threads.
 */
#include "measures/star/star.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/shared/shared.h"

enum { LEAVES_PER_CHECK = 256 };

typedef struct problem {
    const koksma_points *points;
    size_t n, dim, spacing;
    uint32_t *orders; /* for each coordinate, the points in order of this coordinate */
    double *cuts;     /* the cuts of the first coordinate */
    size_t n_cuts;
    double deadline_s;
    const koksma_run *run;
    pthread_t caller; /* the caller's thread, which alone may call run->keep_going */
    atomic_bool interrupted;
    atomic_size_t blocks_done;
    koksma_value *values; /* for each block */
    bool *cut_short;
} problem;

/* The points of a region of corners. There is one region for each level of the recursion. */
typedef struct region {
    uint32_t *inside;    /* points that are inside in all coordinates so far, in any order */
    uint32_t *undecided; /* undecided points; first[k] .. first[k+1] - 1 are undecided in coordinate k and in order of
                            it */
    size_t n_inside, *first;
} region;

typedef struct searcher {
    problem *p;
    region *levels;       /* dim + 1 */
    double *lo, *hi;      /* bounds of the region's slabs for each coordinate */
    double *cuts;         /* dim rows of n + 2 */
    uint32_t *sorted;     /* dim rows of n numbers: the points of `inside` in order of the next coordinate */
    double *sorted_at;    /* dim rows of n numbers: the next coordinate of the points in `sorted` */
    double *undecided_at; /* dim rows of n numbers: the next coordinate of the child's undecided points */
    bool *flags;          /* n */
    double *sides;        /* 2 rows of n + dim numbers: the sides of boxes in a leaf */
    double **products;    /* products of the sides in coordinates 0 .. k, for each k: dim pairs of rows of n + 2 dim +
                          8 numbers */
    size_t leaves;
    bool stop;
    koksma_value *best;
    void *memory;
} searcher;

static double coordinate(const searcher *s, uint32_t i, size_t k)
{
    return s->p->points->xs[(size_t)i * s->p->dim + k];
}

/* Finds the corner that has the best value of a leaf, from the last coordinate to the first. */
static void trace(searcher *s, const double *const *sides[2], const size_t *counts, bool closed, double n_inside)
{
    const size_t dim = s->p->dim;
    double corner[KOKSMA__STAR_MAX_DIM], best = -2, n = (double)s->p->n;
    size_t total = 0, chosen = 0;
    const double *product = s->products[2 * (dim - 2) + closed], *side = sides[closed][dim - 1];
    size_t n_product = 1;
    for (size_t k = 0; k + 1 < dim; k++) {
        n_product += counts[k] - 1;
    }
    for (size_t i = 0; i < n_product; i++) {
        for (size_t j = 0; j < counts[dim - 1]; j++) {
            const double share = (n_inside + (double)(i + j)) / n, volume = product[i] * side[j];
            if ((closed ? share - volume : volume - share) > best) {
                best = closed ? share - volume : volume - share;
                total = i;
                chosen = j;
            }
        }
    }
    corner[dim - 1] = side[chosen];
    for (size_t k = dim - 2; k > 0; k--) {
        const double *before = s->products[2 * (k - 1) + closed], *here = sides[closed][k];
        n_product -= counts[k] - 1;
        chosen = 0;
        for (size_t j = 0; j < counts[k] && j <= total; j++) {
            if (total - j < n_product && before[total - j] * here[j] == s->products[2 * k + closed][total]) {
                chosen = j;
            }
        }
        corner[k] = here[chosen];
        total -= chosen;
    }
    corner[0] = sides[closed][0][total];
    koksma__star_keep(s->p->points, corner, closed, s->best);
}

static void leaf(searcher *s)
{
    const size_t dim = s->p->dim;
    const region *r = &s->levels[dim];
    const double n = (double)s->p->n, n_inside = (double)r->n_inside;
    double high = 1, low = 1, *next = s->sides;
    size_t counts[KOKSMA__STAR_MAX_DIM] = {0};
    const double *open_sides[KOKSMA__STAR_MAX_DIM] = {0}, *closed_sides[KOKSMA__STAR_MAX_DIM] = {0};
    for (size_t k = 0; k < dim; k++) {
        high *= s->hi[k] < 1 ? s->hi[k] : 1;
        low *= s->lo[k];
    }
    if (fmax(high - n_inside / n, (n_inside + (double)r->first[dim]) / n - low) <= s->best->value) {
        return;
    }
    for (size_t k = 0; k < dim; k++) {
        /* the sides are lo, z_1, .. z_g, hi; closed boxes use the first g + 1 of them, open boxes the last g + 1 */
        closed_sides[k] = next;
        *next++ = s->lo[k];
        for (size_t u = r->first[k]; u < r->first[k + 1]; u++) {
            *next++ = coordinate(s, r->undecided[u], k);
        }
        *next++ = s->hi[k] < 1 ? s->hi[k] : 1;
        open_sides[k] = closed_sides[k] + 1;
        counts[k] = r->first[k + 1] - r->first[k] + 1;
    }
    const koksma__kernel_table *kernels = koksma__kernels();
    memcpy(s->products[0], open_sides[0], counts[0] * sizeof(double));
    memcpy(s->products[1], closed_sides[0], counts[0] * sizeof(double));
    size_t n_product = counts[0];
    for (size_t k = 1; k + 1 < dim; k++) {
        kernels->star_extremes(n_product, (const double *const[]){s->products[2 * k - 2], s->products[2 * k - 1]},
                               counts[k], (const double *const[]){open_sides[k], closed_sides[k]},
                               &s->products[2 * k]);
        n_product += counts[k] - 1;
    }
    double best[2];
    kernels->star_pairs(n_product, (const double *const[]){s->products[2 * dim - 4], s->products[2 * dim - 3]},
                        counts[dim - 1], (const double *const[]){open_sides[dim - 1], closed_sides[dim - 1]}, n,
                        n_inside, best);
    for (int closed = 0; closed < 2; closed++) {
        if (best[closed] > s->best->value) {
            trace(s, (const double *const *[]){open_sides, closed_sides}, counts, closed, n_inside);
        }
    }
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Chooses the cuts of coordinate k of a region: 0, the coordinates of all undecided points and of every p->spacing-th
   point inside, and infinity. Returns the number of slabs. */
static size_t find_cuts(const problem *p, size_t k, const region *r, const uint32_t *sorted, double *cuts)
{
    size_t count = 0, kept = 0;
    cuts[count++] = 0;
    for (size_t u = 0; u < r->first[k]; u++) {
        cuts[count++] = p->points->xs[(size_t)r->undecided[u] * p->dim + k];
    }
    for (size_t i = p->spacing - 1; i < r->n_inside; i += p->spacing) {
        cuts[count++] = p->points->xs[(size_t)sorted[i] * p->dim + k];
    }
    qsort(cuts, count, sizeof *cuts, compare);
    for (size_t c = 0; c < count; c++) {
        if (kept == 0 || cuts[c] != cuts[kept - 1]) {
            cuts[kept++] = cuts[c];
        }
    }
    cuts[kept] = INFINITY;
    return kept;
}

static void sort_inside(searcher *s, size_t k, uint32_t *sorted)
{
    const region *r = &s->levels[k];
    const uint32_t *order = s->p->orders + k * s->p->n;
    size_t count = 0;
    if (r->n_inside == s->p->n) {
        memcpy(sorted, order, s->p->n * sizeof *sorted);
        return;
    }
    memset(s->flags, 0, s->p->n * sizeof *s->flags);
    for (size_t i = 0; i < r->n_inside; i++) {
        s->flags[r->inside[i]] = true;
    }
    for (size_t i = 0; i < s->p->n && count < r->n_inside; i++) {
        sorted[count] = order[i];
        count += s->flags[order[i]];
    }
}

/* Prepares the slabs of coordinate k of a region: copies the region's undecided points to its child, and looks up
   coordinate k of these points and of those inside once for all slabs. */
static void begin_slabs(searcher *s, size_t k, const uint32_t *sorted)
{
    const region *r = &s->levels[k];
    region *child = &s->levels[k + 1];
    double *inside_at = s->sorted_at + k * s->p->n, *undecided_at = s->undecided_at + k * s->p->n;
    memcpy(child->first, r->first, (k + 1) * sizeof *child->first);
    memcpy(child->undecided, r->undecided, r->first[k] * sizeof *child->undecided);
    for (size_t u = 0; u < r->first[k]; u++) {
        undecided_at[u] = coordinate(s, r->undecided[u], k);
    }
    for (size_t i = 0; i < r->n_inside; i++) {
        inside_at[i] = coordinate(s, sorted[i], k);
    }
}

/* Sets the child of the region of level k to the slab (a, b], except for the undecided points. Returns how many
   points become undecided in coordinate k. */
static size_t place_slab(searcher *s, size_t k, const uint32_t *sorted, double a, double b)
{
    const double *at = s->sorted_at + k * s->p->n;
    const size_t n_inside = s->levels[k].n_inside;
    region *child = &s->levels[k + 1];
    size_t low = 0, high = n_inside;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (at[middle] <= a) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    while (high < n_inside && at[high] < b) {
        high++;
    }
    child->inside = (uint32_t *)sorted; /* the child's points are the first entries of `sorted`, which nobody changes
                                           */
    child->n_inside = low;
    s->lo[k] = a;
    s->hi[k] = b;
    return high - low;
}

/* Fills the undecided points of the child. Slabs are visited from last to first, so that the points undecided in
   earlier coordinates are a subset of those of the previously visited slab. */
static void fill_slab(searcher *s, size_t k, const uint32_t *sorted, size_t of_k)
{
    region *child = &s->levels[k + 1];
    double *at = s->undecided_at + k * s->p->n;
    const double b = s->hi[k];
    size_t used = 0, from = 0;
    for (size_t m = 0; m < k; m++) {
        const size_t end = child->first[m + 1];
        child->first[m] = used;
        for (; from < end; from++) {
            const double x = at[from];
            child->undecided[used] = child->undecided[from];
            at[used] = x;
            used += x < b;
        }
    }
    child->first[k] = used;
    memcpy(child->undecided + used, sorted + child->n_inside, of_k * sizeof *sorted);
    child->first[k + 1] = used + of_k;
}

static void check_stop(searcher *s)
{
    problem *p = s->p;
    if (p->run && pthread_equal(pthread_self(), p->caller) &&
        !koksma__keep_going(p->run, (double)atomic_load(&p->blocks_done) / (double)p->n_cuts)) {
        atomic_store(&p->interrupted, true);
    }
    s->stop = atomic_load(&p->interrupted) || koksma__now_s() > p->deadline_s;
}

static void search(searcher *s, size_t k);

/* Searches one slab. For a leaf that cannot have a better value than the best so far, the undecided points are not
   collected. */
static void descend(searcher *s, size_t k, const uint32_t *sorted, double a, double b)
{
    const bool is_leaf = k + 1 == s->p->dim;
    const size_t of_k = place_slab(s, k, sorted, a, b);
    const region *child = &s->levels[k + 1];
    const double n = (double)s->p->n;
    double high = 1, low = 1;
    for (size_t m = 0; m <= k; m++) {
        high *= s->hi[m] < 1 ? s->hi[m] : 1;
        low *= s->lo[m];
    }
    const double fewest = (double)child->n_inside, most = (double)(child->n_inside + child->first[k] + of_k);
    if (!is_leaf || fmax(high - fewest / n, most / n - low) > s->best->value) {
        fill_slab(s, k, sorted, of_k);
        if (is_leaf) {
            leaf(s);
        } else if (fmax(high, (double)(child->n_inside + child->first[k + 1]) / n) > s->best->value) {
            search(s, k + 1);
        }
    }
    if (is_leaf && ++s->leaves % LEAVES_PER_CHECK == 0) {
        check_stop(s);
    }
}

static void search(searcher *s, size_t k)
{
    uint32_t *sorted = s->sorted + k * s->p->n;
    double *cuts = s->cuts + k * (s->p->n + 2);
    sort_inside(s, k, sorted);
    const size_t count = find_cuts(s->p, k, &s->levels[k], sorted, cuts);
    begin_slabs(s, k, sorted);
    for (size_t c = count; c-- > 0 && !s->stop;) {
        descend(s, k, sorted, cuts[c], cuts[c + 1]);
    }
}

static bool open_searcher(problem *p, searcher *s)
{
    const size_t n = p->n, dim = p->dim, room = n + 2 * dim + 8;
    *s = (searcher){.p = p};
    const size_t doubles = 2 * dim + dim * (n + 2) + room + 2 * dim * room + 2 * dim * n;
    const size_t bytes = doubles * sizeof(double) + (dim + 1) * (sizeof(region) + (dim + 1) * sizeof(size_t)) +
                         2 * dim * sizeof(double *) + (2 * dim + 1) * n * sizeof(uint32_t) + n;
    s->memory = malloc(bytes);
    if (!s->memory) {
        koksma__fail_memory(bytes);
        return false;
    }
    s->lo = s->memory;
    s->hi = s->lo + dim;
    s->cuts = s->hi + dim;
    s->sides = s->cuts + dim * (n + 2);
    double *rows = s->sides + room;
    s->sorted_at = rows + 2 * dim * room;
    s->undecided_at = s->sorted_at + dim * n;
    s->levels = (region *)(s->undecided_at + dim * n);
    size_t *firsts = (size_t *)(s->levels + dim + 1);
    s->products = (double **)(firsts + (dim + 1) * (dim + 1));
    s->sorted = (uint32_t *)(s->products + 2 * dim);
    uint32_t *lists = s->sorted + dim * n;
    s->flags = (bool *)(lists + (dim + 1) * n);
    for (size_t k = 0; k <= dim; k++) {
        s->levels[k] = (region){.undecided = lists + k * n, .first = firsts + k * (dim + 1)};
    }
    for (size_t k = 0; k < 2 * dim; k++) {
        s->products[k] = rows + k * room;
    }
    memset(s->levels[0].first, 0, (dim + 1) * sizeof(size_t));
    s->levels[0].n_inside = n;
    return true;
}

static koksma_status search_slab(void *context, size_t block)
{
    problem *p = context;
    searcher s;
    if (!open_searcher(p, &s)) {
        return KOKSMA_MEMORY;
    }
    const size_t c = p->n_cuts - 1 - block;
    s.best = &p->values[block];
    check_stop(&s);
    if (!s.stop) {
        begin_slabs(&s, 0, p->orders);
        descend(&s, 0, p->orders, p->cuts[c], p->cuts[c + 1]);
    }
    p->cut_short[block] = s.stop;
    atomic_fetch_add(&p->blocks_done, 1);
    free(s.memory);
    return atomic_load(&p->interrupted) ? koksma__fail_interrupted() : KOKSMA_OK;
}

koksma_status koksma__star_partition(const koksma_points *points, const koksma_run *run, double deadline_s,
                                     koksma_value *out, bool *complete)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    problem p = {
        .points = points, .n = n, .dim = dim, .deadline_s = deadline_s, .run = run, .caller = pthread_self()};
    p.spacing = (size_t)ceil(sqrt((double)n));
    const size_t bytes = (n + 2) * (sizeof(koksma_value) + sizeof(double) + dim * sizeof(uint32_t) + 1);
    p.values = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(p.values, bytes);
    p.cuts = (double *)(p.values + n + 2);
    p.orders = (uint32_t *)(p.cuts + n + 2);
    p.cut_short = (bool *)(p.orders + dim * (n + 2));
    koksma_status status = KOKSMA_OK;
    for (size_t k = 0; k < dim && !status; k++) {
        status = koksma__order(run, n, points->xs + k, dim, p.orders + k * n);
    }
    if (!status) {
        const region all = {.n_inside = n, .first = (size_t[1]){0}};
        p.n_cuts = find_cuts(&p, 0, &all, p.orders, p.cuts);
        for (size_t block = 0; block < p.n_cuts; block++) {
            p.values[block] = *out;
        }
        status = koksma__parallel(run, p.n_cuts, search_slab, &p);
    }
    *complete = true;
    for (size_t block = 0; block < p.n_cuts && !status; block++) {
        if (p.values[block].value > out->value) {
            *out = p.values[block];
        }
        *complete = *complete && !p.cut_short[block];
    }
    free(p.values);
    return status;
}

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
    double *sorted;           /* for each coordinate, its sorted values */
    uint32_t *orders, *ranks; /* for each coordinate, the points in order of it, and the place of each point there */
    size_t n_cuts;            /* of the first coordinate */
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
    region *levels;   /* dim + 1 */
    double *lo, *hi;  /* bounds of the region's slabs for each coordinate */
    double *cuts;     /* dim rows of n + 2: the lower ends of the slabs, and infinity */
    uint32_t *ends;   /* dim rows of 2 n + 4: for each cut, how many points of `inside` are below it, and how many are
                             not above it */
    uint32_t *sorted; /* dim rows of n numbers: the points of `inside` in order of the next coordinate */
    double *undecided_at;      /* dim rows of n numbers: the next coordinate of the child's undecided points */
    uint64_t *inside, *chosen; /* a bit for each place in the order of a coordinate: whether its point is inside, and
                                  whether it is inside or undecided */
    double *sides;             /* 2 rows of n + dim numbers: the sides of boxes in a leaf */
    const double *sides_of[2][KOKSMA__STAR_MAX_DIM]; /* those of open and of closed boxes for each coordinate */
    size_t counts[KOKSMA__STAR_MAX_DIM];             /* how many */
    const double *products[KOKSMA__STAR_MAX_DIM];    /* of the sides in coordinates 0 .. k, for each k */
    double *rows;                                    /* dim rows of `room` numbers, for the products */
    size_t room;
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
static void trace(searcher *s, bool closed, double n_inside)
{
    const double *const *sides = s->sides_of[closed];
    const size_t *counts = s->counts;
    const size_t dim = s->p->dim;
    double corner[KOKSMA__STAR_MAX_DIM], best = -2, n = (double)s->p->n;
    size_t total = 0, chosen = 0;
    const double *product = s->products[dim - 2], *side = sides[dim - 1];
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
        const double *before = s->products[k - 1], *here = sides[k];
        n_product -= counts[k] - 1;
        chosen = 0;
        for (size_t j = 0; j < counts[k] && j <= total; j++) {
            if (total - j < n_product && before[total - j] * here[j] == s->products[k][total]) {
                chosen = j;
            }
        }
        corner[k] = here[chosen];
        total -= chosen;
    }
    corner[0] = sides[0][total];
    koksma__star_keep(s->p->points, corner, closed, s->best);
}

static void leaf(searcher *s)
{
    const size_t dim = s->p->dim;
    const region *r = &s->levels[dim];
    const double n = (double)s->p->n, n_inside = (double)r->n_inside;
    double high = 1, low = 1, *next = s->sides;
    for (size_t k = 0; k < dim; k++) {
        high *= s->hi[k] < 1 ? s->hi[k] : 1;
        low *= s->lo[k];
    }
    const double most[2] = {high - n_inside / n, (n_inside + (double)r->first[dim]) / n - low};
    if (!(most[0] > s->best->value || most[1] > s->best->value)) {
        return;
    }
    for (size_t k = 0; k < dim; k++) {
        /* the sides are lo, z_1, .. z_g, hi; closed boxes use the first g + 1 of them, open boxes the last g + 1 */
        s->sides_of[1][k] = next;
        *next++ = s->lo[k];
        for (size_t u = r->first[k]; u < r->first[k + 1]; u++) {
            *next++ = coordinate(s, r->undecided[u], k);
        }
        *next++ = s->hi[k] < 1 ? s->hi[k] : 1;
        s->sides_of[0][k] = s->sides_of[1][k] + 1;
        s->counts[k] = r->first[k + 1] - r->first[k] + 1;
    }
    const koksma__kernel_table *kernels = koksma__kernels();
    for (int closed = 0; closed < 2; closed++) {
        if (!(most[closed] > s->best->value)) {
            continue;
        }
        const double *const *sides = s->sides_of[closed];
        size_t n_product = s->counts[0];
        s->products[0] = sides[0];
        for (size_t k = 1; k + 1 < dim; k++) {
            double *row = s->rows + k * s->room;
            kernels->star_extremes(n_product, s->products[k - 1], s->counts[k], sides[k], closed, row);
            s->products[k] = row;
            n_product += s->counts[k] - 1;
        }
        if (kernels->star_pairs(n_product, s->products[dim - 2], s->counts[dim - 1], sides[dim - 1], closed, n,
                                n_inside) > s->best->value) {
            trace(s, closed, n_inside);
        }
    }
}

/* Puts the points of `inside` in order of coordinate k, and chooses its cuts: 0, the coordinates of all undecided points
   and of every p->spacing-th point inside, and infinity. Returns the number of slabs. */
static size_t find_slabs(searcher *s, size_t k)
{
    const problem *p = s->p;
    const region *r = &s->levels[k];
    const uint32_t *orders = p->orders + k * p->n, *ranks = p->ranks + k * p->n;
    const size_t spacing = k == 0 ? p->spacing : p->spacing * 7 / 5; /* 1 to 2 times, measured: 5 to 14 % at 7/5 */
    uint32_t *sorted = s->sorted + k * p->n, *ends = s->ends + k * (2 * p->n + 4);
    double *cuts = s->cuts + k * (p->n + 2);
    const double *values = p->sorted + k * p->n;
    const size_t words = p->n / 64 + 1;
    size_t count = 0, start = 0, kept = 1, to_cut = spacing;
    memset(s->inside, 0, 2 * words * sizeof *s->inside);
    for (size_t i = 0; i < r->n_inside; i++) {
        const uint32_t at = ranks[r->inside[i]];
        s->inside[at / 64] |= (uint64_t)1 << at % 64;
    }
    memcpy(s->chosen, s->inside, words * sizeof *s->chosen);
    for (size_t u = 0; u < r->first[k]; u++) {
        const uint32_t at = ranks[r->undecided[u]];
        s->chosen[at / 64] |= (uint64_t)1 << at % 64;
    }
    cuts[0] = 0;
    ends[0] = ends[1] = 0;
    double last = 0;
    for (size_t word = 0; word < words; word++) {
        for (uint64_t left = s->chosen[word]; left; left &= left - 1) {
            const size_t at = 64 * word + (size_t)__builtin_ctzll(left);
            const bool inside = s->inside[word] >> at % 64 & 1;
            const double x = values[at];
            start = x == last ? start : count; /* the points inside that are below x */
            last = x;
            sorted[count] = orders[at];
            count += inside;
            to_cut -= inside;
            if (!inside || !to_cut) {
                to_cut = to_cut ? to_cut : spacing;
                kept += x != cuts[kept - 1];
                cuts[kept - 1] = x;
                ends[2 * kept - 2] = (uint32_t)start;
            }
            if (x == cuts[kept - 1]) {
                ends[2 * kept - 1] = (uint32_t)count;
            }
        }
    }
    cuts[kept] = INFINITY;
    ends[2 * kept] = ends[2 * kept + 1] = (uint32_t)count;
    return kept;
}

/* Prepares the slabs of coordinate k of a region: copies the region's undecided points to its child, and looks up
   coordinate k of these points once for all slabs. */
static void begin_slabs(searcher *s, size_t k)
{
    const region *r = &s->levels[k];
    region *child = &s->levels[k + 1];
    double *undecided_at = s->undecided_at + k * s->p->n;
    memcpy(child->first, r->first, (k + 1) * sizeof *child->first);
    memcpy(child->undecided, r->undecided, r->first[k] * sizeof *child->undecided);
    for (size_t u = 0; u < r->first[k]; u++) {
        undecided_at[u] = coordinate(s, r->undecided[u], k);
    }
    child->inside = s->sorted + k * s->p->n; /* its first entries, which nobody changes */
}

/* Fills the undecided points of the child. Slabs are visited from last to first, so that the points undecided in
   earlier coordinates are a subset of those of the previously visited slab. */
static void fill_slab(searcher *s, size_t k, size_t of_k)
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
    memcpy(child->undecided + used, child->inside + child->n_inside, of_k * sizeof *child->undecided);
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

/* Searches slab c of coordinate k. high, low: the volumes of the largest and the smallest box of the region. For a leaf
   that cannot have a better value than the best so far, the undecided points are not collected. Returns false if no
   earlier slab can have a better value. */
static bool descend(searcher *s, size_t k, size_t c, double high, double low)
{
    const uint32_t *ends = s->ends + k * (2 * s->p->n + 4);
    region *child = &s->levels[k + 1];
    const double n = (double)s->p->n;
    child->n_inside = ends[2 * c + 1];
    const size_t of_k = ends[2 * c + 2] - child->n_inside;
    const double fewest = (double)child->n_inside, most = (double)(child->n_inside + child->first[k] + of_k);
    s->lo[k] = s->cuts[k * (s->p->n + 2) + c];
    s->hi[k] = s->cuts[k * (s->p->n + 2) + c + 1];
    high *= s->hi[k] < 1 ? s->hi[k] : 1;
    low *= s->lo[k];
    if (k + 1 < s->p->dim) {
        fill_slab(s, k, of_k);
        if (fmax(high, (double)(child->n_inside + child->first[k + 1]) / n) <= s->best->value) {
            return false;
        }
        search(s, k + 1);
        return true;
    }
    if (high - fewest / n > s->best->value || most / n - low > s->best->value) {
        fill_slab(s, k, of_k);
        leaf(s);
    }
    if (++s->leaves % LEAVES_PER_CHECK == 0) {
        check_stop(s);
    }
    return true;
}

static void search(searcher *s, size_t k)
{
    double high = 1, low = 1;
    for (size_t m = 0; m < k; m++) {
        high *= s->hi[m] < 1 ? s->hi[m] : 1;
        low *= s->lo[m];
    }
    size_t c = find_slabs(s, k);
    begin_slabs(s, k);
    while (c-- > 0 && !s->stop && descend(s, k, c, high, low)) {
    }
}

static bool open_searcher(problem *p, searcher *s)
{
    const size_t n = p->n, dim = p->dim, room = n + 2 * dim + 8;
    *s = (searcher){.p = p, .room = room};
    const size_t doubles = 2 * dim + dim * (n + 2) + 2 * room + dim * room + dim * n + 2 * (n / 64 + 1);
    const size_t bytes = doubles * sizeof(double) + (dim + 1) * (sizeof(region) + (dim + 1) * sizeof(size_t)) +
                         ((2 * dim + 1) * n + dim * (2 * n + 4)) * sizeof(uint32_t);
    s->memory = malloc(bytes);
    if (!s->memory) {
        koksma__fail_memory(bytes);
        return false;
    }
    s->lo = s->memory;
    s->hi = s->lo + dim;
    s->cuts = s->hi + dim;
    s->sides = s->cuts + dim * (n + 2);
    s->rows = s->sides + 2 * room;
    s->undecided_at = s->rows + dim * room;
    s->inside = (uint64_t *)(s->undecided_at + dim * n);
    s->chosen = s->inside + n / 64 + 1;
    s->levels = (region *)(s->chosen + n / 64 + 1);
    size_t *firsts = (size_t *)(s->levels + dim + 1);
    s->sorted = (uint32_t *)(firsts + (dim + 1) * (dim + 1));
    uint32_t *lists = s->sorted + dim * n;
    s->ends = lists + (dim + 1) * n;
    for (size_t k = 0; k <= dim; k++) {
        s->levels[k] = (region){.undecided = lists + k * n, .first = firsts + k * (dim + 1)};
    }
    memset(s->levels[0].first, 0, (dim + 1) * sizeof(size_t));
    s->levels[0].inside = p->orders;
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
        find_slabs(&s, 0);
        begin_slabs(&s, 0);
        descend(&s, 0, c, 1, 1);
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
    const size_t bytes = (n + 2) * (sizeof(koksma_value) + dim * (sizeof(double) + 2 * sizeof(uint32_t)) + 1);
    p.values = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(p.values, bytes);
    p.sorted = (double *)(p.values + n + 2);
    p.orders = (uint32_t *)(p.sorted + dim * (n + 2));
    p.ranks = p.orders + dim * (n + 2);
    p.cut_short = (bool *)(p.ranks + dim * (n + 2));
    koksma_status status = KOKSMA_OK;
    searcher first;
    for (size_t k = 0; k < dim && !status; k++) {
        status = koksma__order(run, n, points->xs + k, dim, p.orders + k * n);
        for (size_t i = 0; i < n && !status; i++) {
            const uint32_t point = p.orders[k * n + i];
            p.ranks[k * n + point] = (uint32_t)i;
            p.sorted[k * n + i] = points->xs[dim * point + k];
        }
    }
    status = status ? status : open_searcher(&p, &first) ? KOKSMA_OK : KOKSMA_MEMORY;
    if (!status) {
        p.n_cuts = find_slabs(&first, 0);
        free(first.memory);
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

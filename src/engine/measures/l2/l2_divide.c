/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The L2 discrepancies in three and more dimensions by divide and conquer, O(n log^(d-1) n) (Heinrich 1996). For a <=
 * b every kernel of the family is a sum of a few products, sum_m A_m(a) B_m(b). With z = u - 1/2 and G = g + r z^2,
 *
 *     K(a, b) = (G(a) - q a) 1 + 1 (G(b) + q b) - 2 r a b,
 *
 * which is one product if G - q z is constant (star, modified) or if K is a multiple of (a + s) (b - s) (extreme),
 * two if r = 0, else three. The points are halved in order of a coordinate. Pairs within a half are a smaller problem
 * of the same kind. For pairs across the halves the order in this coordinate is known, so weights of the points can
 * absorb the factors A_m and B_m, and the remaining problem has one coordinate less. At the last coordinate but one
 * the halves are sorted by the last coordinate, and one pass with prefix sums handles all pairs across the halves.
 *
 * A problem on coordinate k, with the points in order of this coordinate, thus consists of
 *   - the same problem for the lower half and for the upper half;
 *   - for each m, a problem on coordinate k + 1 between the two halves, with the weights multiplied by A_m and B_m.
 *
 * With M <= 3 products, the time T_d(n) = 2 T_d(n/2) + M T_(d-1)(n) gives n log n for each coordinate but the last
 * two, which share one merge: n log^(d-1) n in total, with a constant that grows as M^(d-1). Problems of up to FEW
 * points are solved by summing over pairs.
 *
 * Above four dimensions all pairs are summed instead. In a test with MAX_DIM = 6 divide and conquer was slower than
 * pairs with AVX-512 up to n = 16,384: for kernels with one product 3.0 times in 5D and 5.1 times in 6D, for kernels
 * with three products 19 times in 5D and 50 times in 6D. At n = 65,536 divide and conquer was as fast as pairs in 5D
 * with one product (2.27 s, pairs 2.42 s), but slower in 6D with one product (1.9 times) and in 5D with three
 * products (6.1 times). Larger n were not measured; there the values would differ from sums over pairs from the 13th
 * digit on.
 *
 * All sums are compensated. The weights are rounded products, with independent errors of 1e-16 for each point that
 * average out. The halves do not depend on the number of threads, and their sums are added in a fixed order.
 */
#include "measures/l2/l2.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/double_double.h"
#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "kernels/kernels.h"
#include "measures/shared/shared.h"

typedef koksma__dd dd;

enum { MAX_DIM = KOKSMA__L2_DIVIDE_DIM, RANKS = 3, FEW = 24, PIECE = 1 << 13 };

typedef struct item {
    double z[MAX_DIM], g[MAX_DIM]; /* u - 1/2, and G of this number, for each coordinate u */
    double weight;
    uint32_t left; /* 1: the item is in the left one of two sets. `upper` is 1 if it is in the upper half */
    uint32_t upper;
} item;

typedef struct divider {
    const koksma__l2_row *row;
    int dim, ranks;
    size_t n, width;
    item *items, *spare; /* items are first in order of the first coordinate, later in order of the second */
    koksma__sum *sums;   /* the sum of each block */
} divider;

/* The memory of one thread. lists[k]: the items of a problem on coordinate k, followed by equal space for merging. */
typedef struct worker {
    const divider *d;
    item *lists[MAX_DIM];
    koksma__sum sum;
} worker;

static void find_factors(const divider *d, double z, double g, double a[RANKS], double b[RANKS])
{
    const double q = d->row->q, r = d->row->r;
    if (d->ranks == 1 && r == 0) { /* in this case G - q z is constant and equal to d->row->g[0] */
        a[0] = 1;
        b[0] = d->row->g[0] + g + q * z;
    } else if (d->ranks == 1) { /* here K = -2 r (a - q/2r) (b + q/2r) */
        a[0] = -2 * r * z + q;
        b[0] = z + q / (2 * r);
    } else {
        a[0] = g - q * z;
        b[0] = 1;
        a[1] = 1;
        b[1] = g + q * z;
        a[2] = -2 * r * z;
        b[2] = z;
    }
}

int koksma__l2_ranks(const koksma__l2_row *row)
{
    const double second = row->g[2] + row->r;
    const bool linear = row->r == 0 && second == 0 && row->g[3] == 0 && row->g[1] == row->q;
    const bool product =
        row->r != 0 && second == 0 && row->g[1] == 0 && row->g[3] == 0 && 4 * row->r * row->g[0] == row->q * row->q;
    return linear || product ? 1 : row->r == 0 ? 2 : 3;
}

/* Returns the product of K over coordinate k and all later coordinates. */
static double kernel_from(const divider *d, int k, const item *u, const item *v)
{
    double product = 1;
    for (; k < d->dim; k++) {
        product *= u->g[k] + v->g[k] - 2 * d->row->r * u->z[k] * v->z[k] + d->row->q * fabs(u->z[k] - v->z[k]);
    }
    return product;
}

static void sort_few(item *items, size_t n, int k)
{
    for (size_t i = 1; i < n; i++) {
        const item moving = items[i];
        size_t j = i;
        for (; j > 0 && items[j - 1].z[k] > moving.z[k]; j--) {
            items[j] = items[j - 1];
        }
        items[j] = moving;
    }
}

/* Merges two lists that are sorted by coordinate k into `to`. */
static void merge(const item *l, size_t n_l, const item *r, size_t n_r, int k, item *to)
{
    const item *const l_end = l + n_l, *const r_end = r + n_r;
    while (l < l_end && r < r_end) {
        *to++ = l->z[k] <= r->z[k] ? *l++ : *r++;
    }
    memcpy(to, l, (size_t)(l_end - l) * sizeof *to);
    memcpy(to + (l_end - l), r, (size_t)(r_end - r) * sizeof *to);
}

static void add(koksma__sum *sum, double x)
{
    const dd s = koksma__dd_sum(sum->total, x);
    sum->total = s.hi;
    sum->lost += s.lo;
}

/* Adds all pairs of a left and a right item across the halves of coordinate k. The items are in order of the last
   coordinate, k + 1. */
static void pass(worker *w, const item *items, size_t n, int k)
{
    const divider *d = w->d;
    const int ranks = d->ranks;
    koksma__sum before[4][RANKS][RANKS]; /* sums over the items so far; the indices are the kind of item (left,
                                            upper), and the product m for coordinate k and for coordinate k + 1 */
    memset(before, 0, sizeof before);
    for (size_t i = 0; i < n; i++) {
        double a[2][RANKS], b[2][RANKS], sum = 0;
        const item *it = &items[i];
        const unsigned kind = 2 * it->left + it->upper;
        find_factors(d, it->z[k], it->g[k], a[0], b[0]);
        find_factors(d, it->z[k + 1], it->g[k + 1], a[1], b[1]);
        for (int m = 0; m < ranks; m++) {
            const double weight = it->weight * (it->upper ? b : a)[0][m];
            for (int l = 0; l < ranks; l++) {
                const koksma__sum *other = &before[3 - kind][m][l];
                sum += weight * b[1][l] * (other->total + other->lost);
                add(&before[kind][m][l], weight * a[1][l]);
            }
        }
        koksma__sum_add(&w->sum, sum);
    }
}

static void between(worker *w, item *items, item *spare, size_t n, int k);

/* Adds the pairs across the halves of coordinate k with the left item in the lower half and the right item in the
   upper half (left_is_lower), or the other way round. The items are in order of coordinate k + 1, the next to be
   halved. */
static void next_coordinate(worker *w, const item *items, size_t n, int k, bool left_is_lower)
{
    const divider *d = w->d;
    for (int m = 0; m < d->ranks; m++) {
        item *list = w->lists[k + 1];
        size_t count = 0;
        for (size_t i = 0; i < n; i++) {
            if ((items[i].left != items[i].upper) == left_is_lower) {
                double a[RANKS], b[RANKS];
                find_factors(d, items[i].z[k], items[i].g[k], a, b);
                list[count] = items[i];
                list[count++].weight *= items[i].upper ? b[m] : a[m];
            }
        }
        between(w, list, list + n, count, k + 1);
    }
}

/* Adds, over all pairs of a left and a right item, the product of their weights and of the kernels of the coordinates
   from k on. The items are in order of coordinate k on entry, of coordinate k + 1 on return. */
static void between(worker *w, item *items, item *spare, size_t n, int k)
{
    const divider *d = w->d;
    if (n <= FEW) {
        for (size_t i = 1; i < n; i++) {
            double sum = 0;
            for (size_t j = 0; j < i; j++) {
                if (items[i].left != items[j].left) {
                    sum += items[j].weight * kernel_from(d, k, &items[i], &items[j]);
                }
            }
            koksma__sum_add(&w->sum, items[i].weight * sum);
        }
        sort_few(items, n, k + 1);
        return;
    }
    const size_t half = n / 2;
    between(w, items, spare, half, k);
    between(w, items + half, spare + half, n - half, k);
    for (size_t i = 0; i < n; i++) {
        items[i].upper = i >= half;
    }
    merge(items, half, items + half, n - half, k + 1, spare);
    memcpy(items, spare, n * sizeof *items);
    if (k + 2 == d->dim) {
        pass(w, items, n, k);
    } else {
        next_coordinate(w, items, n, k, true);
        next_coordinate(w, items, n, k, false);
    }
}

/* Adds the pairs across two halves of the first coordinate. Each half is in order of the second coordinate; on return
   all items are in this order. */
static void across(worker *w, item *items, size_t half, size_t n, item *to)
{
    for (size_t i = 0; i < n; i++) {
        items[i].left = i < half;
        items[i].upper = i >= half;
        items[i].weight = 1;
    }
    merge(items, half, items + half, n - half, 1, to);
    next_coordinate(w, to, n, 0, true);
}

static void within(worker *w, item *items, item *spare, size_t n)
{
    if (n <= FEW) {
        for (size_t i = 1; i < n; i++) {
            double sum = 0;
            for (size_t j = 0; j < i; j++) {
                sum += kernel_from(w->d, 0, &items[i], &items[j]);
            }
            koksma__sum_add(&w->sum, sum);
        }
        sort_few(items, n, 1);
        return;
    }
    const size_t half = n / 2;
    within(w, items, spare, half);
    within(w, items + half, spare + half, n - half);
    across(w, items, half, n, spare);
    memcpy(items, spare, n * sizeof *items);
}

/* Allocates the lists for n items: one list, and space for merging, for each coordinate but the first and the
   last. */
static koksma_status open_worker(const divider *d, size_t n, worker *w)
{
    const size_t lists = (size_t)d->dim - 2, bytes = 2 * lists * n * sizeof(item);
    *w = (worker){.d = d};
    w->lists[1] = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(w->lists[1], bytes);
    for (size_t k = 2; k <= lists; k++) {
        w->lists[k] = w->lists[k - 1] + 2 * n;
    }
    return KOKSMA_OK;
}

/* Adds the worker's sum to that of its block. */
static koksma_status close_worker(worker *w, size_t block)
{
    koksma__sum_add(&w->d->sums[block], w->sum.total);
    koksma__sum_add(&w->d->sums[block], w->sum.lost);
    free(w->lists[1]);
    return KOKSMA_OK;
}

static koksma_status piece(void *context, size_t block)
{
    const divider *d = context;
    const size_t first = block * PIECE, count = d->n - first < PIECE ? d->n - first : PIECE;
    worker w;
    KOKSMA__TRY(open_worker(d, count, &w));
    within(&w, d->items + first, d->spare + first, count);
    return close_worker(&w, block);
}

static koksma_status two_pieces(void *context, size_t block)
{
    const divider *d = context;
    const size_t first = 2 * block * d->width, rest = d->n - first;
    const size_t half = rest < d->width ? rest : d->width, count = rest < 2 * d->width ? rest : 2 * d->width;
    worker w;
    KOKSMA__TRY(open_worker(d, count, &w));
    across(&w, d->items + first, half, count, d->spare + first);
    return close_worker(&w, block);
}

static koksma_status divide(divider *d, const koksma_run *run)
{
    koksma__phases phases = {.share = 0};
    double levels = 1; /* each takes about as long as the others */
    for (size_t width = PIECE; width < d->n; width *= 2) {
        levels++;
    }
    koksma_run phase = koksma__phase_run(&phases, run, 1 / levels);
    koksma_status status = koksma__parallel(&phase, (d->n + PIECE - 1) / PIECE, piece, d);
    for (d->width = PIECE; d->width < d->n && !status; d->width *= 2) {
        phase = koksma__phase_run(&phases, run, 1 / levels);
        status = koksma__parallel(&phase, (d->n + 2 * d->width - 1) / (2 * d->width), two_pieces, d);
        item *const other = d->items;
        d->items = d->spare;
        d->spare = other;
    }
    return status;
}

/* Fills the items in order of the first coordinate, and computes the sums over single points. */
static koksma_status prepare(divider *d, const koksma_points *points, const koksma_run *run, uint32_t *order,
                             koksma__dd *linear, koksma__sum *self)
{
    const size_t dim = (size_t)points->dim;
    const double big_g[4] = {d->row->g[0], d->row->g[1], d->row->g[2] + d->row->r, d->row->g[3]};
    const koksma_status status = koksma__order(run, d->n, points->xs, dim, order);
    for (size_t i = 0; i < d->n && !status; i++) {
        const double *x = points->xs + order[i] * dim;
        item *it = &d->items[i];
        memset(it, 0, sizeof *it);
        for (size_t k = 0; k < dim; k++) {
            it->z[k] = x[k] - 0.5;
            it->g[k] = koksma__l2_polynomial(big_g, x[k]);
        }
        koksma__dd product;
        koksma__kernels()->l2_linear(1, d->dim, x, 1, d->row->a24, &product.hi, &product.lo);
        *linear = koksma__dd_add(*linear, product);
        koksma__sum_add(self, kernel_from(d, 0, it, it));
    }
    return status;
}

koksma_status koksma__l2_by_dividing(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                                     double *square)
{
    const size_t n = points->n, n_blocks = (n + PIECE - 1) / PIECE;
    const size_t bytes = 2 * n * sizeof(item) + n_blocks * sizeof(koksma__sum) + n * sizeof(uint32_t);
    divider d = {.row = row, .dim = points->dim, .ranks = koksma__l2_ranks(row), .n = n, .items = malloc(bytes)};
    KOKSMA__REQUIRE_MEMORY(d.items, bytes);
    void *const memory = d.items;
    d.spare = d.items + n;
    d.sums = (koksma__sum *)(d.spare + n);
    memset(d.sums, 0, n_blocks * sizeof *d.sums);
    koksma__dd linear = {0, 0};
    koksma__sum both = {0};
    koksma_status status = prepare(&d, points, run, (uint32_t *)(d.sums + n_blocks), &linear, &both);
    status = status ? status : divide(&d, run);
    for (size_t block = 0; block < n_blocks; block++) {
        koksma__sum_add(&both, 2 * d.sums[block].total);
        koksma__sum_add(&both, 2 * d.sums[block].lost);
    }
    *square = koksma__l2_combine(row, points->dim, n, linear, &both);
    free(memory);
    return status;
}

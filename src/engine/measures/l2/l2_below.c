/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Sums over all pairs of points in which one point is below the other in both coordinates, by a radix sort that
 * counts inversions. The points are distributed, in order of y, to 2^k parts according to their rank in x. Each node
 * of a binary tree over the parts stores the number of points that have gone to its left half so far, and the sum of
 * their y. A point follows the path from the root to its part. Where the path turns left, the point is added to the
 * node. Where it turns right, the node has exactly the points of its left half that precede the point in y. The same
 * procedure then handles the points within each part.
 *
 * The sums are exact: y is split into two halves so that sums of either half stay below 2^63, and products are summed
 * in 128 bits.
 */
#include "measures/l2/l2.h"

#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"

#ifdef __SIZEOF_INT128__ /* without 128-bit integers, l2_sort.c sums over all pairs instead */

enum { MAX_BITS = 8, PARTS = 1 << MAX_BITS, LOW_BITS = 26, CHUNK = 1 << 15 };

typedef koksma__int128 wide;
typedef koksma__l2_point point;

/* Sums over a set of points: of the low LOW_BITS bits of y, of the bits above these, and the number of points. */
typedef int64_t halves __attribute__((vector_size(16)));
typedef struct node {
    halves y;
    int64_t count;
} node;

/* A sum: high 2^LOW_BITS + low. */
typedef struct total {
    wide high, low;
} total;

typedef struct job {
    size_t n, n_chunks;
    int bits, rest; /* number of bits of the first digit, and of the digits below it */
    point *points, *spare;
    node (*starts)[PARTS]; /* for each chunk, the sums of its points in each part; later the sums over all earlier
                              chunks */
    total *totals;         /* first the result of each chunk, later that of each part */
} job;

static void add(node *sum, const node *other)
{
    sum->y += other->y;
    sum->count += other->count;
}

static node node_of(const point *p)
{
    return (node){{p->y & ((1 << LOW_BITS) - 1), p->y >> LOW_BITS}, 1};
}

/* Distributes points to their parts by the digit at bit `rest`, and returns the sum over the pairs whose points go to
   different parts. tree: the nodes level by level, with the root at index 1; places: the position of the next point
   of each part. */
static total deal(const point *points, size_t n, int bits, int rest, node *tree, uint32_t *places, point *to)
{
    static const halves masks[2] = {{0, 0}, {-1, -1}}; /* loading a mask from a table is faster than computing it */
    total sum = {0, 0};
    for (size_t i = 0; i < n; i++) {
        const point p = points[i];
        const uint32_t part = p.at >> rest & ((1u << bits) - 1);
        const node mine = node_of(&p);
        halves below = {0, 0};
        int64_t count = 0;
        for (int level = bits - 1; level >= 0; level--) {
            node *at = &tree[(1u << (bits - 1 - level)) | (part >> level >> 1)];
            const unsigned right = part >> level & 1;
            const halves is_right = masks[right], is_left = masks[!right];
            below += at->y & is_right;
            at->y += mine.y & is_left;
            count += at->count & -(int64_t)right;
            at->count += !right;
        }
        sum.low += (wide)p.x * (mine.y[0] * count - below[0]);
        sum.high += (wide)p.x * (mine.y[1] * count - below[1]);
        to[places[part]++] = p;
    }
    return sum;
}

/* Returns the sum over all pairs of n points in y order whose ranks in x order agree in all but the lowest `bits`
   bits. */
static total solve(point *points, point *spare, size_t n, int bits)
{
    if (bits == 0) {
        return (total){0, 0};
    }
    const int passes = (bits + MAX_BITS - 1) / MAX_BITS, rest = bits - (bits + passes - 1) / passes;
    node tree[PARTS];
    uint32_t places[PARTS];
    memset(tree, 0, sizeof *tree << (bits - rest));
    for (size_t part = 0; part < (size_t)1 << (bits - rest); part++) {
        places[part] = (uint32_t)(part << rest);
    }
    total sum = deal(points, n, bits - rest, rest, tree, places, spare);
    for (size_t first = 0; rest > 0 && first < n; first += (size_t)1 << rest) {
        const size_t count = n - first < (size_t)1 << rest ? n - first : (size_t)1 << rest;
        const total inside = solve(spare + first, points + first, count, rest);
        sum.high += inside.high;
        sum.low += inside.low;
    }
    return sum;
}

static size_t chunk_size(const job *j, size_t chunk)
{
    return j->n - chunk * CHUNK < CHUNK ? j->n - chunk * CHUNK : CHUNK;
}

static koksma_status count_chunk(void *context, size_t chunk)
{
    const job *j = context;
    const point *points = j->points + chunk * CHUNK;
    memset(j->starts[chunk], 0, sizeof j->starts[chunk]);
    for (size_t i = 0; i < chunk_size(j, chunk); i++) {
        const node mine = node_of(&points[i]);
        add(&j->starts[chunk][points[i].at >> j->rest], &mine);
    }
    return KOKSMA_OK;
}

static koksma_status deal_chunk(void *context, size_t chunk)
{
    const job *j = context;
    const size_t parts = (size_t)1 << j->bits;
    node tree[PARTS], sums[2 * PARTS];
    uint32_t places[PARTS];
    for (size_t part = 0; part < parts; part++) {
        sums[parts + part] = j->starts[chunk][part];
        places[part] = (uint32_t)((part << j->rest) + (size_t)sums[parts + part].count);
    }
    for (size_t v = parts - 1; v > 0; v--) {
        tree[v] = sums[v] = sums[2 * v];
        add(&sums[v], &sums[2 * v + 1]);
    }
    j->totals[chunk] =
        deal(j->points + chunk * CHUNK, chunk_size(j, chunk), j->bits, j->rest, tree, places, j->spare);
    return KOKSMA_OK;
}

static koksma_status solve_part(void *context, size_t part)
{
    const job *j = context;
    const size_t first = part << j->rest;
    j->totals[part] = (total){0, 0};
    if (first < j->n) {
        const size_t count = j->n - first < (size_t)1 << j->rest ? j->n - first : (size_t)1 << j->rest;
        j->totals[part] = solve(j->spare + first, j->points + first, count, j->rest);
    }
    return KOKSMA_OK;
}

static void add_up(const total *totals, size_t count, koksma__dd *sum)
{
    for (size_t i = 0; i < count; i++) {
        const koksma__dd high = koksma__dd_of_int(totals[i].high);
        *sum = koksma__dd_add(*sum, koksma__dd_scale(high, 1 << LOW_BITS));
        *sum = koksma__dd_add(*sum, koksma__dd_of_int(totals[i].low));
    }
}

static koksma_status run_job(job *j, const koksma_run *run, koksma__dd *sum)
{
    koksma__phases phases = {.share = 0};
    koksma_run phase = koksma__phase_run(&phases, run, 0.1);
    koksma_status status = koksma__parallel(&phase, j->n_chunks, count_chunk, j);
    for (size_t part = 0; part < PARTS && !status; part++) {
        node before = {{0, 0}, 0};
        for (size_t chunk = 0; chunk < j->n_chunks; chunk++) {
            const node here = j->starts[chunk][part];
            j->starts[chunk][part] = before;
            add(&before, &here);
        }
    }
    phase = koksma__phase_run(&phases, run, 0.2);
    status = status ? status : koksma__parallel(&phase, j->n_chunks, deal_chunk, j);
    if (!status) {
        add_up(j->totals, j->n_chunks, sum);
        phase = koksma__phase_run(&phases, run, 0.7);
        status = j->rest > 0 ? koksma__parallel(&phase, (size_t)1 << j->bits, solve_part, j) : KOKSMA_OK;
    }
    if (!status && j->rest > 0) {
        add_up(j->totals, (size_t)1 << j->bits, sum);
    }
    return status;
}

koksma_status koksma__l2_sum_below(const koksma_run *run, size_t n, koksma__l2_point *points, koksma__l2_point *spare,
                                   koksma__dd *sum)
{
    job j = {.n = n, .n_chunks = (n + CHUNK - 1) / CHUNK, .points = points, .spare = spare};
    while (n > (size_t)1 << j.rest) {
        j.rest++;
    }
    *sum = (koksma__dd){0, 0};
    if (n <= CHUNK) {
        const total all = solve(points, spare, n, j.rest);
        add_up(&all, 1, sum);
        return KOKSMA_OK;
    }
    j.bits = MAX_BITS;
    j.rest -= MAX_BITS;
    const size_t bytes = j.n_chunks * sizeof *j.starts + (j.n_chunks + PARTS) * sizeof *j.totals;
    j.starts = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(j.starts, bytes);
    j.totals = (total *)(j.starts + j.n_chunks);
    const koksma_status status = run_job(&j, run, sum);
    free(j.starts);
    return status;
}

#endif

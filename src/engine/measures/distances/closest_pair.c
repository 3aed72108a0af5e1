/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The smallest distance between two points of a set in any dimension, by a k-d tree (Bentley 1975): a node splits
 * its points at the median along its longest side. The closest pair lies within one half or between the two halves. A
 * pair of nodes is skipped if their boxes are further apart than the closest pair found so far. Otherwise the larger
 * node is replaced by its two children; if both nodes are leaves, all pairs of their points are compared. On the
 * torus the distance of two boxes is the shorter way around in each coordinate. The search takes O(n log n) for
 * evenly spread points in few dimensions, and O(n^2) in many dimensions, where most boxes are near each other.
 */
#include "measures/distances/distances.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/vector.h"

enum { LEAF = 8, PAIRS_AT_ONCE = 1 << 16 };

/* A node has points first .. end - 1 of `order`. The children of node i are nodes 2 i + 1 and 2 i + 2; a leaf has no
   children. */
typedef struct node {
    size_t first, end;
    double *low, *high; /* its box */
} node;

typedef struct search {
    const double *xs;
    const koksma_run *run;
    size_t n, dim, pairs, done;
    bool torus, stopped;
    double best; /* the least squared distance so far */
    uint32_t *order;
    node *nodes;
    double *boxes;
} search;

static bool is_leaf(const node *a)
{
    return a->end - a->first <= LEAF;
}

static double coordinate(const search *s, size_t i, size_t k)
{
    return s->xs[s->order[i] * s->dim + k];
}

static void build(search *s, size_t at, size_t first, size_t end)
{
    node *a = &s->nodes[at];
    size_t longest = 0;
    a->first = first;
    a->end = end;
    a->low = s->boxes + 2 * s->dim * at;
    a->high = a->low + s->dim;
    for (size_t k = 0; k < s->dim; k++) {
        a->low[k] = a->high[k] = coordinate(s, first, k);
        for (size_t i = first + 1; i < end; i++) {
            a->low[k] = fmin(a->low[k], coordinate(s, i, k));
            a->high[k] = fmax(a->high[k], coordinate(s, i, k));
        }
        longest = a->high[k] - a->low[k] > a->high[longest] - a->low[longest] ? k : longest;
    }
    if (!is_leaf(a)) {
        const size_t middle = first + (end - first) / 2;
        koksma__select(s->order, first, end, middle, s->xs, s->dim, longest);
        build(s, 2 * at + 1, first, middle);
        build(s, 2 * at + 2, middle, end);
    }
}

/* Returns a lower bound of the squared distance between points of two boxes, with a margin for rounding. */
static double box_distance(const search *s, const node *a, const node *b)
{
    double sum = 0;
    for (size_t k = 0; k < s->dim; k++) {
        double gap = fmax(0, fmax(b->low[k] - a->high[k], a->low[k] - b->high[k]));
        if (s->torus) {
            gap = fmin(gap, fmax(0, 1 - fmax(b->high[k] - a->low[k], a->high[k] - b->low[k])));
        }
        sum += gap * gap;
    }
    return sum * (1 - 0x1p-40);
}

static void try_pair(search *s, size_t i, size_t j)
{
    double sum = 0;
    for (size_t k = 0; k < s->dim; k++) {
        const double a = coordinate(s, i, k), b = coordinate(s, j, k);
        const double d = s->torus ? koksma__torus_difference(a, b) : a - b;
        sum += d * d;
    }
    s->best = fmin(s->best, sum);
}

/* Tries the pairs of points of two different nodes, or all pairs within one node if at = with. */
static void search_pairs(search *s, size_t at, size_t with)
{
    const node *a = &s->nodes[at], *b = &s->nodes[with];
    if (s->stopped || !(s->best > 0) || (at != with && box_distance(s, a, b) > s->best)) {
        return;
    }
    if (is_leaf(a) && is_leaf(b)) {
        for (size_t i = a->first; i < a->end; i++) {
            for (size_t j = at == with ? i + 1 : b->first; j < b->end; j++) {
                try_pair(s, i, j);
            }
        }
        s->pairs += LEAF * LEAF;
        s->done = a->first; /* each leaf is compared with itself once, in the order of the points: this measures
                               progress */
        if (s->pairs >= PAIRS_AT_ONCE) {
            s->pairs = 0;
            s->stopped = !koksma__keep_going(s->run, (double)s->done / (double)s->n);
        }
        return;
    }
    if (at == with) {
        search_pairs(s, 2 * at + 1, 2 * at + 1);
        search_pairs(s, 2 * at + 2, 2 * at + 2);
        search_pairs(s, 2 * at + 1, 2 * at + 2);
    } else if (a->end - a->first >= b->end - b->first) {
        search_pairs(s, 2 * at + 1, with);
        search_pairs(s, 2 * at + 2, with);
    } else {
        search_pairs(s, at, 2 * with + 1);
        search_pairs(s, at, 2 * with + 2);
    }
}

koksma_status koksma__closest_pair(const koksma_points *points, bool torus, const koksma_run *run, double *distance)
{
    search s = {
        .xs = points->xs, .run = run, .n = points->n, .dim = (size_t)points->dim, .torus = torus, .best = INFINITY};
    size_t nodes = 1;
    for (size_t most = s.n; most > LEAF; most = (most + 1) / 2) { /* `most` is the number of points in the largest
                                                                     node of a level */
        nodes = 2 * nodes + 1;
    }
    s.order = malloc(s.n * sizeof *s.order);
    s.nodes = malloc(nodes * sizeof *s.nodes);
    s.boxes = malloc(2 * s.dim * nodes * sizeof *s.boxes);
    const bool allocated = s.order && s.nodes && s.boxes;
    for (size_t i = 0; i < s.n && allocated; i++) {
        s.order[i] = (uint32_t)i;
    }
    if (allocated) {
        s.stopped = !koksma__keep_going(run, 0);
        build(&s, 0, 0, s.n);
        search_pairs(&s, 0, 0);
    }
    free(s.order);
    free(s.nodes);
    free(s.boxes);
    KOKSMA__REQUIRE_MEMORY(allocated,
                           s.n * sizeof *s.order + nodes * (sizeof *s.nodes + 2 * s.dim * sizeof *s.boxes));
    *distance = sqrt(s.best);
    return s.stopped ? koksma__fail_interrupted() : KOKSMA_OK;
}

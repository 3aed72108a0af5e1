/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A segment tree over ranks by y. Leaf j is a line in x, v_j(x) = b_j + k_j x: n times the excess of the box to (x,
 * y_j), where k_j = -n y_j and b_j is the number of points in the box, or n times the box's deficit, where k_j = n
 * y_j and b_j is minus this number. Inserting a point adds a constant to the lines of a range of ranks; x only grows.
 * The amount `lazy` of a node has not been added to its children yet. The lowest levels of the tree are replaced by
 * blocks of leaves, which are scanned. The star discrepancy of the plane is the largest value of a leaf over all x,
 * and x takes n values from left to right.
 *
 * At first the nodes store bounds. The bound of a node is a line that is above all its leaves at the current x. This
 * line has the largest slope of the leaves, so it is above them at every later x, too. A subtree is searched only
 * when its bound is above the best value so far. An insertion scans one block and takes the larger of two bounds on
 * its way back to the root, in O(log n). In each step to the right, the bound of a subtree of w ranks rises by at
 * most w/n relative to its leaves. If the leaves are u below the best value, the subtree is therefore searched only
 * once in about u n/w steps.
 *
 * For some points, such as Hammersley's, values near the best occur everywhere, and subtrees are searched too often.
 * These searches are counted, and when there are too many, the rest of the walk is a kinetic tournament (Basch,
 * Guibas & Hershberger 1999) with x as the time. A node then stores the winner, which is the line with the largest
 * value among its leaves, and the x until which this line is known to win:
 *
 *     value |        ____.--  line 2 overtakes
 *           |  __.--'  .--'
 *           |-'    .--'  line 1 wins
 *           +----------|--------- x
 *                    until
 *
 * At an x below `until` the stored winner of a subtree is valid and is read in O(1). Past `until` the node's winner
 * and `until` are computed again from those of its children. An insertion adds one to the counts of a range of ranks:
 * this changes `lazy` of O(log n) nodes, and only the winners on the paths to the ends of the range are compared
 * again. All other recomputations happen because one line has overtaken another. Comparisons are made in doubles. If
 * two lines are nearly equal, either may win, because their values are equal up to rounding.
 */
#include "measures/star/star.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"

enum { BLOCK = 16, CHECK_EVERY = 1 << 14, PARTS = 4, MANY = 1 << 12 };

typedef struct node {
    double k, b;  /* the line b + k x: the winner, or a bound of all leaves with their largest k */
    double until; /* x up to which the winner is known to win; unused while nodes store bounds */
    double lazy;
} node;

typedef struct tree {
    size_t n_blocks; /* number of blocks of leaves, a power of two */
    node *nodes;     /* 1 .. 2 n_blocks - 1; block i is node n_blocks + i */
    double *k, *b;   /* the lines of the leaves */
    double x;
    bool exact;   /* true: nodes store winners; false: nodes store bounds */
    size_t looks; /* number of bounds that were tested */
} tree;

typedef struct best_box {
    double value;
    size_t at;
} best_box;

/* Excesses and deficits are computed in parallel, and large sets also in parts of the range of x; each of these walks
   has its own tree. */
typedef struct walks {
    size_t n, n_blocks, parts;
    const double *x, *y;
    const uint32_t *rank;
    const koksma_run *run;
    pthread_t caller; /* the caller's thread, which alone may call run->keep_going */
    atomic_bool stopped;
    best_box best[2][PARTS];
} walks;

static inline double at(double k, double b, double x)
{
    return b + k * x;
}

/* Returns the largest value of the leaves of a block at the current x, and makes it the bound of the block. */
static double scan(tree *t, size_t v)
{
    const double *k = t->k + (v - t->n_blocks) * BLOCK, *b = t->b + (v - t->n_blocks) * BLOCK;
    double values[BLOCK];
    for (int j = 0; j < BLOCK; j++) {
        values[j] = at(k[j], b[j], t->x);
    }
    for (int half = BLOCK / 2; half > 0; half /= 2) {
        for (int j = 0; j < half; j++) {
            values[j] = values[j] > values[j + half] ? values[j] : values[j + half];
        }
    }
    t->nodes[v].b = values[0] - t->nodes[v].k * t->x;
    t->nodes[v].lazy = 0;
    return values[0];
}

static void pull_block(tree *t, size_t v)
{
    if (!t->exact) {
        scan(t, v);
        return;
    }
    node *const block = &t->nodes[v];
    const double *k = t->k + (v - t->n_blocks) * BLOCK, *b = t->b + (v - t->n_blocks) * BLOCK;
    double value = at(k[0], b[0], t->x), until = INFINITY;
    int winner = 0;
    for (int j = 1; j < BLOCK; j++) {
        const double other = at(k[j], b[j], t->x);
        const bool wins = other > value || (other == value && k[j] > k[winner]);
        value = wins ? other : value;
        winner = wins ? j : winner;
    }
    for (int j = 0; j < BLOCK; j++) {
        const double rise = k[j] - k[winner];
        const double crossing = (b[winner] - b[j]) / rise;
        until = rise > 0 && crossing < until ? crossing : until;
    }
    *block = (node){k[winner], b[winner], until, 0};
}

static void pull(tree *t, size_t v)
{
    const node *l = &t->nodes[2 * v], *r = l + 1;
    const double left = at(l->k, l->b, t->x), right = at(r->k, r->b, t->x);
    if (!t->exact) {
        t->nodes[v].b = (left > right ? left : right) - t->nodes[v].k * t->x;
        return;
    }
    const bool left_wins = left > right || (left == right && l->k >= r->k);
    const node *w = left_wins ? l : r, *o = left_wins ? r : l;
    double until = l->until < r->until ? l->until : r->until;
    if (o->k > w->k) {
        const double crossing = (w->b - o->b) / (o->k - w->k);
        until = crossing < until ? crossing : until;
    }
    t->nodes[v] = (node){w->k, w->b, until, 0};
}

static void add_to_block(tree *t, size_t v, size_t first, size_t end, double amount)
{
    double *b = t->b + (v - t->n_blocks) * BLOCK;
    for (size_t j = first; j < end; j++) {
        b[j] += amount;
    }
}

static void push(tree *t, size_t v)
{
    const double lazy = t->nodes[v].lazy;
    if (lazy != 0) {
        for (size_t child = 2 * v; child <= 2 * v + 1; child++) {
            t->nodes[child].b += lazy;
            t->nodes[child].lazy += lazy;
        }
        t->nodes[v].lazy = 0;
    }
}

/* Updates the winner of node v for the current x. */
static void advance(tree *t, size_t v)
{
    if (!t->exact || t->nodes[v].until > t->x) {
        return;
    }
    if (v >= t->n_blocks) {
        add_to_block(t, v, 0, BLOCK, t->nodes[v].lazy);
        pull_block(t, v);
        return;
    }
    push(t, v);
    advance(t, 2 * v);
    advance(t, 2 * v + 1);
    pull(t, v);
}

/* Raises *best to the largest value of the leaves below node v, if that is larger. slack: the amount by which bounds
   may be too low. */
static void look(tree *t, size_t v, double slack, double *best)
{
    t->looks++;
    if (!(at(t->nodes[v].k, t->nodes[v].b, t->x) > *best - slack)) {
        return;
    }
    if (v >= t->n_blocks) {
        add_to_block(t, v, 0, BLOCK, t->nodes[v].lazy);
        const double most = scan(t, v);
        *best = most > *best ? most : *best;
        return;
    }
    push(t, v);
    look(t, 2 * v, slack, best);
    look(t, 2 * v + 1, slack, best);
    pull(t, v);
}

/* Adds an amount to all leaves with index >= `from`, and updates the nodes on the path for the current x. */
static void add_from(tree *t, size_t from, double amount)
{
    size_t v = 1, half = t->n_blocks * BLOCK / 2, path[64], depth = 0;
    while (v < t->n_blocks) {
        push(t, v);
        path[depth++] = v;
        const bool right = from >= half;
        const size_t other = 2 * v + !right;
        if (right) {
            from -= half;
        } else {
            t->nodes[other].b += amount;
            t->nodes[other].lazy += amount;
        }
        advance(t, other);
        v = 2 * v + right;
        half /= 2;
    }
    add_to_block(t, v, 0, BLOCK, t->nodes[v].lazy);
    add_to_block(t, v, from, BLOCK, amount);
    pull_block(t, v);
    while (depth > 0) {
        pull(t, path[--depth]);
    }
}

/* Sets the tree to its state after the first `from` points. */
static void start(tree *t, const walks *w, size_t from, double sign)
{
    const size_t deficit = sign < 0, n_lines = w->n + deficit;
    for (size_t j = 0; j < t->n_blocks * BLOCK; j++) {
        t->k[j] = -sign * (double)w->n * w->y[j < n_lines ? j : n_lines - 1];
        t->b[j] = j < n_lines ? 0 : -(double)INFINITY;
    }
    for (size_t i = 0; i < from; i++) {
        t->b[w->rank[i] + deficit] += sign;
    }
    for (size_t j = 1; j < n_lines; j++) {
        t->b[j] += t->b[j - 1];
    }
    t->x = from > 0 ? w->x[from] : 0;
    for (size_t v = 2 * t->n_blocks - 1; v > 0; v--) {
        t->nodes[v].lazy = 0;
        if (v >= t->n_blocks) {
            t->nodes[v].k = t->k[(v - t->n_blocks) * BLOCK + (deficit ? BLOCK - 1 : 0)];
            pull_block(t, v);
        } else {
            t->nodes[v].k = t->nodes[2 * v + deficit].k;
            pull(t, v);
        }
    }
}

static bool keeps_going(walks *w, double fraction_done)
{
    if (pthread_equal(pthread_self(), w->caller) && !koksma__keep_going(w->run, fraction_done)) {
        atomic_store(&w->stopped, true);
    }
    return !atomic_load(&w->stopped);
}

/* The fraction of all walks that is done when `done` of the `all` points of a walk are; walks begin in their order. */
static double fraction_at(const walks *w, size_t block, size_t done, size_t all)
{
    return ((double)block + (double)done / (double)all) / (2 * (double)w->parts);
}

/* Finds the best value among points `from` to `end`. sign 1: the excess, evaluated after each insertion; sign -1: the
   deficit, evaluated before each insertion. */
static koksma_status walk(walks *w, tree *t, size_t block, size_t from, size_t end, double sign, best_box *best)
{
    const size_t n = w->n;
    /* Rounding can lower a bound by at most this much: at most n additions compute it, and each rounds a number of at
       most 2n. */
    const double slack = 0x1p-51 * (double)n * (double)n;
    /* If on average more bounds than this are tested for each point, a kinetic tournament (see the top) is as fast, and
       the tree becomes one. */
    const size_t too_many = 4 + 2 * (size_t)koksma__log2((double)t->n_blocks);
    *best = (best_box){-INFINITY, from};
    start(t, w, from, sign);
    for (size_t i = from; i < end; i++) {
        if (i % CHECK_EVERY == 0 && !keeps_going(w, fraction_at(w, block, i - from, end - from))) {
            return koksma__fail_interrupted();
        }
        if (!t->exact && i < n && t->looks > too_many * (i - from) + 4 * t->n_blocks) {
            t->exact = true;
            start(t, w, i, sign);
        }
        t->x = i < n ? w->x[i] : 1;
        if (sign > 0) {
            add_from(t, w->rank[i], 1);
        } else {
            advance(t, 1);
        }
        double value = t->exact ? at(t->nodes[1].k, t->nodes[1].b, t->x) : best->value;
        if (!t->exact) {
            look(t, 1, slack, &value);
        }
        if (value > best->value) {
            *best = (best_box){value, i};
        }
        if (sign < 0 && i < n) {
            add_from(t, w->rank[i] + 1, -1);
        }
    }
    return KOKSMA_OK;
}

static koksma_status walk_one(void *context, size_t block)
{
    walks *w = context;
    tree t = {.n_blocks = w->n_blocks};
    const size_t part = block / 2, deficit = block % 2;
    const size_t from = w->n * part / w->parts,
                 end = w->n * (part + 1) / w->parts + (deficit && part + 1 == w->parts);
    const size_t bytes = 2 * t.n_blocks * sizeof(node) + 2 * t.n_blocks * BLOCK * sizeof(double);
    t.nodes = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(t.nodes, bytes);
    t.k = (double *)(t.nodes + 2 * t.n_blocks);
    t.b = t.k + t.n_blocks * BLOCK;
    const koksma_status status = walk(w, &t, block, from, end, deficit ? -1 : 1, &w->best[deficit][part]);
    free(t.nodes);
    return status;
}

koksma_status koksma__star_kinetic(size_t n, const double *x, const uint32_t *rank, const double *y,
                                   const koksma_run *run, double best[2], size_t at_best[2])
{
    walks w = {.n = n,
               .n_blocks = 1,
               .parts = n < MANY ? 1 : PARTS,
               .x = x,
               .y = y,
               .rank = rank,
               .run = run,
               .caller = pthread_self()};
    while (w.n_blocks * BLOCK < n + 2) {
        w.n_blocks *= 2;
    }
    const koksma_status status = koksma__parallel(run, 2 * w.parts, walk_one, &w);
    for (int deficit = 0; deficit < 2 && !status; deficit++) {
        best[deficit] = -INFINITY;
        for (size_t part = 0; part < w.parts; part++) {
            if (w.best[deficit][part].value > best[deficit]) {
                best[deficit] = w.best[deficit][part].value;
                at_best[deficit] = w.best[deficit][part].at;
            }
        }
    }
    return status;
}

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds the best boxes of all strips with a given left side while the right side moves to the right. For the points
 * of the strip in order of y, with w the width of the strip, let
 *
 *     F_j = #{points up to j} - n w y_j,   G_i = #{points before i} - n w y_i.
 *
 * The largest excess is the largest F_j - G_i, i <= j, for closed strips. The largest deficit is the largest F_i -
 * G_j, i < j, for open strips, where the lower and the upper side of the square count as points too. F, G and the
 * differences are lines in w. Each node of a tree over the points in order of y stores the largest F, the smallest G
 * and the best difference of the leaves below it, and the w up to which these are valid (a kinetic segment tree,
 * Basch, Guibas and Hershberger 1999). A new point changes the nodes on one path. A point in a left subtree shifts
 * all lines of the right subtree equally, which does not change their order. Among points with equal y the first has
 * the smallest G and the last the largest F; the others give only smaller values.
 */
#include "measures/extreme/extreme.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "measures/shared/shared.h"

typedef struct line {
    double count, slope; /* count - w slope */
} line;

typedef struct node {
    line f, g, best;
    double points, until; /* number of points in the strip; width up to which the lines are valid */
} node;

typedef struct tree {
    size_t leaves; /* number of leaves, a power of two; node i has children 2 i and 2 i + 1 */
    node *nodes;
    bool closed;
    double width;
} tree;

enum { CHECK_EVERY = 4096 };

static const line none = {-INFINITY, 0};

static inline line shifted(line l, double count)
{
    return (line){l.count + count, l.slope};
}

/* Returns the line that is larger at w, or, if both are equal, the line with the larger slope. Reduces *until to the
   width at which the other line overtakes it. */
static inline line larger(line a, line b, double w, double *until)
{
    const double ahead = a.count - b.count - w * (a.slope - b.slope);
    const bool first = ahead > 0 || (ahead == 0 && a.slope <= b.slope);
    const line top = first ? a : b, other = first ? b : a;
    if (top.slope > other.slope) {
        const double crossing = (top.count - other.count) / (top.slope - other.slope);
        *until = crossing < *until ? crossing : *until;
    }
    return top;
}

static inline line smaller(line a, line b, double w, double *until)
{
    const line top = larger((line){-a.count, -a.slope}, (line){-b.count, -b.slope}, w, until);
    return (line){-top.count, -top.slope};
}

static inline line difference(line a, line b)
{
    return (line){a.count - b.count, a.slope - b.slope};
}

static void pull(tree *t, size_t i)
{
    const node *l = &t->nodes[2 * i], *r = &t->nodes[2 * i + 1];
    const line r_f = shifted(r->f, l->points), r_g = shifted(r->g, l->points);
    double until = l->until < r->until ? l->until : r->until;
    const line across = t->closed ? difference(r_f, l->g) : difference(l->f, r_g);
    node *to = &t->nodes[i];
    to->f = larger(l->f, r_f, t->width, &until);
    to->g = smaller(l->g, r_g, t->width, &until);
    to->best = larger(larger(l->best, r->best, t->width, &until), across, t->width, &until);
    to->points = l->points + r->points;
    to->until = until;
}

static void advance(tree *t, size_t i)
{
    if (t->nodes[i].until <= t->width) {
        advance(t, 2 * i);
        advance(t, 2 * i + 1);
        pull(t, i);
    }
}

static void put_leaf(tree *t, size_t leaf, node value)
{
    t->nodes[t->leaves + leaf] = value;
    for (size_t i = (t->leaves + leaf) / 2; i > 0; i /= 2) {
        pull(t, i);
    }
}

/* Empties the tree. For open strips the lower and the upper side of the square are its first and last entries. */
static void clear(tree *t, size_t n, double height)
{
    const node empty = {none, {INFINITY, 0}, none, 0, INFINITY};
    t->width = 0;
    for (size_t i = 0; i < 2 * t->leaves; i++) {
        t->nodes[i] = empty;
    }
    if (!t->closed) {
        put_leaf(t, 0, (node){{0, 0}, {INFINITY, 0}, none, 0, INFINITY});
        put_leaf(t, n + 1, (node){none, {0, height}, none, 0, INFINITY});
    }
}

static void add_level(tree *t, const koksma__sweep_plane *p, size_t level)
{
    for (size_t i = p->first[level]; i < p->first[level + 1]; i++) {
        const double slope = (double)p->n * p->y[p->by_x[i]];
        put_leaf(t, p->by_x[i] + 1, (node){{1, slope}, {0, slope}, t->closed ? (line){1, 0} : none, 1, INFINITY});
    }
}

static void consider(tree *t, size_t left, size_t right, koksma__sweep_best *best)
{
    const line l = t->nodes[1].best;
    const double value = l.count - t->width * l.slope;
    if (value > best->value) {
        *best = (koksma__sweep_best){value, left, right, t->closed};
    }
}

/* Moves the right side over all levels. Returns true if the deadline passed before the end. */
static bool sweep_right(const koksma__sweep_plane *p, size_t left, double deadline_s, tree *closed, tree *open,
                        koksma__sweep_best *best)
{
    clear(closed, p->n, (double)p->n);
    clear(open, p->n, (double)p->n);
    for (size_t right = left; right < p->n_levels; right++) {
        if (right % CHECK_EVERY == 0 && koksma__now_s() > deadline_s) {
            return true;
        }
        closed->width = open->width = p->levels[right] - p->levels[left];
        advance(closed, 1);
        add_level(closed, p, right);
        consider(closed, left, right, best);
        if (right > left) {
            advance(open, 1);
            consider(open, left, right, best);
            add_level(open, p, right);
        }
    }
    return false;
}

koksma_status koksma__extreme_sweep(const koksma__sweep_plane *p, size_t from, size_t end, double deadline_s,
                                    koksma__sweep_best *best, bool *late)
{
    tree closed = {.leaves = 2, .closed = true}, open;
    while (closed.leaves < p->n + 2) {
        closed.leaves *= 2;
    }
    open = closed;
    open.closed = false;
    const size_t bytes = 4 * closed.leaves * sizeof(node);
    closed.nodes = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(closed.nodes, bytes);
    open.nodes = closed.nodes + 2 * closed.leaves;
    for (size_t left = from; left < end && !*late; left++) {
        *late = sweep_right(p, left, deadline_s, &closed, &open, best) || koksma__now_s() > deadline_s;
    }
    free(closed.nodes);
    return KOKSMA_OK;
}

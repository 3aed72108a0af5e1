/* SPDX-License-Identifier: Apache-2.0 */
/*
 * star-plane: minimises the star discrepancy in the plane, by a search over permutations; the best coordinates for
 * each permutation are computed exactly. The file is long because the constraint solver and the search share all
 * their state.
 *
 * Number the points by x, let p(i) be the rank by y of point i, c(i,j) the number of points with rank at most i by x
 * and at most j by y, and F = n f for a bound f. Then coordinates with a star discrepancy of at most f exist if and
 * only if
 *
 *     X_i Y_j >= c(i,j) - F,   X_i Y_j <= c(i-1,j-1) + F,   X_i <= X_i+1,   Y_j <= Y_j+1,   X_n+1 Y_n+1 = n,
 *
 * i, j = 1 .. n + 1; X_n+1 and Y_n+1 are the sides of the domain, whose area is scaled to n. In logarithms these are
 * difference constraints. The constraints have a solution if and only if no cycle of constraints is violated. A
 * solution is then found from any start by raising X or lowering Y where a constraint is violated, one node after the
 * other (Bellman & Ford with a queue). A violated cycle is found by following the causes of changes. The cycle
 * becomes satisfiable at the F for which the product of its terms (count - F) equals the product of its terms (count
 * + F): F is raised to this value, and the search for violations continues. When no constraint is violated, F is the
 * least value for the permutation p, and the cycle to which F was raised last is called critical.
 *
 * A walk starts from the permutation of the points (i, {i a + s}), where a has small partial quotients and s is
 * random, or, in a share of the searches (width_of), from the best set. The least F that a walk has met is its
 * target; it accepts permutations whose F is below a limit, which exceeds the target by a threshold (record-to-record
 * travel, Dueck 1993). A move swaps the ranks by y of two points. The move is chosen for a cycle that is violated at
 * the target: a box of this cycle with too many points loses a point, or a box with too few points gains one, because
 * no other swap can help. The last CYCLES violated cycles are stored, and a walk reduces the number of stored cycles
 * that are violated at the target: a move that increases this number, or violates a stored cycle at the limit, is
 * rejected before any constraint is checked. The least F is computed only when no stored cycle is violated; it gives
 * a new target or a new cycle (min-conflicts with constraints generated on demand). Work is counted in corners
 * visited.
 *
 * Source: the constraints as in Clement, Doerr, Klamroth & Paquete 2023, who solve them as integer programs.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/measures.h"
#include "measures/shared/shared.h"
#include "optimise/search.h"

enum { MAX_N = 4096, PATIENCE = 2000, CYCLES = 256, GUIDES = 16, MAX_EDGES = 16, NONE = UINT32_MAX };

/* Parameters of a search for n points. With few points a search explores widely, because the best sets differ much from
   lattices; with many points it stays near the best set. */
typedef struct width {
    double threshold; /* a walk rises at most by this fraction above the least F that it has met */
    double accepted;  /* a walk starts only from a set whose F is at most about this fraction above the best F */
    double again;     /* the share of searches that start from the best set */
} width;

static width width_of(size_t n)
{
    return n <= 48 ? (width){.threshold = 0.05, .accepted = 0.3, .again = 0.1}
                   : (width){.threshold = 0.02, .accepted = 0.05, .again = 0.25};
}

/* Returns the number of corners that one search visits; this takes some tenths of a second. */
static double budget_of(size_t n)
{
    return 2e7 + 3e5 * (double)n;
}

/* Violations by less than this many points count as rounding. */
static const double TOLERANCE = 1e-10;

/* An edge of a cycle of constraints. With sign = 1 it goes from node Y_j to node X_i, whose constraint X_i Y_j >=
   c(i,j) - F fails if the corner has too many points. With sign = -1 it goes from X_i+1 to Y_j+1, whose constraint
   X_i+1 Y_j+1 <= c(i,j) + F fails if the corner has too few points. */
typedef struct edge {
    uint16_t i, j;
    int8_t sign;
} edge;

typedef struct cycle {
    size_t n;
    edge edges[MAX_EDGES];
} cycle;

/* A swap of the ranks by y of two points, which are given by their ranks by x. */
typedef struct swap {
    size_t a, b;
} swap;

typedef struct plane {
    size_t n, side, stride;   /* side: n + 1, the number of nodes of each axis */
    uint32_t *rank, *at;      /* p and its inverse, 1 .. n */
    int16_t *counts, *turned; /* c(i,j) for i, j = 0 .. n + 1: in counts at index i stride + j, in turned at j stride
                                 + i */
    double *v, *saved;        /* X_1 .. X_n+1, Y_1 .. Y_n+1 */
    float *rounded;           /* v as floats */
    uint32_t *cause, *queue, *found, *stamps;
    uint8_t *queued;
    size_t first, waiting; /* first entry and length of the queue, a ring buffer with capacity for 2 * side nodes */
    uint32_t stamp;
    cycle cycles[CYCLES];     /* the stored cycles; the most recently violated ones come first */
    cycle guides[GUIDES];     /* some of the stored cycles that are violated at a walk's target */
    size_t guided, conflicts; /* number of guides, and number of stored cycles violated at the target */
    edge *traced, *critical;  /* each has capacity for 2 * side edges */
    size_t n_traced, n_critical;
    double work, budget;
    const koksma_run *run;
    double asked; /* the work at which run was asked last */
    bool stopped; /* run wants the search to end */
    koksma__stream random;
    void *memory;
} plane;

static koksma_status plane_init(plane *s, size_t n, uint64_t seed, const koksma_run *run)
{
    *s = (plane){.n = n,
                 .side = n + 1,
                 .stride = (n + 2 + 31) / 32 * 32,
                 .random = {.seed = seed},
                 .budget = budget_of(n),
                 .run = run};
    const size_t nodes = 2 * s->side, matrix = (n + 2) * s->stride;
    const size_t bytes = 2 * nodes * sizeof(double) + nodes * sizeof(float) +
                         (4 * nodes + 2 * (n + 1)) * sizeof(uint32_t) + 2 * nodes * sizeof(edge) +
                         2 * matrix * sizeof(int16_t) + nodes;
    s->memory = calloc(1, bytes);
    KOKSMA__REQUIRE_MEMORY(s->memory, bytes);
    s->v = s->memory;
    s->saved = s->v + nodes;
    s->rounded = (float *)(s->saved + nodes);
    s->cause = (uint32_t *)(s->rounded + nodes);
    s->queue = s->cause + nodes;
    s->found = s->queue + nodes;
    s->stamps = s->found + nodes;
    s->rank = s->stamps + nodes;
    s->at = s->rank + n + 1;
    s->traced = (edge *)(s->at + n + 1);
    s->critical = s->traced + nodes;
    s->counts = (int16_t *)(s->critical + nodes);
    s->turned = s->counts + matrix;
    s->queued = (uint8_t *)(s->turned + matrix);
    return KOKSMA_OK;
}

/* Computes the counts for s->rank, and the inverse permutation. */
static void count_all(plane *s)
{
    const size_t n = s->n, stride = s->stride;
    for (size_t i = 1; i <= n; i++) {
        s->at[s->rank[i]] = (uint32_t)i;
    }
    for (int turned = 0; turned < 2; turned++) {
        const uint32_t *rank = turned ? s->at : s->rank;
        int16_t *c = turned ? s->turned : s->counts;
        for (size_t i = 1; i <= n; i++) {
            int16_t *row = c + i * stride;
            memcpy(row, row - stride, (n + 2) * sizeof *row);
            for (size_t j = rank[i]; j <= n + 1; j++) {
                row[j]++;
            }
        }
        memcpy(c + (n + 1) * stride, c + n * stride, (n + 2) * sizeof *c);
    }
    s->work += 2.0 * (double)(n * n);
}

/* Returns the change of c(i,j) by a swap. */
static int change(const plane *s, swap w, size_t i, size_t j)
{
    const size_t a = s->rank[w.a], b = s->rank[w.b];
    return i < w.a || i >= w.b ? 0 : a < b ? -(j >= a && j < b) : j >= b && j < a;
}

static void apply(plane *s, swap w)
{
    const uint32_t a = s->rank[w.a], b = s->rank[w.b], low = a < b ? a : b, high = a < b ? b : a;
    const int16_t by = a < b ? -1 : 1;
    for (size_t i = w.a; i < w.b; i++) {
        for (size_t j = low; j < high; j++) {
            s->counts[i * s->stride + j] = (int16_t)(s->counts[i * s->stride + j] + by);
        }
    }
    for (size_t j = low; j < high; j++) {
        for (size_t i = w.a; i < w.b; i++) {
            s->turned[j * s->stride + i] = (int16_t)(s->turned[j * s->stride + i] + by);
        }
    }
    s->rank[w.a] = b;
    s->rank[w.b] = a;
    s->at[b] = (uint32_t)w.a;
    s->at[a] = (uint32_t)w.b;
    s->work += 2.0 * (double)(w.b - w.a) * (high - low);
}

/* Returns whether a cycle is violated at F after a swap (NULL: without a swap). */
static bool violated(const plane *s, const edge *edges, size_t n, double F, const swap *w)
{
    double more = 1, less = 1;
    for (size_t e = 0; e < n; e++) {
        const size_t i = edges[e].i, j = edges[e].j;
        const double count = s->counts[i * s->stride + j] + (w ? change(s, *w, i, j) : 0);
        if (edges[e].sign > 0) {
            if (count <= F) {
                return false;
            }
            more *= i == s->side && j == s->side ? count : count - F;
        } else {
            less *= i == s->side && j == s->side ? count : count + F;
        }
        if (more > 1e60 && less > 1e60) {
            more *= 1e-60;
            less *= 1e-60;
        }
    }
    return more > less;
}

/* Returns the value, rounded up, to which F must rise so that a cycle that is violated at F becomes satisfiable. */
static double closing(const plane *s, const edge *edges, size_t n, double F)
{
    double low = F, high = (double)s->n;
    while (high - low > 1e-14 * high) {
        const double middle = low + (high - low) / 2;
        *(violated(s, edges, n, middle, NULL) ? &low : &high) = middle;
    }
    return high;
}

static void push(plane *s, uint32_t node)
{
    if (!s->queued[node]) {
        const size_t nodes = 2 * s->side;
        s->queued[node] = 1;
        s->queue[(s->first + s->waiting++) % nodes] = node;
    }
}

/* Empties the queue and forgets all causes. */
static void clear(plane *s)
{
    memset(s->queued, 0, 2 * s->side);
    memset(s->cause, 0xff, 2 * s->side * sizeof *s->cause);
    s->first = s->waiting = 0;
}

/* Writes to *out the edge (corner and sign) of the constraint by which node `from` moves node `to`. Returns false if
   the two nodes belong to one axis, where the only constraint is their order. */
static bool corner_of(const plane *s, uint32_t from, uint32_t to, edge *out)
{
    const uint32_t side = (uint32_t)s->side;
    if ((from < side) == (to < side)) {
        return false;
    }
    const uint32_t x = from < side ? from : to, y = from < side ? to - side : from - side;
    const bool outer = x + 1 == side && y + 1 == side, deficit = from < side;
    *out = (edge){(uint16_t)(x + (outer || !deficit)), (uint16_t)(y + (outer || !deficit)), deficit ? -1 : 1};
    return true;
}

/* Stores in s->traced the violated cycle that is found when node `from` has to move node `to`, which is among the
   causes of `from`. */
static void trace(plane *s, uint32_t from, uint32_t to)
{
    s->n_traced = 0;
    for (uint32_t node = to, cause = from;; node = cause, cause = s->cause[cause]) {
        s->n_traced += corner_of(s, cause, node, &s->traced[s->n_traced]);
        if (cause == to) {
            return;
        }
    }
}

/* Moves a cycle to the front of the stored cycles. */
static void keep_cycle(plane *s, const cycle *c, size_t from)
{
    const cycle copy = *c;
    memmove(s->cycles + 1, s->cycles, from * sizeof copy);
    s->cycles[0] = copy;
}

/* Raises F until the traced cycle is satisfiable. This cycle becomes the critical one, and is stored if it has at most
   MAX_EDGES edges. */
static void raise(plane *s, double *F)
{
    *F = fmax(closing(s, s->traced, s->n_traced, *F), *F * (1 + 1e-14));
    memcpy(s->critical, s->traced, s->n_traced * sizeof *s->traced);
    s->n_critical = s->n_traced;
    if (s->n_traced <= MAX_EDGES) {
        cycle c = {.n = s->n_traced};
        memcpy(c.edges, s->traced, c.n * sizeof *c.edges);
        keep_cycle(s, &c, CYCLES - 1);
    }
}

/* Sets node `to`, which is an X_i or a Y_j (see the top), to `value`, as its constraint with node `from` requires.
   Returns false if `to` is among the causes of `from`: these constraints cannot all hold, and s->traced has them. */
static bool set(plane *s, uint32_t from, uint32_t to, double value)
{
    if (s->stamps[to] == s->stamp) {
        trace(s, from, to);
        return false;
    }
    s->v[to] = value;
    s->rounded[to] = (float)value;
    s->cause[to] = from;
    push(s, to);
    return true;
}

/* Searches the nodes others .. others + count - 1 for those that have a constraint with `node` that may be violated
   at F. s->found receives their offsets from `others`. Returns the number of nodes found. */
static size_t far(const plane *s, size_t count, const int16_t *counts, size_t others, uint32_t node, double F)
{
    const float sign = node < s->side ? -1 : 1, rounding = (float)s->n * 0x1p-21F;
    return koksma__kernels()->far_corners(count, counts, s->rounded + others, sign, sign * s->rounded[node],
                                          (float)F - rounding, s->found);
}

/* Moves all nodes that have a violated constraint with the given node. Returns false if this finds a violated
   cycle. */
static bool relax(plane *s, uint32_t node, double F)
{
    const size_t side = s->side;
    const bool x = node < side;
    const uint32_t at = x ? node : node - (uint32_t)side, last = (uint32_t)side - 1;
    const double value = s->v[node];
    const uint32_t outer = x ? last + (uint32_t)side : last, next = x ? node + 1 : node - 1;
    s->stamp++;
    for (uint32_t n = node; n != NONE; n = s->cause[n]) {
        s->stamps[n] = s->stamp;
    }
    if (at == last) {
        const double other = (double)s->n / value;
        if ((x ? s->v[outer] - other : other - s->v[outer]) > 1e-14 * other && !set(s, node, outer, other)) {
            return false;
        }
    }
    if (at != (x ? last : 0) && (x ? s->v[next] < value : s->v[next] > value) && !set(s, node, next, value)) {
        return false;
    }
    const int16_t *counts = x ? s->counts + at * s->stride : s->turned + (at + 1) * s->stride + 1;
    const uint32_t others = x ? (uint32_t)side : 0;
    const size_t found = far(s, side, counts, others, node, F);
    for (size_t k = 0; k < found; k++) {
        const uint32_t other = others + s->found[k];
        const double count = counts[s->found[k]], volume = s->v[other] * value;
        if ((x ? volume - count : count - volume) > F + TOLERANCE &&
            !set(s, node, other, (count + (x ? F : -F)) / value)) {
            return false;
        }
    }
    s->work += (double)side + 32;
    return true;
}

/* Returns whether the run, which is asked from time to time, wants the search to end. */
static bool stopped(plane *s)
{
    if (s->work >= s->asked + KOKSMA__ASKED) {
        s->asked = s->work;
        s->stopped = s->stopped || !koksma__keep_going(s->run, 0);
    }
    return s->stopped;
}

/* Processes the queue until no constraint is violated. A violated cycle raises F; returns false if F rises above
   `limit`, or if the run wants the search to end. */
static bool settle(plane *s, double *F, double limit)
{
    const size_t nodes = 2 * s->side;
    while (s->waiting) {
        const uint32_t node = s->queue[s->first];
        s->first = (s->first + 1) % nodes;
        s->waiting--;
        s->queued[node] = 0;
        if (stopped(s)) {
            return false;
        }
        if (!relax(s, node, *F)) {
            raise(s, F);
            if (*F > limit) {
                return false;
            }
            memset(s->cause, 0xff, nodes * sizeof *s->cause);
            push(s, node);
        }
    }
    return true;
}

/* Satisfies all constraints at F. A violated cycle raises F; returns false if F rises above `limit`. */
static bool settle_all(plane *s, double *F, double limit)
{
    clear(s);
    for (uint32_t node = 0; node < 2 * s->side; node++) {
        push(s, node);
    }
    return settle(s, F, limit);
}

/* Returns a lower bound of the least F of the permutation: the least F at which all stored cycles are satisfiable. The
   cycle that requires this F becomes the critical one. */
static double estimate(plane *s)
{
    double F = 0;
    for (size_t c = 0; c < CYCLES; c++) {
        const cycle *kept = &s->cycles[c];
        if (violated(s, kept->edges, kept->n, F, NULL)) {
            F = closing(s, kept->edges, kept->n, F);
            memcpy(s->critical, kept->edges, kept->n * sizeof(edge));
            s->n_critical = kept->n;
        }
    }
    return F;
}

/* Computes the least F of the permutation, starting the search at `guess`. Returns false if it is above `limit`. */
static bool solve(plane *s, double *F, double guess, double limit)
{
    for (;; guess *= 0.985) {
        double least = fmax(estimate(s), guess);
        const bool known = least > guess;
        s->n_critical = known ? s->n_critical : 0;
        if (!settle_all(s, &least, limit)) {
            return false;
        }
        if (s->n_critical) {
            *F = least;
            return true;
        }
    }
}

/* Returns whether a rank is among the first `reach` ranks above j or, if `above` is false, among the last `reach` ranks
   up to j. */
static bool beside(size_t rank, size_t j, size_t reach, bool above)
{
    return above ? rank > j && rank <= j + reach : rank <= j && rank + reach > j;
}

/* Returns a random integer from 1 to `most`, distributed about log-uniformly. */
static size_t log_uniform(koksma__stream *random, size_t most)
{
    int bits = 0;
    while (most >> bits > 1) {
        bits++;
    }
    const size_t d = 1 + koksma__next_below(random, (size_t)1 << koksma__next_below(random, (size_t)bits + 1));
    return d < most ? d : most;
}

/* Draws a swap for a random corner of one of the guides or, if there are none, of the critical cycle. The swap lowers
   the count of a corner with too many points, or raises the count of a corner with too few. Returns false if it finds
   no swap. */
static bool draw_swap(plane *s, swap *w)
{
    const cycle *guide = s->guided ? &s->guides[koksma__next_below(&s->random, s->guided)] : NULL;
    const edge e = guide ? guide->edges[koksma__next_below(&s->random, guide->n)]
                         : s->critical[koksma__next_below(&s->random, s->n_critical)];
    const size_t n = s->n, i = e.i, j = e.j;
    if (i == 0 || i >= n || j == 0 || j >= n) {
        return false;
    }
    const bool many = e.sign > 0;
    /* half of the swaps take points within about sqrt(n) ranks of the corner, the others take any points */
    const size_t reach = koksma__next(&s->random) % 2 ? (size_t)sqrt((double)n) : n;
    const size_t before = log_uniform(&s->random, i < reach ? i : reach),
                 after = log_uniform(&s->random, n - i < reach ? n - i : reach);
    size_t a = i + 1 - before, b = i + after;
    for (size_t left = reach; left && a && !beside(s->rank[a], j, reach, !many); left--) {
        a--;
    }
    for (size_t left = reach; left && b <= n && !beside(s->rank[b], j, reach, many); left--) {
        b++;
    }
    *w = (swap){a, b};
    return a > 0 && b <= n && beside(s->rank[a], j, reach, !many) && beside(s->rank[b], j, reach, many);
}

/* Returns whether a swap is refused: after it, more of the stored constraint cycles would be violated at the value
   `target` than now (one violated cycle is permitted), or any would be violated at the value `limit`. */
static bool refused(plane *s, double target, double limit, const swap *w)
{
    size_t count = 0;
    for (size_t c = 0; c < CYCLES && s->cycles[c].n; c++) {
        const edge *edges = s->cycles[c].edges;
        const size_t n = s->cycles[c].n;
        if (violated(s, edges, n, target, w) &&
            (++count > (s->conflicts ? s->conflicts : 1) || violated(s, edges, n, limit, w))) {
            keep_cycle(s, &s->cycles[c], c);
            return true;
        }
    }
    return false;
}

/* Counts the stored cycles that are violated at target, and draws the guides among them (reservoir sampling). */
static void find_conflicts(plane *s, double target)
{
    s->guided = s->conflicts = 0;
    for (size_t c = 0; c < CYCLES && s->cycles[c].n; c++) {
        if (violated(s, s->cycles[c].edges, s->cycles[c].n, target, NULL)) {
            const size_t seen = s->conflicts++, at = seen < GUIDES ? seen : koksma__next_below(&s->random, seen + 1);
            if (at < GUIDES) {
                s->guides[at] = s->cycles[c];
            }
            s->guided += seen < GUIDES;
        }
    }
}

static void round_all(plane *s)
{
    for (size_t k = 0; k < 2 * s->side; k++) {
        s->rounded[k] = (float)s->v[k];
    }
}

/* Queues the nodes of the constraints that an applied swap violates at F. */
static void push_violated(plane *s, swap w, double F)
{
    const size_t side = s->side, stride = s->stride, a = s->rank[w.a], b = s->rank[w.b];
    const bool fewer = a > b; /* true: the swap has lowered the counts */
    const size_t low = fewer ? b : a, high = fewer ? a : b;
    for (size_t k = fewer ? w.a : low; k < (fewer ? w.b : high); k++) {
        const int16_t *counts = fewer ? s->counts + k * stride + low : s->turned + k * stride + w.a;
        const uint32_t node = (uint32_t)(fewer ? k : side + k - 1);
        if (far(s, fewer ? high - low : w.b - w.a, counts, fewer ? side + low : w.a - 1, node, F)) {
            push(s, node);
        }
    }
}

/* Makes one or two swaps, unless F would exceed `limit` or more stored cycles would be violated at `target`. The
   coordinates satisfy the constraints at `limit` before and after the call. */
static bool move(plane *s, double target, double limit)
{
    swap w[2];
    const int n = koksma__next_unit(&s->random) < 0.3 ? 2 : 1;
    s->work += 100;
    if (!draw_swap(s, &w[0]) || (n == 1 && refused(s, target, limit, &w[0]))) {
        return false;
    }
    apply(s, w[0]);
    if (n == 2) {
        if (!draw_swap(s, &w[1]) || refused(s, target, limit, &w[1])) {
            apply(s, w[0]);
            return false;
        }
        apply(s, w[1]);
    }
    const size_t bytes = 2 * s->side * sizeof *s->v;
    memcpy(s->saved, s->v, bytes);
    clear(s);
    double at_limit = limit;
    for (int k = 0; k < n; k++) {
        push_violated(s, w[k], limit);
    }
    if (settle(s, &at_limit, limit)) {
        return true;
    }
    for (int k = n; k-- > 0;) {
        apply(s, w[k]);
    }
    memcpy(s->v, s->saved, bytes);
    round_all(s);
    return false;
}

/* Writes the current coordinates to points, scaled such that the square's side is 1. */
static void write_points(const plane *s, koksma_points *points)
{
    for (size_t i = 0; i < s->n; i++) {
        const double x = s->v[i] / s->v[s->n], y = s->v[s->side + s->rank[i + 1] - 1] / s->v[2 * s->side - 1];
        points->xs[2 * i] = fmin(x, 1 - 0x1p-53);
        points->xs[2 * i + 1] = fmin(y, 1 - 0x1p-53);
    }
}

/* Walks from the current permutation, whose least F is given. Each set with a value below *best is written to
   points. */
static void walk(plane *s, double F, double *best, koksma_points *points)
{
    const double threshold = F * width_of(s->n).threshold * koksma__next_unit(&s->random), below = 1 - 1e-7;
    double target = F * below;
    find_conflicts(s, target);
    for (size_t m = 0; m < PATIENCE && s->work < s->budget && !stopped(s); m++) {
        const double limit = target / below + threshold;
        if (!move(s, target, limit)) {
            continue;
        }
        s->work += 500;
        find_conflicts(s, target);
        if (s->conflicts) {
            continue;
        }
        double to;
        if (!solve(s, &to, target, limit)) {
            break; /* F equals the limit up to rounding */
        }
        if (to < target) {
            m = 0;
            target = to * below;
            if (to < *best) {
                *best = to;
                write_points(s, points);
            }
        }
        find_conflicts(s, target);
    }
    s->guided = 0;
}

/* Sets the permutation, its counts and the coordinates X and Y from given points in the unit square. */
static koksma_status take_points(plane *s, const double *xs, uint32_t *order)
{
    const koksma_run run = {.threads = 1};
    const size_t n = s->n;
    for (size_t k = 2; k-- > 0;) { /* y, then x */
        const koksma_status status = koksma__order(&run, n, xs + k, 2, order);
        if (status) {
            return status;
        }
        for (size_t i = 0; i < n; i++) {
            const double value = fmax(xs[2 * order[i] + k], 0.25 / (double)n);
            s->v[k * s->side + i] = k ? value : value * (double)n;
            (k ? s->at : s->rank)[i + 1] = order[i];
        }
    }
    s->v[n] = (double)n;
    s->v[2 * s->side - 1] = 1;
    for (size_t j = 1; j <= n; j++) {
        order[s->at[j]] = (uint32_t)j; /* the rank by y of each point */
    }
    for (size_t i = 1; i <= n; i++) {
        s->rank[i] = order[s->rank[i]];
    }
    round_all(s);
    count_all(s);
    return KOKSMA_OK;
}

/* Draws the points (i, {i a + s}), where a has random small partial quotients. */
static void draw_start(plane *s, double *xs)
{
    koksma__stream *random = &s->random;
    double a = koksma__next_unit(random);
    const double ones = 0.6 + 0.35 * koksma__next_unit(random); /* the share of partial quotients that are 1 */
    for (int k = 0; k < 24; k++) {
        double quotient = 1;
        while (quotient < 20 && koksma__next_unit(random) > ones) {
            quotient++;
        }
        a = 1 / (quotient + a);
    }
    const double shift = koksma__next_unit(random);
    for (size_t i = 0; i < s->n; i++) {
        const double y = (double)i * a + shift;
        xs[2 * i] = ((double)i + 0.5) / (double)s->n;
        xs[2 * i + 1] = y - floor(y);
    }
}

static koksma_status search(const koksma_spec *measure, const koksma_optimise_options *o, uint64_t seed, double value,
                            const koksma_run *run, koksma_points *points)
{
    (void)measure, (void)o;
    const size_t n = points->n;
    plane s;
    koksma_status status = plane_init(&s, n, seed, run);
    double *xs = status ? NULL : malloc(2 * n * sizeof *xs + n * sizeof(uint32_t));
    uint32_t *order = (uint32_t *)(xs + (xs ? 2 * n : 0));
    if (!status && !xs) {
        status = koksma__fail_memory(3 * n * sizeof *xs);
    }
    const width wide = width_of(n);
    /* a walk starts from a random set only if its F is at most this multiple of the best F */
    const double accepted = 1.01 + wide.accepted * koksma__next_unit(&s.random) + 1 / (double)n;
    const bool again = koksma__next_unit(&s.random) < wide.again;
    double best = value * (double)n * (1 + 1e-9), F;
    while (!status && s.work < s.budget && !stopped(&s)) {
        if (again) {
            memcpy(xs, points->xs, 2 * n * sizeof *xs);
        } else {
            draw_start(&s, xs);
        }
        status = take_points(&s, xs, order);
        double limit = (again ? 1 : accepted) * best;
        if (!status && settle_all(&s, &limit, limit) && solve(&s, &F, 0.98 * limit, limit)) {
            if (F < best) {
                best = F;
                write_points(&s, points);
            }
            walk(&s, F, &best, points);
        }
    }
    if (s.stopped) {
        status = koksma__fail_interrupted();
    }
    free(xs);
    free(s.memory);
    return status;
}

static int serves(const koksma_spec *measure, const koksma_optimise_options *o)
{
    return measure->measure == &koksma__measure_star && !(measure->params[0] > 0) && o->dim == 2 && o->n <= MAX_N &&
                   o->keep == KOKSMA_KEEP_NONE && !o->n_projections
               ? 10
               : 0;
}

const koksma_method koksma__method_star_plane = {
    .name = "star-plane",
    .title = "permutations with exact coordinates by difference constraints (star, 2D)",
    .cite = "clement2023 dueck1993",
    .serves = serves,
    .search = search,
};

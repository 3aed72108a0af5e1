/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The discrepancy of half-planes by a rotational sweep about each point, O(n^2 log n).
 *
 * While a half-plane moves without its border passing a point, its count is constant and its area changes, until the
 * border touches points. So the supremum is reached by a line through two points, or through one point that bisects
 * the chord of the line (where the area is stationary as the line turns). Each point is the pivot once. The
 * directions from the pivot to the other points are turned into the upper half-plane and sorted by angle; they are
 * called rays:
 *
 *            \   c  /
 *             \    /   b
 *              \  /  .'
 *     ----------o------- a
 *
 * The line turns counter-clockwise about the pivot o and passes a, b and c. A point of the upper half-plane leaves
 * the left side of the line as the line passes it. A point of the lower half-plane, whose direction was turned up
 * (flipped), enters the left side. So the count is updated in O(1) for each ray; the area on one side is a closed
 * form of the line. Points at the same angle are passed together. At each angle the closed half-plane, with the
 * points on the line, is tried for the excess, and the open one, without them, for the deficit. Sorting uses a key in
 * doubles; nearly equal keys are ordered by the exact sign of the cross product (orientation.c), so that collinear
 * points are recognised. Threads work on blocks of pivots. If the deadline passes, the remaining pivots are skipped,
 * and the value is a lower bound. See measures/edge.c.
 */
#include "measures/edge/edge.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/shared/shared.h"

enum { PIVOTS_PER_BLOCK = 16, DIGIT = 11 };

/* The direction from the pivot to another point, turned into the upper half-plane; `key` increases with its angle. */
typedef struct ray {
    double key, dx, dy;
    uint32_t index;
    bool flipped;
} ray;

/* The best line so far, through point `pivot` along (dx, dy). other: the second point on the line, or n + c if the
   line is chord c of the pivot. */
typedef struct best_line {
    double value;
    size_t pivot, other;
    double dx, dy;
    bool closed;
} best_line;

typedef struct pivots {
    const koksma__domain *domain;
    const double *xs;
    size_t n;
    best_line *best; /* the best line of each block of pivots */
    double deadline_s;
    atomic_bool late; /* the deadline passed before all pivots were tried */
} pivots;

/* Turns a direction, given as exact differences, into the upper half-plane. */
static void turn_up(koksma__chord *c)
{
    if (c->up[0] < c->up[1] || (c->up[0] == c->up[1] && c->across[0] < c->across[1])) {
        double swap = c->up[0];
        c->up[0] = c->up[1];
        c->up[1] = swap;
        swap = c->across[0];
        c->across[0] = c->across[1];
        c->across[1] = swap;
    }
}

/* Returns the exact sign of the cross product of rays a and b of the pivot p, which is positive if a has the smaller
   angle. */
static int turn(const double *xs, const double p[2], const ray *a, const ray *b)
{
    const double *u = xs + 2 * (size_t)a->index, *v = xs + 2 * (size_t)b->index;
    const double ux[2] = {u[0], p[0]}, uy[2] = {u[1], p[1]}, vx[2] = {v[0], p[0]}, vy[2] = {v[1], p[1]};
    const int sign = koksma__sign_of_cross(ux, vy, uy, vx);
    return a->flipped == b->flipped ? sign : -sign;
}

/* Does one stable pass of a radix sort by the DIGIT bits that begin at bit `shift`. */
static void sort_digit(const uint64_t *from, uint64_t *to, size_t n, int shift)
{
    uint32_t start[1 << DIGIT] = {0}, total = 0;
    for (size_t i = 0; i < n; i++) {
        start[from[i] >> shift & ((1 << DIGIT) - 1)]++;
    }
    for (size_t d = 0; d < 1 << DIGIT; d++) {
        const uint32_t count = start[d];
        start[d] = total;
        total += count;
    }
    for (size_t i = 0; i < n; i++) {
        to[start[from[i] >> shift & ((1 << DIGIT) - 1)]++] = from[i];
    }
}

static void merge_sort(ray *rays, ray *spare, size_t n)
{
    if (n > 1) {
        const size_t half = n / 2;
        merge_sort(rays, spare, half);
        merge_sort(rays + half, spare, n - half);
        memcpy(spare, rays, half * sizeof *rays);
        for (size_t i = 0, l = 0, r = half; l < half; i++) {
            rays[i] = r < n && rays[r].key < spare[l].key ? rays[r++] : spare[l++];
        }
    }
}

/* Sorts rays stably by key: first a radix sort of the keys rounded to 32 bits, then an insertion sort. If insertion
   takes more than 4n moves, for example because many points lie in almost the same direction, a merge sort replaces
   it. */
static void sort_rays(ray *rays, ray *spare, uint64_t *items, size_t n)
{
    size_t moves = 0;
    for (size_t i = 0; i < n; i++) {
        items[i] = (uint64_t)((rays[i].key + 1) * 0x1.fffffffep30) << 32 | i;
    }
    sort_digit(items, items + n, n, 32);
    sort_digit(items + n, items, n, 32 + DIGIT);
    sort_digit(items, items + n, n, 32 + 2 * DIGIT);
    for (size_t i = 0; i < n; i++) {
        spare[i] = rays[(uint32_t)items[n + i]];
    }
    for (size_t i = 0; i < n; i++) {
        const ray moving = spare[i];
        size_t j = i;
        for (; j > 0 && rays[j - 1].key > moving.key; j--, moves++) {
            rays[j] = rays[j - 1];
        }
        rays[j] = moving;
        if (moves > 4 * n) {
            memcpy(rays + i + 1, spare + i + 1, (n - i - 1) * sizeof *rays);
            merge_sort(rays, spare, n);
            return;
        }
    }
}

/* Keys have errors of about 1e-15, so rays with keys closer than 4e-15 are put in order by exact arithmetic. */
static void settle_order(const double *xs, const double p[2], ray *rays, size_t n)
{
    for (size_t i = 1; i < n; i++) {
        const ray moving = rays[i];
        size_t j = i;
        for (; j > 0 && moving.key - rays[j - 1].key < 4e-15 && turn(xs, p, &moving, &rays[j - 1]) > 0; j--) {
            rays[j] = rays[j - 1];
        }
        rays[j] = moving;
    }
}

static void consider(const pivots *job, best_line *best, size_t left_open, size_t left_closed, best_line line)
{
    /* the half-plane is the left side of (dx, dy), where -dy x + dx y >= -dy p[0] + dx p[1] */
    const double *p = job->xs + 2 * line.pivot, n = (double)job->n;
    const double area = job->domain->area_below_through(line.dy, -line.dx, p);
    const double excess = (double)left_closed / n - area, deficit = area - (double)left_open / n;
    line.closed = excess >= deficit;
    line.value = line.closed ? excess : deficit;
    if (line.value > best->value) {
        *best = line;
    }
}

/* Returns the sign of the angle from a chord of the pivot p to a ray, which is positive if the chord comes first. */
static int chord_turn(const double *xs, const double p[2], const koksma__chord *c, const ray *r)
{
    const double *v = xs + 2 * (size_t)r->index, vx[2] = {v[0], p[0]}, vy[2] = {v[1], p[1]};
    const int sign = koksma__sign_of_cross(c->across, vy, c->up, vx);
    return r->flipped ? -sign : sign;
}

/* Tries the chords that come before ray r, or all remaining ones if r is NULL. A chord along r is removed, because
   the caller tries the line of r itself. */
static void try_chords(const pivots *job, size_t pivot, koksma__chord chords[KOKSMA__MAX_CHORDS], const ray *r,
                       size_t left, size_t same, best_line *best)
{
    for (int c = 0; c < KOKSMA__MAX_CHORDS; c++) {
        const double dx = chords[c].across[0] - chords[c].across[1], dy = chords[c].up[0] - chords[c].up[1];
        if (dx == 0 && dy == 0) {
            continue;
        }
        const int order = r ? chord_turn(job->xs, job->xs + 2 * pivot, &chords[c], r) : 1;
        if (order >= 0) {
            if (order > 0) {
                consider(job, best, left, left + same,
                         (best_line){.pivot = pivot, .other = job->n + (size_t)c, .dx = dx, .dy = dy});
            }
            chords[c] = (koksma__chord){{0}, {0}};
        }
    }
}

/* Turns the line from angle 0 to pi past all `count` rays. left: the number of points on its left at angle 0. The
   other n - count points coincide with the pivot. */
static void turn_line(const pivots *job, size_t pivot, const ray *rays, size_t count, size_t left, best_line *best)
{
    const double *p = job->xs + 2 * pivot;
    const size_t same = job->n - count;
    koksma__chord chords[KOKSMA__MAX_CHORDS] = {0};
    job->domain->chords(p, chords);
    for (int c = 0; c < KOKSMA__MAX_CHORDS; c++) {
        turn_up(&chords[c]);
    }
    for (size_t i = 0; i < count;) {
        try_chords(job, pivot, chords, &rays[i], left, same, best);
        size_t end = i, unflipped = 0;
        while (end < count &&
               (end == i || (rays[end].key - rays[i].key < 4e-15 && turn(job->xs, p, &rays[i], &rays[end]) == 0))) {
            unflipped += !rays[end++].flipped;
        }
        const size_t flipped = end - i - unflipped;
        consider(job, best, left - unflipped, left + flipped + same,
                 (best_line){.pivot = pivot, .other = rays[i].index, .dx = rays[i].dx, .dy = rays[i].dy});
        left += flipped;
        left -= unflipped;
        i = end;
    }
    try_chords(job, pivot, chords, NULL, left, same, best);
}

static void try_pivot(const pivots *job, size_t pivot, ray *rays, best_line *best)
{
    const double *xs = job->xs, *p = xs + 2 * pivot;
    size_t count = 0, left = 0;
    for (size_t j = 0; j < job->n; j++) {
        const double dx = xs[2 * j] - p[0], dy = xs[2 * j + 1] - p[1];
        const bool flipped = dy < 0 || (dy == 0 && dx < 0);
        const double x = flipped ? -dx : dx, y = flipped ? -dy : dy;
        rays[count] = (ray){-x / (fabs(x) + y), x, y, (uint32_t)j, flipped};
        const bool apart = dx != 0 || dy != 0;
        left += apart && !flipped;
        count += apart;
    }
    sort_rays(rays, rays + job->n, (uint64_t *)(rays + 2 * job->n), count);
    settle_order(xs, p, rays, count);
    turn_line(job, pivot, rays, count, left, best);
}

static koksma_status try_block(void *context, size_t block)
{
    pivots *job = context;
    job->best[block] = (best_line){.value = -1};
    if (block > 0 && atomic_load(&job->late)) {
        return KOKSMA_OK;
    }
    const size_t bytes = 2 * job->n * (sizeof(ray) + sizeof(uint64_t));
    ray *rays = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(rays, bytes);
    const size_t first = block * PIVOTS_PER_BLOCK;
    best_line best = {.value = -1};
    for (size_t pivot = first; pivot < first + PIVOTS_PER_BLOCK && pivot < job->n; pivot++) {
        if (pivot > 0 && koksma__now_s() > job->deadline_s) { /* the first pivot is always tried */
            atomic_store(&job->late, true);
            break;
        }
        try_pivot(job, pivot, rays, &best);
    }
    job->best[block] = best;
    free(rays);
    return KOKSMA_OK;
}

/* Makes the witness, the half-plane a x + b y <= c on the left of the line. c is chosen so that comparisons in
   doubles put every point on the correct side. */
static void make_witness(const pivots *job, const best_line *line, koksma_value *out)
{
    const double size = fmax(fabs(line->dx), fabs(line->dy)), scale = size < 0x1p-400 ? 0x1p600 : 1;
    const double *p = job->xs + 2 * line->pivot, a = line->dy * scale, b = -line->dx * scale;
    koksma__chord chords[KOKSMA__MAX_CHORDS] = {0};
    job->domain->chords(p, chords);
    koksma_witness w = {.kind = KOKSMA_WITNESS_HALF_PLANE, .dim = 2, .closed = line->closed, .lo = {a, b}};
    double inner = -HUGE_VAL, outer = HUGE_VAL;
    for (size_t i = 0; i < job->n; i++) {
        const double *x = job->xs + 2 * i, vx[2] = {x[0], p[0]}, vy[2] = {x[1], p[1]};
        int side;
        if (line->other < job->n) {
            const double *q = job->xs + 2 * line->other, qx[2] = {q[0], p[0]}, qy[2] = {q[1], p[1]};
            side = koksma__sign_of_cross(qx, vy, qy, vx);
            side = q[1] < p[1] || (q[1] == p[1] && q[0] < p[0]) ? -side : side;
        } else {
            koksma__chord *c = &chords[line->other - job->n];
            turn_up(c);
            side = koksma__sign_of_cross(c->across, vy, c->up, vx);
        }
        const double here = a * x[0] + b * x[1];
        if (line->closed ? side >= 0 : side > 0) {
            w.count++;
            inner = fmax(inner, here);
        } else {
            outer = fmin(outer, here);
        }
    }
    w.volume = job->domain->area_below_through(a, b, p);
    w.hi[0] = line->closed ? inner : fmin(outer, a * p[0] + b * p[1]);
    out->value = line->value;
    out->witness = w;
}

/* Called after the deadline: computes an upper bound for all lines, and replaces the best line if this computation
   finds a better one. */
static koksma_status find_bound(const pivots *job, const koksma_run *run, double deadline_s, koksma_value *out)
{
    koksma__edge_line line = {.value = out->value};
    const koksma_status status =
        koksma__edge_cover(job->domain, job->n, job->xs, run, deadline_s, &line, &out->upper);
    if (!status && line.value > out->value) {
        out->value = line.value;
        out->witness = (koksma_witness){.kind = KOKSMA_WITNESS_HALF_PLANE,
                                        .dim = 2,
                                        .closed = line.closed,
                                        .count = line.count,
                                        .volume = line.mass,
                                        .lo = {line.a, line.b},
                                        .hi = {line.c}};
    }
    out->lower = out->value;
    out->exact = out->upper <= out->lower;
    return status;
}

koksma_status koksma__edge_sweep(const koksma__domain *domain, size_t n, const double *xs, const koksma_run *run,
                                 koksma_value *out)
{
    const size_t n_blocks = (n + PIVOTS_PER_BLOCK - 1) / PIVOTS_PER_BLOCK;
    const double end_s = koksma__deadline_s(run, 0.95);
    KOKSMA__FAIL_IF(n > UINT32_MAX / 2, KOKSMA_N, "edge: n = %zu: it takes fewer than 2^31 points", n);
    pivots job = {.domain = domain,
                  .xs = xs,
                  .n = n,
                  .best = malloc(n_blocks * sizeof *job.best),
                  .deadline_s = koksma__deadline_s(run, 0.5)};
    KOKSMA__REQUIRE_MEMORY(job.best, n_blocks * sizeof *job.best);
    koksma_status status = koksma__parallel(run, n_blocks, try_block, &job);
    if (!status) {
        best_line best = {.value = -1};
        for (size_t block = 0; block < n_blocks; block++) {
            best = job.best[block].value > best.value ? job.best[block] : best;
        }
        out->value = -1;
        if (best.value >= 0) {
            make_witness(&job, &best, out);
        }
        status = atomic_load(&job.late) ? find_bound(&job, run, end_s, out) : KOKSMA_OK;
    }
    free(job.best);
    return status;
}

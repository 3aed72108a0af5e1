/* SPDX-License-Identifier: Apache-2.0 */
/*
 * edge: the largest difference, over all half-planes, between the share of points in the half-plane and its area of
 * the unit square. The quantity that the second paper announces as David Dobkin's: how badly an edge through a pixel
 * can come out.
 *
 * Formula: sup over half-planes H of |#{x_i in H}/n - area of H in the square|. Turning a line about a point changes
 * the area on a side by (r1^2 - r2^2)/2 per radian, r1 and r2 being its lengths to either side. So the supremum is
 * reached on a line through two points, on the line through a point that this point bisects (it cuts the triangle of
 * area 2uv off a corner at distances u and v), or on a side. Closed half-planes for excess, open ones for deficit.
 * Source: Mitchell 1992, section 5; Dobkin and Eppstein 1993; Dobkin, Eppstein and Mitchell 1996. Here each point is
 * a pivot, about which a line turns past the others in order of angle: O(n^2 log n). Known exactly: one point
 * (1/2,1/2) 1/2, (1/4,1/4) 7/8, (0,0) 1; m x m cell centres 1/(2m). Limits: order and ties of angles are exact for
 * all doubles; areas are rounded: errors of a few 1e-16.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/measures.h"
#include "measures/parts/lines.h"
#include "measures/parts/orientation.h"

enum { PIVOTS_PER_BLOCK = 16, RUN = 8 };

/* Another point as the pivot sees it. key grows with the angle of (dx, dy) turned into the upper half-plane. */
typedef struct ray {
    double key, dx, dy;
    uint32_t index;
    bool flipped;
} ray;

/* The best line so far: through point `pivot` along (dx, dy); other = n for the bisected chord. */
typedef struct best_line {
    double value;
    size_t pivot, other;
    double dx, dy;
    bool closed;
} best_line;

typedef struct pivots {
    const double *xs;
    size_t n;
    best_line *best; /* one a block */
} pivots;

/* The direction of the chord that p bisects, as two exact differences: (e0 - p0, p1 - e1), e the nearest corner. */
static void chord(const double p[2], double across[2], double up[2])
{
    across[0] = p[0] < 0.5 ? 0 : 1;
    across[1] = p[0];
    up[0] = p[1];
    up[1] = p[1] < 0.5 ? 0 : 1;
    if (up[0] < up[1] || (up[0] == up[1] && across[0] < across[1])) { /* into the upper half-plane */
        double swap = up[0];
        up[0] = up[1];
        up[1] = swap;
        swap = across[0];
        across[0] = across[1];
        across[1] = swap;
    }
}

/* The exact sign of the cross product of two rays of p, both turned into the upper half-plane: > 0 if a comes first.
 */
static int turn(const double *xs, const double p[2], const ray *a, const ray *b)
{
    const double *u = xs + 2 * (size_t)a->index, *v = xs + 2 * (size_t)b->index;
    const double ux[2] = {u[0], p[0]}, uy[2] = {u[1], p[1]}, vx[2] = {v[0], p[0]}, vy[2] = {v[1], p[1]};
    const int sign = koksma__sign_of_cross(ux, vy, uy, vx);
    return a->flipped == b->flipped ? sign : -sign;
}

static void sort_rays(ray *rays, ray *spare, size_t n)
{
    for (size_t first = 0; first < n; first += RUN) {
        const size_t end = first + RUN < n ? first + RUN : n;
        for (size_t i = first + 1; i < end; i++) {
            const ray moving = rays[i];
            size_t j = i;
            for (; j > first && rays[j - 1].key > moving.key; j--) {
                rays[j] = rays[j - 1];
            }
            rays[j] = moving;
        }
    }
    ray *from = rays, *to = spare;
    for (size_t width = RUN; width < n; width *= 2) {
        for (size_t first = 0; first < n; first += 2 * width) {
            const size_t middle = first + width < n ? first + width : n;
            const size_t end = first + 2 * width < n ? first + 2 * width : n;
            size_t l = first, r = middle;
            for (size_t i = first; i < end; i++) {
                const bool left = r >= end || (l < middle && from[l].key <= from[r].key);
                to[i] = left ? from[l] : from[r];
                l += left;
                r += !left;
            }
        }
        ray *const swap = from;
        from = to;
        to = swap;
    }
    for (size_t i = 0; from != rays && i < n; i++) {
        rays[i] = from[i];
    }
}

/* Keys are good to about 1e-15: neighbours that are closer are put in order exactly. */
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

static void consider(best_line *best, size_t n, size_t left_open, size_t left_closed, const double p[2],
                     best_line line)
{
    /* the left side of (dx, dy): -dy x + dx y >= .. */
    const double area = koksma__area_below_through(line.dy, -line.dx, p);
    const double excess = (double)left_closed / (double)n - area, deficit = area - (double)left_open / (double)n;
    line.closed = excess >= deficit;
    line.value = line.closed ? excess : deficit;
    if (line.value > best->value) {
        *best = line;
    }
}

/* How the chord of p lies to a ray: > 0 if the chord comes first. */
static int chord_turn(const double *xs, const double p[2], const double across[2], const double up[2], const ray *r)
{
    const double *v = xs + 2 * (size_t)r->index, vx[2] = {v[0], p[0]}, vy[2] = {v[1], p[1]};
    const int sign = koksma__sign_of_cross(across, vy, up, vx);
    return r->flipped ? -sign : sign;
}

/* Turns the line from angle 0 to pi past all rays; left: points on its left, same: those at the pivot. */
static void turn_line(const pivots *job, size_t pivot, const ray *rays, size_t count, size_t left, best_line *best)
{
    const double *p = job->xs + 2 * pivot;
    const size_t n = job->n, same = n - count;
    double across[2], up[2];
    chord(p, across, up);
    const best_line bisected = {.pivot = pivot, .other = n, .dx = across[0] - across[1], .dy = up[0] - up[1]};
    bool chord_left = bisected.dx != 0 || bisected.dy != 0;
    for (size_t i = 0; i < count;) {
        if (chord_left) {
            const int order = chord_turn(job->xs, p, across, up, &rays[i]);
            if (order > 0) {
                consider(best, n, left, left + same, p, bisected);
            }
            chord_left = order < 0;
        }
        size_t end = i, unflipped = 0;
        while (end < count &&
               (end == i || (rays[end].key - rays[i].key < 4e-15 && turn(job->xs, p, &rays[i], &rays[end]) == 0))) {
            unflipped += !rays[end++].flipped;
        }
        const size_t flipped = end - i - unflipped;
        consider(best, n, left - unflipped, left + flipped + same, p,
                 (best_line){.pivot = pivot, .other = rays[i].index, .dx = rays[i].dx, .dy = rays[i].dy});
        left += flipped;
        left -= unflipped;
        i = end;
    }
    if (chord_left) {
        consider(best, n, left, left + same, p, bisected);
    }
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
    sort_rays(rays, rays + job->n, count);
    settle_order(xs, p, rays, count);
    turn_line(job, pivot, rays, count, left, best);
}

static koksma_status try_block(void *context, size_t block)
{
    const pivots *job = context;
    ray *rays = malloc(2 * job->n * sizeof *rays);
    if (!rays) {
        return koksma__fail_memory(2 * job->n * sizeof *rays);
    }
    const size_t first = block * PIVOTS_PER_BLOCK;
    best_line best = {.value = -1};
    for (size_t pivot = first; pivot < first + PIVOTS_PER_BLOCK && pivot < job->n; pivot++) {
        try_pivot(job, pivot, rays, &best);
    }
    job->best[block] = best;
    free(rays);
    return KOKSMA_OK;
}

/* Lines along the sides: the points on a side in no area. */
static void try_sides(const koksma_points *points, koksma_value *out)
{
    static const double sides[4][3] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, -1}, {0, -1, -1}};
    for (int s = 0; s < 4; s++) {
        size_t count = 0;
        for (size_t i = 0; i < points->n; i++) {
            count += points->xs[2 * i + (size_t)(s % 2)] == (s < 2 ? 0 : 1);
        }
        const double value = (double)count / (double)points->n;
        if (count > 0 && value > out->value) {
            out->value = value;
            out->witness = (koksma_witness){.kind = KOKSMA_WITNESS_HALF_PLANE,
                                            .dim = 2,
                                            .closed = true,
                                            .count = count,
                                            .lo = {sides[s][0], sides[s][1]},
                                            .hi = {sides[s][2]}};
        }
    }
}

/* The half-plane a x + b y <= c on the left of the line. c is set so that comparing in doubles counts right. */
static void make_witness(const pivots *job, const best_line *line, koksma_value *out)
{
    const double *p = job->xs + 2 * line->pivot, a = line->dy, b = -line->dx;
    double across[2], up[2];
    chord(p, across, up);
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
            side = koksma__sign_of_cross(across, vy, up, vx);
        }
        const double here = a * x[0] + b * x[1];
        if (line->closed ? side >= 0 : side > 0) {
            w.count++;
            inner = fmax(inner, here);
        } else {
            outer = fmin(outer, here);
        }
    }
    w.volume = koksma__area_below_through(a, b, p);
    w.hi[0] = line->closed ? inner : fmin(outer, a * p[0] + b * p[1]);
    out->value = line->value;
    out->witness = w;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const size_t n = points->n, n_blocks = (n + PIVOTS_PER_BLOCK - 1) / PIVOTS_PER_BLOCK;
    if (n > UINT32_MAX / 2) {
        return koksma__fail(KOKSMA_N, "edge: n = %zu: fewer than 2^31 points", n);
    }
    pivots job = {.xs = points->xs, .n = n, .best = malloc(n_blocks * sizeof *job.best)};
    if (!job.best) {
        return koksma__fail_memory(n_blocks * sizeof *job.best);
    }
    const koksma_status status = koksma__parallel(args->run, n_blocks, try_block, &job);
    if (!status) {
        best_line best = {.value = -1};
        for (size_t block = 0; block < n_blocks; block++) {
            best = job.best[block].value > best.value ? job.best[block] : best;
        }
        out->value = -1;
        if (best.value >= 0) {
            make_witness(&job, &best, out);
        }
        try_sides(points, out);
    }
    free(job.best);
    return status;
}

const koksma_measure koksma__measure_edge = {
    .name = "edge",
    .title = "L-infinity discrepancy of half-planes",
    .cite = "mitchell1992 dobkin1993 dobkin1996",
    .cost = "n^2 log n",
    .min_dim = 2,
    .max_dim = 2,
    .eval = eval,
};

/* SPDX-License-Identifier: Apache-2.0 */
/* The star discrepancy of the plane and of the line. In the plane a line sweeps over the points in order of x. For
   each rank j by y the sweep keeps the number of points so far whose rank is below j, which gives the excess (rank <=
   j) and the deficit (rank < j) of the box to (x, y_j). Equal coordinates need no special case: a box that is
   evaluated before all its points are counted gives too small a value, but the sweep evaluates it again later. */
#include "measures/star/star.h"

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/shared/shared.h"

enum { CROSSOVER = 2000, POINTS_PER_BLOCK = 1 << 15 };

void koksma__star_keep(const koksma_points *points, const double *corner, bool closed, koksma_value *out)
{
    size_t count = 0;
    for (size_t i = 0; i < points->n; i++) {
        bool in = true;
        for (int k = 0; k < points->dim; k++) {
            const double x = points->xs[i * (size_t)points->dim + (size_t)k];
            in &= closed ? x <= corner[k] : x < corner[k];
        }
        count += in;
    }
    double volume = 1;
    for (int k = 0; k < points->dim; k++) {
        volume *= corner[k];
    }
    const double share = (double)count / (double)points->n, value = closed ? share - volume : volume - share;
    if (!(value <= out->value)) {
        out->value = value;
        out->witness = (koksma_witness){.dim = points->dim, .closed = closed, .count = count, .volume = volume};
        if (points->dim <= KOKSMA_WITNESS_DIM) {
            out->witness.kind = KOKSMA_WITNESS_BOX;
            for (int k = 0; k < points->dim; k++) {
                out->witness.hi[k] = corner[k];
            }
        }
    }
}

typedef struct sweep {
    double *x, *y, *count; /* arguments of the kernel star_sweep, with n, n + 8 and n + 9 numbers */
    uint32_t *order, *rank;
} sweep;

/* Returns the y of the best box whose x coordinate is that of index `at`, after counting the points again. */
static double best_y(size_t n, const sweep *s, size_t at, bool closed)
{
    const size_t used = closed ? at + 1 : at;
    const double scale = (double)n * (at < n ? s->x[at] : 1);
    size_t best_j = 0;
    double best = -INFINITY, below = 0;
    for (size_t j = 0; j <= n; j++) {
        s->count[j] = 0;
    }
    for (size_t i = 0; i < used; i++) {
        s->count[s->rank[i]]++;
    }
    for (size_t j = 0; j < n + !closed; j++) {
        const double up_to = below + s->count[j];
        const double value = closed ? up_to - scale * s->y[j] : scale * s->y[j] - below;
        if (value > best) {
            best = value;
            best_j = j;
        }
        below = up_to;
    }
    return s->y[best_j];
}

typedef struct preparation {
    const koksma_points *points;
    sweep *s;
} preparation;

static size_t end_of(const preparation *p, size_t block)
{
    const size_t end = (block + 1) * POINTS_PER_BLOCK;
    return end < p->points->n ? end : p->points->n;
}

/* Fills y from `order`, which has the order by y at this time. The ranks of the points are stored in `count` until
   `order` has the order by x. */
static koksma_status take_ys(void *context, size_t block)
{
    const preparation *p = context;
    for (size_t j = block * POINTS_PER_BLOCK; j < end_of(p, block); j++) {
        const size_t i = p->s->order[j];
        p->s->y[j] = p->points->xs[2 * i + 1];
        ((uint32_t *)p->s->count)[i] = (uint32_t)j;
    }
    return KOKSMA_OK;
}

static koksma_status take_xs(void *context, size_t block)
{
    const preparation *p = context;
    for (size_t i = block * POINTS_PER_BLOCK; i < end_of(p, block); i++) {
        p->s->x[i] = p->points->xs[2 * (size_t)p->s->order[i]];
        p->s->rank[i] = ((uint32_t *)p->s->count)[p->s->order[i]];
    }
    return KOKSMA_OK;
}

static koksma_status prepare(const koksma_points *points, const koksma_run *run, sweep *s)
{
    const size_t n = points->n, n_blocks = (n + POINTS_PER_BLOCK - 1) / POINTS_PER_BLOCK;
    preparation p = {points, s};
    koksma_status status = koksma__order(run, n, points->xs + 1, 2, s->order);
    status = status ? status : koksma__parallel(run, n_blocks, take_ys, &p);
    for (size_t j = n; j < n + 8; j++) {
        s->y[j] = 1;
    }
    status = status ? status : koksma__order(run, n, points->xs, 2, s->order);
    return status ? status : koksma__parallel(run, n_blocks, take_xs, &p);
}

koksma_status koksma__star_2d_by(bool kinetic, const koksma_points *points, const koksma_run *run, koksma_value *out)
{
    const size_t n = points->n, bytes = (3 * n + 17) * sizeof(double) + 2 * n * sizeof(uint32_t);
    double *memory = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(memory, bytes);
    sweep s = {.x = memory, .y = memory + n, .count = memory + 2 * n + 8};
    s.order = (uint32_t *)(memory + 3 * n + 17);
    s.rank = s.order + n;
    double best[2];
    size_t at[2];
    koksma__phases phases = {.share = 0};
    koksma_run phase = koksma__phase_run(&phases, run, 0);
    koksma_status status = prepare(points, &phase, &s);
    if (!status && kinetic) {
        phase = koksma__phase_run(&phases, run, 1);
        status = koksma__star_kinetic(n, s.x, s.rank, s.y, &phase, best, at);
    } else if (!status) {
        koksma__kernels()->star_sweep(n, s.x, s.rank, s.y, s.count, best, at);
    }
    for (int closed = 0; closed < 2 && !status; closed++) {
        const double corner[2] = {at[!closed] < n ? s.x[at[!closed]] : 1, best_y(n, &s, at[!closed], closed)};
        koksma__star_keep(points, corner, closed, out);
    }
    free(memory);
    return status;
}

/* Computes the star discrepancy on the line. With x_0 <= x_1 <= .. the largest excess is max (i + 1)/n - x_i, and the
   largest deficit is max x_i - i/n, or 0 at x = 1 (Niederreiter 1992, theorem 2.6). Among equal points the last one
   has the largest excess and the first one the largest deficit. */
static koksma_status star_line(const koksma_points *points, const koksma_run *run, koksma_value *out)
{
    const size_t n = points->n;
    uint32_t *order = malloc(n * sizeof *order);
    KOKSMA__REQUIRE_MEMORY(order, n * sizeof *order);
    const koksma_status status = koksma__order(run, n, points->xs, 1, order);
    double best[2] = {-INFINITY, -INFINITY}, ends[2] = {0};
    for (size_t i = 0; i < n && !status; i++) {
        const double x = points->xs[order[i]];
        const double values[2] = {x - (double)i / (double)n, (double)(i + 1) / (double)n - x};
        for (int closed = 0; closed < 2; closed++) {
            if (values[closed] > best[closed]) {
                best[closed] = values[closed];
                ends[closed] = x;
            }
        }
    }
    for (int closed = 0; closed < 2 && !status; closed++) {
        koksma__star_keep(points, &ends[closed], closed, out);
    }
    free(order);
    return status;
}

koksma_status koksma__star_2d(const koksma_points *points, const koksma_run *run, koksma_value *out)
{
    if (!koksma__keep_going(run, 0)) {
        return koksma__fail_interrupted();
    }
    return points->dim == 1 ? star_line(points, run, out)
                            : koksma__star_2d_by(points->n > CROSSOVER, points, run, out);
}

/* SPDX-License-Identifier: Apache-2.0 */
/* The star discrepancy of the plane: points are swept by x. For ranks j by y, the number of points so far of rank
   below j is all that an excess (rank <= j) and a deficit (rank < j) at (x, y_j) need. Equal coordinates need no
   special case: what is evaluated too early is too small, and the right box is visited as well. */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "measures/parts/order.h"
#include "measures/parts/star.h"

enum { CROSSOVER = 2000 };

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
    double *x, *y, *count; /* n, n + 1 and n + 1 numbers */
    uint32_t *order, *rank;
} sweep;

/* Which y the best box at x has. The counts are made anew. */
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

static koksma_status prepare(const koksma_points *points, const koksma_run *run, sweep *s)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    koksma_status status = KOKSMA_OK;
    if (dim == 2) {
        status = koksma__order(run, n, points->xs + 1, dim, s->order);
    }
    for (size_t j = 0; j < n && !status; j++) {
        const size_t i = dim == 2 ? s->order[j] : j;
        s->y[j] = dim == 2 ? points->xs[i * dim + 1] : 1;
        ((uint32_t *)s->count)[i] = (uint32_t)j; /* the rank by index, until it is ordered */
    }
    s->y[n] = 1;
    if (!status) {
        status = koksma__order(run, n, points->xs, dim, s->order);
    }
    for (size_t i = 0; i < n && !status; i++) {
        s->x[i] = points->xs[s->order[i] * dim];
        s->rank[i] = ((uint32_t *)s->count)[s->order[i]];
    }
    return status;
}

koksma_status koksma__star_2d_by(bool kinetic, const koksma_points *points, const koksma_run *run, koksma_value *out)
{
    const size_t n = points->n, bytes = (3 * n + 2) * sizeof(double) + 2 * n * sizeof(uint32_t);
    double *memory = malloc(bytes);
    if (!memory) {
        return koksma__fail_memory(bytes);
    }
    sweep s = {.x = memory, .y = memory + n, .count = memory + 2 * n + 1};
    s.order = (uint32_t *)(memory + 3 * n + 2);
    s.rank = s.order + n;
    double best[2];
    size_t at[2];
    koksma_status status = prepare(points, run, &s);
    if (!status && kinetic) {
        status = koksma__star_kinetic(n, s.x, s.rank, s.y, run, best, at);
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

koksma_status koksma__star_2d(const koksma_points *points, const koksma_run *run, koksma_value *out)
{
    if (!koksma__keep_going(run, 0)) {
        return koksma__fail_interrupted();
    }
    return koksma__star_2d_by(points->n > CROSSOVER, points, run, out);
}

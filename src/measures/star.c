/* SPDX-License-Identifier: Apache-2.0 */
/*
 * star: the largest difference, over all boxes with a corner at the origin, between the share of points in the box
 * and its volume. The first paper's D; the L-infinity star discrepancy.
 *
 * Formula: D = sup over y in [0,1]^d of |#{x_i in [0,y)}/n - prod_k y_k|. It is reached at a corner whose
 * coordinates are coordinates of points, or 1 (Niederreiter 1972): an excess at a closed box, a deficit at an open
 * one. Source: Zaremba 1968; Shirley 1991, section 5.5.7. Known exactly: one point at (g,g), g = (sqrt 5 - 1)/2, has
 * D = g; 4 x 4 cell centres 15/64; one point at the centre of the cube 7/8; Hammersley 2^m: n D = m/3 + 13/9 - (-1)^m
 * 4/(9 2^m) (De Clerck 1986). Limits: counts are exact, volumes are rounded products: errors of a few 1e-16 at any n.
 */
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/measures.h"

enum { MAX_N_3D = 4096 };

/* The points are swept by x; for every x the counts below every y are at hand. A third coordinate z is a loop over
   its levels around that. Missing coordinates have the one level 1 and are left out of the volume by it. */
typedef struct sweep {
    size_t n;
    int dim;
    double *points;    /* n x 3, sorted by x; missing coordinates are 0 */
    double *levels[3]; /* sorted coordinates, then 1 */
    size_t n_levels[3];
    size_t *closed, *open; /* by y level: points at or below it, points below it */
    koksma_value *out;
} sweep;

static int compare_first(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The first level that is >= value. */
static size_t rank_of(const double *levels, size_t count, double value)
{
    size_t low = 0, high = count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (levels[middle] < value) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static void keep(sweep *s, double value, bool closed, size_t count, const double *corner)
{
    koksma_witness *w = &s->out->witness;
    s->out->value = value;
    *w = (koksma_witness){.kind = KOKSMA_WITNESS_BOX, .dim = s->dim, .closed = closed, .count = count, .volume = 1};
    for (int k = 0; k < s->dim; k++) {
        w->hi[k] = corner[k];
        w->volume *= corner[k];
    }
}

static void evaluate(sweep *s, double x, double z, bool closed)
{
    const size_t *counts = closed ? s->closed : s->open;
    const double n = (double)s->n;
    for (size_t j = 0; j < s->n_levels[1]; j++) {
        const double volume = x * s->levels[1][j] * z;
        const double value = closed ? (double)counts[j] / n - volume : volume - (double)counts[j] / n;
        if (value > s->out->value) {
            keep(s, value, closed, counts[j], (double[]){x, s->levels[1][j], z});
        }
    }
}

/* All corners with this z. */
static void sweep_xy(sweep *s, double z)
{
    const size_t ny = s->n_levels[1];
    memset(s->closed, 0, ny * sizeof *s->closed);
    memset(s->open, 0, ny * sizeof *s->open);
    size_t next = 0;
    for (size_t level = 0; level < s->n_levels[0]; level++) {
        const double x = s->levels[0][level];
        evaluate(s, x, z, false);
        for (; next < s->n && s->points[3 * next] <= x; next++) {
            const double *p = s->points + 3 * next;
            const size_t rank = rank_of(s->levels[1], ny, p[1]);
            const size_t above = rank + (rank < ny && s->levels[1][rank] == p[1]);
            const bool z_closed = s->dim < 3 || p[2] <= z, z_open = s->dim < 3 || p[2] < z;
            for (size_t j = rank; z_closed && j < ny; j++) {
                s->closed[j]++;
            }
            for (size_t j = above; z_open && j < ny; j++) {
                s->open[j]++;
            }
        }
        evaluate(s, x, z, true);
    }
}

static size_t fill_levels(const sweep *s, int k, double *levels)
{
    size_t count = 0, kept = 0;
    for (size_t i = 0; k < s->dim && i < s->n; i++) {
        levels[count++] = s->points[3 * i + (size_t)k];
    }
    levels[count++] = 1;
    qsort(levels, count, sizeof *levels, compare_first);
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || levels[i] != levels[i - 1]) {
            levels[kept++] = levels[i];
        }
    }
    return kept;
}

static koksma_status run_sweep(sweep *s, const koksma_run *run)
{
    qsort(s->points, s->n, 3 * sizeof *s->points, compare_first);
    for (int k = 0; k < 3; k++) {
        s->n_levels[k] = fill_levels(s, k, s->levels[k]);
    }
    s->out->value = -1;
    for (size_t level = 0; level < s->n_levels[2]; level++) {
        if (!koksma__keep_going(run, (double)level / (double)s->n_levels[2])) {
            return koksma__fail_interrupted();
        }
        sweep_xy(s, s->levels[2][level]);
    }
    return KOKSMA_OK;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const size_t n = points->n;
    if (points->dim == 3 && n > MAX_N_3D) {
        return koksma__fail(KOKSMA_N, "star: n = %zu: up to %d points in 3D", n, MAX_N_3D);
    }
    sweep s = {.n = n, .dim = points->dim, .out = out};
    const size_t bytes = (3 * n + 3 * (n + 1)) * sizeof *s.points + 2 * (n + 1) * sizeof *s.closed;
    s.points = malloc(bytes);
    if (!s.points) {
        return koksma__fail_memory(bytes);
    }
    for (int k = 0; k < 3; k++) {
        s.levels[k] = s.points + 3 * n + (size_t)k * (n + 1);
    }
    s.closed = (size_t *)(s.points + 3 * n + 3 * (n + 1));
    s.open = s.closed + n + 1;
    for (size_t i = 0; i < n; i++) {
        for (int k = 0; k < 3; k++) {
            s.points[3 * i + (size_t)k] = k < points->dim ? points->xs[i * (size_t)points->dim + (size_t)k] : 0;
        }
    }
    const koksma_status status = run_sweep(&s, args->run);
    free(s.points);
    return status;
}

const koksma_measure koksma__measure_star = {
    .name = "star",
    .title = "L-infinity star discrepancy (anchored boxes)",
    .cite = "zaremba1968 niederreiter1972 shirley1991",
    .cost = "n^2 in 2D, n^3 in 3D",
    .min_dim = 1,
    .max_dim = 3,
    .eval = eval,
};

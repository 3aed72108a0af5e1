/* SPDX-License-Identifier: Apache-2.0 */
/*
 * extreme: the largest difference, over all axis-parallel boxes, between the share of points in the box and its
 * volume. The first paper's T ("Stroud's discrepancy"), which turning the points by 90 degrees does not change.
 *
 * Formula: T = sup over boxes of |#{x_i in box}/n - volume|. An excess is reached at a closed box whose sides are
 * at coordinates of points, a deficit at an open box whose sides are at coordinates of points, 0 or 1. Points at
 * exactly 0 are outside an open box that starts at 0.
 * Source: Stroud 1971; Shirley 1991, section 5.5.7. With grid=20 it is the procedure behind his table 5.7: sides at
 * multiples of 1/20 only, half-open boxes. Inferred from his value for the regular grid, 0.3600 where the supremum
 * is 0.4375.
 * Known exactly: 4 x 4 cell centres T = 7/16, with grid=20 0.36; a single point T = 1.
 * Limits: counts are exact, volumes are rounded products: errors of a few 1e-16.
 */
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/measures.h"
#include "measures/parts/extreme_grid.h"

enum { MAX_N_2D = 4096, MAX_N_3D = 128 };

/* Boxes are chosen side by side from the last coordinate to the second; the points that are left at each depth are
   kept sorted by the first, along which one pass finds the best interval. */
typedef struct search {
    size_t n;
    int dim;
    double *lists[3];  /* lists[k]: points that are left when coordinates above k are chosen; dim numbers each */
    double *levels[3]; /* sorted coordinates of all points, without repeats; for deficits with 0 and 1 */
    size_t n_levels[3];
    double lo[3], hi[3];
    const koksma_run *run;
    bool stopped;
    koksma_value *out;
} search;

static int compare_first(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void keep(search *s, double value, bool closed, size_t count, double volume)
{
    koksma_witness *w = &s->out->witness;
    if (value <= s->out->value) {
        return;
    }
    s->out->value = value;
    *w = (koksma_witness){
        .kind = KOKSMA_WITNESS_BOX, .dim = s->dim, .closed = closed, .count = count, .volume = volume};
    memcpy(w->lo, s->lo, sizeof s->lo);
    memcpy(w->hi, s->hi, sizeof s->hi);
}

/* The best closed interval of the first coordinate: over i <= j, (j+1-i)/n - width (z_j - z_i). */
static void best_excess(search *s, const double *list, size_t count, double width)
{
    const double n = (double)s->n;
    double low = 0, low_at = 0, best = s->out->value;
    size_t low_index = 0;
    for (size_t i = 0; i < count; i++) {
        const double z = list[i * (size_t)s->dim];
        const double start = (double)i / n - width * z;
        if (i == 0 || start < low) {
            low = start;
            low_at = z;
            low_index = i;
        }
        if ((double)(i + 1) / n - width * z - low > best) {
            s->lo[0] = low_at;
            s->hi[0] = z;
            const double volume = width * (z - low_at);
            keep(s, (double)(i + 1 - low_index) / n - volume, true, i + 1 - low_index, volume);
            best = s->out->value > best ? s->out->value : best;
        }
    }
}

/* The best open interval: over lo < hi among 0, the z's and 1, width (hi - lo) - #{lo < z < hi}/n. */
static void best_deficit(search *s, const double *list, size_t count, double width)
{
    const double n = (double)s->n;
    size_t i = 0;
    while (i < count && list[i * (size_t)s->dim] <= 0) {
        i++;
    }
    double low = -(double)i / n, low_at = 0, best = s->out->value; /* low = min of width lo - #{z <= lo}/n */
    size_t low_index = i;
    for (;;) {
        const double z = i < count ? list[i * (size_t)s->dim] : 1;
        if (width * z - (double)i / n - low > best) {
            s->lo[0] = low_at;
            s->hi[0] = z;
            const double volume = width * (z - low_at);
            keep(s, volume - (double)(i - low_index) / n, false, i - low_index, volume);
            best = s->out->value > best ? s->out->value : best;
        }
        if (i >= count) {
            return;
        }
        while (i < count && list[i * (size_t)s->dim] == z) {
            i++;
        }
        if (width * z - (double)i / n < low) {
            low = width * z - (double)i / n;
            low_at = z;
            low_index = i;
        }
    }
}

/* Chooses the sides of coordinates k, k-1, .. 1 for boxes of the given width so far. */
static void choose(search *s, int k, size_t count, double width, bool closed)
{
    if (k == 0) {
        (closed ? best_excess : best_deficit)(s, s->lists[0], count, width);
        return;
    }
    const size_t dim = (size_t)s->dim;
    const double *from = s->lists[k];
    double *to = s->lists[k - 1];
    for (size_t a = 0; a < s->n_levels[k] && !s->stopped; a++) {
        if (k == s->dim - 1 && !koksma__keep_going(s->run, (double)a / (double)s->n_levels[k])) {
            s->stopped = true;
        }
        for (size_t b = closed ? a : a + 1; b < s->n_levels[k]; b++) {
            const double lo = s->levels[k][a], hi = s->levels[k][b];
            size_t left = 0;
            for (size_t i = 0; i < count; i++) {
                const double z = from[i * dim + (size_t)k];
                if (closed ? z >= lo && z <= hi : z > lo && z < hi) {
                    memcpy(to + left * dim, from + i * dim, dim * sizeof *to);
                    left++;
                }
            }
            s->lo[k] = lo;
            s->hi[k] = hi;
            choose(s, k - 1, left, width * (hi - lo), closed);
        }
    }
}

static void fill_levels(search *s, bool closed)
{
    for (int k = 0; k < s->dim; k++) {
        double *levels = s->levels[k];
        size_t count = 0, kept = 0;
        for (size_t i = 0; i < s->n; i++) {
            levels[count++] = s->lists[s->dim - 1][i * (size_t)s->dim + (size_t)k];
        }
        if (!closed) {
            levels[count++] = 0;
            levels[count++] = 1;
        }
        qsort(levels, count, sizeof *levels, compare_first);
        for (size_t i = 0; i < count; i++) {
            if (i == 0 || levels[i] != levels[i - 1]) {
                levels[kept++] = levels[i];
            }
        }
        s->n_levels[k] = kept;
    }
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    if (args->params[0] > 0) {
        return koksma__extreme_grid(points, (int)args->params[0], out);
    }
    const size_t max_n = dim == 3 ? MAX_N_3D : dim == 2 ? MAX_N_2D : SIZE_MAX;
    if (n > max_n) {
        return koksma__fail(KOKSMA_N, "extreme: n = %zu: up to %zu points in %zuD; extreme:grid=M takes more", n,
                            max_n, dim);
    }
    search s = {.n = n, .dim = points->dim, .run = args->run, .out = out};
    const size_t bytes = dim * (n * dim + n + 2) * sizeof(double);
    double *memory = malloc(bytes);
    if (!memory) {
        return koksma__fail_memory(bytes);
    }
    for (size_t k = 0; k < dim; k++) {
        s.lists[k] = memory + k * (n * dim + n + 2);
        s.levels[k] = s.lists[k] + n * dim;
    }
    memcpy(s.lists[dim - 1], points->xs, n * dim * sizeof(double));
    qsort(s.lists[dim - 1], n, dim * sizeof(double), compare_first);
    out->value = -1;
    for (int closed = 0; closed < 2; closed++) {
        fill_levels(&s, closed);
        choose(&s, points->dim - 1, n, 1, closed);
    }
    free(memory);
    return s.stopped ? koksma__fail_interrupted() : KOKSMA_OK;
}

static const koksma_param params[] = {
    {"grid", "sides at multiples of 1/grid only, half-open boxes (2D); 0: everywhere, exactly", 0, 0, 4096, NULL,
     true},
    {0},
};

const koksma_measure koksma__measure_extreme = {
    .name = "extreme",
    .title = "Stroud's discrepancy (all axis-parallel boxes)",
    .cite = "stroud1971 shirley1991",
    .cost = "n^3 in 2D, n^5 in 3D",
    .min_dim = 1,
    .max_dim = 3,
    .params = params,
    .eval = eval,
};

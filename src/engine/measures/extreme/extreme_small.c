/* SPDX-License-Identifier: Apache-2.0 */
/* Finds the best box in d = 1 to 3 dimensions by trying all pairs of sides in all coordinates but the first:
   O(n^(2d-1)). */
#include "measures/extreme/extreme.h"

#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/shared/shared.h"

enum { MAX_N_3D = 128 };

/* The sides of boxes are chosen from the last coordinate to the second. The points between the chosen sides are kept
   sorted by the first coordinate, along which one pass finds the best interval. */
typedef struct search {
    size_t n;
    int dim;
    double *lists[3];  /* lists[k]: the points between the sides in coordinates above k, dim numbers each */
    double *levels[3]; /* sorted distinct coordinates of all points; for deficits also 0 and 1 */
    size_t n_levels[3];
    double lo[3], hi[3];
    const koksma_run *run;
    double deadline_s;
    bool stopped, late;
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

/* Finds the closed interval of the first coordinate with the largest excess, (j+1-i)/n - width (z_j - z_i) over i <=
   j, where the z's are the sorted first coordinates. */
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

/* Finds the open interval of the first coordinate with the largest deficit, width (hi - lo) - #{lo < z < hi}/n over
   lo < hi among 0, 1 and the sorted first coordinates z. */
static void best_deficit(search *s, const double *list, size_t count, double width)
{
    const double n = (double)s->n;
    size_t i = 0;
    while (i < count && list[i * (size_t)s->dim] <= 0) {
        i++;
    }
    double low = -(double)i / n, low_at = 0, best = s->out->value; /* low = the least value so far of width lo - #{z
                                                                      <= lo}/n */
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

/* Tries all sides in coordinates k, k-1, .. 1. width: the product of the side lengths in the coordinates above k. */
static void choose(search *s, int k, size_t count, double width, bool closed)
{
    if (k == 0) {
        (closed ? best_excess : best_deficit)(s, s->lists[0], count, width);
        return;
    }
    const size_t dim = (size_t)s->dim;
    const double *from = s->lists[k];
    double *to = s->lists[k - 1];
    for (size_t a = 0; a < s->n_levels[k] && !s->stopped && !s->late; a++) {
        for (size_t b = closed ? a : a + 1; b < s->n_levels[k] && !s->stopped && !s->late; b++) {
            if (k == s->dim - 1) {
                s->stopped = !koksma__keep_going(s->run, (double)a / (double)s->n_levels[k]);
                s->late = koksma__now_s() > s->deadline_s;
            }
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

koksma_status koksma__extreme_small(const koksma_points *points, const koksma_run *run, koksma_value *out)
{
    const size_t n = points->n, dim = (size_t)points->dim;
    KOKSMA__FAIL_IF(dim == 3 && n > MAX_N_3D, KOKSMA_N, "extreme: n = %zu: it takes up to %d points in 3D", n,
                    MAX_N_3D);
    if (!koksma__keep_going(run, 0)) {
        return koksma__fail_interrupted();
    }
    search s = {.n = n, .dim = points->dim, .run = run, .deadline_s = koksma__deadline_s(run, 0.95), .out = out};
    const size_t bytes = dim * (n * dim + n + 2) * sizeof(double);
    double *memory = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(memory, bytes);
    for (size_t k = 0; k < dim; k++) {
        s.lists[k] = memory + k * (n * dim + n + 2);
        s.levels[k] = s.lists[k] + n * dim;
    }
    memcpy(s.lists[dim - 1], points->xs, n * dim * sizeof(double));
    qsort(s.lists[dim - 1], n, dim * sizeof(double), compare_first);
    out->value = -1;
    for (size_t k = 0; k < dim; k++) {
        s.hi[k] = 1;
    }
    keep(&s, 0, true, n, 1); /* start with the whole cube, so that there is always a witness */
    for (int closed = 0; closed < 2; closed++) {
        fill_levels(&s, closed);
        choose(&s, points->dim - 1, n, 1, closed);
    }
    free(memory);
    if (s.late) { /* some boxes were not tried, so the upper bound is 1 */
        out->exact = false;
        out->lower = out->value;
        out->upper = 1;
    }
    return s.stopped ? koksma__fail_interrupted() : KOKSMA_OK;
}

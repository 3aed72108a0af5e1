/* SPDX-License-Identifier: Apache-2.0 */
/*
 * star: the L-infinity star discrepancy, the largest absolute difference, over all boxes with a corner at the origin,
 * between the share of points in the box and its volume. The value is D in Shirley 1991.
 *
 * Formula: D = sup over y in [0,1]^d of |#{x_i in [0,y)}/n - prod_k y_k|. The supremum is reached at a corner whose
 * coordinates are coordinates of points, or 1 (Niederreiter 1972): an excess by a closed box, a deficit by an open
 * one.
 * With grid=200 only closed boxes with corners at multiples of 1/200 are tried, and only in two dimensions; this seems to
 * be the procedure of Shirley's table 5.5 (its regular pattern has S = 0.0600 on such a grid, and exactly 0.0597).
 * Source: Zaremba 1968; Shirley 1991, section 5.5.7; in more than two dimensions Dobkin, Eppstein and Mitchell 1996;
 * for the upper bounds Thiemard 2001.
 * Known exactly: one point at (g,g), g = (sqrt 5 - 1)/2, has D = g; 4 x 4 cell centres 15/64 (also with
 * grid=200); one point at the centre of the cube 7/8; Hammersley 2^m, m >= 2: n D = m/3 + 13/9 - (-1)^m 4/(9 2^m) (De
 * Clerck 1986; n D is 1 for m = 0, 3/2 for m = 1).
 * Limits: counts are exact, volumes are rounded products: errors of a few 1e-16 at any n. With a time limit, in 3
 * dimensions and more, the value may be a lower bound; it then comes with a proven upper bound.
 */
#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "measures/measures.h"
#include "measures/shared/shared.h"
#include "measures/star/star.h"

enum { FIRST_STEPS = 40, FIRST_RESTARTS = 1 };

/* Part of the progress that the short search reports. */
#define SEARCH_SHARE 0.02

/* The smallest c with x <= c/grid, compared as doubles: the first corner whose closed box has x. */
static size_t corner_of(double x, int grid)
{
    int c = (int)(x * grid);
    while (c > 0 && x <= (double)(c - 1) / grid) {
        c--;
    }
    while (x > (double)c / grid) {
        c++;
    }
    return (size_t)c;
}

static void keep(koksma_value *out, double value, size_t count, double x, double y)
{
    if (value > out->value) {
        out->value = value;
        out->witness = (koksma_witness){
            .kind = KOKSMA_WITNESS_BOX, .dim = 2, .count = count, .closed = true, .volume = x * y, .hi = {x, y}};
    }
}

/* The largest |count/n - area| over the closed boxes from the origin to the corners (c/grid, r/grid): counts[r] is first
   the number of points that come in at column c and row r, and then of all points up to both. O(n + grid^2). Errors:
   DIM, MEMORY. */
static koksma_status star_grid(const koksma_points *points, int grid, koksma_value *out)
{
    KOKSMA__FAIL_IF(points->dim != 2, KOKSMA_DIM, "star:grid: it has no %d-dimensional form, only dim = 2",
                    points->dim);
    const size_t m = (size_t)grid + 1;
    size_t *counts = calloc(m * m, sizeof *counts);
    KOKSMA__REQUIRE_MEMORY(counts, m * m * sizeof *counts);
    for (size_t i = 0; i < points->n; i++) {
        counts[corner_of(points->xs[2 * i], grid) * m + corner_of(points->xs[2 * i + 1], grid)]++;
    }
    out->value = -1;
    for (size_t c = 0; c < m; c++) {
        size_t column = 0;
        for (size_t r = 0; r < m; r++) {
            size_t *const count = &counts[c * m + r];
            column += *count;
            *count = column + (c ? count[-(ptrdiff_t)m] : 0);
            const double x = (double)c / grid, y = (double)r / grid;
            keep(out, fabs((double)*count / (double)points->n - x * y), *count, x, y);
        }
    }
    free(counts);
    return KOKSMA_OK;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    if (args->params[0] > 0) {
        return star_grid(points, (int)args->params[0], out);
    }
    KOKSMA__FAIL_IF(points->n >= (size_t)1 << 28, KOKSMA_N, "star: n = %zu: it takes fewer than 2^28 points",
                    points->n);
    if (points->dim <= 2) {
        return koksma__star_2d(points, args->run, out);
    }
    /* The partition (star_partition.c) starts from the good value that a short search finds, so that most of it can
       be skipped. */
    const double half_s = koksma__deadline_s(args->run, 0.5), end_s = koksma__deadline_s(args->run, 0.95);
    bool complete = false;
    const size_t steps = points->n / 5 < FIRST_STEPS ? points->n / 5 : FIRST_STEPS;
    koksma__phases phases = {.share = 0};
    koksma_run phase = koksma__phase_run(&phases, args->run, SEARCH_SHARE);
    koksma_status status =
        koksma__star_search(points, &phase, 1, steps, FIRST_RESTARTS, koksma__deadline_s(args->run, 0.4), out);
    phase = koksma__phase_run(&phases, args->run, 1 - SEARCH_SHARE);
    status = status ? status : koksma__star_partition(points, &phase, half_s, out, &complete);
    if (!status && !complete) {
        out->exact = false;
        out->lower = out->value;
        status = koksma__star_cover(points, args->run, end_s, out->lower, &out->upper);
        out->exact = out->upper <= out->lower;
    }
    return status;
}

static const koksma_param params[] = {
    {"grid", "use only closed boxes with corners at multiples of 1/grid (2D); 0: use all boxes", 0, 0, 4096, NULL,
     true},
    {0},
};

const koksma_measure koksma__measure_star = {
    .name = "star",
    .title = "L-infinity star discrepancy (anchored boxes)",
    .cite = "zaremba1968 niederreiter1972 dobkin1996 thiemard2001 shirley1991",
    .cost = "n log n in 2D, n^(1+d/2)",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = KOKSMA__STAR_MAX_DIM,
    .params = params,
    .eval = eval,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * latin and stratified: whether each of n boxes of equal size, which partition the cube, holds one point. latin cuts
 * each coordinate in turn into n intervals. stratified cuts the first two coordinates into m x n/m cells, for every
 * divisor m of n except 1 and n; in 3 or 4 dimensions, if n is m^dim, it also cuts the cube into m^dim cells. The
 * points in each box are counted; the value is the number of empty boxes. O(n) for each partition.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/net.h"
#include "verify/verify.h"

/* Counts the points in each of the n cells that arise if coordinate use[k] is cut into m[k] strata, for each k <
   dim. */
static void count_cells(const koksma_points *points, const int *use, const size_t *m, int dim, uint32_t *counts)
{
    memset(counts, 0, points->n * sizeof *counts);
    for (size_t i = 0; i < points->n; i++) {
        size_t cell = 0;
        for (int k = 0; k < dim; k++) {
            cell = cell * m[k] + koksma__stratum(points->xs[i * (size_t)points->dim + (size_t)use[k]], m[k]);
        }
        counts[cell]++;
    }
}

static koksma_status add_strata(koksma__verification *v, const int *use, const size_t *m, int dim,
                                const char *subject)
{
    const koksma_points *points = v->points;
    count_cells(points, use, m, dim, v->counts);
    size_t empty = 0;
    for (size_t c = 0; c < points->n; c++) {
        empty += v->counts[c] == 0;
    }
    return koksma__add_finding(v, subject, (double)empty, empty == 0, "%zu of %zu strata are empty", empty,
                               points->n);
}

static koksma_status look_latin(koksma__verification *v)
{
    char subject[48];
    koksma_status status = KOKSMA_OK;
    for (int k = 0; k < v->points->dim && !status; k++) {
        snprintf(subject, sizeof subject, "%d", k);
        status = add_strata(v, &k, &v->points->n, 1, subject);
    }
    return status;
}

static koksma_status look_stratified(koksma__verification *v)
{
    const size_t n = v->points->n;
    const int use[4] = {0, 1, 2, 3}, dim = v->points->dim;
    char subject[48];
    koksma_status status = KOKSMA_OK;
    for (size_t m = 2; dim >= 2 && m * m <= n && !status; m++) {
        const size_t sides[2] = {m, n / m}, other[2] = {n / m, m};
        if (n % m) {
            continue;
        }
        snprintf(subject, sizeof subject, "%zu x %zu", m, n / m);
        status = add_strata(v, use, sides, 2, subject);
        if (m * m < n && !status) {
            snprintf(subject, sizeof subject, "%zu x %zu", n / m, m);
            status = add_strata(v, use, other, 2, subject);
        }
    }
    if (dim == 3 || dim == 4) {
        const size_t m = (size_t)(pow((double)n, 1.0 / dim) + 0.5), sides[4] = {m, m, m, m};
        if (m >= 2 && (dim == 3 ? m * m * m : m * m * m * m) == n && !status) {
            snprintf(subject, sizeof subject, "%zu^%d", m, dim);
            status = add_strata(v, use, sides, dim, subject);
        }
    }
    return status;
}

const koksma__property koksma__property_latin = {
    .public = {.name = "latin",
               .meaning =
                   "each of n strata of the coordinate `subject` has one point; value: number of empty strata"},
    .look = look_latin,
};

const koksma__property koksma__property_stratified = {
    .public = {.name = "stratified",
               .meaning = "each of m x k cells in coordinates 0 and 1, or of m^dim cells, has one point; value: "
                          "number of empty cells"},
    .look = look_stratified,
};

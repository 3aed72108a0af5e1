/* SPDX-License-Identifier: Apache-2.0 */
/* Properties of one set that are counted in one pass over its points or prefixes. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/elementary.h"
#include "core/points.h"
#include "verify/verify.h"

/* ---- Strata ------------------------------------------------------------------------------------------------------ */

/*
 * latin and stratified: whether each of n boxes of equal size, which partition the cube, holds one point. latin cuts
 * each coordinate in turn into n intervals. stratified cuts the first two coordinates into m x n/m cells, for every
 * divisor m of n except 1 and n; in 3 or 4 dimensions, if n is m^dim, it also cuts the cube into m^dim cells. The
 * points in each box are counted; the value is the number of empty boxes. O(n) for each partition.
 */

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
        const size_t m = (size_t)(koksma__pow((double)n, 1.0 / dim) + 0.5), sides[4] = {m, m, m, m};
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

/* ---- The origin -------------------------------------------------------------------------------------------------- */

/*
 * origin-unique and origin-not-missing: how many points are at the origin. The first point of a digital sequence is the
 * origin; a generator that skips it destroys the net property of the sequence's prefixes. origin-not-missing fails where
 * the points look like points 1 to n of such a sequence: each coordinate takes different multiples of 2^-m, 2^m > n,
 * of which none is 0 and not all are odd multiples. O(n dim).
 */

static size_t at_origin(const koksma_points *points)
{
    size_t count = 0;
    for (size_t i = 0; i < points->n; i++) {
        bool zero = true;
        for (int k = 0; k < points->dim; k++) {
            zero = zero && points->xs[i * (size_t)points->dim + (size_t)k] == 0;
        }
        count += zero;
    }
    return count;
}

/* Whether the points look like points 1 to n of a sequence like Sobol's: in each coordinate different multiples of
   2^-m, 2^m > n, none of them 0 and not all odd. Grids are excluded because their points share coordinates, and cell
   centres because all their coordinates are odd multiples. `seen` has room for one bit for each multiple. */
static bool is_sequence_from_one(const koksma_points *points, uint32_t *seen)
{
    size_t cells = 1;
    while (cells <= points->n) {
        cells *= 2;
    }
    for (int k = 0; k < points->dim; k++) {
        bool odd = true;
        memset(seen, 0, (cells / 32 + 1) * sizeof *seen);
        for (size_t i = 0; i < points->n; i++) {
            const double place = points->xs[i * (size_t)points->dim + (size_t)k] * (double)cells;
            const size_t cell = (size_t)place;
            if (place != (double)cell || cell == 0 || seen[cell / 32] >> cell % 32 & 1) {
                return false;
            }
            seen[cell / 32] |= 1u << cell % 32;
            odd = odd && cell % 2;
        }
        if (odd) {
            return false;
        }
    }
    return true;
}

static koksma_status look_unique(koksma__verification *v)
{
    const size_t count = at_origin(v->points);
    return koksma__add_finding(v, "-", (double)count, count <= 1, "%zu at the origin", count);
}

static koksma_status look_present(koksma__verification *v)
{
    const size_t count = at_origin(v->points);
    const bool holds = count > 0 || !is_sequence_from_one(v->points, v->counts);
    return koksma__add_finding(
        v, "-", (double)count, holds, "%zu at the origin%s", count,
        count > 0 ? ""
        : holds   ? "; only unscrambled sequences need a point there"
                  : ": different multiples of 2^-m in each coordinate, as a sequence without its first point");
}

const koksma__property koksma__property_origin_unique = {
    .public = {.name = "origin-unique",
               .meaning = "at most one point is at the origin; value: number of points there"},
    .look = look_unique,
};

const koksma__property koksma__property_origin_not_missing = {
    .public = {.name = "origin-not-missing",
               .meaning = "the points do not look like an unscrambled sequence whose first point, the origin, is "
                          "missing; value: number of points at the origin"},
    .look = look_present,
};

/* ---- Coordinates as floats --------------------------------------------------------------------------------------- */

/*
 * below-one-as-float: checks that no coordinate becomes 1 when it is converted to float. Doubles from 1 - 2^-25 on
 * round to the float 1, which is outside [0,1): a renderer then reads past the end of a table. O(n dim).
 */

static koksma_status look_below_one_as_float(koksma__verification *v)
{
    const koksma_points *points = v->points;
    size_t count = 0, first = 0;
    for (size_t i = points->n * (size_t)points->dim; i-- > 0;) {
        if ((float)points->xs[i] >= 1) {
            count++;
            first = i / (size_t)points->dim;
        }
    }
    char where[48] = "";
    if (count) {
        snprintf(where, sizeof where, ", first of point %zu", first);
    }
    return koksma__add_finding(v, "-", (double)count, count == 0, "%zu of %zu coordinates become 1%s", count,
                               points->n * (size_t)points->dim, where);
}

const koksma__property koksma__property_below_one_as_float = {
    .public = {.name = "below-one-as-float",
               .meaning = "no coordinate becomes 1 as a float; value: number of coordinates that become 1"},
    .look = look_below_one_as_float,
};

/* ---- Progressive order ------------------------------------------------------------------------------------------- */

/*
 * progressive: whether the points can be used progressively, in their order, a few at first and more later. The value
 * is the largest ratio, over the prefixes of 2^j >= 16 points, of the prefix's L2 star discrepancy to its root mean
 * square for as many random points, sqrt((2^-d - 3^-d) / n). The longest prefix is one that takes about a second:
 * 2^22 points in the plane, 2^18 in three dimensions, 2^12 in four to twelve.
 */

enum { PREFIX_LEAST = 16, PREFIX_MOST_DIM = 12 };

/* The number of points of the longest prefix that can be measured in about a second. */
static size_t longest_prefix(const koksma_points *points)
{
    const size_t most = points->dim <= 2 ? (size_t)1 << 22 : points->dim == 3 ? (size_t)1 << 18 : (size_t)1 << 12;
    size_t n = PREFIX_LEAST;
    while (n <= points->n / 2 && n < most) {
        n *= 2;
    }
    return n;
}

static koksma_status look_progressive(koksma__verification *v)
{
    const koksma_points *points = v->points;
    size_t worst = 0;
    double value = 0;
    koksma_spec l2_star;
    koksma_status status = koksma_measure_spec("l2-star", &l2_star);
    const size_t last = longest_prefix(points);
    for (size_t n = PREFIX_LEAST; n <= points->n && n <= last && points->dim <= PREFIX_MOST_DIM && !status; n *= 2) {
        const koksma_points prefix = {n, points->dim, points->xs};
        const double random = (koksma__pow(2, -points->dim) - koksma__pow(3, -points->dim)) / (double)n;
        koksma_value found;
        status = koksma_evaluate(&l2_star, &prefix, v->run, &found);
        const double ratio = status ? 0 : found.value / sqrt(random);
        if (ratio > value) {
            value = ratio;
            worst = n;
        }
    }
    if (status || worst == 0) {
        return status;
    }
    return koksma__add_finding(v, "-", value, value <= 2, "the worst of the prefixes up to %zu points has %zu", last,
                               worst);
}

const koksma__property koksma__property_progressive = {
    .public = {.name = "progressive",
               .meaning =
                   "prefixes have at most twice the L2 star discrepancy of random points; value: the largest ratio"},
    .look = look_progressive,
};

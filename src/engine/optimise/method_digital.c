/* SPDX-License-Identifier: Apache-2.0 */
/*
 * digital: searches for the generator matrices of a digital sequence in base 2; needs only the value of the measure,
 * and so works for any measure. A move of the walk adds, in the matrix of one coordinate, a row to a row below it, or
 * a column to a column on its right. Both kinds of move preserve, for all k, the rank of the upper left k x k
 * submatrix, so that each coordinate remains a (0,1)-sequence: its first 2^k points include one in each interval of
 * length 2^-k. Adding rows is Matousek's linear scrambling, and preserves all net parameters; adding columns changes
 * the direction numbers, and so the joint distribution of the coordinates. Columns are not added in coordinate 0:
 * adding a column in all coordinates at once leaves every prefix of 2^k points the same set, so that moves of the
 * other coordinates suffice. A move is kept if the value grows by no more than a threshold that falls to 0 (threshold
 * accepting, Dueck & Scheuer 1990). A quarter of the walks start with 8 random moves for each column and coordinate.
 *
 * Sources: Matousek 1998 for the scrambling, and Joe & Kuo 2008 for Sobol' sequences with optimised direction
 * numbers.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "optimise/search.h"

enum { MOVES = 200, LOWER = 10, DIGITS = KOKSMA__SEQUENCE_DIGITS };

/* Computes coordinate k of all points from coordinate k of the points with indices 2^c: its digits are column c of
   the generator matrix. */
static void fill(koksma_points *points, size_t k)
{
    const size_t dim = (size_t)points->dim;
    for (size_t high = 2; high < points->n; high *= 2) {
        const uint64_t column = (uint64_t)(points->xs[high * dim + k] * 0x1p53);
        for (size_t r = 1; r < high; r++) {
            const uint64_t x = column ^ (uint64_t)(points->xs[r * dim + k] * 0x1p53);
            points->xs[(high + r) * dim + k] = (double)x * 0x1p-53;
        }
    }
}

/* Adds row `from` to row `to` in the matrix of coordinate k. */
static void add_row(koksma_points *points, size_t k, unsigned from, unsigned to)
{
    for (size_t high = 1; high < points->n; high *= 2) {
        double *x = points->xs + high * (size_t)points->dim + k;
        const uint64_t y = (uint64_t)(*x * 0x1p53);
        *x = (double)(y ^ (y >> (DIGITS - 1 - from) & 1) << (DIGITS - 1 - to)) * 0x1p-53;
    }
}

static void add_column(koksma_points *points, size_t k, unsigned from, unsigned to)
{
    const size_t dim = (size_t)points->dim;
    double *x = points->xs + ((size_t)1 << to) * dim + k;
    const uint64_t y = (uint64_t)(points->xs[((size_t)1 << from) * dim + k] * 0x1p53);
    *x = (double)((uint64_t)(*x * 0x1p53) ^ y) * 0x1p-53;
}

/* Makes a random move and returns the coordinate that it changed. The move changes only the first m rows, which
   distinguish 2^m points, and the next LOWER rows, because rows below these move points too little to matter. */
static size_t move(koksma_points *points, unsigned m, koksma__stream *random)
{
    const size_t k = koksma__next_below(random, (size_t)points->dim);
    const unsigned rows = m + LOWER < DIGITS ? m + LOWER : DIGITS;
    if (k > 0 && m > 1 && koksma__next(random) % 2) {
        const unsigned to = 1 + koksma__next_below(random, m - 1);
        add_column(points, k, koksma__next_below(random, to), to);
    } else {
        const unsigned to = 1 + koksma__next_below(random, rows - 1);
        add_row(points, k, koksma__next_below(random, to < m ? to : m), to);
    }
    fill(points, k);
    return k;
}

static koksma_status search(const koksma_spec *measure, const koksma_optimise_options *o, uint64_t seed, double value,
                            const koksma_run *run, koksma_points *points)
{
    koksma__stream random = {.seed = seed};
    const size_t bytes = points->n * (size_t)points->dim * sizeof(double);
    const double tolerance = 0.02 * koksma__next_unit(&random);
    const double sign = measure->measure->larger_is_better ? -1 : 1;
    unsigned m = 0;
    double current = sign * koksma__log(value), best = current, after;
    koksma_points walk = {0}, next; /* the walk's sequence, and the next one; `points` keeps the best one */
    koksma_status status = koksma_points_init(&next, points->n, points->dim);
    status = status ? status : koksma_points_init(&walk, points->n, points->dim);
    if (!status) {
        memcpy(walk.xs, points->xs, bytes);
    }
    while (points->n >> (m + 1)) {
        m++;
    }
    const bool anew = koksma__next(&random) % 4 == 0;
    for (size_t i = 0; !status && anew && i < 8 * m * (size_t)points->dim; i++) {
        move(&walk, m, &random);
        current = INFINITY;
        status = koksma__ask(run);
    }
    for (int i = 0; i < MOVES && !status; i++) {
        memcpy(next.xs, walk.xs, bytes);
        move(&next, m, &random);
        status = koksma__search_value(measure, o, &next, run, &after);
        after = sign * koksma__log(after);
        if (!status && after <= current + tolerance * (1 - (double)(i + 1) / MOVES)) {
            current = after;
            memcpy(walk.xs, next.xs, bytes);
        }
        if (!status && after < best) {
            best = after;
            memcpy(points->xs, next.xs, bytes);
        }
    }
    koksma_points_fini(&walk);
    koksma_points_fini(&next);
    return status;
}

static int serves(const koksma_spec *measure, const koksma_optimise_options *o)
{
    (void)measure;
    return o->keep == KOKSMA_KEEP_SEQUENCE ? 5 : 0;
}

const koksma_method koksma__method_digital = {
    .name = "digital",
    .title = "generator matrices of a sequence, over all its prefixes of 2^k points (any measure)",
    .cite = "matousek1998 joe2008 dueck1990",
    .serves = serves,
    .search = search,
};

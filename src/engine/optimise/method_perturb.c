/* SPDX-License-Identifier: Apache-2.0 */
/*
 * perturb: a random search that needs only the value of the measure, and so works for any measure. A walk moves one
 * point at a time on the torus, by a step whose length is drawn log-uniformly between 10^-4 and 1 times the mean
 * spacing n^(-1/d). With keep=net the point stays within its intervals of length 1/n; with keep=latin two points swap a
 * coordinate instead, and with keep=every-prefix in three moves of ten their places in the order. A move is accepted if
 * the new value is at most the walk's current value plus a threshold that falls to 0 (threshold accepting, Dueck &
 * Scheuer 1990).
 */
#include <math.h>
#include <string.h>

#include "core/elementary.h"
#include "optimise/search.h"

enum { MOVES = 200 };

static int serves(const koksma_spec *measure, const koksma_optimise_options *o)
{
    (void)measure;
    return o->keep != KOKSMA_KEEP_SEQUENCE;
}

/* Returns one coordinate of a point, moved by up to `reach`. */
static double moved(double x, double reach, size_t n, koksma_keep keep, koksma__stream *random)
{
    const double cell = 1 / (double)n, by = reach * (2 * koksma__next_unit(random) - 1);
    if (keep == KOKSMA_KEEP_NET) {
        const double low = floor(x * (double)n) * cell, to = x + by * cell;
        return to >= low && to < low + cell && to < 1 && floor(to * (double)n) == floor(x * (double)n) ? to : x;
    }
    const double to = x + by, wrapped = to - floor(to);
    return wrapped < 1 ? wrapped : 0;
}

static void move(koksma_points *points, koksma_keep keep, koksma__stream *random, double *a, double *b)
{
    const size_t dim = (size_t)points->dim, k = koksma__next_below(random, dim);
    const bool order = keep == KOKSMA_KEEP_PREFIXES && koksma__next_unit(random) < 0.3;
    for (size_t c = 0; c < dim && (order || keep == KOKSMA_KEEP_LATIN); c++) {
        const double swapped = a[c];
        a[c] = order || c == k ? b[c] : a[c];
        b[c] = order || c == k ? swapped : b[c];
    }
    if (order || keep == KOKSMA_KEEP_LATIN) {
        return;
    }
    const double spacing = keep == KOKSMA_KEEP_NET ? 1 : koksma__pow((double)points->n, -1.0 / points->dim);
    const double reach = spacing * koksma__pow(10, -4 * koksma__next_unit(random));
    for (size_t c = 0; c < dim; c++) {
        a[c] = moved(a[c], reach, points->n, keep, random);
    }
}

static koksma_status search(const koksma_spec *measure, const koksma_optimise_options *o, uint64_t seed, double value,
                            const koksma_run *run, koksma_points *points)
{
    koksma__stream random = {.seed = seed};
    const size_t dim = (size_t)points->dim, bytes = dim * sizeof(double);
    koksma_points walk; /* the walk's set; `points` keeps the best one */
    const double tolerance = 0.01 * koksma__next_unit(&random) * value;
    const double sign = measure->measure->larger_is_better ? -1 : 1;
    double current = sign * value, best = current, before[2 * KOKSMA_MAX_DIM];
    koksma_status status = koksma_points_init(&walk, points->n, points->dim);
    if (!status) {
        memcpy(walk.xs, points->xs, points->n * bytes);
    }
    for (int m = 0; m < MOVES && !status; m++) {
        double *a = walk.xs + koksma__next_below(&random, points->n) * dim,
               *b = walk.xs + koksma__next_below(&random, points->n) * dim, after = 0;
        memcpy(before, a, bytes);
        memcpy(before + dim, b, bytes);
        move(&walk, o->keep, &random, a, b);
        status = koksma__search_value(measure, o, &walk, run, &after);
        after *= sign;
        if (!status && after < best) {
            best = after;
            memcpy(points->xs, walk.xs, points->n * bytes);
        }
        if (after <= current + tolerance * (1 - (double)(m + 1) / MOVES)) {
            current = after;
        } else {
            memcpy(a, before, bytes);
            memcpy(b, before + dim, bytes);
        }
    }
    koksma_points_fini(&walk);
    return status;
}

const koksma_method koksma__method_perturb = {
    .name = "perturb",
    .title = "moves of one point, or swaps of one coordinate, for any measure",
    .cite = "dueck1990",
    .serves = serves,
    .search = search,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * witness: minimises a discrepancy that is a supremum over boxes, half-planes or disks. The region where the supremum
 * is reached is the witness, and its border touches points. Moving these points out of a closed region with too many
 * points, or into an open region with too few, reduces that region's discrepancy: it follows a subgradient of the
 * supremum. A walk moves each touching point with probability 1/2, by a step whose length is drawn log-uniformly
 * between 10^-4 and 1 times the mean spacing; every fourth move is of a random point, because other regions have
 * nearly the same discrepancy. A move is accepted if the value grows by less than a threshold that falls to 0
 * (threshold accepting, Dueck & Scheuer 1990).
 */
#include <math.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "optimise/search.h"

enum { MOVES = 200 };

/* A point within this distance of the border counts as touching it. */
#define NEAR 1e-9

static int serves(const koksma_spec *measure, const koksma_optimise_options *o)
{
    const koksma_measure *m = measure->measure;
    return m->family != KOKSMA_FAMILY_NONE && m->answer == KOKSMA_ANSWER_EXACT && !m->gradient &&
                   o->dim <= KOKSMA_WITNESS_DIM && o->keep == KOKSMA_KEEP_NONE && !o->n_projections
               ? 3
               : 0;
}

/* Sets `out` to the direction in which a point leaves the region through the border that it touches. Returns false if
   the point touches no border. */
static bool outward(const koksma_witness *w, const double *x, double *out)
{
    double distance = w->kind == KOKSMA_WITNESS_HALF_PLANE ? -w->hi[0] : 0, length = 0;
    bool touches = false;
    for (int k = 0; k < w->dim; k++) {
        out[k] = 0;
        if (w->kind == KOKSMA_WITNESS_BOX) {
            if (x[k] < w->lo[k] - NEAR || x[k] > w->hi[k] + NEAR) {
                return false;
            }
            out[k] = x[k] > w->hi[k] - NEAR ? 1 : x[k] < w->lo[k] + NEAR ? -1 : 0;
            touches = touches || out[k] != 0;
        } else if (w->kind == KOKSMA_WITNESS_HALF_PLANE) {
            out[k] = w->lo[k];
            distance += w->lo[k] * x[k];
            length += w->lo[k] * w->lo[k];
        } else {
            const double d = x[k] - w->lo[k];
            out[k] = d - nearbyint(d);
            length += out[k] * out[k];
        }
    }
    if (w->kind == KOKSMA_WITNESS_BOX) {
        return touches;
    }
    length = sqrt(length);
    for (int k = 0; k < w->dim; k++) {
        out[k] /= length > 0 ? length : 1;
    }
    return w->kind == KOKSMA_WITNESS_HALF_PLANE ? fabs(distance) < NEAR * length
                                                : w->kind == KOKSMA_WITNESS_DISK && fabs(length - w->hi[0]) < NEAR;
}

static void move_point(double *x, const double *direction, double by, int dim)
{
    for (int k = 0; k < dim; k++) {
        const double to = x[k] + by * direction[k];
        x[k] = fmin(fmax(to, 0), 1 - 0x1p-53);
    }
}

/* Moves each point that touches the witness with probability 1/2, or moves a random point. */
static void move(koksma_points *points, const koksma_witness *w, koksma__stream *random)
{
    const double reach =
        koksma__pow((double)points->n, -1.0 / points->dim) * koksma__pow(10, -4 * koksma__next_unit(random));
    double direction[KOKSMA_MAX_DIM];
    bool moved = false;
    const bool any = koksma__next(random) % 4 == 0;
    for (size_t i = 0; i < points->n && !any && w->kind != KOKSMA_WITNESS_NONE; i++) {
        double *x = points->xs + i * (size_t)points->dim;
        if (outward(w, x, direction) && koksma__next(random) % 2) {
            move_point(x, direction, (w->closed ? reach : -reach) * koksma__next_unit(random), points->dim);
            moved = true;
        }
    }
    if (!moved) {
        double *x = points->xs + koksma__next_below(random, points->n) * (size_t)points->dim;
        for (int k = 0; k < points->dim; k++) {
            direction[k] = 2 * koksma__next_unit(random) - 1;
        }
        move_point(x, direction, reach, points->dim);
    }
}

static koksma_status search(const koksma_spec *measure, const koksma_optimise_options *o, uint64_t seed, double value,
                            const koksma_run *run, koksma_points *points)
{
    (void)o;
    koksma__stream random = {.seed = seed};
    const size_t bytes = points->n * (size_t)points->dim * sizeof(double);
    const double tolerance = 0.01 * koksma__next_unit(&random) * value;
    koksma_points walk = {0}, next; /* the walk's set, and the next one; `points` keeps the best one */
    koksma_value at, after;
    double best = value;
    koksma_status status = koksma_points_init(&next, points->n, points->dim);
    status = status ? status : koksma_points_init(&walk, points->n, points->dim);
    status = status ? status : koksma_evaluate(measure, points, run, &at);
    if (!status) {
        memcpy(walk.xs, points->xs, bytes);
    }
    for (int m = 0; m < MOVES && !status; m++) {
        memcpy(next.xs, walk.xs, bytes);
        move(&next, &at.witness, &random);
        status = koksma__ask(run);
        status = status ? status : koksma_evaluate(measure, &next, run, &after);
        if (!status && after.value <= at.value + tolerance * (1 - (double)(m + 1) / MOVES)) {
            at = after;
            memcpy(walk.xs, next.xs, bytes);
        }
        if (!status && after.value < best) {
            best = after.value;
            memcpy(points->xs, next.xs, bytes);
        }
    }
    koksma_points_fini(&walk);
    koksma_points_fini(&next);
    return status;
}

const koksma_method koksma__method_witness = {
    .name = "witness",
    .title = "moves of the points on the border of the worst region (extreme, edge, disk)",
    .cite = "dueck1990",
    .serves = serves,
    .search = search,
};

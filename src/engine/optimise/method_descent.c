/* SPDX-License-Identifier: Apache-2.0 */
/* descent: for measures with a gradient, L-BFGS of the square of the measure from many starts (descent.c). */
#include <math.h>
#include <string.h>

#include "optimise/search.h"

/* What a call costs beside its terms: with few points, most of its time. */
static const double CALL = 1000;

typedef struct job {
    const koksma_spec *measure;
    const koksma_optimise_options *options;
    const koksma_run *run;
} job;

static koksma_status square_of(const void *context, const koksma_points *points, double *value, double *gradient)
{
    const job *j = context;
    return koksma__search_square(j->measure, j->options, points, j->run, value, gradient);
}

static koksma_status search(const koksma_spec *measure, const koksma_optimise_options *o, uint64_t seed, double value,
                            const koksma_run *run, koksma_points *points)
{
    const job j = {measure, o, run};
    koksma__stream random = {.seed = seed};
    koksma__descent d;
    const double n = (double)points->n, cost = CALL + (o->power ? koksma__radial_power_cost(o) : n * n * points->dim);
    koksma_status status =
        koksma__descent_init(&d, points, o->keep, o->keep == KOKSMA_KEEP_NET || !measure->measure->on_torus, cost);
    double best = value * value;
    d.function = square_of;
    d.context = &j;
    d.run = run;
    while (!status && d.work < d.budget) {
        double square = INFINITY;
        status = koksma__descent_start(&d, points, o->keep, &random);
        d.goal = best;
        status = status ? status : koksma__descend(&d, KOKSMA__ITERATIONS, &square);
        if (square < best) { /* also of a descent that is interrupted */
            best = square;
            memcpy(points->xs, d.points.xs, d.count * sizeof(double));
        }
    }
    koksma__descent_fini(&d);
    return status;
}

static int serves(const koksma_spec *measure, const koksma_optimise_options *o)
{
    return (measure->measure->gradient || o->power) && (o->keep == KOKSMA_KEEP_NONE || o->keep == KOKSMA_KEEP_NET)
               ? 5
               : 0;
}

const koksma_method koksma__method_descent = {
    .name = "descent",
    .title = "L-BFGS from many starts (measures with a gradient, target power)",
    .cite = "nocedal1980 nocedal2006",
    .serves = serves,
    .search = search,
};

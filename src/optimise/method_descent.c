/* SPDX-License-Identifier: Apache-2.0 */
/* descent: for measures with a gradient, L-BFGS of the square of the measure from many starts (descent.c). */
#include <string.h>

#include "core/spec.h"
#include "optimise/descent.h"

typedef struct job {
    const koksma_measure *measure;
    koksma_args args;
} job;

static koksma_status square_of(const void *context, const koksma_points *points, double *value, double *gradient)
{
    const job *j = context;
    return j->measure->gradient(points, &j->args, value, gradient);
}

static koksma_status search(const koksma_spec *measure, koksma_keep keep, uint64_t seed, double value,
                            koksma_points *points)
{
    static const koksma_run one_thread = {.threads = 1};
    const job j = {measure->measure, koksma__spec_arguments(measure, &one_thread)};
    koksma__stream random = {.seed = seed};
    koksma__descent d;
    const double n = (double)points->n;
    koksma_status status = koksma__descent_init(&d, points, keep, keep == KOKSMA_KEEP_NET || !j.measure->on_torus,
                                                n * n * points->dim + 1000);
    double best = value * value;
    d.function = square_of;
    d.context = &j;
    while (!status && d.work < d.budget) {
        koksma__descent_start(&d, points, keep, &random);
        d.goal = best;
        double square;
        status = koksma__descend(&d, KOKSMA__ITERATIONS, &square);
        if (!status && square < best) {
            best = square;
            memcpy(points->xs, d.points.xs, d.count * sizeof(double));
        }
    }
    koksma__descent_fini(&d);
    return status;
}

static int serves(const koksma_spec *measure, size_t n, int dim, koksma_keep keep)
{
    (void)n, (void)dim;
    return measure->measure->gradient && keep != KOKSMA_KEEP_LATIN ? 5 : 0;
}

const koksma_method koksma__method_descent = {
    .name = "descent",
    .title = "L-BFGS from many starts (measures with a gradient)",
    .cite = "nocedal1980 nocedal2006",
    .serves = serves,
    .search = search,
};

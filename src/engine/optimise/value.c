/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The value that a search minimises. With projections u of weights w_u it is the square root of sum_u w_u D_u^2 / sum_u
 * w_u, where D_u is the measure of the points in the coordinates u.
 *
 * For the L2 family this is the weighted discrepancy of Sloan & Wozniakowski (1998). The square of the value has a
 * gradient if the square of the measure has one. For a sequence the value is the weighted geometric mean over its
 * prefixes of 2, 4, ..., n points and over the projections, and with keep=every-prefix over those of FROM, FROM + 1, ...,
 * n: a gain of 1 % counts as much at 2 points as at n, although measures decrease with n at different rates.
 */
#include "optimise/search.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/spec.h"
#include "core/status.h"

koksma_status koksma__search_check(const koksma_optimise_options *o)
{
    KOKSMA__FAIL_IF((o->n_projections && !o->projections) || (o->weights && !o->n_projections), KOKSMA_ARGUMENT,
                    "options->projections is NULL or empty, but %s",
                    o->weights ? "there are weights" : "n_projections is not 0");
    KOKSMA__TRY(koksma__radial_power_check(o));
    KOKSMA__FAIL_IF(o->n_projections && o->dim > 64, KOKSMA_DIM,
                    "dim = %d: projections need points of at most 64 dimensions", o->dim);
    for (size_t p = 0; p < o->n_projections; p++) {
        const uint64_t u = o->projections[p];
        KOKSMA__FAIL_IF(!u || (o->dim < 64 && u >> o->dim), KOKSMA_ARGUMENT, "projection %zu has %s", p,
                        u ? "a coordinate that the points do not have" : "no coordinate");
        KOKSMA__FAIL_IF(o->weights && !(o->weights[p] >= 1e-100 && o->weights[p] <= 1e100), KOKSMA_ARGUMENT,
                        "the weight of projection %zu is %g: weights are 1e-100 to 1e100", p, o->weights[p]);
    }
    return KOKSMA_OK;
}

static double weight(const koksma_optimise_options *o, size_t p)
{
    return o->weights ? o->weights[p] : 1;
}

/* Copies the points, with only the coordinates of a projection. */
static void project(const koksma_points *points, uint64_t u, koksma_points *out)
{
    const size_t dim = (size_t)points->dim;
    double *to = out->xs;
    out->dim = 0;
    for (size_t c = 0; c < points->n * dim; c++) {
        if (u >> c % dim & 1) {
            *to++ = points->xs[c];
            out->dim += c < dim;
        }
    }
}

enum { FROM = 8 };

/* Computes the mean of the logarithms of the measure over all prefixes. */
static koksma_status mean_of_prefixes(const koksma_spec *measure, bool each, const koksma_points *points,
                                      const koksma_run *run, double *mean)
{
    double count = 0;
    *mean = 0;
    for (size_t n = !each ? 2 : points->n < FROM ? points->n : FROM; n <= points->n; n += each ? 1 : n, count++) {
        const koksma_points prefix = {.n = n, .dim = points->dim, .xs = points->xs};
        koksma_value value;
        KOKSMA__TRY(koksma_evaluate(measure, &prefix, run, &value));
        KOKSMA__FAIL_IF(!(value.value > 0), KOKSMA_ARGUMENT,
                        "%s of the first %zu points is %g: the geometric mean over all prefixes needs values above 0",
                        measure->measure->name, n, value.value);
        *mean += koksma__log(value.value);
    }
    *mean /= count;
    return KOKSMA_OK;
}

/* Computes the term that is averaged over projections: the square of the measure or, for a sequence, the mean of its
   logarithms over the prefixes. */
static koksma_status term(const koksma_spec *measure, const koksma_optimise_options *o, const koksma_points *points,
                          const koksma_run *run, double *out)
{
    koksma_value value = {0};
    if (koksma__search_of_prefixes(o)) {
        return mean_of_prefixes(measure, o->keep == KOKSMA_KEEP_PREFIXES, points, run, out);
    }
    KOKSMA__TRY(koksma_evaluate(measure, points, run, &value));
    *out = value.value * value.value;
    return KOKSMA_OK;
}

koksma_status koksma__search_value(const koksma_spec *measure, const koksma_optimise_options *o,
                                   const koksma_points *points, const koksma_run *run, double *value)
{
    double mean = 0, weights = 0;
    koksma_value whole = {.value = NAN};
    koksma_status status = KOKSMA_OK;
    KOKSMA__TRY(koksma__ask(run));
    if (o->power) {
        status = koksma__radial_power_square(o, points, run, &mean, NULL);
        *value = sqrt(mean);
        return status;
    }
    if (!o->n_projections && !koksma__search_of_prefixes(o)) {
        status = koksma_evaluate(measure, points, run, &whole);
        *value = whole.value;
        return status;
    }
    if (!o->n_projections) {
        status = term(measure, o, points, run, &mean);
    } else {
        koksma_points projected;
        KOKSMA__TRY(koksma_points_init(&projected, points->n, points->dim));
        for (size_t p = 0; p < o->n_projections && !status; p++) {
            double one;
            project(points, o->projections[p], &projected);
            status = term(measure, o, &projected, run, &one);
            mean += status ? 0 : weight(o, p) * one;
            weights += weight(o, p);
        }
        mean /= weights;
        koksma_points_fini(&projected);
    }
    *value = koksma__search_of_prefixes(o) ? koksma__exp(mean) : sqrt(mean);
    return status;
}

koksma_status koksma__search_square(const koksma_spec *measure, const koksma_optimise_options *o,
                                    const koksma_points *points, const koksma_run *run, double *square,
                                    double *gradient)
{
    const koksma_args args = koksma__spec_arguments(measure, run);
    const size_t dim = (size_t)points->dim;
    koksma_points projected;
    koksma_status status = KOKSMA_OK;
    double weights = 0;
    if (o->power) {
        return koksma__radial_power_square(o, points, run, square, gradient);
    }
    if (!o->n_projections) {
        return measure->measure->gradient(points, &args, square, gradient);
    }
    KOKSMA__TRY(koksma_points_init(&projected, points->n, 2 * points->dim));
    double *own = projected.xs + points->n * dim;
    *square = 0;
    for (size_t p = 0; p < o->n_projections; p++) {
        weights += weight(o, p);
    }
    for (size_t c = 0; c < points->n * dim; c++) {
        gradient[c] = 0;
    }
    for (size_t p = 0; p < o->n_projections && !status; p++) {
        double one = 0;
        const double *from = own, share = weight(o, p) / weights;
        project(points, o->projections[p], &projected);
        status = measure->measure->gradient(&projected, &args, &one, own);
        *square += share * one;
        for (size_t c = 0; c < points->n * dim && !status; c++) {
            gradient[c] += o->projections[p] >> c % dim & 1 ? share * *from++ : 0;
        }
    }
    koksma_points_fini(&projected);
    return status;
}

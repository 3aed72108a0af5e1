/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_integral: an integrand of the table with its parameters and dimension, or a function of the caller; its
 * values at points and their mean. Points are evaluated in blocks of fixed size on several threads, and the sums of
 * the blocks are added in order.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/lookup.h"
#include "core/parallel.h"
#include "core/points.h"
#include "core/spec.h"
#include "core/status.h"
#include "core/sum.h"
#include "integrands/integrands.h"

enum { BLOCK = 1024, NAME = 64 };

static const koksma_integrand *const integrands[] = {
#define INTEGRAND(name) &koksma__integrand_##name,
#include "integrands/integrands.def"
#undef INTEGRAND
};

KOKSMA__LOOKUP(koksma_integrand, integrands)
KOKSMA__NAME_AT(koksma_integrand)

static koksma_integral *new_integral(int dim)
{
    koksma_integral *f = calloc(1, sizeof *f);
    if (f) {
        f->dim = f->axes = dim;
        f->value = f->variance = f->variation = f->lowest = f->highest = NAN;
    }
    return f;
}

koksma_status koksma_integral_open(const char *text, int dim, koksma_integral **out)
{
    KOKSMA__REQUIRE(text, out);
    char name[NAME];
    const char *rest = "";
    *out = NULL;
    KOKSMA__TRY(koksma__spec_split(text, name, &rest));
    const koksma_integrand *member = koksma_integrand_find(name);
    if (!member) {
        return koksma__fail_unknown("integrand", name, koksma_integrand_name_at, NULL,
                                    "'koksma list integrands' names them");
    }
    KOKSMA__TRY(koksma__dim_check(name, dim, member->min_dim, member->max_dim));
    koksma_integral *f = new_integral(dim);
    KOKSMA__REQUIRE_MEMORY(f, sizeof *f);
    f->integrand = member;
    f->axes = member->axes ? member->axes : dim;
    koksma_status status = koksma__params_parse(name, member->params, rest, f->params);
    status = status ? status : member->prepare(f);
    if (status) {
        koksma_integral_close(f);
        return status;
    }
    *out = f;
    return KOKSMA_OK;
}

koksma_status koksma_integral_of_function(const koksma_function *function, int dim, koksma_integral **out)
{
    KOKSMA__REQUIRE(function, out);
    *out = NULL;
    const size_t length = function->name ? strnlen(function->name, NAME) : 0;
    KOKSMA__FAIL_IF(length == 0 || length == NAME || !function->at, KOKSMA_ARGUMENT,
                    "koksma_integral_of_function: it takes a function with a name of 1 to %d characters", NAME - 1);
    const int most = function->max_dim < KOKSMA_MAX_DIM ? function->max_dim : KOKSMA_MAX_DIM;
    KOKSMA__FAIL_IF(function->min_dim < 1 || function->min_dim > most, KOKSMA_ARGUMENT,
                    "%s: min_dim %d, max_dim %d: it takes 1 <= min_dim <= max_dim", function->name, function->min_dim,
                    function->max_dim);
    KOKSMA__TRY(koksma__dim_check(function->name, dim, function->min_dim, most));
    koksma_integral *f = new_integral(dim);
    char *name = strdup(function->name);
    if (!f || !name) {
        free(f);
        free(name);
        return koksma__fail_memory(sizeof *f);
    }
    f->function = *function;
    f->function.name = name;
    f->value = function->integral;
    *out = f;
    return KOKSMA_OK;
}

void koksma_integral_close(koksma_integral *integral)
{
    if (integral) {
        KOKSMA__FREE((char *)integral->function.name, integral->factors, integral->a);
        free(integral);
    }
}

void koksma_integral_about(const koksma_integral *integral, koksma_integral_facts *facts)
{
    KOKSMA__REQUIRE_OR(, integral, facts);
    const koksma_integral *f = integral;
    *facts = (koksma_integral_facts){.dim = f->dim,
                                     .axes = f->axes,
                                     .value = f->value,
                                     .variance = f->variance,
                                     .variation = f->variation,
                                     .lowest = f->lowest,
                                     .highest = f->highest};
    snprintf(facts->text, sizeof facts->text, "%s", f->integrand ? f->integrand->name : f->function.name);
    if (f->integrand) {
        koksma__params_text(f->integrand->params, f->params, facts->text, sizeof facts->text);
    }
}

/* ---- Values ------------------------------------------------------------------------------------------------- */

typedef struct job {
    const koksma_integral *f;
    const koksma_points *points;
    double *values;    /* the value of each point, or NULL */
    koksma__sum *sums; /* the sum of each block, or NULL */
} job;

static koksma_status evaluate_block(void *context, size_t block)
{
    const job *j = context;
    const koksma_integral *f = j->f;
    const size_t first = block * BLOCK, end = first + BLOCK < j->points->n ? first + BLOCK : j->points->n;
    for (size_t i = first; i < end; i++) {
        const double *x = j->points->xs + i * (size_t)f->dim;
        const double value = f->integrand ? f->integrand->at(f, x) : f->function.at(x, f->dim, f->function.context);
        if (j->values) {
            j->values[i] = value;
        } else {
            koksma__sum_add(&j->sums[block], value);
        }
    }
    return KOKSMA_OK;
}

static koksma_status check(const koksma_integral *f, const koksma_points *points)
{
    const char *name = f->integrand ? f->integrand->name : f->function.name;
    KOKSMA__FAIL_IF(!points->xs || points->n == 0, KOKSMA_ARGUMENT, "%s: it takes 1 point or more", name);
    KOKSMA__FAIL_IF(points->dim != f->dim, KOKSMA_DIM,
                    "%s: the integrand was opened for %d dimensions, but the points have %d", name, f->dim,
                    points->dim);
    return koksma__points_check(points);
}

static koksma_status evaluate(job *j, const koksma_run *run)
{
    return koksma__parallel(run, (j->points->n + BLOCK - 1) / BLOCK, evaluate_block, j);
}

koksma_status koksma_integral_values(const koksma_integral *integral, const koksma_points *points,
                                     const koksma_run *run, double *values)
{
    KOKSMA__REQUIRE(integral, points, values);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__TRY(check(integral, points));
    job j = {integral, points, values, NULL};
    return evaluate(&j, run);
}

koksma_status koksma_integrate(const koksma_integral *integral, const koksma_points *points, const koksma_run *run,
                               double *out)
{
    KOKSMA__REQUIRE(integral, points, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__TRY(check(integral, points));
    const size_t n_blocks = points->n / BLOCK + 1;
    job j = {integral, points, NULL, calloc(n_blocks, sizeof(koksma__sum))};
    KOKSMA__REQUIRE_MEMORY(j.sums, n_blocks * sizeof *j.sums);
    const koksma_status status = evaluate(&j, run);
    koksma__sum sum = {0};
    for (size_t i = 0; i < n_blocks; i++) {
        koksma__sum_add(&sum, j.sums[i].total);
        koksma__sum_add(&sum, j.sums[i].lost);
    }
    free(j.sums);
    if (!status) {
        *out = koksma__sum_value(&sum) / (double)points->n;
    }
    return status;
}

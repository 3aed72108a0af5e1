/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_evaluate: checks the arguments on behalf of all measures, then calls the measure's own function. An
   exact value is its own lower and upper bound. */
#include <koksma/series.h>

#include <limits.h>
#include <math.h>
#include <string.h>

#include "api/api.h"
#include "core/points.h"
#include "core/spec.h"
#include "core/status.h"

koksma_status koksma__evaluate_check(const char *caller, const koksma_spec *spec, const koksma_points *points)
{
    const koksma_measure *m = spec->measure;
    KOKSMA__FAIL_IF(!m || !points->xs || points->n == 0, KOKSMA_ARGUMENT,
                    "%s: it takes the spec of a measure and at least 1 point", caller);
    KOKSMA__FAIL_IF(spec->pattern, KOKSMA_ARGUMENT,
                    "%s: the spec has a pattern and a measure; exactly one of them is not NULL", caller);
    KOKSMA__FAIL_IF(!m->name || !m->eval, KOKSMA_ARGUMENT,
                    "%s: the measure has no %s: koksma_measure_find has measures", caller, m->name ? "eval" : "name");
    koksma_status status = koksma__dim_check(m->name, points->dim, m->min_dim, m->max_dim);
    status = status ? status : koksma__params_check(m->name, m->params, spec->params);
    return status ? status : koksma__points_check(points);
}

koksma_status koksma_evaluate(const koksma_spec *spec, const koksma_points *points, const koksma_run *run,
                              koksma_value *out)
{
    KOKSMA__REQUIRE(spec, points, out);
    KOKSMA__REQUIRE_RUN(run);
    koksma_value value = {.value = NAN, .square = NAN, .lower = NAN, .upper = NAN, .exact = true};
    KOKSMA__TRY(koksma__evaluate_check("koksma_evaluate", spec, points));
    const koksma_args args = koksma__spec_arguments(spec, run);
    const char kept = koksma__call_begin();
    KOKSMA__TRY(koksma__call_end(kept, spec->measure->eval(points, &args, &value), "koksma_measure.eval"));
    if (value.exact) {
        value.lower = value.upper = value.value;
    }
    *out = value;
    return KOKSMA_OK;
}

/* ---- Arrays of NumPy --------------------------------------------------------------------------------------------- */

/* Calls koksma_evaluate and koksma_generate on the memory of a NumPy array. An array with another layout than that of
   koksma_points is rejected with KOKSMA__ARRAY_OTHER; the caller then copies it into that layout. */

static bool points_of(const koksma__array *array, int flags, koksma_points *points)
{
    flags |= KOKSMA__ARRAY_C_ORDER | KOKSMA__ARRAY_ALIGNED | KOKSMA__ARRAY_NATIVE;
    if (array->version != 2 || array->n_axes != 2 || array->kind != 'f' || array->item_size != sizeof(double) ||
        (array->flags & flags) != flags || array->shape[0] < 1 || array->shape[1] < 1 || array->shape[1] > INT_MAX) {
        return false;
    }
    *points = (koksma_points){.n = (size_t)array->shape[0], .dim = (int)array->shape[1], .xs = array->data};
    return true;
}

int koksma__evaluate_array(const koksma_spec *measure, const koksma__array *array, int threads, koksma_value *out)
{
    koksma_points points;
    const koksma_run run = {.threads = threads};
    return points_of(array, 0, &points) ? (int)koksma_evaluate(measure, &points, &run, out) : KOKSMA__ARRAY_OTHER;
}

int koksma__generate_array(const koksma_spec *pattern, uint64_t seed, const koksma__array *array, int threads)
{
    koksma_points points;
    const koksma_run run = {.threads = threads};
    return points_of(array, KOKSMA__ARRAY_WRITABLE, &points) ? (int)koksma_generate(pattern, seed, &run, &points)
                                                             : KOKSMA__ARRAY_OTHER;
}

/* ---- Prefixes and rates ------------------------------------------------------------------------------------------ */

/*
 * Convergence rates of discrepancies that follow from the claims of a pattern. (The rates that no points can exceed
 * are in lower_bounds.c.) With the exponent r, a discrepancy falls as n^-r:
 *   independent points                                  1/2: the sum of n independent terms
 *   one uniform point in each cell of a cubic grid 1/2 + 1/(2 dim): only cells that a region's boundary cuts have
 *                                                       any variance, n^(1 - 1/dim) of them (Beck and Chen 1987)
 *   one uniform point in each cell, with `columns` set  1/2: a boundary cuts a fixed share of the cells
 *   centres of a cubic grid, or near them, for boxes    1/dim: a side of a box can cut a whole layer of cells, each
 *                                                       with the same error; no rate if `columns` is set, because
 *                                                       then layers do not become thinner as n grows
 *   unbiased Latin sets without further claims          1/2: what remains is the variance that is not due to main
 *                                                       effects, that is, to functions of one coordinate (Stein 1987)
 *   nets, and Halton's sequence, for boxes              1 (Niederreiter 1992)
 */

koksma_status koksma_evaluate_prefixes(const koksma_spec *measure, const koksma_points *points, const size_t *sizes,
                                       size_t n_sizes, const koksma_run *run, koksma_value *values)
{
    KOKSMA__REQUIRE(measure, points, sizes, values);
    KOKSMA__REQUIRE_RUN(run);
    koksma_status status = koksma__evaluate_check(__func__, measure, points);
    status = status ? status : koksma__array_check("sizes", sizes, n_sizes, sizeof *values);
    for (size_t i = 0; i < n_sizes && !status; i++) {
        const koksma_points prefix = {sizes[i], points->dim, points->xs};
        KOKSMA__FAIL_IF(prefix.n == 0 || prefix.n > points->n, KOKSMA_N,
                        "prefixes: %zu points; a prefix of this set must have 1 to %zu", prefix.n, points->n);
        status = koksma_evaluate(measure, &prefix, run, &values[i]);
    }
    return status;
}

/* Returns whether the number of columns is the same for every n, so that cells become more elongated as n grows. */
static bool columns_are_given(const koksma_spec *spec)
{
    for (int k = 0; spec->pattern->params && spec->pattern->params[k].name; k++) {
        if (!strcmp(spec->pattern->params[k].name, "columns") && spec->params[k] > 0) {
            return true;
        }
    }
    return false;
}

double koksma_rate(const koksma_spec *pattern, const koksma_measure *measure, int dim)
{
    KOKSMA__REQUIRE_OR(NAN, pattern, measure);
    if (!pattern->pattern) {
        return NAN;
    }
    const bool narrow = columns_are_given(pattern);
    const unsigned left = koksma__modifiers_of_digits(pattern->modifiers) ? koksma__claims_left(pattern, 1) : ~0u;
    const unsigned claims =
        pattern->pattern->claims & left & ~(narrow ? KOKSMA_CLAIM_STRATIFIED | KOKSMA_CLAIM_GRID : 0u);
    const unsigned more = KOKSMA_CLAIM_GRID | KOKSMA_CLAIM_OA2 | KOKSMA_CLAIM_NET2 | KOKSMA_CLAIM_LATTICE;
    const unsigned nets = KOKSMA_CLAIM_NET2 | KOKSMA_CLAIM_NET2_PREFIXES | KOKSMA_CLAIM_NET_PREFIXES;
    const bool boxes = measure->family == KOKSMA_FAMILY_BOXES, unbiased = claims & KOKSMA_CLAIM_UNBIASED;
    if (measure->family == KOKSMA_FAMILY_NONE) {
        return NAN;
    }
    if (unbiased && claims & KOKSMA_CLAIM_INDEPENDENT) {
        return claims & KOKSMA_CLAIM_STRATIFIED ? 0.5 + 0.5 / dim : 0.5;
    }
    if (boxes && claims & KOKSMA_CLAIM_STRATIFIED && claims & KOKSMA_CLAIM_CENTRED) {
        return 1.0 / dim;
    }
    if (boxes && ((claims & nets && (dim == 2 || claims & KOKSMA_CLAIM_NET_PREFIXES)) ||
                  claims & KOKSMA_CLAIM_LATIN_PREFIXES)) {
        return 1;
    }
    return claims & KOKSMA_CLAIM_LATIN && unbiased && !(claims & more) && dim > 1 ? 0.5 : (double)NAN;
}

/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_evaluate: checks the arguments on behalf of all measures, then calls the measure's own function. An
   exact value is its own lower and upper bound. */
#include "api/evaluate.h"

#include <math.h>

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

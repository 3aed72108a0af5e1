/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_verify: checks one set of points for every property of properties.def and collects the findings. A property
 * adds no finding if its check would take more than about a second for this number of points and dimensions.
 * koksma_verify_sets checks the properties of many sets together.
 */
#include "verify/verify.h"

#include <stdarg.h>
#include <stdlib.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/lookup.h"
#include "core/points.h"
#include "core/status.h"

static const koksma__property *const properties[] = {
#define PROPERTY(name) &koksma__property_##name,
#include "verify/properties.def"
#undef PROPERTY
};

enum { N_PROPERTIES = sizeof properties / sizeof *properties };

const koksma_property *koksma_property_at(size_t i)
{
    return i < N_PROPERTIES ? &properties[i]->public : NULL;
}

koksma_finding *koksma__finding(koksma__verification *v)
{
    koksma_findings *all = v->findings;
    if (koksma__reserve(&all->items, &all->capacity, all->count + 1, sizeof *all->items)) {
        return NULL;
    }
    koksma_finding *f = &all->items[all->count++];
    *f = (koksma_finding){.property = v->property->public.name, .subject = "-", .detail = "-"};
    return f;
}

koksma_status koksma__add_finding(koksma__verification *v, const char *subject, double value, bool holds,
                                  const char *detail, ...)
{
    koksma_finding *f = koksma__finding(v);
    if (!f) {
        return KOKSMA_MEMORY;
    }
    snprintf(f->subject, sizeof f->subject, "%s", subject);
    f->value = value;
    f->holds = holds;
    va_list arguments;
    va_start(arguments, detail);
    koksma__vsnprintf(f->detail, sizeof f->detail, detail, arguments);
    va_end(arguments);
    return KOKSMA_OK;
}

void koksma_findings_fini(koksma_findings *findings)
{
    if (findings) {
        free(findings->items);
        *findings = (koksma_findings){0};
    }
}

koksma_status koksma_verify(const koksma_points *points, const koksma_run *run, koksma_findings *findings)
{
    KOKSMA__REQUIRE(points, findings);
    KOKSMA__REQUIRE_RUN(run);
    *findings = (koksma_findings){0};
    KOKSMA__TRY(koksma__points_check(points));
    koksma__verification v = {.points = points, .run = run, .findings = findings};
    v.counts = malloc((points->n + 1) * sizeof *v.counts);
    koksma_status status = v.counts ? KOKSMA_OK : koksma__fail_memory((points->n + 1) * sizeof *v.counts);
    for (size_t i = 0; i < N_PROPERTIES && !status; i++) {
        v.property = properties[i];
        status = v.property->public.of_sets ? KOKSMA_OK : v.property->look(&v);
    }
    free(v.counts);
    if (status) {
        koksma_findings_fini(findings);
    }
    return status;
}

koksma_status koksma_verify_sets(const koksma_points *sets, size_t n_sets, const koksma_run *run,
                                 koksma_findings *findings)
{
    KOKSMA__REQUIRE(sets, findings);
    KOKSMA__REQUIRE_RUN(run);
    *findings = (koksma_findings){0};
    KOKSMA__TRY(koksma__array_check("n_sets", sets, n_sets, sizeof *sets));
    KOKSMA__FAIL_IF(n_sets < KOKSMA_VERIFY_SETS, KOKSMA_N,
                    "verify: n_sets: %zu sets are too few for a distribution; it takes %d or more, one for each seed",
                    n_sets, KOKSMA_VERIFY_SETS);
    for (size_t i = 0; i < n_sets; i++) {
        KOKSMA__TRY(koksma__points_check(&sets[i]));
        KOKSMA__FAIL_IF(sets[i].n != sets->n || sets[i].dim != sets->dim, KOKSMA_N,
                        "verify: sets of different sizes: %zu points in %d dimensions, then %zu in %d", sets->n,
                        sets->dim, sets[i].n, sets[i].dim);
    }
    koksma__verification v = {.points = sets, .n_sets = n_sets, .run = run, .findings = findings};
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < N_PROPERTIES && !status; i++) {
        v.property = properties[i];
        status = v.property->public.of_sets && v.property->look ? v.property->look(&v) : KOKSMA_OK;
    }
    if (status) {
        koksma_findings_fini(findings);
    }
    return status;
}

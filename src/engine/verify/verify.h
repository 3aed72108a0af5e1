/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The interface of the properties that koksma_verify (verify.c) checks. Each line of properties.def names a
 * koksma__property, whose function looks at one set of points and adds its findings; koksma_verify calls these
 * functions in the order of the lines.
 */
#ifndef KOKSMA_VERIFY_VERIFY_H
#define KOKSMA_VERIFY_VERIFY_H

#include <koksma/verify.h>

typedef struct koksma__verification {
    const koksma_points *points; /* the set or, of properties of sets, the first of n_sets */
    size_t n_sets;
    const koksma_run *run;
    const struct koksma__property *property; /* the property being checked */
    koksma_findings *findings;
    uint32_t *counts; /* scratch memory: n + 1 numbers */
} koksma__verification;

typedef struct koksma__property {
    koksma_property public;
    /* Adds findings with koksma__finding; adds none where the property does not apply to this number of points or
     * dimensions. NULL: the property before adds its findings. */
    koksma_status (*look)(koksma__verification *v);
    size_t base; /* the B of net-base-B; unused by other properties */
} koksma__property;

#define PROPERTY(name) extern const koksma__property koksma__property_##name;
#include "verify/properties.def"
#undef PROPERTY

/* Adds a finding of v->property, with subject and detail "-", and returns it; returns NULL when memory runs out. */
koksma_finding *koksma__finding(koksma__verification *v);

/* Adds a finding with this subject, value, result and detail. Errors: MEMORY. */
koksma_status koksma__add_finding(koksma__verification *v, const char *subject, double value, bool holds,
                                  const char *detail, ...) KOKSMA_PRINTF(5, 6);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Verified properties: a line of properties.def is a koksma__property, which looks at one set of points and adds its
 * findings. koksma_verify (verify.c) asks all of them in the order of the lines.
 */
#ifndef KOKSMA_VERIFY_VERIFY_H
#define KOKSMA_VERIFY_VERIFY_H

#include <koksma/verify.h>

typedef struct koksma__verification {
    const koksma_points *points;
    const koksma_run *run;
    const struct koksma__property *property; /* the one that is looked for */
    koksma_findings *findings;
    uint32_t *counts; /* scratch: n + 1 numbers */
} koksma__verification;

typedef struct koksma__property {
    koksma_property public;
    /* Adds findings by koksma__finding, or none where the property is not for so many points or dimensions. */
    koksma_status (*look)(koksma__verification *v);
    size_t base; /* of net-base-B */
} koksma__property;

#define PROPERTY(name) extern const koksma__property koksma__property_##name;
#include "verify/properties.def"
#undef PROPERTY

/* Adds a finding of the property that is looked for: subject and detail "-"; NULL when memory runs out. */
koksma_finding *koksma__finding(koksma__verification *v);

#endif

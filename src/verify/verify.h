/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_VERIFY_VERIFY_H
#define KOKSMA_VERIFY_VERIFY_H

#include <koksma/verify.h>

typedef enum koksma__property {
#define PROPERTY(id, name) KOKSMA__PROPERTY_##id,
#include "verify/properties.def"
#undef PROPERTY
    KOKSMA__N_PROPERTIES
} koksma__property;

/* Adds an empty finding; NULL when memory runs out. */
koksma_finding *koksma__finding(koksma_findings *findings, koksma__property property);

/* The findings of their kind; counts has room for n + 1 numbers. */
koksma_status koksma__verify_nets(const koksma_points *points, const koksma_run *run, koksma_findings *findings);
koksma_status koksma__verify_strata(const koksma_points *points, uint32_t *counts, koksma_findings *findings);
koksma_status koksma__verify_distances(const koksma_points *points, const koksma_run *run, koksma_findings *findings);

#endif

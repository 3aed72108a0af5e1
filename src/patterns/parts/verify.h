/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_PARTS_VERIFY_H
#define KOKSMA_PATTERNS_PARTS_VERIFY_H

#include <koksma/verify.h>

typedef enum koksma__property {
#define PROPERTY(id, name) KOKSMA__PROPERTY_##id,
#include "patterns/parts/properties.def"
#undef PROPERTY
    KOKSMA__N_PROPERTIES
} koksma__property;

/* Adds an empty finding; NULL when memory runs out. */
koksma_finding *koksma__finding(koksma_findings *findings, koksma__property property);

/* The stratum of x among m, bounded by the doubles nearest to j/m. x = 1 is in the last. */
size_t koksma__stratum(double x, size_t m);

/* How many of the cells with m[k] strata along coordinate use[k] hold a number of points other than `each`, among the
   first n points; at most `enough` are counted. counts has room for the cells. */
size_t koksma__wrong_cells(const koksma_points *points, size_t n, const int *use, const size_t *m, int dim,
                           uint32_t each, size_t enough, uint32_t *counts);

/* The findings of their kind; counts has room for n + 1 numbers. */
koksma_status koksma__verify_nets(const koksma_points *points, const koksma_run *run, uint32_t *counts,
                                  koksma_findings *findings);
koksma_status koksma__verify_strata(const koksma_points *points, uint32_t *counts, koksma_findings *findings);
koksma_status koksma__verify_distances(const koksma_points *points, const koksma_run *run, koksma_findings *findings);

#endif

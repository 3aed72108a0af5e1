/* SPDX-License-Identifier: Apache-2.0 */
/* Rank correlations of measures with errors, and their means over cases: which measure's is the largest, and which
   are not told apart. All cases are resampled together. */
#ifndef KOKSMA_STUDY_RHO_MEANS_H
#define KOKSMA_STUDY_RHO_MEANS_H

#include "study/answers.h"

/* Combinations of options beyond these have no column of their own. */
enum { KOKSMA__RHO_VARIANTS = 24, KOKSMA__RHO_SAMPLES = 1000 };

/* Sums of rho of one measure, by variant. */
typedef struct koksma__rho_sums {
    const char *measure;
    double total, rho[KOKSMA__RHO_VARIANTS];
    size_t all, cases[KOKSMA__RHO_VARIANTS];
    size_t sure;         /* cases whose interval excludes 0 */
    size_t few, perfect; /* without one: of too few patterns, in perfect order */
    double *draws;       /* sums of rho in each resample */
} koksma__rho_sums;

typedef struct koksma__rho_means {
    size_t n, room, n_variants, room_of_variants;
    koksma__rho_sums *of;
    const char **variants;
} koksma__rho_means;

/* A correlation of so many patterns as it is shown and counted: an interval of too few patterns, or without width,
   says nothing and becomes NaN. */
koksma__estimate koksma__rho_shown(const koksma__estimate *rho, size_t n_patterns);

/* Adds a case of a measure and of a combination of options, which must outlive the means: rho as it is shown, with
   its resamples, of so many patterns. Errors: MEMORY. */
koksma_status koksma__rho_add(koksma__rho_means *s, const char *measure, const char *variant,
                              const koksma__estimate *rho, const double draws[KOKSMA__RHO_SAMPLES],
                              size_t n_patterns);

/* Sorts them, best first. */
void koksma__rho_order(koksma__rho_means *s);

/* The sentence, and the table of all measures, once they are in their order. */
koksma_status koksma__rho_sentence(koksma__html *h, const koksma__rho_means *s);
koksma_status koksma__rho_table(koksma__html *h, const char *id, const koksma__rho_means *s);

void koksma__rho_fini(koksma__rho_means *s);

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Rank correlations of measures with errors: sums by measure, scene and number of samples, from which means over any
   scenes can be had. All cases are resampled together, so that means of the same resamples can be compared. */
#ifndef KOKSMA_STUDY_REPORT_RHO_MEANS_H
#define KOKSMA_STUDY_REPORT_RHO_MEANS_H

#include "stats/statistics.h"

/* Combinations of options beyond these have no column of their own. Holm's correction over the 45 pairs of ten measures
   looks at p of .0011: with 4,000 resamples that is two or three of them, and which differences were sure changed with the
   resamples' seed; with 20,000 it is eleven. */
enum { KOKSMA__RHO_VARIANTS = 24, KOKSMA__RHO_SAMPLES = 20000 };

/* Cases of a measure in one scene with one number of samples. */
typedef struct koksma__rho_cell {
    size_t scene;
    long long spp;
    size_t all, few; /* cases, and those of too few patterns for an interval */
    double total;    /* sum of rho */
    double *draws;   /* sums of rho in each resample */
} koksma__rho_cell;

/* Sums of rho of one measure. */
typedef struct koksma__rho_sums {
    const char *measure;
    double total, rho[KOKSMA__RHO_VARIANTS];
    size_t all, cases[KOKSMA__RHO_VARIANTS];
    size_t sure;         /* cases whose interval excludes 0 */
    size_t few, perfect; /* without one: of too few patterns, in perfect order */
    size_t n_cells, room_of_cells;
    koksma__rho_cell *cells;
} koksma__rho_sums;

typedef struct koksma__rho_means {
    size_t n, room, n_variants, room_of_variants, n_scenes, room_of_scenes, n_sizes, room_of_sizes;
    koksma__rho_sums *of;
    const char **variants, **scenes;
    long long *sizes; /* numbers of samples a pixel */
} koksma__rho_means;

/* Where a correlation comes from; the texts must outlive the means. */
typedef struct koksma__rho_source {
    const char *measure, *scene, *variant;
    long long spp;
    size_t n_patterns;
} koksma__rho_source;

/* A correlation of so many patterns as it is shown and counted: an interval of too few patterns, or without width,
   says nothing and becomes NaN. */
koksma__estimate koksma__rho_shown(const koksma__estimate *rho, size_t n_patterns);

/* Adds a case: rho as it is shown, with its resamples; of a measure that is better when larger both with the other
   sign. Errors: MEMORY. */
koksma_status koksma__rho_add(koksma__rho_means *s, const koksma__rho_source *source, const koksma__estimate *rho,
                              const double draws[KOKSMA__RHO_SAMPLES]);

/* Sorts the measures by their mean over all cases, the largest first, equal ones in the plan's order; and the numbers
   of samples. */
void koksma__rho_order(koksma__rho_means *s);

void koksma__rho_fini(koksma__rho_means *s);

#endif

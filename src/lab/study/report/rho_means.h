/* SPDX-License-Identifier: Apache-2.0 */
/* Rank correlations of measures with image errors: sums by measure, scene and number of samples, from which means
   over any set of scenes can be computed. All cases are resampled together, so that the means of two measures can be
   compared resample by resample. */
#ifndef KOKSMA_STUDY_REPORT_RHO_MEANS_H
#define KOKSMA_STUDY_REPORT_RHO_MEANS_H

#include "stats/stats.h"

/* KOKSMA__RHO_VARIANTS: the number of combinations of options that have a column in a table. KOKSMA__RHO_SAMPLES:
   the number of bootstrap resamples. With ten measures, Holm's correction compares the smallest p-value of the 45
   pairs with 0.05 / 45 = .0011. With 4,000 resamples, two or three resamples decide whether p is below this limit,
   and which differences were significant changed with the seed; with 20,000 resamples, eleven decide. */
enum { KOKSMA__RHO_VARIANTS = 24, KOKSMA__RHO_SAMPLES = 20000 };

/* Sums over the cases of a measure in one scene with one number of samples. */
typedef struct koksma__rho_cell {
    size_t scene;
    long long spp;
    size_t all, few; /* number of cases, and of those with too few patterns for an interval */
    double total;    /* sum of rho over the cases */
    double *draws;   /* sum of rho over the cases, for each resample */
} koksma__rho_cell;

/* Sums of rho of one measure. */
typedef struct koksma__rho_sums {
    const char *measure;
    double total, rho[KOKSMA__RHO_VARIANTS];
    size_t all, cases[KOKSMA__RHO_VARIANTS];
    size_t sure; /* number of cases whose interval excludes 0 */
    /* numbers of cases without an interval: those with too few patterns, and those in perfect order */
    size_t few, perfect;
    size_t n_cells;
    koksma__rho_cell *cells;
} koksma__rho_sums;

typedef struct koksma__rho_means {
    size_t n, n_variants, n_scenes, n_sizes;
    koksma__rho_sums *of;
    const char **variants, **scenes;
    long long *sizes;      /* numbers of samples per pixel */
    const koksma_run *run; /* whose keep_going rankings call; may be NULL */
} koksma__rho_means;

/* The case that a correlation belongs to; the strings must outlive the means. */
typedef struct koksma__rho_source {
    const char *measure, *scene, *variant;
    long long spp;
    size_t n_patterns;
} koksma__rho_source;

/* Returns a correlation over n_patterns patterns as tables show it: its interval becomes NaN if it has no meaning,
   because there are fewer than KOKSMA__LEAST_PAIRS patterns or its width is 0. */
koksma__estimate koksma__rho_shown(const koksma__estimate *rho, size_t n_patterns);

/* Adds a case: rho from koksma__rho_shown, and its resamples. For a measure that is better when larger, the caller
   reverses the sign of rho and of its resamples. Errors: MEMORY. */
koksma_status koksma__rho_add(koksma__rho_means *s, const koksma__rho_source *source, const koksma__estimate *rho,
                              const double draws[KOKSMA__RHO_SAMPLES]);

/* Sorts the measures by their mean over all cases, the largest first and equal means in the plan's order, and sorts
   the numbers of samples. */
void koksma__rho_order(koksma__rho_means *s);

void koksma__rho_fini(koksma__rho_means *s);

#endif

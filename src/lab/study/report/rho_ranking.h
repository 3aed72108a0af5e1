/* SPDX-License-Identifier: Apache-2.0 */
/* Ranks the measures by their mean rank correlations over some of the cases, tests which of them differ
   significantly, and finds which statements hold whichever one scene is left out. */
#ifndef KOKSMA_STUDY_REPORT_RHO_RANKING_H
#define KOKSMA_STUDY_REPORT_RHO_RANKING_H

#include "study/report/rho_means.h"

/* A subset of the cases. scenes: whether each scene is in it; NULL: all scenes. spp: the number of samples; 0:
   all. */
typedef struct koksma__rho_subset {
    const bool *scenes;
    long long spp;
} koksma__rho_subset;

typedef struct koksma__rho_standing {
    size_t measure; /* index of the measure in koksma__rho_means */
    size_t cases;
    koksma__estimate mean; /* the mean with its interval, which is NaN if a case has too few patterns */
    koksma__estimate less; /* the mean minus that of the first measure */
    double p;              /* p-value of "the mean is 0", adjusted by Holm over the measures */
} koksma__rho_standing;

typedef struct koksma__rho_ranking {
    size_t n;                 /* number of measures that have cases in the subset */
    size_t n_pairs;           /* number of compared pairs: both measures have intervals and equally many cases */
    koksma__rho_standing *at; /* sorted by mean, the largest first */
    size_t *place;            /* for each measure, its index in `at`; n: it has no cases in the subset */
    double *p;                /* n x n p-values of "the means are equal", by Holm over the pairs; NaN: not compared */
} koksma__rho_ranking;

/* Ranks the measures over a subset of the cases. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__rho_rank(const koksma__rho_means *s, const koksma__rho_subset *of,
                               koksma__rho_ranking *ranking);
void koksma__rho_ranking_fini(koksma__rho_ranking *ranking);

/* koksma__rho_is_better: whether measure a has a significantly larger mean than measure b (at 5 % for all pairs
   together). koksma__rho_predicts: whether a measure's mean is significantly above 0 (at 5 % for all measures
   together). Measures are indices in koksma__rho_means. */
bool koksma__rho_is_better(const koksma__rho_ranking *ranking, size_t a, size_t b);
bool koksma__rho_predicts(const koksma__rho_ranking *ranking, size_t measure);

/* Rankings over all scenes, and over all scenes but one: of[0] includes all scenes, of[1 + s] all but scene s. If
   there is only one scene, there is only of[0]. */
typedef struct koksma__rho_jackknife {
    size_t n;
    koksma__rho_ranking *of;
} koksma__rho_jackknife;

/* Computes the rankings over all scenes and without each of them. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__rho_leave_out(const koksma__rho_means *s, koksma__rho_jackknife *jackknife);
void koksma__rho_jackknife_fini(koksma__rho_jackknife *jackknife);

/* Whether a statement holds over all scenes and whichever one scene is left out: a is significantly better than b; a
   measure's mean is significantly above 0; a measure is the first by its mean; a measure is the last. */
bool koksma__rho_always_better(const koksma__rho_jackknife *jackknife, size_t a, size_t b);
bool koksma__rho_always_predicts(const koksma__rho_jackknife *jackknife, size_t measure);
bool koksma__rho_always_first(const koksma__rho_jackknife *jackknife, size_t measure);
bool koksma__rho_always_last(const koksma__rho_jackknife *jackknife, size_t measure);

/* The mean over all scenes, and the range of a measure's mean over the rankings of a jackknife. */
koksma__estimate koksma__rho_range(const koksma__rho_jackknife *jackknife, size_t measure);

#endif

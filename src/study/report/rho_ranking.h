/* SPDX-License-Identifier: Apache-2.0 */
/* The measures in the order of their mean rank correlations over some of the cases, and which of them surely differ;
   and what of that holds whichever one scene is left out. */
#ifndef KOKSMA_STUDY_REPORT_RHO_RANKING_H
#define KOKSMA_STUDY_REPORT_RHO_RANKING_H

#include "study/report/rho_means.h"

/* Which cases: those of scenes[scene], NULL: of all; spp 0: of all numbers of samples. */
typedef struct koksma__rho_subset {
    const bool *scenes;
    long long spp;
} koksma__rho_subset;

typedef struct koksma__rho_standing {
    size_t measure; /* its number in the means */
    size_t cases;
    koksma__estimate mean; /* interval NaN: a case has too few patterns */
    koksma__estimate less; /* the mean less the first's */
    double p;              /* that the mean is 0; by Holm over the measures */
} koksma__rho_standing;

typedef struct koksma__rho_ranking {
    size_t n;       /* measures that have such cases */
    size_t n_pairs; /* compared pairs of measures: those whose numbers of cases and of intervals are equal */
    koksma__rho_standing *at; /* by mean, the largest first */
    double *p;                /* n x n: that two means are equal, by Holm over the pairs; NaN: not compared */
} koksma__rho_ranking;

/* Errors: MEMORY. */
koksma_status koksma__rho_rank(const koksma__rho_means *s, const koksma__rho_subset *of,
                               koksma__rho_ranking *ranking);
void koksma__rho_ranking_fini(koksma__rho_ranking *ranking);

/* Whether measure a surely has the larger mean than b (at 5 % for all pairs together); whether a measure's mean is
   surely above 0 (at 5 % for all measures together). Numbers of measures in the means. */
bool koksma__rho_is_better(const koksma__rho_ranking *ranking, size_t a, size_t b);
bool koksma__rho_predicts(const koksma__rho_ranking *ranking, size_t measure);

/* Rankings over all scenes, and over all but one of them: of[0] is over all, of[1 + s] without scene s. Of one scene
   there is of[0] alone. */
typedef struct koksma__rho_jackknife {
    size_t n;
    koksma__rho_ranking *of;
} koksma__rho_jackknife;

/* Errors: MEMORY. */
koksma_status koksma__rho_leave_out(const koksma__rho_means *s, koksma__rho_jackknife *jackknife);
void koksma__rho_jackknife_fini(koksma__rho_jackknife *jackknife);

/* What holds over all scenes and whichever one is left out: that a is surely better than b; that a measure surely
   predicts; that a measure has the place (0: the first) by its mean, or the last one. */
bool koksma__rho_always_better(const koksma__rho_jackknife *jackknife, size_t a, size_t b);
bool koksma__rho_always_predicts(const koksma__rho_jackknife *jackknife, size_t measure);
bool koksma__rho_always_first(const koksma__rho_jackknife *jackknife, size_t measure);
bool koksma__rho_always_last(const koksma__rho_jackknife *jackknife, size_t measure);

/* The range of a measure's mean over those rankings. */
koksma__estimate koksma__rho_range(const koksma__rho_jackknife *jackknife, size_t measure);

#endif

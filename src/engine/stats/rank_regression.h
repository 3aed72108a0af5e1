/* SPDX-License-Identifier: Apache-2.0 */
/* Finds which combination of measures predicts the error in an unseen scene: the ranks of the patterns' errors are
   regressed on the ranks of their measures, with cross-validation over scenes. */
#ifndef KOKSMA_STATS_RANK_REGRESSION_H
#define KOKSMA_STATS_RANK_REGRESSION_H

#include <koksma/koksma.h>

/* A case: n patterns in one scene, each with the values of k measures and an error. */
typedef struct koksma__rank_case {
    size_t scene, n;
    /* k + 1 lists of n unit ranks (koksma__unit_ranks): one list for each measure, then one for the error */
    double *ranks;
} koksma__rank_case;

/* Prediction of one scene's errors by models fitted to all other scenes: the models, and the mean Spearman
   correlation between the order that each predicts and the order of the errors. */
typedef struct koksma__held_out {
    size_t cases;   /* number of the scene's cases; 0: the other members are not set */
    size_t single;  /* the measure that the other scenes select */
    size_t pair[2]; /* the pair that the other scenes select; with k = 1, both are `single` */
    /* Penalty of the ridge regression on all measures. Aligned to 8 bytes on all machines, so that the struct is an
       array of doubles. */
    _Alignas(8) double penalty;
    /* the measure that is best in the scene itself, which is chosen in hindsight and thus no prediction;
       rho_hindsight is its correlation with the error */
    size_t hindsight;
    double rho_single, rho_pair, rho_all, rho_hindsight;
} koksma__held_out;

/* Predicts the errors in each of n_scenes scenes from all other scenes, which have equal weight. At least 3 scenes
   must have cases. `out` receives one result for each scene. Calls run->keep_going from time to time, always
   with the fraction 0; run may be NULL. Errors: ARGUMENT (fewer than 3 scenes with cases), MEMORY, INTERRUPTED. */
koksma_status koksma__rank_regression(const koksma__rank_case *cases, size_t n_cases, size_t k, size_t n_scenes,
                                      const koksma_run *run, koksma__held_out *out);

#endif

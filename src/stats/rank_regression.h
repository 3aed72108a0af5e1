/* SPDX-License-Identifier: Apache-2.0 */
/* Which combination of measures predicts the error in a scene that it has not seen: regression of the ranks of
   patterns' errors on the ranks of their measures, cross-validated over scenes. */
#ifndef KOKSMA_STATS_RANK_REGRESSION_H
#define KOKSMA_STATS_RANK_REGRESSION_H

#include <koksma/koksma.h>

/* A case: n patterns with k measures each. */
typedef struct koksma__rank_case {
    size_t scene, n;
    double *ranks; /* k lists of n unit ranks (koksma__unit_ranks), a measure's after another's; then the error's */
} koksma__rank_case;

/* Prediction of one scene's errors by models that were fitted to all other scenes: the models, and the mean Spearman
   correlation of each one's predicted order with the order of the errors. */
typedef struct koksma__held_out {
    size_t cases;               /* 0: nothing else of this is set */
    size_t single;              /* the measure chosen in the other scenes */
    size_t pair[2];             /* the pair; without one (k = 1) twice the single */
    _Alignas(8) double penalty; /* of the ridge regression on all measures; aligned also where a double needs less, so
                                   that statistics can step over results by doubles */
    size_t hindsight; /* the single measure that is best in this very scene, and its correlation: no prediction */
    double rho_single, rho_pair, rho_all, rho_hindsight;
} koksma__held_out;

/* Predicts each of n_scenes scenes, 3 or more with cases, from the others, which all count alike. out: a result a
   scene. Errors: ARGUMENT for fewer scenes, MEMORY. */
koksma_status koksma__rank_regression(const koksma__rank_case *cases, size_t n_cases, size_t k, size_t n_scenes,
                                      koksma__held_out *out);

#endif

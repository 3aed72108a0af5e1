/* SPDX-License-Identifier: Apache-2.0 */
/* latin-hypercube: another name of the pattern n-rooks, used in statistics (McKay, Beckman & Conover 1979); n_rooks.c
   generates the points. */
#include "patterns/patterns.h"

const koksma_pattern koksma__pattern_latin_hypercube = {
    .name = "latin-hypercube",
    .title = "another name for n-rooks",
    .cite = "mckay1979",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_LATIN | KOKSMA_CLAIM_UNBIASED,
    .alias_of = "n-rooks",
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * random: every point is independent and uniform in [0,1)^dim. The baseline of all comparisons.
 *
 *     x_k = u_k,   u uniform in [0,1)^dim, a hash of seed, point and coordinate
 *
 * Source: Shirley 1991, section 5.5.1; Mitchell 1992 calls it Poisson.
 * Known exactly: E(S^2) = (2^-dim - 3^-dim) / n for the L2 star discrepancy S.
 */
#include "patterns/grids/grids.h"
#include "patterns/patterns.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const uint64_t dim = (uint64_t)out->dim;
    return koksma__range_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, args->first * dim, out->n * (size_t)dim,
                                 out->xs);
}

const koksma_pattern koksma__pattern_random = {
    .name = "random",
    .title = "independent uniform points",
    .cite = "shirley1991 mitchell1992",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_UNBIASED | KOKSMA_CLAIM_EXCHANGEABLE |
              KOKSMA_CLAIM_INDEPENDENT,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

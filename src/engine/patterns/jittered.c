/* SPDX-License-Identifier: Apache-2.0 */
/*
 * jittered: one uniform point in each of the m^dim cells of a grid; in 2D also m x n cells.
 *
 *     x_k = (c_k + u_k) / m,   c in {0 .. m-1}^dim, u uniform in [0,1)^dim
 *
 * Source: Cook, Porter & Carpenter 1984; Shirley 1991, section 5.5.3: classical stratified sampling.
 * Known exactly, m x m points in 2D: E(S^2) = ((m-1)/6 + 5/36) / m^4 for the L2 star discrepancy S.
 */
#include "patterns/grids/grids.h"
#include "patterns/patterns.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    return koksma__fill_cells("jittered", seed, args, 1, out);
}

static const koksma_param params[] = {KOKSMA__PARAM_COLUMNS, {0}};

const koksma_pattern koksma__pattern_jittered = {
    .name = "jittered",
    .title = "a uniform point in each cell of a grid",
    .cite = "cook1984 shirley1991",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_STRATIFIED | KOKSMA_CLAIM_UNBIASED | KOKSMA_CLAIM_INDEPENDENT,
    .params = params,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

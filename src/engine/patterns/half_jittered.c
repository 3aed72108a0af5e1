/* SPDX-License-Identifier: Apache-2.0 */
/*
 * half-jittered: one point in the middle half of each cell of a grid. The points form fewer clusters than jittered
 * ones, but have more aliasing. The points are biased, because no point is in the outer parts of the cells.
 *
 *     x_k = (c_k + 1/4 + u_k/2) / m,   c in {0 .. m-1}^dim, u uniform in [0,1)^dim
 *
 * Source: Shirley 1991, section 5.5.3 and figure 5.19 ("semijittered, 0.5 maximum shift").
 */
#include "patterns/grids/grids.h"
#include "patterns/patterns.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    return koksma__fill_cells("half-jittered", seed, args, 0.5, out);
}

static const koksma_param params[] = {KOKSMA__PARAM_COLUMNS, {0}};

const koksma_pattern koksma__pattern_half_jittered = {
    .name = "half-jittered",
    .title = "a uniform point in the middle half of each cell of a grid",
    .cite = "shirley1991",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_STRATIFIED | KOKSMA_CLAIM_CENTRED | KOKSMA_CLAIM_INDEPENDENT,
    .params = params,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

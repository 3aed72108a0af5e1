/* SPDX-License-Identifier: Apache-2.0 */
/*
 * poisson-time: jittered x and y with an independent uniform time, as in a renderer that stratifies only the
 * positions in a pixel.
 *
 *     x, y as in jittered;   t uniform in [0,1)
 *
 * Source: Mitchell 1992, table 2 ("Poisson-Time").
 * Known exactly, n = m^2: E(S^2) = ((m-1)^2/24 + 5(m-1)/36 + 19/216) / n^2 for the L2 star discrepancy S.
 */
#include "patterns/grids/grids.h"
#include "patterns/patterns.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    return koksma__fill_jittered_time("poisson-time", seed, args, out);
}

static const koksma_param params[] = {KOKSMA__PARAM_COLUMNS, {0}};

const koksma_pattern koksma__pattern_poisson_time = {
    .name = "poisson-time",
    .title = "jittered x and y with random times",
    .cite = "mitchell1992",
    .min_dim = 3,
    .max_dim = 3,
    .claims = KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};

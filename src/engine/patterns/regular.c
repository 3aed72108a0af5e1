/* SPDX-License-Identifier: Apache-2.0 */
/*
 * regular: the centres of the m^dim cells of a grid; in 2D also m x n cells.
 *
 *     x_k = (c_k + 1/2) / m,   c in {0 .. m-1}^dim
 *
 * Source: Shirley 1991, section 5.5.2. Shirley's discrepancy of 16 points, D = 15/64 = 0.234, shows that the points
 * are the cells' centres: corners give 0.4375.
 * Known exactly, 4 x 4: D = 15/64, T = 7/16, S^2 = 1/9 - 2 (43/128)^2 + (11/32)^2.
 */
#include "patterns/grids/grids.h"
#include "patterns/patterns.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    return koksma__fill_cells("regular", seed, args, 0, out);
}

static const koksma_param params[] = {KOKSMA__PARAM_COLUMNS, {0}};

const koksma_pattern koksma__pattern_regular = {
    .name = "regular",
    .title = "centres of the cells of a grid",
    .cite = "shirley1991",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_STRATIFIED | KOKSMA_CLAIM_CENTRED,
    .params = params,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

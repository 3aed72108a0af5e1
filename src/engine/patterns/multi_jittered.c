/* SPDX-License-Identifier: Apache-2.0 */
/*
 * multi-jittered: points that are jittered and n-rooks at the same time: one point in each of the m x r cells, and
 * one in each of the n = m r strata of each axis.
 *
 *     x = (c + (p_c(j) + u) / r) / m,   y = (j + (q_j(c) + v) / m) / r
 *
 * where c is the column, j the row, p_c a random permutation of the rows for each column and q_j one of the columns
 * for each row.
 * Source: Chiu, Shirley & Wang 1994. columns=0 takes the largest divisor of n that is at most sqrt(n).
 */
#include <stdlib.h>

#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/grids/grids.h"
#include "patterns/patterns.h"

enum { FEW = 256 };

static void place(uint64_t seed, size_t columns, size_t rows, uint32_t *permutation, koksma_points *out)
{
    const double n = (double)out->n;
    for (size_t c = 0; c < columns; c++) {
        koksma__kernels()->permutation(seed, 2 * (uint32_t)c, (uint32_t)rows, permutation);
        for (size_t j = 0; j < rows; j++) {
            double *x = out->xs + 2 * (c * rows + j);
            *x = koksma__in_cell((double)(c * rows + permutation[j]), *x, n);
        }
    }
    for (size_t j = 0; j < rows; j++) {
        koksma__kernels()->permutation(seed, 2 * (uint32_t)j + 1, (uint32_t)columns, permutation);
        for (size_t c = 0; c < columns; c++) {
            double *y = out->xs + 2 * (c * rows + j) + 1;
            *y = koksma__in_cell((double)(j * columns + permutation[c]), *y, n);
        }
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    size_t columns, rows;
    KOKSMA__TRY(koksma__divisors("multi-jittered", out->n, args->params[0], &columns, &rows));
    KOKSMA__TRY(koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, 2 * out->n, out->xs));
    uint32_t few[FEW];
    const size_t most = columns > rows ? columns : rows;
    uint32_t *permutation = most <= FEW ? few : malloc(most * sizeof *permutation);
    KOKSMA__REQUIRE_MEMORY(permutation, most * sizeof *permutation);
    place(seed, columns, rows, permutation, out);
    if (permutation != few) {
        free(permutation);
    }
    return KOKSMA_OK;
}

static const koksma_param params[] = {KOKSMA__PARAM_DIVISOR, {0}};

const koksma_pattern koksma__pattern_multi_jittered = {
    .name = "multi-jittered",
    .title = "points that are both jittered and n-rooks",
    .cite = "chiu1994",
    .min_dim = 2,
    .max_dim = 2,
    .claims =
        KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_LATIN | KOKSMA_CLAIM_GRID | KOKSMA_CLAIM_STRATIFIED | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};

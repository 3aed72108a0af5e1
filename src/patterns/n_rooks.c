/* SPDX-License-Identifier: Apache-2.0 */
/*
 * n-rooks: each coordinate is jittered in n strata, and the strata of the coordinates are put together by
 * independent random permutations, so that every row and column of the n x n grid holds one point. Any n, any
 * dimension. Statistics calls it Latin hypercube sampling.
 *
 *     x_k = (p_k(i) + u_k) / n,   p_0 the identity, p_k random permutations, u uniform in [0,1)^dim
 *
 * Source: Shirley 1991, section 5.5.5 ("separate", "uncorrelated jitter"); McKay, Beckman & Conover 1979.
 * Known exactly, 2D: E(S^2) = (n + 5 - 1/n) / (36 n^2) for the L2 star discrepancy S: O(n^-1/2), but with the
 * constant 1/6 where random points have 0.373.
 */
#include <stdlib.h>

#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/parts/cells.h"
#include "patterns/parts/fill.h"
#include "patterns/patterns.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t n = out->n, dim = (size_t)out->dim;
    koksma_status status = koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, n * dim, out->xs);
    if (status) {
        return status;
    }
    uint32_t few[256];
    uint32_t *permutation = n <= 256 ? few : malloc(n * sizeof *permutation);
    if (!permutation) {
        return koksma__fail_memory(n * sizeof *permutation);
    }
    if (dim == 2) {
        koksma__fill_permutation(seed, 1, (uint32_t)n, permutation);
        koksma__kernels()->rooks_2d(permutation, n, out->xs);
    }
    for (size_t k = 0; dim != 2 && k < dim; k++) {
        if (k) {
            koksma__fill_permutation(seed, (uint32_t)k, (uint32_t)n, permutation);
        }
        for (size_t i = 0; i < n; i++) {
            double *x = &out->xs[i * dim + k];
            *x = koksma__in_cell((double)(k ? permutation[i] : i), *x, (double)n);
        }
    }
    if (permutation != few) {
        free(permutation);
    }
    return KOKSMA_OK;
}

const koksma_pattern koksma__pattern_n_rooks = {
    .name = "n-rooks",
    .title = "one point in each row and column of an n x n grid",
    .cite = "shirley1991 mckay1979",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_LATIN | KOKSMA_CLAIM_UNBIASED,
    .generate = generate,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * n-rooks: each coordinate is jittered in n strata, and independent random permutations pair the strata of the
 * coordinates, so that every row and column of the n x n grid has one point. The pattern takes any n and any
 * dimension. Statistics calls the method Latin hypercube sampling.
 *
 *     x_k = (p_k(i) + u_k) / n,   p_0 the identity, p_k random permutations, u uniform in [0,1)^dim
 *
 * Source: Shirley 1991, section 5.5.5 ("separate", "uncorrelated jitter"); McKay, Beckman & Conover 1979.
 * Known exactly, 2D: E(S^2) = (n + 5 - 1/n) / (36 n^2) for the L2 star discrepancy S: the root mean square falls as
 * n^-1/2, as for random points, but with the constant 1/6 in place of 0.373.
 */
#include <stdlib.h>

#include "core/platform/system.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/grids/grids.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { FEW = 256 };

/* The arguments that the callback `place` needs. In 2D each jitter u has 32 bits, so that one draw of 128 random bits
   makes two points. */
typedef struct plane {
    uint64_t seed;
    const uint32_t *rows;
} plane;

static void place(const void *context, size_t first, size_t count, bool stream, koksma_points *out)
{
    const plane *p = context;
    (void)stream;
    koksma__kernels()->rooks_2d(p->seed, p->rows + first, first, count, out->n, out->xs + 2 * first);
}

static koksma_status fill_plane(uint64_t seed, const koksma_run *run, uint32_t *rows, koksma_points *out)
{
    const plane p = {seed, rows};
    koksma__kernels()->permutation(seed, 1, (uint32_t)out->n, rows);
    return koksma__fill_rows(run, out, place, &p);
}

static koksma_status fill_space(uint64_t seed, const koksma_run *run, uint32_t *permutation, koksma_points *out)
{
    const size_t n = out->n, dim = (size_t)out->dim;
    const koksma_status status = koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, run, n * dim, out->xs);
    for (size_t k = 0; !status && k < dim; k++) {
        if (k) {
            koksma__kernels()->permutation(seed, (uint32_t)k, (uint32_t)n, permutation);
        }
        for (size_t i = 0; i < n; i++) {
            double *x = &out->xs[i * dim + k];
            *x = koksma__in_cell((double)(k ? permutation[i] : i), *x, (double)n);
        }
    }
    return status;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    uint32_t few[FEW], *permutation = out->n <= FEW ? few : malloc(out->n * sizeof *permutation);
    KOKSMA__REQUIRE_MEMORY(permutation, out->n * sizeof *permutation);
    koksma__large_pages(permutation, out->n * sizeof *permutation);
    const koksma_status status =
        out->dim == 2 ? fill_plane(seed, args->run, permutation, out) : fill_space(seed, args->run, permutation, out);
    if (permutation != few) {
        free(permutation);
    }
    return status;
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

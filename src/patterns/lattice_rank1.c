/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lattice-rank1: the rank-1 lattice built component by component: each z_k is the multiplier with the lowest
 * worst-case error P_2 given those before it.
 *
 *     x_k = {i z_k / n},   z_0 = 1
 *
 * Source: Sloan & Reztsov 2002. Up to 2,048 points all multipliers are tried, above some chosen evenly, so that the
 * search stays below about 4 million steps a dimension (16 n when that is more).
 */
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "patterns/parts/lattice.h"
#include "patterns/patterns.h"

enum { MAX_DIM = 256 };

static uint64_t best_multiplier(size_t n, const double *product)
{
    uint64_t best = 1, z;
    double least = 0;
    for (size_t c = 0; (z = koksma__lattice_candidate(n, c)); c++) {
        const double error = koksma__lattice_error(n, z, product);
        if (c == 0 || error < least) {
            least = error;
            best = z;
        }
    }
    return best;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const size_t n = out->n;
    uint64_t z[MAX_DIM] = {n > 1};
    double few[256];
    double *product = n <= 256 ? few : malloc(n * sizeof *product);
    if (!product) {
        return koksma__fail_memory(n * sizeof *product);
    }
    for (size_t i = 0; i < n; i++) {
        product[i] = 1;
    }
    koksma_status status = KOKSMA_OK;
    for (int k = 0; k < out->dim && n > 1 && !status; k++) {
        z[k] = k ? best_multiplier(n, product) : 1;
        koksma__lattice_extend(n, z[k], product);
        if (!koksma__keep_going(args->run, (double)k / out->dim)) {
            status = koksma__fail_interrupted();
        }
    }
    if (product != few) {
        free(product);
    }
    return status ? status : koksma__fill_lattice(args->run, z, out);
}

const koksma_pattern koksma__pattern_lattice_rank1 = {
    .name = "lattice-rank1",
    .title = "rank-1 lattice built component by component",
    .cite = "sloan2002",
    .min_dim = 1,
    .max_dim = MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_LATTICE | KOKSMA_CLAIM_LATIN,
    .generate = generate,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * korobov: the rank-1 lattice of the powers of one multiplier.
 *
 *     x_k = {i a^k / n}, k = 0 .. dim - 1
 *
 * Source: Korobov 1959. a=0 takes the multiplier with the lowest worst-case error P_2 of those that lattice-rank1
 * tries, by the formula there. Latin when a has no divisor in common with n; the searched a never has.
 */
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "patterns/parts/lattice.h"
#include "patterns/patterns.h"

enum { MAX_DIM = 256 };

static void powers(uint64_t a, size_t n, int dim, uint64_t *z)
{
    z[0] = n > 1;
    for (int k = 1; k < dim; k++) {
        z[k] = z[k - 1] * (a % n) % n;
    }
}

static koksma_status best_multiplier(size_t n, int dim, const koksma_run *run, double *product, uint64_t *best)
{
    uint64_t a, z[MAX_DIM];
    double least = 0;
    if (dim == 2) {
        return koksma__lattice_second(n, run, product, best);
    }
    for (size_t c = 0; c < koksma__lattice_tries(n) && (a = koksma__lattice_candidate(n, c)); c++) {
        powers(a, n, dim, z);
        koksma__lattice_start(n, product);
        double error = 0;
        for (int k = 0; k < dim; k++) {
            if (n > 4096 && !koksma__keep_going(run, 0)) {
                return koksma__fail_interrupted();
            }
            error += koksma__lattice_extend(n, z[k], product);
        }
        if (c == 0 || error < least) {
            least = error;
            *best = a;
        }
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const size_t n = out->n;
    uint64_t a = (uint64_t)args->params[0], z[MAX_DIM];
    if (a == 0 && n > 1 && out->dim > 1) {
        double few[256];
        double *product = n <= 256 ? few : malloc(n * sizeof *product);
        if (!product) {
            return koksma__fail_memory(n * sizeof *product);
        }
        const koksma_status status = best_multiplier(n, out->dim, args->run, product, &a);
        if (product != few) {
            free(product);
        }
        if (status) {
            return status;
        }
    }
    powers(a, n, out->dim, z);
    return koksma__fill_lattice(args->run, z, out);
}

static const koksma_param params[] = {
    {"a", "the multiplier, Latin when it has no divisor in common with n; 0: the best that is found", 0, 0, 1 << 28,
     NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_korobov = {
    .name = "korobov",
    .title = "rank-1 lattice of the powers of one multiplier",
    .cite = "korobov1959 hickernell1998",
    .min_dim = 1,
    .max_dim = MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_LATTICE | KOKSMA_CLAIM_LATIN,
    .params = params,
    .generate = generate,
};

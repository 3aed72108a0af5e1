/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lattice-rank1: the rank-1 lattice built component by component: each z_k is the multiplier with the lowest
 * worst-case error P_2, all coordinates weighing the same, given those before it.
 *
 *     x_k = {i z_k / n},   z_0 = 1
 *
 * Formula: P_2 = (1/n) sum_i prod_k (1 + gamma 2 pi^2 B_2({i z_k / n})) - 1,  B_2(x) = x^2 - x + 1/6,  with the
 * weight gamma = 3/(8 pi^2) = 0.038, with which it is the square of l2-wraparound over (4/3)^d. The points in fewer
 * dimensions are the first coordinates of those in more.
 * Source: Sloan & Reztsov 2002, with gamma = 1; weights: Sloan & Wozniakowski 1998, Dick, Kuo & Sloan 2013;
 * l2-wraparound: Hickernell 1998. With gamma = 1 the products of many coordinates outweigh all pairs: from some 8
 * dimensions on one multiplier comes again and again (n = 4096: 1615), which lays the points on diagonals. Weights
 * 1/k^2 for coordinate k are customary where the first coordinates matter most; here none does, and with them
 * multipliers repeat still (n = 256: within 32 dimensions). In two dimensions the minimiser hangs on no weight.
 * A multiplier is taken once, itself or as n - z, until none of the phi(n)/2 is left; then all may be taken once
 * more: in more dimensions than phi(n)/2 there are diagonals. Up to 2,048 points all are tried, above the first that
 * are left of an even choice, so that the search stays below about 4 million steps a dimension (16 n when that is
 * more).
 */
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "patterns/parts/lattice.h"
#include "patterns/patterns.h"

enum { MAX_DIM = 256 };

static bool is_among(uint64_t z, size_t n, const uint64_t *taken, int count)
{
    for (int k = 0; k < count; k++) {
        if (z == taken[k] || z == n - taken[k]) {
            return true;
        }
    }
    return false;
}

/* 0: all are taken. */
static uint64_t best_multiplier(size_t n, const double *product, const uint64_t *taken, int count)
{
    uint64_t best = 0, z, last = 0;
    double least = 0;
    size_t tries = koksma__lattice_tries(n);
    for (size_t c = 0; tries && (z = koksma__lattice_candidate(n, c)); c++) {
        if (z == last || is_among(z, n, taken, count)) {
            continue;
        }
        const double added = koksma__lattice_added(n, z, product);
        if (best == 0 || added < least) {
            least = added;
            best = z;
        }
        last = z;
        tries--;
    }
    return best;
}

static koksma_status search(size_t n, int dim, const koksma_run *run, double *product, uint64_t *z)
{
    int first = 0; /* of those since all were free */
    z[0] = 1;
    const koksma_status status = dim > 1 ? koksma__lattice_second(n, run, product, &z[1]) : KOKSMA_OK;
    if (status) {
        return status;
    }
    koksma__lattice_start(n, product);
    for (int k = 0; k < dim; k++) {
        if (k > 1 && !(z[k] = best_multiplier(n, product, z + first, k - first))) {
            first = k;
            z[k] = best_multiplier(n, product, NULL, 0);
        }
        koksma__lattice_extend(n, z[k], product);
        if (!koksma__keep_going(run, (double)k / dim)) {
            return koksma__fail_interrupted();
        }
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const size_t n = out->n;
    uint64_t z[MAX_DIM] = {0};
    double few[256];
    double *product = n <= 256 ? few : malloc(n * sizeof *product);
    if (!product) {
        return koksma__fail_memory(n * sizeof *product);
    }
    const koksma_status status = n > 1 ? search(n, out->dim, args->run, product, z) : KOKSMA_OK;
    if (product != few) {
        free(product);
    }
    return status ? status : koksma__fill_lattice(args->run, z, out);
}

const koksma_pattern koksma__pattern_lattice_rank1 = {
    .name = "lattice-rank1",
    .title = "rank-1 lattice built component by component for a low l2-wraparound",
    .cite = "sloan2002 sloan1998 dick2013 hickernell1998",
    .min_dim = 1,
    .max_dim = MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_LATTICE | KOKSMA_CLAIM_LATIN,
    .generate = generate,
};

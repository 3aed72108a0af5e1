/* SPDX-License-Identifier: Apache-2.0 */
/*
 * korobov: the rank-1 lattice whose generating vector consists of the powers of one multiplier a.
 *
 *     x_k = {i a^k / n}, k = 0 .. dim - 1
 *
 * Source: Korobov 1959. a=0 takes the multiplier with the lowest worst-case error P_2, by the formula in
 * lattice_rank1.c. In two dimensions (where the lattices are those of lattice-rank1), and for up to 2,048 points,
 * every multiplier is tried. No search of all multipliers in more dimensions is known that takes less than n^2 dim
 * steps; for more points, 4 million / n evenly distributed multipliers are tried, at least 16. In 10 dimensions the
 * best of these multipliers has about 1.1 to 6 times the error of lattice-rank1 and is found in a third of the time
 * (docs/findings/lattices.md). The points are Latin if a has no divisor in common with n; this holds for every a that
 * the search returns.
 */
#include <math.h>

#include "core/parallel.h"
#include "core/status.h"
#include "patterns/lattices/lattices.h"
#include "patterns/patterns.h"

enum { MAX_DIM = 256, ALL = 2048, WORK = 1 << 22 };

#define GOLDEN 0.6180339887498949

static void powers(uint64_t a, size_t n, int dim, uint64_t *z)
{
    z[0] = n > 1;
    for (int k = 1; k < dim; k++) {
        z[k] = z[k - 1] * (a % n) % n;
    }
}

/* Computes the worst-case error P_2 of the generating vector (1, a, a^2, ...), up to a constant factor and summand.
   */
static koksma_status error_of(koksma__lattice_search *search, int dim, uint64_t a, double *error)
{
    uint64_t z[MAX_DIM];
    powers(a, search->n, dim, z);
    koksma__lattice_start(search);
    *error = 0;
    for (int k = 0; k < dim; k++) {
        KOKSMA__TRY(search->n > 4096 ? koksma__ask(search->run) : KOKSMA_OK);
        *error += koksma__lattice_extend(search, z[k]);
    }
    return KOKSMA_OK;
}

static uint64_t mirrored(uint64_t z, size_t n)
{
    return z < n - z ? z : n - z;
}

/* Returns the c-th multiplier to try: c + 1 for few points, else element c of an evenly distributed sequence. */
static uint64_t candidate(size_t n, size_t c)
{
    return n <= ALL ? c + 1 : 1 + (uint64_t)((double)(n / 2) * fmod((double)(c + 1) * GOLDEN, 1));
}

static koksma_status best_multiplier(koksma__lattice_search *search, int dim, uint64_t *best)
{
    const size_t n = search->n, some = WORK / n < 16 ? 16 : WORK / n;
    const size_t tries = n <= ALL ? koksma__lattice_last(n) : some < n / 2 ? some : n / 2;
    double error, least = 0;
    koksma__lattice_units(search);
    *best = 0;
    for (size_t c = 0; c < tries; c++) {
        uint64_t a = candidate(n, c);
        if (n <= ALL && isinf(search->values[mirrored(a, n)])) {
            continue;
        }
        while (isinf(search->values[mirrored(a, n)])) {
            a++;
        }
        KOKSMA__TRY(error_of(search, dim, a, &error));
        if (*best == 0 || error < least) {
            least = error;
            *best = a;
        }
    }
    return KOKSMA_OK;
}

/* Finds the multiplier for n > 1 points. */
static koksma_status search_for(const koksma_run *run, size_t n, int dim, uint64_t *a)
{
    koksma__lattice_search search;
    if (dim == 2) {
        return koksma__lattice_second(run, n, a);
    }
    koksma_status status = koksma__lattice_open(&search, n, run);
    status = status ? status : best_multiplier(&search, dim, a);
    koksma__lattice_close(&search);
    return status;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const size_t n = out->n;
    uint64_t a = (uint64_t)args->params[0], z[MAX_DIM];
    if (a == 0 && n > 1 && out->dim > 1) {
        KOKSMA__TRY(search_for(args->run, n, out->dim, &a));
    }
    powers(a, n, out->dim, z);
    return koksma__fill_lattice(args->run, z, out);
}

static const koksma_param params[] = {
    {"a",
     "the multiplier (the points are Latin if it has no divisor in common with n); 0: the best one found by a search",
     0, 0, 1 << 28, NULL, true},
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

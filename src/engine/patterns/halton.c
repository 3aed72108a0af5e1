/* SPDX-License-Identifier: Apache-2.0 */
/*
 * halton: the sequence of the radical inverses of i in the first dim primes as bases. Scrambling is optional.
 *
 *     x_k(i) = phi_b(i), b the k-th prime: the digits of i in base b, mirrored at the radix point
 *
 *     scramble=affine  in each base b the digit a at each position becomes u a + v modulo b, with random u > 0 and v
 *                      for each position; the leading zeros of i are mapped, too (for bases 2 and 3 these maps are
 *                      all permutations; after Braaten & Weller 1979)
 *     scramble=owen    Owen's nested uniform scrambling (1995): a random permutation for each position and each
 *                      string of preceding digits, drawn exactly, by stochastic generation (Helmer, Christensen &
 *                      Kensler 2021)
 *
 * Source: Halton 1960. Every unscrambled coordinate is the double nearest to its exact fraction. Scrambled
 * coordinates are multiples of a step: below 2^-51 with affine; with owen 2^-32 in base 2, and b^-M in other bases,
 * where b^M is the largest power of b up to 2^53.
 * Known exactly, 2D, n = 16: D* = 0.201388889, L2 star = 0.068247792.
 */
#include "core/random.h"
#include "core/status.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { NONE, AFFINE, OWEN };

/* Maps the digit a at position j to u a + v modulo the base, with 1 <= u < base and 0 <= v < base drawn once for each
   position. */
static uint32_t affine(const void *context, uint32_t base, int j, uint32_t a)
{
    const uint64_t seed = *(const uint64_t *)context;
    const koksma__words r = koksma__random(seed, KOKSMA__PURPOSE_SCRAMBLE, base, (uint32_t)j);
    return ((1 + koksma__below(r.w[0], base - 1)) * a + koksma__below(r.w[1], base)) % base;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const int scramble = (int)args->params[0];
    if (scramble == OWEN) {
        return koksma__owen_digits(seed, args->run, out);
    }
    const koksma_status status =
        koksma__range_radicals(args, args->first + out->n, NULL, scramble == AFFINE ? affine : NULL, &seed, out);
    return status ? koksma__fail_in(status, "halton") : KOKSMA_OK;
}

static bool ranges(const double *params)
{
    return params[0] != OWEN;
}

static const char *const scrambles[] = {"none", "affine", "owen", NULL};

static const koksma_param params[] = {
    {"scramble",
     "scrambling: none, affine (one random map of the digits at each position) or owen (exact nested scrambling)",
     NONE, NONE, OWEN, scrambles, true},
    {0},
};

const koksma_pattern koksma__pattern_halton = {
    .name = "halton",
    .title = "radical inverses in the first primes",
    .cite = "halton1960 braaten1979 owen1995 helmer2021",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_SEQUENCE |
              KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_LATIN_PREFIXES,
    .params = params,
    .revision = 1, /* since revision 1 a study makes one trial, not several, of the unscrambled points
                      (docs/decisions.md, 58) */
    .generate = generate,
    .ranges = ranges,
};

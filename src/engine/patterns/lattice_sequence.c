/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lattice-sequence: an extensible rank-1 lattice for any number of points: more points can follow, and the first 2^m
 * are a good lattice for every m up to 20.
 *
 *     x_i,k = {phi_2(i) z_k},   phi_2(i) the radical inverse of i in base 2
 *
 * tools/make_lattice_sequence.py makes the vector component by component: it chooses each component so that for every
 * m the lattice of 2^m points is nearly as good as with the best multiplier for this m. If n is not a power of two,
 * the points consist of shifted lattices with 2^m points each and a part of another lattice. The vector was optimised
 * for up to 2^20 points, but can be used for more. Multiples of 2^32 added to z_k change no point below 2^32; without
 * them the points beyond 2^32 would lie on few lines. late_bits therefore draws bits 32 to 52 of each z_k but the
 * first from a hash, so that pairs of coordinates of 2^33 to 2^51 points are as even as those of a random vector
 * (docs/decisions.md, 55).
 * Sources: Hickernell, Hong, L'Ecuyer & Lemieux 2000, and Cools, Kuo & Nuyens 2006 for embedded lattices. The weights
 * are those of lattice-rank1. For 2^m points, m = 4 to 20, the worst-case error is at most 1.53 times that of
 * lattice-rank1 in 2 to 10 dimensions; Cools, Kuo & Nuyens report at most 1.6 (docs/findings/lattices.md).
 */
#include <koksma/sampler.h>

#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

#include "patterns/data/lattice_sequence.inc" /* z, made from lattice_sequence.csv */

/* Returns bits 32 to 52 of z_k, as a multiple of 2^32. */
static uint64_t late_bits(int k)
{
    return k ? koksma_mix(koksma_mix((uint64_t)k + 1)) >> 43 << 32 : 0;
}

/* Computes one coordinate modulo 2^32: bit b of i contributes z 2^(31 - b), as in a digital sequence, but the
   contributions are added with carries. */
static void early_column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    (void)context;
    for (size_t i = 0; i < count; i++) {
        xs[i] = (double)(koksma_mirror((uint32_t)(first + i)) * z[k]) * 0x1p-32;
    }
}

/* Computes one coordinate modulo 2^53, for points beyond 2^32. */
static void late_column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const uint64_t part = *(const uint64_t *)context, wide = z[k] + late_bits(k);
    const uint64_t late = koksma_mirror((uint32_t)part);
    for (size_t i = 0; i < count; i++) {
        const uint64_t mirrored = (uint64_t)koksma_mirror((uint32_t)(first + i)) << 32 | late;
        xs[i] = (double)(int64_t)(mirrored * wide >> 11) * 0x1p-53;
    }
}

static koksma_status generate_part(const void *context, uint64_t part, const koksma_args *args, koksma_points *out)
{
    (void)context;
    return koksma__range_columns(args, out, part ? late_column : early_column, &part);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    return koksma__range_parts(args, out, generate_part, NULL);
}

const koksma_pattern koksma__pattern_lattice_sequence = {
    .name = "lattice-sequence",
    .title = "extensible rank-1 lattice for any number of points; the first 2^m points are a good lattice for each m",
    .cite = "hickernell2000 cools2006 nuyens2006",
    .min_dim = 1,
    .max_dim = sizeof z / sizeof *z,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_SEQUENCE |
              KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_LATTICE_PREFIXES,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

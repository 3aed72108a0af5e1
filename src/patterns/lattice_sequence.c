/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lattice-sequence: an extensible rank-1 lattice for any number of points: more points can follow, and the first 2^m
 * are a good lattice for every m up to 20.
 *     x_i,k = {phi_2(i) z_k},   phi_2(i) the radical inverse of i in base 2
 *
 * tools/make_lattice_sequence.py makes the vector component by component: it chooses each component so that for every
 * m the lattice of 2^m points is nearly as good as with the best multiplier for this m. If n is not a power of two,
 * the points consist of shifted lattices with 2^m points each and a part of another lattice. The vector was optimised
 * for up to 2^20 points, but can be used for up to 2^32.
 * Source: Hickernell, Hong, L'Ecuyer & Lemieux 2000; embedded lattices: Cools, Kuo & Nuyens 2006; the weights are
 * those of lattice-rank1. For 2^m points, m = 4 to 12, l2-wraparound is at most 1.4 times that of lattice-rank1 in 2
 * to 10 dimensions (tests/patterns/test_lattices.c).
 */
#include <koksma/sampler.h>

#include "core/status.h"
#include "patterns/patterns.h"
#include "patterns/shared/columns.h"

static const uint32_t z[] = {
#include "patterns/shared/lattice_sequence.inc"
};

/* Computes one coordinate modulo 2^32: bit b of i contributes z 2^(31 - b), as in a digital sequence, but the
   contributions are added with carries. */
static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    (void)context;
    for (size_t i = 0; i < count; i++) {
        xs[i] = (double)(koksma_mirror((uint32_t)(first + i)) * z[k]) * 0x1p-32;
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    KOKSMA__TRY(koksma__range_fits("lattice-sequence", args, out));
    return koksma__range_columns(args, out, column, NULL);
}

const koksma_pattern koksma__pattern_lattice_sequence = {
    .name = "lattice-sequence",
    .title = "extensible rank-1 lattice for any number of points; the first 2^m points are a good lattice for each m",
    .cite = "hickernell2000 cools2006 nuyens2006",
    .min_dim = 1,
    .max_dim = sizeof z / sizeof *z,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

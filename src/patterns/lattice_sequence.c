/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lattice-sequence: an extensible rank-1 lattice: any number of points, more can follow, and the first 2^m are a good
 * lattice for every m to 20.
 *
 *     x_i,k = {phi_2(i) z_k},   phi_2(i) the bits of i mirrored about the point
 *
 * The vector is made component by component by tools/make_lattice_sequence.py, so that for each coordinate the lattice of no
 * m is far from that of the best multiplier for this m alone. Between powers of two the points are whole lattices of 2^m
 * points, shifted, and a part of another. Beyond 2^20 points it goes on to 2^32 with the same vector, which was
 * not chosen for them.
 * Source: Hickernell, Hong, L'Ecuyer & Lemieux 2000; embedded lattices: Cools, Kuo & Nuyens 2006; weights as of lattice-rank1.
 * Of 2^m points, m = 4 to 12, l2-wraparound is at most 1.4 times that of lattice-rank1 in 2 to 10 dimensions
 * (tests/patterns/test_lattices.c).
 */
#include "core/status.h"
#include "patterns/patterns.h"
#include "patterns/shared/columns.h"

static const uint32_t z[] = {
#include "patterns/shared/lattice_sequence.inc"
};

/* Modulo 2^32: bit b of i stands for z 2^(31 - b), as in a digital sequence, but added with carries. */
static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    (void)context;
    for (size_t i = 0; i < count; i++) {
        uint32_t mirrored = 0;
        for (uint64_t rest = first + i, place = UINT32_C(1) << 31; rest; rest >>= 1, place >>= 1) {
            mirrored |= rest & 1 ? (uint32_t)place : 0;
        }
        xs[i] = (double)(mirrored * z[k]) * 0x1p-32;
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
    .title = "extensible rank-1 lattice: any number of points, the first 2^m a good lattice for each m",
    .cite = "hickernell2000 cools2006 nuyens2006",
    .min_dim = 1,
    .max_dim = sizeof z / sizeof *z,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

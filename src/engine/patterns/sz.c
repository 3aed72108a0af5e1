/* SPDX-License-Identifier: Apache-2.0 */
/*
 * sz: a digital sequence in base 2 that is a (0,256)-sequence in base 256. Its dimensions 16 k .. 16 k + 15 are a
 * (0,16)-sequence in base 16, its dimensions 4 k .. 4 k + 3 a (0,4)-sequence in base 4, and its dimensions 2 k and 2
 * k + 1 a (0,2)-sequence in base 2.
 *
 *     x_d = matrix of d times the bits of i;   matrix of d = Q(1, d & 1) Q(2, d & 2) Q(4, d & 12) Q(8, d & 240)
 *     Q(q, a) consists of blocks of q x q bits: block (r, c) is the element binomial(c, r) a^(c-r) of GF(2^q), as the
 *     matrix that multiplies the bits of other elements by it; dimensions d count from 0
 *
 * Source: the aim, and the use of binary matrices for bases that are powers of two, come from Ahmed, Pharr,
 * Ostromoukhov & Huang (2025); the product above is new in this project. The Q(q, a) for all a in GF(2^q) are Faure's
 * matrices, which Niederreiter (1987) generalised to any finite field: Q(q, a) Q(q, b) = Q(q, a + b), and together
 * they are a (0, 2^q)-sequence in base 2^q. The fields are represented by nimbers, so that each field is a subfield
 * of the next: for a in GF(2^q),
 *
 *     Q(q, a) = (diagonal of 2q x 2q blocks) Q(2q, a^2),
 *
 * since binomial(2c + c', 2r + r') = binomial(c, r) binomial(c', r') modulo 2. A block-diagonal matrix permutes the
 * values of each digit in base 2^2q, which preserves nets. Up to these permutations the matrix of dimension d is thus
 * Q(8, a_d), with 256 different a_d; the matrices of 16 consecutive dimensions are Q(4, ...) times one common matrix,
 * and so on. Multiplying all matrices from the right by the same upper triangular matrix only permutes the indices
 * within aligned blocks. The first two dimensions are the (0,2)-sequence of Sobol'.
 *
 * Coordinates have 53 digits: beyond point 2^48 the last three of 56 are cut off.
 *
 * Known exactly: in 2D the points are those of the pattern sobol. The modifier owen scrambles the points and
 * preserves the nets in all four bases.
 */
#include <koksma/sampler.h>

#include <stdlib.h>

#include "core/status.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { MOST_DIM = 256 };

/* Returns the product of two nimbers of q bits, where q is a power of two. The recursion uses F F = F + F/2 with F =
   2^(q/2). */
static uint32_t product(uint32_t a, uint32_t b, int q)
{
    const int half = q / 2;
    if (q == 1 || !a || !b) {
        return a & b;
    }
    const uint32_t low = (1u << half) - 1, lows = product(a & low, b & low, half);
    const uint32_t highs = product(a >> half, b >> half, half);
    const uint32_t all = product((a >> half) ^ (a & low), (b >> half) ^ (b & low), half);
    return (all ^ lows) << half | (lows ^ product(highs, 1u << (half - 1), half));
}

/* Returns the product of the matrix Q(q, a) and the bit vector z, whose bit r belongs to row r. */
static uint64_t multiply(int q, uint32_t a, uint64_t z)
{
    const uint32_t digit = (1u << q) - 1;
    uint64_t sum = z;
    for (int c = 1; a && z >> c * q; c++) {
        uint32_t term = (uint32_t)(z >> c * q) & digit;
        for (int r = c - 1; term && r >= 0; r--) {
            term = product(term, a, q);
            sum ^= (r & ~c) ? 0 : (uint64_t)term << r * q;
        }
    }
    return sum;
}

/* Returns the product of the last three matrices of dimension d and the bits z of an index. */
static uint64_t multiply_three(int d, uint64_t z)
{
    const uint32_t k = (uint32_t)d;
    return k < 2 ? z : multiply(2, k & 2, multiply(4, k & 12, multiply(8, k & 240, z)));
}

/* Returns column b < 32 of the matrix of dimension d; the highest bit is the first row. */
static uint32_t column_of(int d, int b)
{
    const uint32_t z = (uint32_t)multiply_three(d, (uint64_t)1 << b);
    return koksma_mirror(d & 1 ? koksma_pascal(z) : z);
}

/* Returns the digits that all points of a part have in common (patterns/nets/nets.h). */
static uint64_t sum_of(int d, uint64_t part)
{
    return koksma__mirror_digits(multiply(1, d & 1, multiply_three(d, part << 32)));
}

static koksma_status generate_part(const void *context, uint64_t part, const koksma_args *args, koksma_points *out)
{
    koksma__digital_columns j = *(const koksma__digital_columns *)context;
    uint64_t sums[MOST_DIM];
    uint32_t starts[MOST_DIM];
    for (int d = 0; part && d < out->dim; d++) {
        sums[d] = sum_of(d, part);
        starts[d] = koksma__early_digits(sums[d]);
        j.starts = starts;
    }
    KOKSMA__TRY(koksma__range_columns(args, out, koksma__digital_column, &j));
    return part ? koksma__add_late_digits(args->run, sums, out) : KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const uint64_t last = args->first + out->n - 1;
    const size_t bytes = (size_t)out->dim * sizeof(uint32_t[32]);
    uint32_t(*directions)[32] = calloc(1, bytes);
    KOKSMA__REQUIRE_MEMORY(directions, bytes);
    for (int d = 0; d < out->dim; d++) { /* compute only the columns that the indices up to the last one use */
        for (int b = 0; b < 32 && last >> b; b++) {
            directions[d][b] = column_of(d, b);
        }
    }
    const koksma__digital_columns columns = {.directions = (const uint32_t(*)[32])directions};
    const koksma_status status = koksma__in_first_part(args, out)
                                     ? koksma__range_columns(args, out, koksma__digital_column, &columns)
                                     : koksma__range_parts(args, out, generate_part, &columns);
    free(directions);
    return status;
}

const koksma_pattern koksma__pattern_sz = {
    .name = "sz",
    .title = "a sequence whose groups of 2, 4 and 16 dimensions are (0,s)-sequences in bases 2, 4 and 16",
    .cite = "ahmed2025 niederreiter1987",
    .min_dim = 1,
    .max_dim = MOST_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_SEQUENCE |
              KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2 | KOKSMA_CLAIM_NET2_PREFIXES | KOKSMA_CLAIM_PAIRS |
              KOKSMA_CLAIM_QUADRUPLES,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

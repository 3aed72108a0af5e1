/* SPDX-License-Identifier: Apache-2.0 */
/*
 * r-sequence: the additive recurrence of the generalised golden ratio.
 *
 *     x_k = {1/2 + (i+1) g^-k}, k = 1 .. dim,   g the positive root of g^(dim+1) = g + 1
 *
 * Source: Roberts 2018. For dim = 1, g is the golden ratio 1.618…, for dim = 2 the plastic number 1.3247…. The powers of
 * 1/g are multiples of 2^-64, off by less than 2^-64 for dim <= 2 and less than 2^-59 for more. Sums are exact modulo 1, so
 * that point i is off by less than (i+1) 2^-64 (2^-59), or 2^-53 if that is more, however it is reached.
 *
 *     shuffle=1    a hash shuffles the lower 32 bits of the index i by a nested uniform permutation, a different one
 *                  for each value of the higher bits
 *
 * With shuffle=1 every aligned block of 2^m points, m <= 32, is a run of 2^m consecutive points of the sequence, and the
 * points of two seeds are paired at random. If n is not a power of two, the first n points consist of several runs, one
 * for each bit 1 of n: the RMS L2 star discrepancy is 1.19 times that of one run on average over n = 1 to 1024, and
 * 1.64 times at most (n = 98).
 *
 * koksma_r_2d of koksma/sampler.h computes single points of the sequence with shuffle=1,shift=1.
 * Known, 2D, n = 16: D* = 0.243477007, L2 star = 0.067755940.
 */
#include <koksma/sampler.h>

#include "kernels/kernels.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { MAX_DIM = 64 };

/* Returns the fraction a with a^dim + a^(dim+1) = 1, by bisection. */
static uint64_t root(int dim)
{
    uint64_t a = 0;
    for (int bit = 63; bit >= 0; bit--) {
        const uint64_t t = a | (uint64_t)1 << bit;
        uint64_t power = t;
        for (int k = 1; k < dim; k++) {
            power = koksma__upper_half(power, t);
        }
        const uint64_t next = koksma__upper_half(power, t);
        if (power + next >= power) { /* no overflow: the sum is below 1 */
            a = t;
        }
    }
    return a;
}

static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const uint64_t alpha = ((const uint64_t *)context)[k];
    uint64_t x = ((uint64_t)1 << 63) + (first + 1) * alpha;
    for (size_t i = 0; i < count; i++, x += alpha) {
        xs[i] = (double)(int64_t)(x >> 11) * 0x1p-53;
    }
}

typedef struct shuffled {
    uint64_t seed, part;
    const uint64_t *alphas;
} shuffled;

static void shuffled_columns(const void *context, int k, int some, uint64_t first, size_t count, koksma__columns xs)
{
    const shuffled *s = context;
    uint32_t index[KOKSMA__COLUMN_BLOCK];
    for (size_t i = 0; i < count; i++) {
        index[i] = (uint32_t)(first + i);
    }
    koksma__kernels()->owen_hash(count, index, true, true, koksma_order(s->seed, (uint32_t)s->part), index);
    for (int c = 0; c < some; c++) {
        const uint64_t alpha = s->alphas[k + c], start = ((uint64_t)1 << 63) + ((s->part << 32) + 1) * alpha;
        for (size_t i = 0; i < count; i++) {
            const uint64_t x = start + index[i] * alpha;
            xs[c][i] = (double)(int64_t)(x >> 11) * 0x1p-53;
        }
    }
}

static koksma_status generate_part(const void *context, uint64_t part, const koksma_args *args, koksma_points *out)
{
    shuffled s = *(const shuffled *)context;
    s.part = part;
    return koksma__range_blocks(args, out, shuffled_columns, &s);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    uint64_t alphas[MAX_DIM] = {0x9E3779B97F4A7C15u};
    if (out->dim == 2) {
        alphas[0] = 0xC13FA9A902A6328Fu; /* 1/g and 1/g^2 for dim = 2, rounded to nearest */
        alphas[1] = 0x91E10DA5C79E7B1Du;
    } else if (out->dim > 2) {
        alphas[0] = root(out->dim);
        for (int k = 1; k < out->dim; k++) {
            alphas[k] = koksma__upper_half(alphas[k - 1], alphas[0]);
        }
    }
    if (args->params[0] != 0) {
        const shuffled s = {.seed = seed, .alphas = alphas};
        return koksma__range_parts(args, out, generate_part, &s);
    }
    return koksma__range_columns(args, out, column, alphas);
}

static const koksma_param params[] = {
    {"shuffle", "1: put the points in random order; aligned blocks of 2^m points stay together", 0, 0, 1, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_r_sequence = {
    .name = "r-sequence",
    .title = "additive recurrence of the generalised golden ratio",
    .cite = "roberts2018",
    .min_dim = 1,
    .max_dim = MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N,
    .params = params,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * r-sequence: the additive recurrence of the generalised golden ratio.
 *
 *     x_k = {1/2 + (i+1) g^-k}, k = 1 .. dim,   g the positive root of g^(dim+1) = g + 1
 *
 * Source: Roberts 2018. dim = 1 has the golden ratio 1.618…, dim = 2 the plastic number 1.3247…. In whole numbers
 * modulo 2^64: no drift. koksma_r_2d of koksma/sampler.h has the shifted points one by one.
 * Known, 2D, n = 16: D* = 0.243477007, L2 star = 0.067755940.
 */
#include "patterns/parts/columns.h"
#include "patterns/patterns.h"

enum { MAX_DIM = 64 };

/* The upper 64 bits of a product of fractions. */
static uint64_t product(uint64_t a, uint64_t b)
{
    const uint64_t al = (uint32_t)a, ah = a >> 32, bl = (uint32_t)b, bh = b >> 32;
    const uint64_t middle = ah * bl + (al * bl >> 32), other = al * bh + (uint32_t)middle;
    return ah * bh + (middle >> 32) + (other >> 32);
}

/* The fraction a with a^dim + a^(dim+1) = 1, by bisection. */
static uint64_t root(int dim)
{
    uint64_t a = 0;
    for (int bit = 63; bit >= 0; bit--) {
        const uint64_t t = a | (uint64_t)1 << bit;
        uint64_t power = t;
        for (int k = 1; k < dim; k++) {
            power = product(power, t);
        }
        const uint64_t next = product(power, t);
        if (power + next >= power) { /* the sum is below 1 */
            a = t;
        }
    }
    return a;
}

static void column(const void *context, int k, size_t first, size_t count, double *xs)
{
    const uint64_t alpha = ((const uint64_t *)context)[k];
    uint64_t x = ((uint64_t)1 << 63) + (first + 1) * alpha;
    for (size_t i = 0; i < count; i++, x += alpha) {
        xs[i] = (double)(int64_t)(x >> 11) * 0x1p-53;
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    uint64_t alphas[MAX_DIM] = {0x9E3779B97F4A7C15u};
    if (out->dim == 2) {
        alphas[0] = 0xC13FA9A902A6328Fu; /* rounded to nearest */
        alphas[1] = 0x91E10DA5C79E7B1Du;
    } else if (out->dim > 2) {
        alphas[0] = root(out->dim);
        for (int k = 1; k < out->dim; k++) {
            alphas[k] = product(alphas[k - 1], alphas[0]);
        }
    }
    return koksma__fill_columns(args->run, out, column, alphas);
}

const koksma_pattern koksma__pattern_r_sequence = {
    .name = "r-sequence",
    .title = "additive recurrence of the generalised golden ratio",
    .cite = "roberts2018",
    .min_dim = 1,
    .max_dim = MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N,
    .generate = generate,
};

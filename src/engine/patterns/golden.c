/* SPDX-License-Identifier: Apache-2.0 */
/*
 * golden: one coordinate is equidistant, the other has the fractional parts of the multiples of the golden ratio, for
 * any n.
 *
 *     x = i / n,   y = {i phi},   phi = (1 + sqrt 5) / 2
 *
 * Source: the Kronecker sequence of the golden ratio (Niederreiter 1992) as a set of n points.
 * Known exactly, n = 16: D* = 0.148558813, L2 star = 0.052896127.
 */
#include "kernels/kernels.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    if (k == 0) {
        koksma__kernels()->steps(count, (double)first, 0, *(const double *)context, xs);
        return;
    }
    const uint64_t phi = 0x9E3779B97F4A7C15u;
    uint64_t y = first * phi;
    for (size_t i = 0; i < count; i++, y += phi) {
        xs[i] = (double)(int64_t)(y >> 11) * 0x1p-53;
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const double n = (double)args->n;
    return koksma__range_columns(args, out, column, &n);
}

const koksma_pattern koksma__pattern_golden = {
    .name = "golden",
    .title = "points (i/n, fractional part of i times the golden ratio)",
    .cite = "niederreiter1992",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_ANY_N,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

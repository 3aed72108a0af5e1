/* SPDX-License-Identifier: Apache-2.0 */
/*
 * pmj02: progressive multi-jittered points whose prefixes of 2^m are (0,m,2)-nets in base 2, with every other
 * property of the paper, by stochastic generation from the matrices of the Stirling numbers of the first kind modulo
 * 2 and the same shifted by a row and a column.
 *
 *     x(2^l + i) is in the empty half of the stratum of width 2^-l of x(i ^ partner_l), at a random place
 *
 * Source: Christensen, Kensler & Kilpatrick 2018; Helmer, Christensen & Kensler 2021 for the generation.
 *
 *     shuffle=1    nested uniform shuffle of the index, by a hash that keeps index 0
 *
 * With shuffle=1 the first 2^m points are the same set in another order, and every aligned block of 2^m points stays
 * a (0,m,2)-net. Two seeds then pair their points at random. Without it they do not: the strata of point i are the
 * same for all seeds up to exclusive ors of their numbers.
 *
 * koksma_pmj02_2d of koksma/sampler.h has the points of shuffle=1 one by one.
 */
#include <koksma/sampler.h>

#include "core/random.h"
#include "core/status.h"
#include "patterns/patterns.h"
#include "patterns/shared/columns.h"
#include "patterns/shared/grow.h"

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    uint32_t partners[2 * 32];
    for (uint32_t l = 0; l < 32; l++) {
        partners[l] = koksma_pmj02_partner(0, l);
        partners[32 + l] = koksma_pmj02_partner(1, l);
    }
    const uint32_t order = koksma_order(seed, 0);
    KOKSMA__TRY(koksma__range_fits("pmj02", args, out));
    return koksma__grow_range(seed, KOKSMA__PURPOSE_POINT, partners, args->params[0] != 0 ? &order : NULL, args, out);
}

static const koksma_param params[] = {
    {"shuffle", "1: in random order, aligned blocks of 2^m points staying (0,m,2)-nets", 0, 0, 1, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_pmj02 = {
    .name = "pmj02",
    .title = "progressive multi-jittered points, (0,2) prefixes",
    .cite = "christensen2018 helmer2021",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2 | KOKSMA_CLAIM_NET2_PREFIXES |
              KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

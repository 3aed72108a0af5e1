/* SPDX-License-Identifier: Apache-2.0 */
/*
 * pmj02: progressive multi-jittered points whose prefixes of 2^m points are (0,m,2)-nets in base 2; they have all
 * properties of the pmj02 sequences of Christensen, Kensler & Kilpatrick 2018. The points are made by stochastic
 * generation (shared/grow.h) from two matrices: the matrix of the Stirling numbers of the first kind modulo 2, and
 * this matrix shifted by a row and a column.
 *
 *     x(2^l + i) is at a random position in the empty half of the stratum of width 2^-l of x(i XOR partner_l)
 *
 * Source: Christensen, Kensler & Kilpatrick 2018; the generation is from Helmer, Christensen & Kensler 2021.
 *
 *     shuffle=1    points of the same matrices in random order, scrambled by a hash as in sobol:scramble=hash-owen
 *
 * With shuffle=1 every aligned block of 2^m points is a (0,m,2)-net, and the points of two seeds are paired at
 * random. Without shuffle=1 the points of two seeds are correlated: the numbers of the strata of point i for two
 * seeds differ only by an exclusive or with a constant.
 *
 * Without shuffle=1 the points fall into classes that interleave (figure 1 of Christensen et al.): the parities of
 * bits 0, 2, 4, .. and of bits 1, 3, 5, .. of the index define four classes, each a (0,m-2,2)-net in every aligned
 * block of 2^m points. The points of even index are no such class: they all lie in one half of x.
 *
 * Known: for 2^m points root mean square errors fall about as N^-1.5 for smooth functions, as N^-0.75 for edges and as
 * N^-1 for steps along an axis, as published (docs/findings/integration.md).
 *
 * koksma_pmj02_2d of koksma/sampler.h computes single points of the set with shuffle=1.
 */
#include <koksma/sampler.h>

#include "core/random.h"
#include "kernels/kernels.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

/* Computes the columns of the matrix of coordinate k: column l follows from point 2^l, which is in the empty half of
   the stratum of its partner. */
static void directions_of(int k, uint32_t *directions)
{
    for (int l = 0; l < 32; l++) {
        directions[l] = 0x80000000u >> l;
        for (int b = 0; b < l; b++) {
            directions[l] ^= koksma__pmj02_partners[32 * k + l] >> b & 1 ? directions[b] : 0;
        }
    }
}

/* Computes the columns of the matrix of coordinate k for all 53 digits, from its definition: column n has in row r the
   Stirling number of the first kind of n + k and r + k, modulo 2. These numbers are the coefficients of the
   polynomial x (x + 1) ... (x + n - 1), which is x^ceil(n/2) (x + 1)^floor(n/2) modulo 2. */
static void columns_of(int k, uint64_t columns[KOKSMA__DIGITS])
{
    uint64_t product = 1; /* bit r: the coefficient of x^r */
    for (int n = 0; n < KOKSMA__DIGITS + k; n++) {
        columns[n < k ? 0 : n - k] = koksma__mirror_digits(product >> k);
        product = product << 1 ^ (n % 2 ? product : 0);
    }
}

/* The points of one part (patterns/nets/nets.h). */
typedef struct job {
    uint64_t seed, part;
    bool shuffle;
    uint64_t sums[2]; /* digits that all points of the part have in common */
} job;

static void shuffled(const void *context, int k, int some, uint64_t first, size_t count, koksma__columns xs)
{
    const job *j = context;
    uint32_t index[KOKSMA__COLUMN_BLOCK], v[KOKSMA__COLUMN_BLOCK], directions[32];
    koksma__hash_owen_order(j->seed, j->part, first, count, index);
    for (int c = 0; c < some; c++) {
        directions_of(k + c, directions);
        koksma__mirror_directions(directions, directions);
        koksma__kernels()->digital_at(count, index, directions, v);
        koksma__hash_owen_scramble(j->seed, k + c, j->part ? j->sums[k + c] : 0, count, v, xs[c]);
    }
}

static koksma_status generate_first(const job *j, const koksma_args *args, koksma_points *out)
{
    return j->shuffle ? koksma__range_blocks(args, out, shuffled, j)
                      : koksma__grow_range(j->seed, KOKSMA__PURPOSE_POINT, koksma__pmj02_partners, NULL, args, out);
}

static koksma_status generate_part(const void *context, uint64_t part, const koksma_args *args, koksma_points *out)
{
    job j = *(const job *)context;
    uint64_t columns[KOKSMA__DIGITS], late[2 * KOKSMA__LATE_DIGITS];
    const koksma__grow_part grow_part = {part, late};
    if (!part) {
        return generate_first(&j, args, out);
    }
    j.part = part;
    for (int k = 0; k < 2; k++) {
        columns_of(k, columns);
        j.sums[k] = koksma__part_sum(columns, part);
        koksma__late_partners(columns, late + (size_t)k * KOKSMA__LATE_DIGITS);
    }
    return j.shuffle
               ? koksma__range_blocks(args, out, shuffled, &j)
               : koksma__grow_range(j.seed, KOKSMA__PURPOSE_POINT, koksma__pmj02_partners, &grow_part, args, out);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const job j = {.seed = seed, .shuffle = args->params[0] != 0};
    return koksma__in_first_part(args, out) ? generate_first(&j, args, out)
                                            : koksma__range_parts(args, out, generate_part, &j);
}

static const koksma_param params[] = {
    {"shuffle", "1: put the points in random order; aligned blocks of 2^m points remain (0,m,2)-nets", 0, 0, 1, NULL,
     true},
    {0},
};

const koksma_pattern koksma__pattern_pmj02 = {
    .name = "pmj02",
    .title = "progressive multi-jittered points whose prefixes are (0,m,2)-nets",
    .cite = "christensen2018 helmer2021",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2 | KOKSMA_CLAIM_NET2_PREFIXES |
              KOKSMA_CLAIM_UNBIASED | KOKSMA_CLAIM_CLASSES,
    .params = params,
    .revision = 1,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

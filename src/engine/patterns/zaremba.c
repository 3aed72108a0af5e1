/* SPDX-License-Identifier: Apache-2.0 */
/*
 * zaremba: Hammersley points with folded radical inverses, the best pattern of Mitchell's tables 1 and 2.
 *
 *     x_0 = i / n,   x_k = psi_b(i), b the k-th prime
 *     psi_b is the folded radical inverse: the digit a at position j of i (j = 0 is the least significant) becomes
 *     (a + j) mod b, also for the infinitely many leading zeros; then the digits are mirrored at the radix point.
 *     Example: psi_2(0) = 1/4 + 1/16 + … = 1/3
 *
 * Source: Zaremba 1968, Warnock 1972, after Mitchell 1992, section 3. Only this definition reproduces Mitchell's
 * numbers: without the leading zeros, or with positions counted from 1, the results differ. Known exactly: L2 star
 * for n = 16, 256, 1600: 0.035833915 0.002550635 0.000438 in 2D, 0.039301 0.003756 0.000761 in 3D. In base 2 the
 * folded radical inverse is a digital shift of the radical inverse in hammersley.
 *     scramble=owen  Owen's nested uniform scrambling (1995), exact; the points are those of hammersley with
 *                    scramble=owen, because folding permutes the digits at each position, and a uniform scrambling
 *                    has the same distribution after any such permutation
 */
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

static uint32_t fold(const void *context, uint32_t base, int j, uint32_t a)
{
    (void)context;
    return (a + (uint32_t)j) % base;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    if (args->params[0] == KOKSMA__SCRAMBLE_OWEN) {
        return koksma__owen_hammersley(seed, args->run, out);
    }
    return koksma__range_radicals(args, args->n, &(double){0}, fold, NULL, out);
}

static const koksma_param params[] = {KOKSMA__PARAM_SCRAMBLE(", each coordinate in its base"), {0}};

const koksma_pattern koksma__pattern_zaremba = {
    .name = "zaremba",
    .title = "Hammersley points with folded radical inverses",
    .cite = "zaremba1968 warnock1972 mitchell1992 owen1995 helmer2021",
    .min_dim = 2,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2,
    .params = params,
    .generate = generate,
    .ranges = koksma__ranges_unscrambled,
};

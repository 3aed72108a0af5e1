/* SPDX-License-Identifier: Apache-2.0 */
/*
 * lattice-rank1: the rank-1 lattice built component by component: given z_0 .. z_(k-1), z_k is the multiplier with
 * the lowest worst-case error P_2, where all coordinates have equal weights.
 *
 *     x_k = {i z_k / n},   z_0 = 1
 *
 * Formula: P_2 = (1/n) sum_i prod_k (1 + gamma 2 pi^2 B_2({i z_k / n})) - 1,  B_2(x) = x^2 - x + 1/6, with the weight
 * gamma = 3/(8 pi^2) = 0.038. With this weight P_2 is the square of l2-wraparound divided by (4/3)^d. The set in
 * fewer dimensions consists of the first coordinates of the set in more dimensions.
 *
 * Sources: Sloan & Reztsov 2002 for the construction with gamma = 1, Nuyens & Cools 2006 and 2006a for evaluating all
 * multipliers at once in O(n log n) (lattices/unit_sums.c), Sloan & Wozniakowski 1998 and Dick, Kuo & Sloan 2013 for
 * weights, Hickernell 1998 for l2-wraparound.
 *
 * Why gamma is small: with gamma = 1 the terms of many coordinates outweigh the terms of all pairs of coordinates.
 * From about 8 dimensions on the same multiplier is then chosen repeatedly (1615 for n = 4096), so that the points
 * lie on diagonals. Weights 1/k^2 for coordinate k are customary if the first coordinates are the most important,
 * which this pattern does not assume; even with such weights a multiplier is chosen twice (within 32 dimensions for n
 * = 256). With gamma = 0.038 no multiplier (z and n - z counted as one) was chosen again before all phi(n)/2 had been
 * chosen, for each n from 5 to 700 in 64 dimensions and for powers of two up to 65,536 in 128 dimensions. No theorem
 * excludes repetitions. In more dimensions than phi(n)/2 some points lie on diagonals. In two dimensions the
 * minimiser does not depend on the weight.
 *
 * Ties: z and n - z always have equal errors, and the smaller is taken, except that for a few even n the unit next above
 * n/2 may be taken (lattices/lattices.h): with up to 10 coordinates for 17 of the n up to 2,000, from 10 and 12 to 254.
 * Among other multipliers with bitwise equal sums the smallest is taken.
 * Known: P_2 in 10 dimensions: n = 1024: 1.979e-4, 2^20: 7.69e-9 (docs/findings/lattices.md).
 *
 * With order=Q only projections of up to Q coordinates count (finite-order weights), and gamma2 to gammaQ are the
 * weights of the projections of 2 to Q coordinates, relative to a weight of 1 for single coordinates (the
 * order-dependent weights of Cools, Kuo & Nuyens 2006). With Gamma_l = gammal, or gamma^(l-1) where it is not given,
 * the search minimises
 *
 *     P_2 = (1/n) sum_i sum_(l=1)^Q Gamma_l e_l(2 pi^2 B_2({i z_0 / n}), 2 pi^2 B_2({i z_1 / n}), ...)
 *
 * with e_l the elementary symmetric polynomials. LatNet Builder's weights order-dependent:0:1,0.1,0.01 are
 * order=3,gamma2=0.1,gamma3=0.01. In two dimensions weights do not matter. With gamma2=0, which gives pairs of
 * coordinates no weight, z_1 is still the best multiplier in two dimensions.
 *
 * Time: In two dimensions the search takes some 15 ns a point and no memory (lattices/lattice_plane.c), above O(dim n
 * log n): half a second for 2^20 points in 10 dimensions, hardly more for a prime number of points. The memory in
 * addition to the points is then 28 n bytes for powers of two, up to 95 n bytes for other n, and 4 n Q bytes more with
 * order=Q.
 */

#include <math.h>

#include "core/status.h"
#include "patterns/lattices/lattices.h"
#include "patterns/patterns.h"

enum { MAX_DIM = 256, MOST_ORDER = 8 };

/* Computes the factors for koksma__lattice_extend_orders: for l = 0 .. order - 1, the factor Gamma_(l+1) / gamma^l of
   the elementary symmetric polynomial of degree l in the terms 3/4 B_2 = gamma 2 pi^2 B_2. */
static koksma_status weights_of(const koksma_args *args, int order, double factors[MOST_ORDER])
{
    double power = 1, sum = 0;
    factors[0] = 1;
    for (int l = 2; l <= MOST_ORDER; l++) {
        const double weight = args->params[l - 1];
        power *= 8 * M_PI * M_PI / 3;
        KOKSMA__FAIL_IF(weight < 0 && weight != -1, KOKSMA_ARGUMENT,
                        "lattice-rank1: gamma%d=%g; a weight of 0 or more would do, or -1 for the default", l,
                        weight);
        KOKSMA__FAIL_IF(weight >= 0 && l > order, KOKSMA_ARGUMENT,
                        "lattice-rank1: gamma%d has no effect with order=%d; order=%d would do", l, order, l);
        factors[l - 1] = weight < 0 ? 1 : weight * power;
        sum += l <= order ? factors[l - 1] : 0;
    }
    KOKSMA__FAIL_IF(
        order && sum == 0, KOKSMA_ARGUMENT,
        "lattice-rank1: gamma2 to gamma%d are 0, so that all lattices are equally good; one above 0 would do", order);
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    uint64_t z[MAX_DIM] = {0};
    const int order = (int)args->params[0];
    double factors[MOST_ORDER];
    KOKSMA__FAIL_IF(order == 1, KOKSMA_ARGUMENT, "lattice-rank1: order=1 is not supported; 0, or 2 to %d, would do",
                    MOST_ORDER);
    KOKSMA__TRY(weights_of(args, order, factors));
    if (out->n > 1) {
        KOKSMA__TRY(koksma__lattice_find(args->run, out->n, out->dim, order, factors, 1, z));
    }
    return koksma__fill_lattice(args->run, z, out);
}

static const koksma_param params[] = {
    {"order", "count only projections of up to this number of coordinates, 2 to 8; 0: count all", 0, 0, MOST_ORDER,
     NULL, true},
    {"gamma2", "weight of projections of 2 coordinates (single coordinates have 1); -1: 0.038", -1, -1, 1e6, NULL,
     false},
    {"gamma3", "weight of projections of 3 coordinates; -1: 0.038^2", -1, -1, 1e6, NULL, false},
    {"gamma4", "weight of projections of 4 coordinates; -1: 0.038^3", -1, -1, 1e6, NULL, false},
    {"gamma5", "weight of projections of 5 coordinates; -1: 0.038^4", -1, -1, 1e6, NULL, false},
    {"gamma6", "weight of projections of 6 coordinates; -1: 0.038^5", -1, -1, 1e6, NULL, false},
    {"gamma7", "weight of projections of 7 coordinates; -1: 0.038^6", -1, -1, 1e6, NULL, false},
    {"gamma8", "weight of projections of 8 coordinates; -1: 0.038^7", -1, -1, 1e6, NULL, false},
    {0},
};

const koksma_pattern koksma__pattern_lattice_rank1 = {
    .name = "lattice-rank1",
    .title = "rank-1 lattice whose vector is built component by component for a low l2-wraparound",
    .cite = "sloan2002 nuyens2006 nuyens2006a sloan1998 dick2013 cools2006 hickernell1998",
    .min_dim = 1,
    .max_dim = MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_ANY_N |
              KOKSMA_CLAIM_LATTICE | KOKSMA_CLAIM_LATIN,
    .params = params,
    .generate = generate,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * hammersley: the first coordinate is (i + offset)/n; the others are the Halton sequence of one dimension less.
 *
 *     x_0 = (i + offset) / n,   x_k = phi_b(i), b the k-th prime
 *
 * Source: Hammersley 1960. offset=0.5 has a lower star discrepancy than offset=0. In 2D, n = 2^m points are a
 * (0,m,2)-net in base 2. Known exactly: in 2D with n = 16 the star discrepancy is 0.171875 with offset 0, and
 * 0.15234375 with offset 1/2.
 *
 *     scramble=owen  Owen's nested uniform scrambling (1995), exact: the radical inverses are scrambled as in halton,
 *                    and x_0 in base 2 if n is a power of 2; otherwise x_0 is uniform in [i/n, (i+1)/n). offset has
 *                    no effect
 */
#include <math.h>

#include "core/status.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { NONE, OWEN };

/* Computes the generator matrices of the 2D set with n = 2^m and an offset that is a multiple of 2^(m-32). The points
   are then a digital net in base 2; as 32-bit numbers its coordinates are i 2^(32-m) + start and i with its bits
   reversed. */
typedef struct net {
    uint32_t directions[2][32], start;
} net;

static bool make_net(uint64_t n, double offset, net *s)
{
    const int m = koksma__levels_of(n);
    const double start = ldexp(offset, 32 - m);
    if (m > 32 || (uint64_t)1 << m != n || start != floor(start)) {
        return false;
    }
    for (int b = 0; b < 32; b++) {
        s->directions[0][b] = b < m ? (uint32_t)1 << (32 - m + b) : 0;
        s->directions[1][b] = (uint32_t)1 << (31 - b);
    }
    s->start = (uint32_t)start;
    return true;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    net digital;
    KOKSMA__FAIL_IF(args->params[1] == OWEN && args->params[0] != 0, KOKSMA_ARGUMENT,
                    "hammersley: offset has no effect with scramble=owen; leave out one of the two");
    if (args->params[1] == OWEN) {
        return koksma__owen_hammersley(seed, args->run, out);
    }
    if (out->dim == 2 && make_net(args->n, args->params[0], &digital)) {
        const uint32_t *directions[2] = {digital.directions[0], digital.directions[1]},
                       starts[2] = {digital.start, 0};
        return koksma__range_digital(args, directions, starts, out);
    }
    return koksma__range_radicals(args, args->n, &args->params[0], NULL, NULL, out);
}

static bool ranges(const double *params)
{
    return params[1] != OWEN;
}

static const char *const scrambles[] = {"none", "owen", NULL};

static const koksma_param params[] = {
    {"offset", "offset of the first coordinate, in units of 1/n", 0, 0, 0.999, NULL, false},
    {"scramble", "scrambling: none, or owen (exact nested scrambling, each coordinate in its base)", NONE, NONE, OWEN,
     scrambles, true},
    {0},
};

const koksma_pattern koksma__pattern_hammersley = {
    .name = "hammersley",
    .title = "equidistant first coordinate, radical inverses for the others",
    .cite = "hammersley1960 owen1995 helmer2021",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2,
    .params = params,
    .generate = generate,
    .ranges = ranges,
};

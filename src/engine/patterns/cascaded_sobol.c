/* SPDX-License-Identifier: Apache-2.0 */
/*
 * cascaded-sobol: n = 2^m points, where each coordinate, as a whole number below n, is the index into the
 * one-dimensional Sobol' sequence that gives the next coordinate. Every pair of consecutive coordinates is thus a
 * (0,m,2)-net in base 2.
 *
 *     y_0 = the m bits of i reversed,  y_k+1 = the first m digits of dimension k + 2 of Sobol' at index y_k,
 *     x_k = y_k / n
 *
 * Source: Paulin, Coeurjolly, Iehl, Bonneel, Keller & Ostromoukhov 2021. The paper optimises the direction numbers;
 * this file uses those of Joe & Kuo 2008. For any direction numbers, a one-dimensional digital sequence paired with
 * its index is a (0,m,2)-net (Niederreiter 1987). Coordinates have m binary digits; the modifier owen scrambles these
 * and adds random digits below them. All points change with n.
 */
#include <stdlib.h>

#include "core/status.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { BITS = 32, MOST_LEVELS = 31 };

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const int levels = koksma__levels_of(out->n), m = levels < MOST_LEVELS ? levels : MOST_LEVELS;
    KOKSMA__FAIL_IF((uint64_t)1 << m != out->n, KOKSMA_N,
                    "cascaded-sobol: n = %zu is not a power of two up to 2^%d; n = %zu would do", out->n, MOST_LEVELS,
                    (size_t)1 << m);
    const size_t bytes = (size_t)out->dim * BITS * sizeof(uint32_t);
    uint32_t(*directions)[BITS] = calloc(1, bytes);
    KOKSMA__REQUIRE_MEMORY(directions, bytes);
    for (int b = 0; b < m; b++) {
        directions[0][b] = 0x80000000u >> b;
        for (int k = 1; k < out->dim; k++) {
            const uint32_t *next = koksma__sobol_directions(k, 0), index = directions[k - 1][b] >> (BITS - m);
            directions[k][b] = koksma__digital_start(next, index) & ~(0xffffffffu >> m);
        }
    }
    const koksma__digital_columns columns = {.directions = (const uint32_t(*)[32])directions};
    const koksma_status status = koksma__range_columns(args, out, koksma__digital_column, &columns);
    free(directions);
    return status;
}

const koksma_pattern koksma__pattern_cascaded_sobol = {
    .name = "cascaded-sobol",
    .title = "n = 2^m points whose pairs of consecutive coordinates are (0,m,2)-nets: each coordinate is an index "
             "into the next Sobol' dimension",
    .cite = "paulin2021 joe2008 niederreiter1987",
    .min_dim = 1,
    .max_dim = KOKSMA__SOBOL_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_LATIN | KOKSMA_CLAIM_NET2 |
              KOKSMA_CLAIM_PAIRS,
    .generate = generate,
};

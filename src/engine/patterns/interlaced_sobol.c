/* SPDX-License-Identifier: Apache-2.0 */
/*
 * interlaced-sobol: a higher-order digital sequence. Each coordinate interlaces the binary digits of `order`
 * coordinates of the Sobol' sequence.
 *
 *     digit number d (l - 1) + r of x_k is digit l of y_(d (k - 1) + r),   d = order, r = 1 .. d, y the Sobol' points
 *
 * For integrands with square-integrable mixed derivatives up to `order` the error falls as n^-order in place of n^-1,
 * up to powers of log n: for exp in one dimension from 2^5 points on, for products in three dimensions from about
 * 2^10. For integrands that are not smooth the points are worse than the Sobol' points.
 *
 *     scramble=owen   scrambles the coordinates before they are interlaced: estimates are unbiased, and errors fall as
 *                     n^(-order - 1/2). The modifier owen=1 scrambles after interlacing and destroys this rate
 *
 * Source: Dick 2008; scrambled: Dick 2011. A coordinate has 53 binary digits; each of its Sobol' coordinates supplies
 * 53 / order of these, but at most 32. With order=2 errors therefore stop decreasing at 2^26 points. With order=1 the
 * points are those of the pattern sobol.
 */
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum {
    BLOCK = 4096,
    DIGITS = 53,
    MOST_ORDER = 5,
    SOBOL_OWEN = 3 /* the value `owen` of the parameter scramble of the pattern sobol */
};

typedef struct interlacing {
    uint64_t seed;
    const koksma_args *args;
    koksma_points *out;
    int order;
    uint64_t spread[256];
} interlacing;

/* Stores for each byte its bits with `order` - 1 zeros between adjacent bits. */
static void make_spread(int order, uint64_t spread[256])
{
    for (int byte = 0; byte < 256; byte++) {
        spread[byte] = 0;
        for (int bit = 0; bit < 8; bit++) {
            spread[byte] |= (uint64_t)(byte >> bit & 1) << (order * bit);
        }
    }
}

/* Returns the number whose binary digits are those of `order` numbers y in turn. The digits are placed byte by byte:
   digit j of byte k of y_r becomes digit order (8 k + j) + r. */
static double interlace(const double *y, int order, const uint64_t *spread)
{
    uint64_t x = 0;
    for (int r = 0; r < order; r++) {
        uint64_t word = (uint64_t)(y[r] * 0x1p53) << 11;
        for (int shift = DIGITS - 1 - r - 7 * order; shift > -8 * order; shift -= 8 * order, word <<= 8) {
            const uint64_t bits = spread[word >> 56];
            x |= shift >= 0 ? bits << shift : bits >> -shift;
        }
    }
    return (double)x * 0x1p-53;
}

static koksma_status make_block(void *context, size_t block)
{
    const interlacing *j = context;
    const koksma_run alone = {.threads = 1};
    const size_t first = block * BLOCK, left = j->out->n - first, count = left < BLOCK ? left : BLOCK;
    koksma_args args = {
        .run = &alone, .first = j->args->first + first, .params = {j->args->params[1] > 0 ? SOBOL_OWEN : 0}};
    koksma_points base;
    KOKSMA__TRY(koksma_points_init(&base, count, j->out->dim * j->order));
    const koksma_status status = koksma__pattern_sobol.generate(j->seed, &args, &base);
    for (size_t i = 0; !status && i < count * (size_t)j->out->dim; i++) {
        j->out->xs[first * (size_t)j->out->dim + i] = interlace(base.xs + i * (size_t)j->order, j->order, j->spread);
    }
    koksma_points_fini(&base);
    return status;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    interlacing j = {seed, args, out, (int)args->params[0], {0}};
    KOKSMA__FAIL_IF(out->dim * j.order > KOKSMA__SOBOL_DIM, KOKSMA_DIM,
                    "interlaced-sobol: order=%d needs %d coordinates of Sobol' for each coordinate: dim can be at "
                    "most %d, not %d",
                    j.order, j.order, KOKSMA__SOBOL_DIM / j.order, out->dim);
    make_spread(j.order, j.spread);
    return koksma__parallel(args->run, (out->n + BLOCK - 1) / BLOCK, make_block, &j);
}

static const char *const scrambles[] = {"none", "owen", NULL};

static const koksma_param params[] = {
    {"order", "number of Sobol' coordinates that are interlaced into one, 1 to 5", 2, 1, MOST_ORDER, NULL, true},
    {"scramble", "scrambling before the coordinates are interlaced: none or owen", 0, 0, 1, scrambles, true},
    {0},
};

const koksma_pattern koksma__pattern_interlaced_sobol = {
    .name = "interlaced-sobol",
    .title = "higher-order sequence for smooth integrands: each coordinate interlaces the digits of several Sobol' "
             "coordinates",
    .cite = "dick2008 dick2011 joe2008",
    .min_dim = 1,
    .max_dim = KOKSMA__SOBOL_DIM,
    .claims =
        KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N,
    .params = params,
    .generate = generate,
    .ranges = koksma__ranges_always,
};

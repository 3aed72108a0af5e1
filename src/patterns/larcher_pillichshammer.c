/* SPDX-License-Identifier: Apache-2.0 */
/*
 * larcher-pillichshammer: a digital (0,m,2)-net in base 2 with a lower discrepancy than Hammersley's.
 *
 *     x = i / n,   y = the sum modulo 2, digit by digit, of 2^-1 + 2^-2 + … + 2^-(b+1) over the set bits b of i
 *
 * The matrix of y has ones on and above its diagonal. Source: Larcher & Pillichshammer 2001; the generator in the
 * form of Kollig & Keller 2002. Known exactly, n = 16: D* = 0.140625; n = 1024: 3.41796875 / n. For n = 2^m, n D*
 * grows like m / 5 (Larcher & Pillichshammer 2003), Hammersley's like m / 3.
 */
#include "kernels/kernels.h"
#include "patterns/parts/columns.h"
#include "patterns/patterns.h"

static void column(const void *context, int k, size_t first, size_t count, double *xs)
{
    const double n = *(const double *)context;
    if (k == 0) {
        koksma__kernels()->steps(count, (double)first, 0, n, xs);
        return;
    }
    uint32_t directions[32], v[KOKSMA__COLUMN_BLOCK], start = 0;
    for (int b = 0; b < 32; b++) {
        directions[b] = 0xffffffffu << (31 - b);
        start ^= first >> b & 1 ? directions[b] : 0;
    }
    koksma__kernels()->digital(count, directions, start, v);
    koksma__kernels()->fractions(count, v, xs);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const double n = (double)out->n;
    return koksma__fill_columns(args->run, out, column, &n);
}

const koksma_pattern koksma__pattern_larcher_pillichshammer = {
    .name = "larcher-pillichshammer",
    .title = "a digital net that beats Hammersley's",
    .cite = "larcher2001 larcher2003 kollig2002",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2,
    .generate = generate,
};

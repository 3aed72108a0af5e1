/* SPDX-License-Identifier: Apache-2.0 */
/*
 * larcher-pillichshammer: a digital (0,m,2)-net in base 2 with a lower discrepancy than Hammersley's.
 *
 *     x = i / n,   y = the sum modulo 2, digit by digit, of 2^-1 + 2^-2 + … + 2^-(b+1) over the set bits b of i
 *
 * The matrix of y has ones on and above its diagonal. Source: Larcher & Pillichshammer 2001; the generator in the
 * form of Kollig & Keller 2002. Known exactly, n = 16: D* = 0.140625; n = 1024: 3.41796875 / n. For n = 2^m, n D*
 * grows as m / 5 (Larcher & Pillichshammer 2003), while for Hammersley's net it grows as m / 3.
 *
 *     scramble=owen  Owen's nested uniform scrambling (1995) in base 2, exact, in steps of 2^-32; where n is not
 *                    a power of 2, x is uniform in [i/n, (i+1)/n)
 */
#include <stdlib.h>

#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

static void fill_directions(uint32_t directions[32])
{
    for (int b = 0; b < 32; b++) {
        directions[b] = 0xffffffffu << (31 - b);
    }
}

static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const double n = *(const double *)context;
    if (k == 0) {
        koksma__kernels()->steps(count, (double)first, 0, n, xs);
        return;
    }
    uint32_t directions[32], v[KOKSMA__COLUMN_BLOCK];
    fill_directions(directions);
    koksma__kernels()->digital(count, directions, koksma__digital_start(directions, first), v);
    koksma__kernels()->fractions(count, v, xs);
}

static koksma_status generate_owen(uint64_t seed, const koksma_run *run, koksma_points *out)
{
    uint32_t directions[32], partners[32], *v = malloc(out->n * sizeof *v);
    KOKSMA__REQUIRE_MEMORY(v, out->n * sizeof *v);
    fill_directions(directions);
    koksma__partners(directions, 32, partners);
    koksma_status status = koksma__grow_column(seed, KOKSMA__PURPOSE_SCRAMBLE, partners, run, out->n, v);
    status = status ? status : koksma__owen_equidistant(seed, run, out);
    for (size_t i = 0; i < out->n && !status; i++) {
        out->xs[2 * i + 1] = v[i] * 0x1p-32;
    }
    free(v);
    return status;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    if (args->params[0] == KOKSMA__SCRAMBLE_OWEN) {
        return generate_owen(seed, args->run, out);
    }
    const double n = (double)args->n;
    return koksma__range_columns(args, out, column, &n);
}

static const koksma_param params[] = {KOKSMA__PARAM_SCRAMBLE(" in base 2"), {0}};

const koksma_pattern koksma__pattern_larcher_pillichshammer = {
    .name = "larcher-pillichshammer",
    .title = "a digital net with a lower star discrepancy than Hammersley's",
    .cite = "larcher2001 larcher2003 kollig2002 owen1995 helmer2021",
    .min_dim = 2,
    .max_dim = 2,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2,
    .params = params,
    .generate = generate,
    .ranges = koksma__ranges_unscrambled,
};

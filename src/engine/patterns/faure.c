/* SPDX-License-Identifier: Apache-2.0 */
/*
 * faure: the (0,dim)-sequence of Faure in the smallest prime base b >= dim.
 *
 *     x_k = sum_r y_r b^(-r-1),   y = P^k a mod b: y_r = sum_(c >= r) C(c,r) k^(c-r) a_c
 *
 * with a the digits of i and P the upper triangular Pascal matrix. The first b^m points are a (0,m,dim)-net in base
 * b. Every unscrambled coordinate is the double nearest to its exact fraction. Source: Faure 1982.
 *
 *     scramble=owen  Owen's nested uniform scrambling (1995) in base b, drawn exactly, by stochastic generation
 * (Helmer, Christensen & Kensler 2021); coordinates are multiples of b^-M, where b^M is the largest power up to 2^53
 */
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

/* Points r and b^l d + r', with l = `level`, agree in the first l digits of y = P^k a if in these digits P^k (r' + d e)
   = P^k r, where e is the unit vector of digit l. Therefore r' is r plus d times the first l entries of column l of
   P^-k, which is P^(b-k) modulo b. This column has the coefficients of (x + b - k)^l. */
static void relatives(const void *context, int k, int level, uint32_t *digits)
{
    const uint32_t b = *(const uint32_t *)context, t = (b - (uint32_t)k) % b;
    uint32_t power[KOKSMA__OWEN_DIGITS + 1] = {1};
    for (int l = 1; l <= level; l++) {
        for (int c = l; c >= 0; c--) {
            power[c] = ((c > 0 ? power[c - 1] : 0) + t * power[c]) % b;
        }
    }
    for (int c = 0; c < level; c++) {
        digits[c] = power[c];
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    uint32_t base = 2;
    for (int k = 1; base < (uint32_t)out->dim; k++) {
        base = koksma__prime(k);
    }
    if (args->params[0] == KOKSMA__SCRAMBLE_OWEN) {
        return koksma__owen_sequence(seed, base, relatives, &base, args->run, out);
    }
    return koksma__digit_sequence("faure", base, koksma__digits_of_double(base), koksma__pascal_matrix, args, out);
}

static const koksma_param params[] = {KOKSMA__PARAM_SCRAMBLE(" in base b"), {0}};

const koksma_pattern koksma__pattern_faure = {
    .name = "faure",
    .title = "the (0,dim)-sequence in the smallest prime base",
    .cite = "faure1982 owen1995 helmer2021",
    .min_dim = 1,
    .max_dim = 1000,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET_PREFIXES,
    .params = params,
    .generate = generate,
    .ranges = koksma__ranges_unscrambled,
};

/* SPDX-License-Identifier: Apache-2.0 */
/* Truncated normal numbers by inverting their distribution function: koksma__log and koksma__inverse_erf of
   core/elementary.h in lanes, step by step, so that the bits are those of the reference. */
#include "core/elementary.h"
#include "kernels/kernels.h"
#include "kernels/lanes64.h"

/* koksma__log of normal numbers from 0 to 1: x = 2^e m with m from 1/2 to 1 by the bits, as frexp does. */
static inline lanes64_d log_of(lanes64_d x)
{
    const lanes64_u bits = (lanes64_u)x;
    lanes64_d m = (lanes64_d)((bits & 0xfffffffffffffu) | 0x3fe0000000000000u), e = lanes64_whole(bits >> 52) - 1022;
    const lanes64_i low = (lanes64_i)(m < 0x1.6a09e667f3bcdp-1);
    m += lanes64_masked(low, m);
    e -= lanes64_masked(low, lanes64_splat_d(1));
    const lanes64_d f = (m - 1) / (m + 1), square = f * f;
    lanes64_d sum = {0};
    for (int i = 23; i >= 3; i -= 2) {
        sum = sum * square + 1.0 / i;
    }
    return e * 0x1.62e42feep-1 + (2 * f + (2 * f * square * sum + e * 0x1.a39ef35793c76p-33));
}

static inline lanes64_d polynomial(int part, lanes64_d z)
{
    const double *terms = koksma__inverse_erf_terms(part);
    lanes64_d t = lanes64_splat_d(terms[0]);
    for (int i = 1; i < KOKSMA__INVERSE_ERF_TERMS; i++) {
        t = t * z + terms[i];
    }
    return t;
}

static inline lanes64_d inverse_erf(lanes64_d x)
{
    const lanes64_d w = -log_of((1 - x) * (1 + x));
    lanes64_d t = polynomial(0, w - 3.125);
    const lanes64_i tails = (lanes64_i)(w >= 6.25);
    if (lanes64_any(tails)) {
        const lanes64_d root = lanes64_sqrt(w);
        t = lanes64_chosen(tails, polynomial(1, root - 3.25), t);
        t = lanes64_chosen((lanes64_i)(w >= 16), polynomial(2, root - 5), t);
        t = lanes64_chosen((lanes64_i)(lanes64_abs(x) >= 1), lanes64_splat_d(6), t);
    }
    return t * x;
}

void KERNEL_NAME(truncated_normals)(double reach, double scale, size_t count, double *xs)
{
    const lanes64_d zero = lanes64_splat_d(0), one = lanes64_splat_d(1);
    for (size_t i = 0; i < count; i += LANES64) {
        double rest[LANES64] = {0}; /* the last numbers, where they are fewer than lanes */
        const size_t some = count - i < LANES64 ? count - i : LANES64;
        if (some < LANES64) {
            memcpy(rest, xs + i, some * sizeof *xs);
        }
        const lanes64_d u = lanes64_load_d(some < LANES64 ? rest : xs + i);
        const lanes64_d v = lanes64_min(lanes64_max(0.5 + scale * inverse_erf((2 * u - 1) * reach), zero), one);
        memcpy(rest, &v, sizeof rest);
        memcpy(xs + i, rest, some * sizeof *xs);
    }
}

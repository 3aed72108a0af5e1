/* SPDX-License-Identifier: Apache-2.0 */
/*
 * orthogonal-array: points on a jittered orthogonal array: every 2D projection has one point in each of s x s cells
 * (strength 2, n = s^2), or every 3D projection has one in each of s x s x s cells (strength 3, n = s^3), where s is
 * prime.
 *
 *     strength 2   up to s + 1 dimensions (Bose 1938): point i has the levels i div s, i mod s and, for k = 1, 2, ...,
 *                  (i div s + k (i mod s)) mod s
 *     strength 3   up to s dimensions (Bush 1952): the digits of i in base s are the coefficients of a polynomial, and
 *                  level k of point i is its value at k, modulo s
 *
 * The levels of each coordinate are permuted at random, and the n/s points of each level are put, in random order,
 * into the n/s strata of that level, so that the points are also n-rooks. Source: Owen 1992; the multi-jittered
 * arrays of Jarosz et al. 2019.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/grids/grids.h"
#include "patterns/patterns.h"

enum { FEW = 256 };

static bool is_prime(size_t s)
{
    for (size_t p = 2; p * p <= s; p++) {
        if (s % p == 0) {
            return false;
        }
    }
    return s >= 2;
}

static size_t power(size_t s, int strength)
{
    return strength == 2 ? s * s : s * s * s;
}

static koksma_status find_levels(size_t n, int dim, int strength, size_t *levels)
{
    size_t s = (size_t)koksma__pow((double)n, 1.0 / strength);
    s += power(s + 1, strength) <= n;
    const size_t columns = strength == 2 ? s + 1 : s;
    if (power(s, strength) == n && is_prime(s) && (size_t)dim <= columns) {
        *levels = s;
        return KOKSMA_OK;
    }
    size_t low = s, high = s + 1;
    const size_t least = (size_t)(strength == 2 ? dim - 1 : dim);
    while (low >= 2 && !is_prime(low)) {
        low--;
    }
    while (!is_prime(high) || high < least) {
        high++;
    }
    if (low < 2 || low < least) {
        low = high;
    }
    KOKSMA__FAIL_IF(power(low, strength) > KOKSMA_MAX_COORDINATES / (size_t)dim, KOKSMA_DIM,
                    "orthogonal-array: dim = %d is too large: a set of strength %d would have too many points", dim,
                    strength);
    char other[32] = "";
    if (low != high && power(high, strength) <= KOKSMA_MAX_COORDINATES / (size_t)dim) {
        snprintf(other, sizeof other, " or %zu", power(high, strength));
    }
    return koksma__fail(
        KOKSMA_N,
        "orthogonal-array: n = %zu is not s^%d with a prime s that is large enough for dim = %d; n = %zu%s would do",
        n, strength, dim, power(low, strength), other);
}

static size_t level(size_t i, size_t s, int k, int strength)
{
    const size_t a = i / s % s, b = i % s, at = (size_t)k;
    if (strength == 2) {
        return k == 0 ? a : k == 1 ? b : (a + (at - 1) * b) % s;
    }
    return ((i / s / s * at + a) % s * at + b) % s;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const int strength = (int)args->params[0];
    const size_t n = out->n;
    size_t s = 0;
    KOKSMA__TRY(find_levels(n, out->dim, strength, &s));
    KOKSMA__TRY(koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, n * (size_t)out->dim, out->xs));
    uint32_t few[FEW + 2 * 16 + 16];
    uint32_t *strata = n <= FEW ? few : malloc((n + 2 * s) * sizeof *strata);
    KOKSMA__REQUIRE_MEMORY(strata, (n + 2 * s) * sizeof *strata);
    uint32_t *order = strata + n, *used = order + s;
    for (int k = 0; k < out->dim; k++) {
        const uint64_t own = koksma__random_seed(seed, (uint64_t)k, KOKSMA__PURPOSE_SHUFFLE);
        koksma__random_permutation(own, 0, (uint32_t)s, order);
        for (size_t l = 0; l < s; l++) {
            koksma__random_permutation(own, 1 + (uint32_t)l, (uint32_t)(n / s), strata + l * (n / s));
            used[l] = 0;
        }
        for (size_t i = 0; i < n; i++) {
            const size_t l = order[level(i, s, k, strength)];
            double *x = out->xs + i * (size_t)out->dim + k;
            *x = koksma__in_cell((double)(l * (n / s) + strata[l * (n / s) + used[l]++]), *x, (double)n);
        }
    }
    if (strata != few) {
        free(strata);
    }
    return KOKSMA_OK;
}

static const koksma_param params[] = {
    {"strength", "2: n = s^2, 2D projections; 3: n = s^3, 3D projections", 2, 2, 3, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_orthogonal_array = {
    .name = "orthogonal-array",
    .title = "all 2D (or 3D) projections stratified",
    .cite = "bose1938 bush1952 owen1992 jarosz2019",
    .min_dim = 2,
    .max_dim = 644, /* sets with s = 643 levels; larger primes s exceed KOKSMA_MAX_COORDINATES */
    .claims = KOKSMA_CLAIM_LATIN | KOKSMA_CLAIM_OA2 | KOKSMA_CLAIM_OA3 | KOKSMA_CLAIM_UNBIASED,
    .params = params,
    .generate = generate,
};

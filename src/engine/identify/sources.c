/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The digital sequences that points are compared with: those of Sobol' with each set of direction numbers of this
 * library, that of Niederreiter in base 2 (Bratley, Fox & Niederreiter 1992, as in GSL), radical inverses in the
 * primes (Halton) and Faure's. A coordinate of point i is a matrix times the digits of i; radical inverses have the
 * unit matrix.
 *
 * Niederreiter's matrix for an irreducible polynomial p of degree e has in row q e + u the numbers v_u, v_(u+1), ...
 * of the linear recurrence of p^(q+1), which begins with e q zeros and e ones, as Bratley, Fox & Niederreiter chose
 * it.
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "identify/sample.h"
#include "patterns/nets/nets.h"

enum { SOBOL, NIEDERREITER, RADICAL, FAURE };

static const koksma__source sources[] = {
    {"Sobol' (Joe & Kuo 2008, new-joe-kuo-6.21201)", "sobol", SOBOL, KOKSMA__JOE_KUO, 1111},
    {"Halton", "halton", RADICAL, 0, 1111},
    {"Sobol' (Bratley & Fox 1988, ACM 659)", "sobol:numbers=bratley-fox", SOBOL, KOKSMA__BRATLEY_FOX, 40},
    {"Niederreiter in base 2 (Bratley, Fox & Niederreiter 1992)", "", NIEDERREITER, 0, 12},
    {"Faure", "faure", FAURE, 0, 1000},
    {"Sobol' (groups of dimensions, of this library)", "sobol:numbers=groups", SOBOL, KOKSMA__GROUPS, 128},
};

const koksma__source *koksma__source_at(size_t i)
{
    return i < sizeof sources / sizeof *sources ? &sources[i] : NULL;
}

int koksma__source_dims(const koksma__source *source, int dim)
{
    return source->kind == FAURE ? dim : source->dims;
}

uint64_t koksma__gray(uint64_t i)
{
    return i ^ i >> 1;
}

uint64_t koksma__from_gray(uint64_t g)
{
    for (int shift = 32; shift; shift /= 2) {
        g ^= g >> shift;
    }
    return g;
}

static int degree(uint64_t p)
{
    return 63 - __builtin_clzll(p);
}

static uint64_t product(uint64_t a, uint64_t b)
{
    uint64_t c = 0;
    for (; b; b >>= 1, a <<= 1) {
        c ^= b & 1 ? a : 0;
    }
    return c;
}

static bool is_irreducible(uint64_t p)
{
    for (uint64_t q = 2; 2 * degree(q) <= degree(p); q++) {
        uint64_t rest = p;
        while (rest && degree(rest) >= degree(q)) {
            rest ^= q << (degree(rest) - degree(q));
        }
        if (!rest) {
            return false;
        }
    }
    return true;
}

/* Fills the columns of Niederreiter's matrix for the j-th irreducible polynomial, from x on. */
static void niederreiter(int j, uint32_t columns[32])
{
    uint64_t p = 2;
    for (int seen = 0; seen < j;) {
        seen += is_irreducible(++p);
    }
    const int e = degree(p);
    uint64_t power = 1;
    for (int c = 0; c < 32; c++) {
        columns[c] = 0;
    }
    for (int row = 0; row < 32; row += e) {
        unsigned char v[96] = {0};
        power = product(power, p);
        const int m = degree(power);
        for (int r = m - e; r < 32 + e; r++) {
            v[r] = r < m;
            for (int k = 0; k < m && r >= m; k++) {
                v[r] ^= power >> k & 1 ? v[r - m + k] : 0;
            }
        }
        for (int u = 0; u < e && row + u < 32; u++) {
            for (int c = 0; c < 32; c++) {
                columns[c] |= v[c + u] ? 0x80000000u >> (row + u) : 0;
            }
        }
    }
}

/* Reduces the columns, from the first on, to an echelon form: pivots[r] has its highest bit in row r, or is 0. */
static void reduce_columns(koksma__coordinate *c)
{
    for (int b = 0; b < 32; b++) {
        uint64_t v = c->directions[b], combination = (uint64_t)1 << b;
        while (v) {
            const int row = __builtin_clz((uint32_t)v);
            if (!c->pivots[row]) {
                c->pivots[row] = v;
                c->combinations[row] = combination;
                break;
            }
            v ^= c->pivots[row];
            combination ^= c->combinations[row];
        }
    }
}

/* Prepares coordinate j. */
static koksma_status init(const koksma__source *source, int dim, int j, koksma__coordinate *c)
{
    *c = (koksma__coordinate){.base = 2, .digits = 32};
    if (source->kind == RADICAL) {
        c->base = koksma__prime(j);
    }
    for (int k = 1; source->kind == FAURE && c->base < (uint32_t)dim; k++) {
        c->base = koksma__prime(k);
    }
    if (source->kind == RADICAL || source->kind == FAURE) {
        c->digits = koksma__digits_of_double(c->base);
    }
    c->powers[0] = 1;
    for (int k = 1; k <= c->digits; k++) {
        c->powers[k] = c->powers[k - 1] * c->base;
    }
    c->whole = (double)c->powers[c->digits];
    if (source->kind == FAURE) {
        const size_t entries = (size_t)c->digits * (size_t)c->digits;
        c->matrix = malloc(2 * entries * sizeof *c->matrix);
        KOKSMA__REQUIRE_MEMORY(c->matrix, 2 * entries * sizeof *c->matrix);
        c->inverse = c->matrix + entries;
        koksma__pascal_matrix(c->base, j, c->digits, c->matrix);
        koksma__pascal_matrix(c->base, ((int)c->base - j) % (int)c->base, c->digits, c->inverse); /* P^base = 1 */
    } else if (source->kind == SOBOL) {
        c->directions = koksma__sobol_directions(j, source->set);
    } else if (source->kind == NIEDERREITER) {
        niederreiter(j, c->own);
        c->directions = c->own;
    }
    if (c->directions) {
        reduce_columns(c);
    }
    return KOKSMA_OK;
}

koksma_status koksma__coordinates_init(const koksma__source *source, int dim, int count, koksma__coordinate **out)
{
    *out = calloc((size_t)count, sizeof **out);
    KOKSMA__REQUIRE_MEMORY(*out, (size_t)count * sizeof **out);
    for (int j = 0; j < count; j++) {
        KOKSMA__TRY(init(source, dim, j, &(*out)[j]));
    }
    return KOKSMA_OK;
}

void koksma__coordinates_fini(koksma__coordinate *coordinates, int count)
{
    for (int j = 0; coordinates && j < count; j++) {
        free(coordinates[j].matrix);
    }
    free(coordinates);
}

/* y = C a, digit by digit, where a are the digits of i. */
static uint64_t matrix_numerator(const koksma__coordinate *c, uint64_t i)
{
    uint32_t a[64];
    int count = 0;
    for (; i && count < c->digits; i /= c->base) {
        a[count++] = (uint32_t)(i % c->base);
    }
    uint64_t sum = 0;
    for (int r = 0; r < count; r++) {
        uint64_t y = 0;
        for (int l = r; l < count; l++) {
            y += (uint64_t)c->matrix[r * c->digits + l] * a[l];
        }
        sum += y % c->base * c->powers[c->digits - 1 - r];
    }
    return sum;
}

uint64_t koksma__numerator(const koksma__coordinate *c, uint64_t i)
{
    uint64_t sum = 0;
    if (c->directions) {
        for (i &= UINT32_MAX; i; i &= i - 1) {
            sum ^= c->directions[__builtin_ctzll(i)];
        }
        return sum;
    }
    if (c->matrix) {
        return matrix_numerator(c, i);
    }
    for (int k = c->digits - 1; i && k >= 0; k--, i /= c->base) {
        sum += i % c->base * c->powers[k];
    }
    return sum;
}

static uint64_t binary_index(const koksma__coordinate *c, double x, double tolerance)
{
    int digits = 32;
    while (digits > 1 && tolerance * ldexp(8, digits) > 1) {
        digits--;
    }
    const double v = nearbyint(ldexp(x, digits));
    if (v >= ldexp(1, digits)) {
        return UINT64_MAX;
    }
    uint64_t rest = (uint64_t)v << (32 - digits), index = 0;
    while (rest) {
        const int row = __builtin_clz((uint32_t)rest);
        if (!c->pivots[row]) {
            return UINT64_MAX;
        }
        rest ^= c->pivots[row];
        index ^= c->combinations[row];
    }
    return index;
}

/* a = C^-1 y, where y are the digits of v, the last of which is digit digits - 1 of the coordinate. */
static uint64_t inverse_index(const koksma__coordinate *c, uint64_t v, int digits)
{
    uint32_t y[64];
    uint64_t index = 0;
    for (int r = digits - 1; r >= 0; r--, v /= c->base) {
        y[r] = (uint32_t)(v % c->base);
    }
    for (int r = digits - 1; r >= 0; r--) {
        uint64_t a = 0;
        for (int l = r; l < digits; l++) {
            a += (uint64_t)c->inverse[r * c->digits + l] * y[l];
        }
        index = index * c->base + a % c->base;
    }
    return index;
}

uint64_t koksma__index_of(const koksma__coordinate *c, double x, double tolerance)
{
    if (c->directions) {
        return binary_index(c, x, tolerance);
    }
    int digits = c->digits;
    while (digits > 1 && tolerance * (double)c->powers[digits] > .1) {
        digits--;
    }
    const double v = nearbyint(x * (double)c->powers[digits]);
    if (v >= (double)c->powers[digits]) {
        return UINT64_MAX;
    }
    uint64_t rest = (uint64_t)v, index = 0;
    if (c->matrix) {
        return inverse_index(c, rest, digits);
    }
    for (int k = 0; k < digits; k++, rest /= c->base) {
        index = index * c->base + rest % c->base;
    }
    return index;
}

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Direction numbers of Sobol' sequences from primitive polynomials and initial numbers (those of Joe & Kuo 2008,
 * those of Bratley & Fox 1988 and our own), expanded once by the recurrence of Sobol 1967.
 */
#include "patterns/nets/nets.h"

#include <pthread.h>

#include "patterns/data/sobol.inc" /* joe_kuo, bratley_fox and groups, made from sobol.csv */

static pthread_once_t once = PTHREAD_ONCE_INIT;
static uint32_t joe_kuo_columns[KOKSMA__SOBOL_DIM][32], bratley_fox_columns[40][32], groups_columns[128][32];
static uint16_t joe_kuo_polynomials[KOKSMA__SOBOL_DIM], bratley_fox_polynomials[40], groups_polynomials[128];

static const struct {
    const uint16_t *rows;
    uint32_t (*columns)[32];
    uint16_t *polynomials;
    int dim;
} sets[KOKSMA__SOBOL_SETS] = {
    [KOKSMA__JOE_KUO] = {joe_kuo, joe_kuo_columns, joe_kuo_polynomials, KOKSMA__SOBOL_DIM},
    [KOKSMA__BRATLEY_FOX] = {bratley_fox, bratley_fox_columns, bratley_fox_polynomials, 40},
    [KOKSMA__GROUPS] = {groups, groups_columns, groups_polynomials, 128},
};

static int degree_of(uint32_t polynomial)
{
    return polynomial ? 31 - __builtin_clz(polynomial) : 0;
}

/* Expands one row of the table by the recurrence of the polynomial x^s + a_1 x^(s-1) + … + a_(s-1) x + 1,
   m_i = 2 a_1 m_(i-1) ^ 4 a_2 m_(i-2) ^ … ^ 2^s m_(i-s) ^ m_(i-s), where column i is m_i 2^(32-i). */
static const uint16_t *expand(const uint16_t *row, uint32_t *columns)
{
    const uint32_t polynomial = row[0];
    const int degree = degree_of(polynomial);
    for (int i = 0; i < 32; i++) {
        if (i < degree) {
            columns[i] = (uint32_t)row[1 + i] << (31 - i);
            continue;
        }
        columns[i] = columns[i - degree] ^ columns[i - degree] >> degree;
        for (int j = 1; j < degree; j++) {
            columns[i] ^= polynomial >> (degree - j) & 1 ? columns[i - j] : 0;
        }
    }
    return row + 1 + degree;
}

static void expand_all(void)
{
    for (int s = 0; s < KOKSMA__SOBOL_SETS; s++) {
        const uint16_t *row = sets[s].rows;
        for (int i = 0; i < 32; i++) {
            sets[s].columns[0][i] = 0x80000000u >> i;
        }
        for (int k = 1; k < sets[s].dim; k++) {
            sets[s].polynomials[k] = row[0];
            row = expand(row, sets[s].columns[k]);
        }
    }
}

int koksma__sobol_dim(int set)
{
    return sets[set].dim;
}

const uint32_t *koksma__sobol_directions(int k, int set)
{
    pthread_once(&once, expand_all);
    return sets[set].columns[k];
}

uint32_t koksma__sobol_polynomial(int k)
{
    pthread_once(&once, expand_all);
    return joe_kuo_polynomials[k];
}

void koksma__sobol_columns(int k, int set, uint64_t columns[KOKSMA__DIGITS])
{
    const uint32_t *directions = koksma__sobol_directions(k, set), polynomial = sets[set].polynomials[k];
    const int degree = degree_of(polynomial);
    for (int i = 0; i < KOKSMA__DIGITS; i++) {
        if (i < 32 || !degree) { /* dimension 0 has no polynomial; its matrix is the identity */
            columns[i] =
                i < 32 ? (uint64_t)directions[i] << KOKSMA__LATE_DIGITS : UINT64_C(1) << (KOKSMA__DIGITS - 1 - i);
            continue;
        }
        columns[i] = columns[i - degree] ^ columns[i - degree] >> degree;
        for (int j = 1; j < degree; j++) {
            columns[i] ^= polynomial >> (degree - j) & 1 ? columns[i - j] : 0;
        }
    }
}

void koksma__partners(const uint32_t *directions, int levels, uint32_t *partners)
{
    for (int l = 0; l < levels; l++) {
        uint32_t rest = directions[l];
        partners[l] = 0;
        for (int c = l - 1; c >= 0; c--) {
            if (rest >> (31 - c) & 1) {
                rest ^= directions[c];
                partners[l] |= 1u << c;
            }
        }
    }
}

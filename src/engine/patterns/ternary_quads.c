/* SPDX-License-Identifier: Apache-2.0 */
/*
 * ternary-quads: a digital sequence in base 3 whose dimensions 2 k and 2 k + 1 are a (0,2)-sequence, and whose dimensions
 * 4 k .. 4 k + 3 are a (1,4)-sequence, for every k. t = 1 is the least possible value, because a (0,4)-sequence needs
 * a base of at least 4.
 *
 *     matrix of dimension 4 g + b = C_b N_g   modulo 3
 *     C_0, C_1, C_2   row r (from 0) is the Laurent series of 1/(x - b)^(r+1): the powers of Pascal's matrix
 *     C_3             rows 2 q and 2 q + 1 are the series of x/p^(q+1) and 1/p^(q+1), p = x^2 - x - 1
 *     N_g             upper triangular with ones on the diagonal; N_0 is the identity
 *
 * Column c has the coefficient of x^-(c+1) of the series. Source: the aims, base 3 and irreducible polynomials come
 * from Ostromoukhov, Bonneel, Coeurjolly & Iehl (2024), who searched for such matrices; the C_b above, which have the
 * property for every number of points, and the N_g are this project's. Niederreiter (1988) constructed digital
 * sequences from series of rational functions. Why t is 0 and 1:
 *
 *     Take k rows in all, the first ones of some of the C_b, and a linear combination of them that is not 0. This
 *     combination is a fraction whose denominator is the product of the powers of the four polynomials in these rows;
 *     its degree is k, or k + 1 if an odd number of rows comes from C_3. If the first m coefficients of the series
 *     vanish, the degree of the numerator is below that of the denominator minus m. Therefore the rows are
 *     independent for m = k without C_3, and for k = m - 1 with it, which means t = 0 and t = 1. For the pair C_2,
 *     C_3 and m = k the numerator would be a constant. With u = x + 1, p = u^2 + 1 and the leading row is (u -
 *     1)/p^(q+1), so that u^-k would be a constant multiple of u - 1 modulo p. But the powers of u modulo p are 1, u
 *     and their negatives; so t = 0 for this pair, too.
 *
 * Multiplying the matrices of a group from the right by the same upper triangular matrix only permutes the indices
 * below each power of 3, so all groups have these properties. The N_g were found by a search
 * (tools/make_ternary_quads.c) for even projections on pairs of dimensions of different groups. There are 3^33
 * points, because 33 ternary digits fit into a double.
 *
 * Known exactly: the first three coordinates are those of faure in three dimensions.
 *
 *     scramble=owen  Owen's nested uniform scrambling (1995) in base 3, drawn exactly, by stochastic generation
 * (Helmer, Christensen & Kensler 2021); it keeps t in base 3
 */
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { BASE = 3, DIGITS = 33, EARLY = 20, QUAD = 4, MOST_DIM = 128, GROUPS = MOST_DIM / QUAD - 1 };

/* Columns 1 to 19 of all groups (early), and columns 20 to 32, which points from 3^20 on need (late). */
#include "patterns/data/ternary_quads.inc"

_Static_assert(sizeof early == GROUPS * (EARLY - 1) * sizeof *early &&
                   sizeof late == GROUPS * (DIGITS - EARLY) * sizeof *late,
               "all groups have their columns");

/* Returns column c > 0 of N_g above its diagonal, g > 0: its entries are the digits of a number in base 3. */
static uint64_t searched_column(int g, int c)
{
    return c < EARLY ? early[(g - 1) * (EARLY - 1) + c - 1] : late[(g - 1) * (DIGITS - EARLY) + c - EARLY];
}

/* Computes the rows of C_3. From s_i, the coefficients of 1/p^q, those of 1/p^(q+1) follow by long division: s'_i =
   s_(i-2) + s'_(i-1) + s'_(i-2). */
static void fill_quadratic(int digits, uint32_t *matrix)
{
    uint32_t series[DIGITS + 2] = {1}; /* of x^0, x^-1, ... */
    for (int r = 0; r < digits; r += 2) {
        uint32_t next[DIGITS + 2] = {0};
        for (int i = 2; i < digits + 2; i++) {
            next[i] = (series[i - 2] + next[i - 1] + next[i - 2]) % BASE;
        }
        for (int i = 0; i < digits + 2; i++) {
            series[i] = next[i];
        }
        for (int c = 0; c < digits; c++) {
            matrix[r * digits + c] = series[c + 2];
            if (r + 1 < digits) {
                matrix[(r + 1) * digits + c] = series[c + 1];
            }
        }
    }
}

/* Multiplies the matrix by N_g. The last column is replaced first, because each column needs those before it. */
static void multiply(int g, int digits, uint32_t *matrix)
{
    for (int c = digits - 1; g > 0 && c > 0; c--) {
        for (int r = 0; r <= c; r++) {
            uint32_t sum = matrix[r * digits + c];
            uint64_t number = searched_column(g, c);
            for (int i = 0; i < c; i++, number /= BASE) {
                sum += matrix[r * digits + i] * (uint32_t)(number % BASE);
            }
            matrix[r * digits + c] = sum % BASE;
        }
    }
}

static void fill_matrix(uint32_t base, int k, int digits, uint32_t *matrix)
{
    if (k % QUAD < 3) {
        koksma__pascal_matrix(base, k % QUAD, digits, matrix);
    } else {
        fill_quadratic(digits, matrix);
    }
    multiply(k / QUAD, digits, matrix);
}

/* Back substitution: finds z such that the first `level` digits of C (r + d z) and C (r + d e) are equal, where e is
   the unit vector of digit number `level`. The matrix of `level` + 1 digits is the upper left corner of the whole
   matrix. */
static void relatives(const void *context, int k, int level, uint32_t *digits)
{
    (void)context;
    const int size = level + 1;
    uint32_t matrix[DIGITS * DIGITS];
    fill_matrix(BASE, k, size, matrix);
    for (int r = level - 1; r >= 0; r--) {
        uint32_t sum = matrix[r * size + level];
        for (int c = r + 1; c < level; c++) {
            sum += matrix[r * size + c] * digits[c];
        }
        digits[r] = (BASE - sum % BASE) % BASE; /* the diagonal is 1 */
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    if (args->params[0] == KOKSMA__SCRAMBLE_OWEN) {
        return koksma__owen_sequence(seed, BASE, relatives, NULL, args->run, out);
    }
    return koksma__digit_sequence("ternary-quads", BASE, DIGITS, fill_matrix, args, out);
}

static const koksma_param params[] = {KOKSMA__PARAM_SCRAMBLE(" in base 3"), {0}};

const koksma_pattern koksma__pattern_ternary_quads = {
    .name = "ternary-quads",
    .title = "a sequence in base 3 whose pairs of dimensions are (0,2)-sequences and whose groups of four are "
             "(1,4)-sequences",
    .cite = "ostromoukhov2024 niederreiter1988 owen1995 helmer2021",
    .min_dim = 1,
    .max_dim = MOST_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_SEQUENCE |
              KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_PAIRS_3 | KOKSMA_CLAIM_QUADRUPLES_3,
    .params = params,
    .generate = generate,
    .ranges = koksma__ranges_unscrambled,
};

/* SPDX-License-Identifier: Apache-2.0 */
/*
 * net-file: the digital net or sequence whose generator matrices are in a file; the spec is net-file:PATH.
 *
 *     x_i,k = sum_l y_l b^-l,   y = C_k a modulo b,   i = sum_c a_c b^c   (l = 1, 2, ..., c = 0, 1, ...)
 *
 * The file is in one of these formats of the collection LDData, or in Joe & Kuo's own format; comments follow a #:
 *
 *     # dnet      base b, dimensions s, columns k (or b^k), digits r; then a line for each dimension: the k columns of
 *                 C, each as a whole number whose highest digit, that of b^(r-1), is the entry of row 1. Interlaced
 *                 (higher-order) nets have this format, too.
 *     # plattice  prime b, dimensions s, degree k and modulus Q(z), then one polynomial q(z) a line for each dimension;
 *                 polynomials are given by their values at z = b. Row l of column c of C is the coefficient of
 *                 z^-(l+c) in q/Q (Niederreiter 1992). All rows that fit into a double are used, 53 in base 2, where
 *                 Niederreiter and LatNet Builder's own conversion to matrices stop after k: the first k digits of a
 *                 point, on which its quality as a net depends, are the same
 *     # soboljk   lines "k degree a m_1 ... m_degree" from dimension k = 2 on; the matrix of dimension 1 is the
 *                 identity (Joe & Kuo 2008, whose own files begin with the line "d s a m_i" in place of "# soboljk")
 *
 * The files of LatNet Builder begin differently: in place of the line "# dnet", "# plattice" or "# soboljk" there is a
 * heading "# Parameters for ..." among the first comments, which also gives the base ("... in base 2"); they have no line
 * for the base. LatNet Builder's files of Sobol' points have the number of dimensions on a separate line, and by
 * default only m_1 ... m_degree on each later line ("# Parameters m_{j,c} ..."): the polynomials are then the
 * primitive ones in Joe & Kuo's order, by degree and then by a. If a digital net of LatNet Builder has an interlacing
 * factor d (the line "# Interlacing factor"), there are d matrices for each dimension, and row l of the j-th of them
 * (j = 0 .. d - 1) is row l d + j, counted from 0, of the dimension's matrix (Dick 2008).
 *
 * Sources: Niederreiter 1992; for the formats L'Ecuyer et al. 2022 and Joe & Kuo 2008.
 *
 * Point i does not depend on n, and there are b^k points; k is 53 for Sobol' numbers. A coordinate has as many digits as
 * fit into a double (53 in base 2); further digits are cut off. The modifier owen-base=b scrambles the points in base b.
 */
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "patterns/files/files.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { MOST_COLUMNS = 64, MOST_DIGITS = 53, LARGEST_BASE = 256, SOBOL_COLUMNS = 53, LARGEST_DEGREE = 31 };

typedef struct matrices {
    uint32_t base;
    int columns, digits;                         /* columns and rows (digits) of each matrix */
    uint64_t end;                                /* all points to compute have indices below this number */
    uint8_t (*digit)[MOST_COLUMNS][MOST_DIGITS]; /* [k][c][l]: row l + 1, column c of C_k */
} matrices;

/* ---- Points ------------------------------------------------------------------------------------------------ */

static void add_column(const matrices *m, const uint8_t *column, uint32_t times, uint32_t *y)
{
    for (int l = 0; l < m->digits; l++) {
        y[l] = (y[l] + times * column[l]) % m->base;
    }
}

static double value_of(const matrices *m, const uint32_t *y)
{
    double whole = 0, scale = 1; /* both below 2^53 */
    for (int l = 0; l < m->digits; l++) {
        whole = whole * m->base + y[l];
        scale *= m->base;
    }
    return whole / scale;
}

/* Does the same as `column` (below), but for base 2, with each column of the matrix in one word. */
static void binary_column(const matrices *m, int k, uint64_t first, size_t count, double *xs)
{
    uint64_t words[MOST_COLUMNS] = {0}, y = 0;
    for (int c = 0; c < m->columns; c++) {
        for (int l = 0; l < m->digits; l++) {
            words[c] = words[c] << 1 | m->digit[k][c][l];
        }
        y ^= first >> c & 1 ? words[c] : 0;
    }
    for (size_t i = 0; i < count; i++) {
        xs[i] = (double)(int64_t)y / (double)(INT64_C(1) << m->digits);
        /* add a column for each digit of the index that changes on the step to the next point */
        for (int c = 0; c < m->columns; c++) {
            y ^= words[c];
            if (!((first + i) >> c & 1)) {
                break;
            }
        }
    }
}

/* Computes one coordinate of `count` points. Going from i to i + 1 adds a column once for each digit that changes: a
   digit that wraps from b - 1 to 0 needs no subtraction, because b times a column is 0. */
static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const matrices *m = context;
    uint32_t a[MOST_COLUMNS + 1] = {0}, y[MOST_DIGITS] = {0};
    uint64_t rest = first;
    if (m->base == 2) {
        binary_column(m, k, first, count, xs);
        return;
    }
    for (int c = 0; rest; c++, rest /= m->base) {
        a[c] = (uint32_t)(rest % m->base);
        add_column(m, m->digit[k][c], a[c], y);
    }
    for (size_t i = 0; i < count; i++) {
        xs[i] = value_of(m, y);
        bool carry = i + 1 < count;
        for (int c = 0; carry && c < m->columns; c++) {
            add_column(m, m->digit[k][c], 1, y);
            a[c] = a[c] + 1 == m->base ? 0 : a[c] + 1;
            carry = a[c] == 0;
        }
    }
}

/* ---- Files ------------------------------------------------------------------------------------------------- */

static koksma_status take(koksma__number_lines *lines, const char *what, uint64_t least, uint64_t most, uint64_t *out)
{
    KOKSMA__TRY(koksma__number_lines_take(lines, what, 1, out));
    KOKSMA__FAIL_IF(*out < least || *out > most, KOKSMA_MALFORMED,
                    "%s: line %zu: %s is %llu; it has to be %llu to %llu", lines->name, lines->number, what,
                    (unsigned long long)*out, (unsigned long long)least, (unsigned long long)most);
    return KOKSMA_OK;
}

/* Sets the number of columns. `given` is this number or, if it is above MOST_COLUMNS, the number of points
   base^columns. */
static koksma_status count_columns(const koksma__number_lines *lines, uint64_t base, uint64_t given, int *columns)
{
    uint64_t points = given;
    *columns = (int)given;
    if (given > MOST_COLUMNS) {
        for (*columns = 0; points % base == 0; (*columns)++) {
            points /= base;
        }
        KOKSMA__FAIL_IF(points != 1 || *columns > MOST_COLUMNS, KOKSMA_MALFORMED,
                        "%s: line %zu: %llu is neither a number of columns, at most %d, nor a power of %llu",
                        lines->name, lines->number, (unsigned long long)given, MOST_COLUMNS,
                        (unsigned long long)base);
    }
    return KOKSMA_OK;
}

static koksma_status take_base(koksma__number_lines *lines, uint64_t *base)
{
    if (!lines->base) {
        return take(lines, "the base", 2, LARGEST_BASE, base);
    }
    *base = lines->base;
    KOKSMA__FAIL_IF(*base < 2 || *base > LARGEST_BASE, KOKSMA_MALFORMED, "%s: the base is %llu; it takes 2 to %d",
                    lines->name, (unsigned long long)*base, LARGEST_BASE);
    return KOKSMA_OK;
}

/* Reads the two lines that only interlaced nets of LatNet Builder have. */
static koksma_status take_interlacing(koksma__number_lines *lines, uint64_t dims, uint64_t *factor)
{
    uint64_t components;
    *factor = 1;
    if (!lines->base || !strstr(lines->text, "# Interlacing factor")) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(take(lines, "the interlacing factor", 1, MOST_DIGITS, factor));
    KOKSMA__TRY(take(lines, "the number of components", 1, UINT64_MAX, &components));
    KOKSMA__FAIL_IF(components != dims * *factor, KOKSMA_MALFORMED,
                    "%s: line %zu: %llu components, not %llu times %llu", lines->name, lines->number,
                    (unsigned long long)components, (unsigned long long)dims, (unsigned long long)*factor);
    return KOKSMA_OK;
}

/* Reads the matrix of one component: its row l becomes row l step + first of a matrix of m->digits rows. */
static koksma_status read_matrix(koksma__number_lines *lines, uint64_t rows, int step, int first, const matrices *m,
                                 uint8_t (*digit)[MOST_DIGITS])
{
    uint64_t numbers[MOST_COLUMNS];
    KOKSMA__TRY(koksma__number_lines_take(lines, "a matrix", (size_t)m->columns, numbers));
    for (int c = 0; c < m->columns; c++) {
        uint64_t left = numbers[c];
        for (int l = (int)rows - 1; l >= 0; l--, left /= m->base) {
            if (l * step + first < m->digits) {
                digit[c][l * step + first] = (uint8_t)(left % m->base);
            }
        }
        KOKSMA__FAIL_IF(left, KOKSMA_MALFORMED, "%s: line %zu: %llu has more than %llu digits in base %llu",
                        lines->name, lines->number, (unsigned long long)numbers[c], (unsigned long long)rows,
                        (unsigned long long)m->base);
    }
    return KOKSMA_OK;
}

static koksma_status read_dnet(koksma__number_lines *lines, int dim, matrices *m)
{
    uint64_t base, dims, factor, columns, rows;
    KOKSMA__TRY(take_base(lines, &base));
    KOKSMA__TRY(take(lines, "the number of dimensions", 1, UINT32_MAX, &dims));
    KOKSMA__TRY(koksma__number_lines_dims(lines, dims, dim));
    KOKSMA__TRY(take_interlacing(lines, dims, &factor));
    KOKSMA__TRY(take(lines, "the number of columns", 1, UINT64_MAX, &columns));
    KOKSMA__TRY(count_columns(lines, base, columns, &m->columns));
    KOKSMA__TRY(take(lines, "the number of digits", 1, 64, &rows));
    const int kept = koksma__digits_of_double((uint32_t)base), step = (int)factor, all = (int)rows * step;
    m->base = (uint32_t)base;
    m->digits = all < kept ? all : kept;
    for (int k = 0; k < dim; k++) {
        for (int j = 0; j < step; j++) {
            KOKSMA__TRY(read_matrix(lines, rows, step, j, m, m->digit[k]));
        }
    }
    return KOKSMA_OK;
}

/* Computes the coefficients, lowest first, of a polynomial given by its value at z = b; returns its degree, -1 for the
   polynomial 0. */
static int coefficients_of(uint64_t value, uint32_t base, uint32_t *out)
{
    int degree = -1;
    for (int d = 0; d <= MOST_COLUMNS; d++, value /= base) {
        out[d] = (uint32_t)(value % base);
        degree = out[d] ? d : degree;
    }
    return degree;
}

static uint32_t inverse_modulo(uint32_t a, uint32_t prime)
{
    uint32_t power = 1;
    for (uint32_t e = prime - 2; e; e >>= 1, a = a * a % prime) {
        power = e & 1 ? power * a % prime : power;
    }
    return power;
}

/* Computes the first `count` coefficients u_1, u_2, ... of the Laurent series of q/Q by long division: each step
   multiplies the remainder, at first q, by z. The degree of q is below that of Q. */
static void divide(uint32_t *rest, const uint32_t *modulus, int degree, uint32_t base, int count, uint8_t *u)
{
    const uint32_t inverse = inverse_modulo(modulus[degree], base);
    for (int w = 0; w < count; w++) {
        const uint32_t digit = rest[degree - 1] * inverse % base;
        for (int d = degree - 1; d >= 0; d--) {
            const uint32_t higher = d ? rest[d - 1] : 0;
            rest[d] = (higher + (base - digit) * modulus[d]) % base;
        }
        u[w] = (uint8_t)digit;
    }
}

static koksma_status read_plattice(koksma__number_lines *lines, int dim, matrices *m)
{
    uint64_t base, dims, columns, value;
    uint32_t modulus[MOST_COLUMNS + 1], q[MOST_COLUMNS + 1];
    KOKSMA__TRY(take_base(lines, &base));
    for (uint64_t d = 2; d * d <= base; d++) {
        KOKSMA__FAIL_IF(base % d == 0, KOKSMA_MALFORMED, "%s: line %zu: the base is %llu, which is not a prime",
                        lines->name, lines->number, (unsigned long long)base);
    }
    KOKSMA__TRY(take(lines, "the number of dimensions", 1, UINT32_MAX, &dims));
    KOKSMA__TRY(koksma__number_lines_dims(lines, dims, dim));
    KOKSMA__TRY(take(lines, "the degree of the modulus", 1, MOST_COLUMNS - 1, &columns));
    KOKSMA__TRY(take(lines, "the modulus", 2, UINT64_MAX, &value));
    m->base = (uint32_t)base;
    m->columns = (int)columns;
    m->digits = koksma__digits_of_double(m->base);
    KOKSMA__FAIL_IF(coefficients_of(value, m->base, modulus) != m->columns, KOKSMA_MALFORMED,
                    "%s: line %zu: the modulus is not of degree %d", lines->name, lines->number, m->columns);
    for (int k = 0; k < dim; k++) {
        uint8_t u[MOST_COLUMNS + MOST_DIGITS];
        KOKSMA__TRY(koksma__number_lines_take(lines, "a polynomial of the generating vector", 1, &value));
        KOKSMA__FAIL_IF(coefficients_of(value, m->base, q) >= m->columns, KOKSMA_MALFORMED,
                        "%s: line %zu: the polynomial's degree is not below that of the modulus", lines->name,
                        lines->number);
        divide(q, modulus, m->columns, m->base, m->columns + m->digits, u);
        for (int c = 0; c < m->columns; c++) {
            memcpy(m->digit[k][c], u + c, (size_t)m->digits);
        }
    }
    return KOKSMA_OK;
}

/* Computes the columns of one dimension from its line of Sobol' numbers: v[c] is column c as a 53-bit number. */
static koksma_status sobol_columns(const koksma__number_lines *lines, int k, const uint64_t *numbers, size_t count,
                                   uint64_t *v)
{
    const uint64_t degree = count > 1 ? numbers[1] : 0, a = count > 2 ? numbers[2] : 0;
    KOKSMA__FAIL_IF(count < 4 || numbers[0] != (uint64_t)k + 1 || degree != count - 3, KOKSMA_MALFORMED,
                    "%s: line %zu: expected the dimension %d, a degree s, a, and s numbers", lines->name,
                    lines->number, k + 1);
    KOKSMA__FAIL_IF(a >> (degree - 1), KOKSMA_MALFORMED,
                    "%s: line %zu: a is %llu, but a polynomial of degree %llu has an a below %llu", lines->name,
                    lines->number, (unsigned long long)a, (unsigned long long)degree, 1ULL << (degree - 1));
    for (int c = 0; c < SOBOL_COLUMNS; c++) {
        if (c < (int)degree) {
            const uint64_t number = numbers[3 + c];
            KOKSMA__FAIL_IF(number % 2 == 0 || number >> (c + 1), KOKSMA_MALFORMED,
                            "%s: line %zu: %llu is not odd and below %llu", lines->name, lines->number,
                            (unsigned long long)number, 1ULL << (c + 1));
            v[c] = number << (SOBOL_COLUMNS - 1 - c);
            continue;
        }
        v[c] = v[c - (int)degree] ^ v[c - (int)degree] >> degree;
        for (int d = 1; d < (int)degree; d++) {
            v[c] ^= a >> ((int)degree - 1 - d) & 1 ? v[c - d] : 0;
        }
    }
    return KOKSMA_OK;
}

/* Reads the line of dimension k, counted from 0, as dimension, degree, a and m_1, m_2, ...; *count is 0 at the end. */
static koksma_status next_sobol_line(koksma__number_lines *lines, int k, uint64_t *numbers, size_t *count)
{
    const bool short_form = !strcmp(lines->kind, "sobol");
    uint64_t *const at = numbers + (short_form ? 3 : 0), most = (uint64_t)(LARGEST_DEGREE + (short_form ? 0 : 3));
    KOKSMA__TRY(koksma__number_lines_next(lines, most, at, count));
    if (k == 1 && lines->base && *count == 1 && *at != 1) { /* the number of dimensions */
        KOKSMA__TRY(koksma__number_lines_next(lines, most, at, count));
    }
    if (short_form && *count) {
        KOKSMA__FAIL_IF(k >= KOKSMA__SOBOL_DIM, KOKSMA_DIM,
                        "%s: line %zu: without polynomials it can have %d dimensions; files with them have no limit",
                        lines->name, lines->number, KOKSMA__SOBOL_DIM);
        const uint32_t polynomial = koksma__sobol_polynomial(k);
        const int degree = 31 - __builtin_clz(polynomial);
        numbers[0] = (uint64_t)k + 1;
        numbers[1] = (uint64_t)degree;
        numbers[2] = polynomial >> 1 & (((uint32_t)1 << (degree - 1)) - 1); /* without x^degree and 1 */
        *count += 3;
    }
    return KOKSMA_OK;
}

static koksma_status read_sobol(koksma__number_lines *lines, int dim, matrices *m)
{
    uint64_t numbers[3 + LARGEST_DEGREE] = {0};
    /* Points below 2^32 have 32 digits and need no further columns, which would take time. */
    m->base = 2;
    m->columns = m->digits = m->end > UINT64_C(1) << 32 ? SOBOL_COLUMNS : 32;
    for (int k = 0; k < dim; k++) {
        uint64_t v[SOBOL_COLUMNS];
        size_t count = 1;
        if (k) {
            KOKSMA__TRY(next_sobol_line(lines, k, numbers, &count));
            KOKSMA__TRY(count ? sobol_columns(lines, k, numbers, count, v)
                              : koksma__number_lines_dims(lines, (uint64_t)k, dim));
        }
        for (int c = 0; c < m->columns; c++) {
            for (int l = 0; l < m->digits; l++) {
                m->digit[k][c][l] = k ? v[c] >> (SOBOL_COLUMNS - 1 - l) & 1 : l == c;
            }
        }
    }
    return KOKSMA_OK;
}

static koksma_status read_matrices(koksma__number_lines *lines, int dim, matrices *m)
{
    static const struct {
        const char *kind;
        koksma_status (*read)(koksma__number_lines *lines, int dim, matrices *m);
    } kinds[] = {{"dnet", read_dnet}, {"plattice", read_plattice}, {"soboljk", read_sobol}, {"sobol", read_sobol}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (!strcmp(lines->kind, kinds[i].kind)) {
            return kinds[i].read(lines, dim, m);
        }
    }
    return koksma__fail(
        KOKSMA_MALFORMED,
        "%s: the first line must be '# dnet', '# plattice', '# soboljk', Joe and Kuo's 'd s a m_i' or "
        "that of LatNet Builder's output; lattice-file reads lattices",
        lines->name);
}

static koksma_status check_count(const koksma__number_lines *lines, const matrices *m)
{
    uint64_t points = 1;
    for (int c = 0; c < m->columns && points < m->end; c++) {
        points *= m->base; /* no overflow: at most 2^51 times the base */
    }
    KOKSMA__FAIL_IF(points < m->end, KOKSMA_N, "%s: it has %llu points, not %llu", lines->name,
                    (unsigned long long)points, (unsigned long long)m->end);
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    matrices m = {.digit = calloc((size_t)out->dim, sizeof *m.digit), .end = args->first + out->n};
    koksma__number_lines lines;
    KOKSMA__REQUIRE_MEMORY(m.digit, (size_t)out->dim * sizeof *m.digit);
    koksma_status status = koksma__number_lines_open("net-file", args->path, &lines);
    status = status ? status : read_matrices(&lines, out->dim, &m);
    status = status ? status : check_count(&lines, &m);
    status = status ? status : koksma__range_columns(args, out, column, &m);
    koksma__number_lines_close(&lines);
    free(m.digit);
    return status;
}

const koksma_pattern koksma__pattern_net_file = {
    .name = "net-file",
    .title = "digital net whose matrices are read from a file: net-file:PATH (LatNet Builder's formats, Joe & Kuo's "
             "Sobol' numbers)",
    .cite = "lecuyer2022 joe2008 niederreiter1992",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_SEQUENCE,
    .generate = generate,
    .operand = "PATH",
    .ranges = koksma__ranges_always,
};

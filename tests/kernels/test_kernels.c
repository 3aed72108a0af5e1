/* SPDX-License-Identifier: Apache-2.0 */
/* The kernels against their twins, bit for bit, for odd counts. The twins of random numbers are Random123's own Philox. */
#include <math.h>
#include <string.h>

#include "core/random.h"
#include "kernels/kernels.h"
#include "patterns/grids/grids.h"
#include "patterns/nets/nets.h"
#include "test.h"

enum { MAX = 300 };

static const char *const isas[] = {"baseline", "avx2", "avx512"};

static uint32_t words[4 * MAX];
static double units[2 * MAX];
static koksma__nested_node nodes[1 << KOKSMA__NESTED_LEVELS];

static int setup(void **state)
{
    (void)state;
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    ref->words(5, KOKSMA__PURPOSE_TEST, 0, 0, MAX, words);
    ref->uniform(6, KOKSMA__PURPOSE_TEST, 0, 0, MAX, units);
    words[0] = 0;
    words[1] = UINT32_MAX;
    for (size_t d = 0; d < sizeof nodes / sizeof *nodes; d++) {
        nodes[d] = koksma__nested_node_of(koksma__random(8, KOKSMA__PURPOSE_TEST, d, 0));
        nodes[d].flips = (uint64_t)d * 37 % 128;
    }
    return 0;
}

typedef void (*compare)(const koksma__kernel_table *table, size_t count, void *out);

static void assert_equal_to_reference(compare f, size_t most)
{
    static unsigned char a[32 * MAX], b[32 * MAX];
    for (size_t isa = 0; isa < 3; isa++) {
        const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
        for (size_t count = 0; fast && count <= most; count += 1 + count / 7) {
            memset(a, 0, sizeof a);
            memset(b, 0, sizeof b);
            f(koksma__kernels_find("ref"), count, a);
            f(fast, count, b);
            assert_memory_equal(a, b, sizeof a);
        }
    }
}

/* ---- Random numbers ------------------------------------------------------------------------------------------ */

static void uniform(const koksma__kernel_table *t, size_t count, void *out)
{
    t->uniform(count * 77, 3, 0xfffffff0u + count, 5, count, out);
}

static void words_and_draws(const koksma__kernel_table *t, size_t count, void *out)
{
    uint32_t drawn[4 * MAX + 32];
    t->words(~count, 9, 0xfffffffffull, 1, count, out);
    t->draws(~count, 9, 0xfffffffffull, 1, count, drawn); /* may write more */
    memcpy((uint32_t *)out + 4 * MAX, drawn, 4 * count * sizeof *drawn);
}

static void permutation(const koksma__kernel_table *t, size_t count, void *out)
{
    t->permutation(count, 3, (uint32_t)count, out);
}

/* Counts with every remainder of the vectors; seeds and lanes with high bits. */
static void nested_bits(const koksma__kernel_table *t, size_t count, void *out)
{
    const uint64_t seed = count % 2 ? UINT64_MAX - count : 0x123456789abcdefu * count;
    uint64_t *x = out;
    for (size_t i = 0; i < count; i++) {
        const uint64_t word = words[2 * i] | (uint64_t)words[2 * i + 1] << 32;
        x[i] = i == 2 ? UINT64_MAX >> 11 : i == 3 ? 0 : word >> (i % 3 ? 11 : 30);
    }
    t->nested_bits(seed, count % 3 ? (uint32_t)count : UINT32_MAX, nodes, count, x);
}

/* The definition of nested scrambling, digit by digit: two numbers that agree in exactly their first m digits agree in
   exactly these afterwards, and the flip of digit m depends on the digits before it alone. */
TEST_CASE(nested_bits_keep_prefixes)
{
    for (int m = KOKSMA__NESTED_LEVELS; m < KOKSMA__NESTED_DIGITS; m++) {
        const koksma__words r = koksma__random(10, KOKSMA__PURPOSE_TEST, (uint64_t)m, 0);
        const uint64_t digit = (uint64_t)1 << (KOKSMA__NESTED_DIGITS - 1 - m);
        const uint64_t x = (r.w[0] | (uint64_t)r.w[1] << 32) >> 11, other = x ^ digit ^ (r.w[2] & (digit - 1));
        for (size_t isa = 0; isa < 3; isa++) {
            const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
            uint64_t pair[2] = {x, other};
            if (fast) {
                fast->nested_bits(3, 4, nodes, 2, pair);
                const uint64_t differ = pair[0] ^ pair[1];
                assert_true(differ >= digit && differ < 2 * digit);
            }
        }
    }
}

/* Random123's known-answer vectors for philox4x32-10 and -7 with counter and key of all ones. */
TEST_CASE(philox_known_answer)
{
    const koksma__words r = koksma__random(UINT64_MAX, UINT32_MAX, UINT64_MAX, UINT32_MAX);
    const uint32_t expected[4] = {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd};
    assert_memory_equal(r.w, expected, sizeof expected);
    const koksma__words draw = koksma__random_draw(UINT64_MAX, UINT32_MAX, UINT64_MAX, UINT32_MAX);
    const uint32_t of_seven[4] = {0x5207ddc2, 0x45165e59, 0x4d8ee751, 0x8c52f662};
    assert_memory_equal(draw.w, of_seven, sizeof of_seven);
}

/* ---- Patterns -------------------------------------------------------------------------------------------------- */

static const size_t grids[][2] = {{1, 1}, {4, 4}, {8, 8}, {3, 5}, {7, 2}, {16, 3}, {5, 16}, {13, 13}};

static void cells_2d(const koksma__kernel_table *t, size_t count, void *out)
{
    const size_t *n = grids[count % 8];
    memcpy(out, units, 2 * n[0] * n[1] * sizeof *units);
    ((double *)out)[1] = 1 - 0x1p-53; /* must not round into the next cell */
    t->cells_2d(0.25, 0.5, n[0], n[1], out);
}

TEST_CASE(cells_are_those_of_patterns)
{
    for (size_t g = 0; g < 8; g++) {
        const size_t nx = grids[g][0], ny = grids[g][1];
        double xs[2 * 169];
        memcpy(xs, units, sizeof xs);
        koksma__kernels_find("ref")->cells_2d(0, 1, nx, ny, xs);
        for (size_t i = 0; i < nx * ny; i++) {
            assert_near(xs[2 * i], koksma__in_cell((double)(i / ny), units[2 * i], (double)nx), 0);
            assert_near(xs[2 * i + 1], koksma__in_cell((double)(i % ny), units[2 * i + 1], (double)ny), 0);
        }
    }
}

static void quotients(const koksma__kernel_table *t, size_t count, void *out)
{
    t->quotients(count, units, 0.37, count % 2 ? 0x1p40 : 3.1, out);
}

static void steps(const koksma__kernel_table *t, size_t count, void *out)
{
    t->steps(count, 12345678, 0.25, count % 2 ? 0x1p31 : 1234567890, out);
}

static void fractions(const koksma__kernel_table *t, size_t count, void *out)
{
    t->fractions(count, words, out);
}

static void fraction_rows(const koksma__kernel_table *t, size_t count, void *out)
{
    t->fraction_rows(count, 4, words, 97, count % 2, out);
    t->fraction_rows(count, 2, words, 131, count % 2, (double *)out + 600 + count % 3);
}

static void digital(const koksma__kernel_table *t, size_t count, void *out)
{
    t->digital(count, koksma__sobol_directions(5, 0), 0x12345678, out);
}

static void digital_rows(const koksma__kernel_table *t, size_t count, void *out)
{
    static const int dims[] = {2, 4, 1, 3, 7, 16};
    const uint32_t *directions[16];
    for (int c = 0; c < 16; c++) {
        directions[c] = koksma__sobol_directions(3 * c, 0);
    }
    for (size_t d = 0; d < sizeof dims / sizeof *dims; d++) {
        const size_t dim = (size_t)dims[d], some = count * dim <= 1100 ? count : 1100 / dim;
        double xs[1200] = {0};
        t->digital_rows(some, dims[d], directions, words, count % 2, xs + count % 3);
        for (size_t i = 0; i < 1200; i++) {
            ((double *)out)[i] = ((double *)out)[i] / 3 + xs[i];
        }
    }
}

static void digital_at(const koksma__kernel_table *t, size_t count, void *out)
{
    t->digital_at(count, words, koksma__sobol_directions(9, 1), out);
}

static void owen_hash(const koksma__kernel_table *t, size_t count, void *out)
{
    uint32_t *v = out;
    t->owen_hash(count, words, true, true, 0xdeadbeef, v);
    t->owen_hash(count, words, false, true, 0x1234, v + MAX);
    t->owen_hash(count, words, true, false, 0, v + 2 * MAX);
    t->owen_hash(count, words, false, false, 77, v + 3 * MAX);
}

static void pascal(const koksma__kernel_table *t, size_t count, void *out)
{
    t->pascal(count, words, out);
}

static void grow(const koksma__kernel_table *t, size_t count, void *out)
{
    uint32_t *v = out;
    memcpy(v, words, 256 * sizeof *v);
    for (size_t first = 0; first < 2; first++) {
        t->grow(v, 8, first, count < 255 ? count : 255, 0x5b, words + 300);
    }
}

static void covers(const koksma__kernel_table *t, size_t count, void *out)
{
    unsigned *found = out;
    for (size_t i = 0; i < count; i++) {
        const double d2 = 0.1 * units[i] * units[i];
        found[i] = t->covers(8 * (i % 4), units + i, units + 200, units[i + 1], units[i + 9], 0.02, 0.02, d2);
    }
}

/* Of a tile of which most is empty: squares of every level, some of a cell one after the other. */
static void dart_cells(const koksma__kernel_table *t, size_t count, void *out)
{
    enum { CELLS = 9, STRIDE = CELLS + 7, UNITS = KOKSMA__PLACE_UNITS };
    const int32_t low = 33000000; /* of a reach of 1.4 cells */
    uint32_t places[STRIDE * (CELLS + 4)], *found = out;
    uint32_t squares[MAX];
    koksma__dart_cells c = {places, STRIDE, (int)(count % KOKSMA__PACKED_LEVEL), (uint32_t)count, squares};
    for (uint32_t i = 0; i < STRIDE * (CELLS + 4); i++) {
        const uint32_t x = i % STRIDE - 2, y = i / STRIDE - 2;
        places[i] =
            i % STRIDE < CELLS + 4 && words[i] % 3 == 0
                ? koksma__place(x * UNITS + words[i + 1] % (UNITS + 1), y * UNITS + words[i + 2] % (UNITS + 1))
                : koksma__no_place(x, y);
    }
    for (size_t i = 0; i < count; i++) {
        const uint32_t x = words[i / 3] % CELLS, y = words[i / 3 + 1] % CELLS, inside = (1u << c.level) - 1;
        squares[i] = koksma__place(x << c.level | (words[i] & inside), y << c.level | (words[i + 2] & inside));
        *found++ = (uint32_t)t->nearest_place(places + koksma__dart_corner(&c, squares[i]), STRIDE,
                                              koksma__dart_place(&c, squares[i], words + i));
    }
    found += t->far_darts(&c, low, count, words, found);
    uint32_t open[4 * MAX + 1];
    const size_t kept = t->open_quarters(&c, low, open);
    *found++ = (uint32_t)kept;
    memcpy(found, open, kept * sizeof *open);
}

/* Some of the places are on the point itself; the widest circle reaches over the edge of the torus. */
static void pair_counts(const koksma__kernel_table *t, size_t count, void *out)
{
    const size_t bins = 1 + count % 100;
    const double r = 0.5 / (double)(1 + count % 5);
    t->pair_counts(count, units, units + count % 7, units[count / 2], units[count / 2 + count % 7], r * r,
                   (double)bins / r, bins, out);
    memset((uint64_t *)out + bins, 0, 8 * sizeof(uint64_t));
}

static void nearest_offset(const koksma__kernel_table *t, size_t count, void *out)
{
    t->nearest_offset(count % 30, units, units + 100, count, units, 0.3, out);
}

/* Windows of 8 and 16 columns, values of 1 to 4 coordinates. */
static void mask_growth(const koksma__kernel_table *t, size_t count, void *out)
{
    const size_t span = 8 + 8 * (count % 2), rows = count / 9 % 7;
    float numbers[2 * MAX], *found = out;
    for (size_t i = 0; i < 2 * MAX; i++) {
        numbers[i] = (float)units[i];
    }
    for (int dim = 1; dim <= 4; dim++) {
        found[dim] = t->mask_growth(rows, span, 17, 131, dim, numbers + count, numbers + count % 5, numbers + 100,
                                    numbers + 104 + count % 3);
    }
}

/* Numbers, the words of their relatives, and what lies between, which stays as it is. */
static void nested_digits(const koksma__kernel_table *t, size_t count, void *out)
{
    static const uint32_t bases[] = {3, 5, 7, 11, 13};
    const uint32_t base = bases[count % 5], relatives = 1 + (uint32_t)(count / 5 % (base - 1));
    double *v = out, *relative[12], whole = base, width = 1;
    while (whole * base <= 0x1p53) {
        whole *= base;
    }
    for (size_t power = 0; power < count % 12; power++) {
        width *= base;
    }
    if (count % 3 == 0) {
        width = whole / base;
    }
    const size_t first = count % 7, step = (MAX - first) / (relatives + 1);
    memcpy(v, words, MAX * sizeof *v);
    for (size_t i = first; i < first + step; i++) {
        v[i] = i == 3 ? whole - 1 : i == 4 ? width : i == 5 ? 0 : (double)(uint64_t)(units[i] * whole);
    }
    for (size_t d = 0; d < relatives; d++) {
        relative[d] = v + first + (d + 1) * step;
    }
    t->nested_digits(base, relatives, count < step ? count : step, width, v + first, relative);
}

/* Narrow bells reach all three polynomials of the inverse erf, and the number 1. */
static void truncated_normals(const koksma__kernel_table *t, size_t count, void *out)
{
    static const double reaches[] = {0.95, 0.9999, 0.99999999999, 1};
    double *xs = out;
    for (size_t r = 0; r < sizeof reaches / sizeof *reaches; r++, xs += count) {
        for (size_t i = 0; i < count; i++) {
            xs[i] = i % 9 == 3 ? 1 - ldexp(1, -(int)(i % 54)) : i % 9 == 5 ? ldexp(1, -(int)(i % 54)) : units[i];
        }
        t->truncated_normals(reaches[r], 0.08, count, xs);
    }
}

/* Runs of every length up to 12, at all distances up to twice the cut's. */
static void gauss_force(const koksma__kernel_table *t, size_t count, void *out)
{
    uint32_t run[26];
    for (uint32_t r = 0; r < 13; r++) {
        run[2 * r] = (uint32_t)(count + 7 * r) % 250;
        run[2 * r + 1] = run[2 * r] + r;
    }
    for (size_t runs = 0; runs <= 13; runs++) {
        t->gauss_force(runs, run, units, units + MAX, units[count], 0.03, -48, 0.25 + 0.01 * (double)(count % 7),
                       (double *)out + 2 * runs);
    }
}

static void rows_of_columns(const koksma__kernel_table *t, size_t count, void *out)
{
    t->rows_of_columns(count, 4, units, 97, count % 2, out);
    t->rows_of_columns(count, 2, units, 131, count % 2, (double *)out + 600 + count % 3);
}

static void permute(const koksma__kernel_table *t, size_t count, void *out)
{
    static const uint32_t sizes[] = {0, 1, 300, 4095, 65536, 0x7fffffff};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const uint32_t n = sizes[s] + (uint32_t)(sizes[s] < 300 ? count : 0);
        if (n) {
            const uint32_t first = n > count ? (n - (uint32_t)count) / 3 : 0;
            t->permute(first, n > count ? count : n, n, 0x123456789abcdefu * (s + count), (uint32_t *)out + MAX * s);
        }
    }
}

static void rooks_2d(const koksma__kernel_table *t, size_t count, void *out)
{
    static const size_t sides[] = {(size_t)1 << 20, ((size_t)1 << 20) - 1, 1000003, 300, 2000000};
    uint32_t rows[MAX];
    for (size_t s = 0; s < sizeof sides / sizeof *sides; s++) {
        for (size_t i = 0; i < count; i++) {
            rows[i] = (uint32_t)((words[i] * (uint64_t)sides[s]) >> 32);
        }
        t->rooks_2d(s, rows, (sides[s] - count) / 2 * 2, count, sides[s], (double *)out + 240 * s);
    }
}

/* ---- Measures -------------------------------------------------------------------------------------------------- */

static void star_sweep(const koksma__kernel_table *t, size_t n, void *out)
{
    double x[MAX], y[MAX + 8], count[MAX + 9];
    uint32_t rank[MAX];
    size_t at[2] = {0};
    koksma__random_permutation(n, 0, (uint32_t)n, rank);
    for (size_t i = 0; i < n; i++) {
        x[i] = ((double)i + units[i]) / (double)n;
    }
    for (size_t j = 0; j < n + 8; j++) {
        y[j] = j < n ? ((double)j + units[n + j]) / (double)n : 1;
    }
    if (n) {
        t->star_sweep(n, x, rank, y, count, out, at);
    }
    memcpy((double *)out + 2, at, sizeof at);
}

/* Lists longer than the fast form's chunks among them. */
static void star_partition(const koksma__kernel_table *t, size_t na, void *out)
{
    double *sums = out, found[2 * MAX + 8];
    for (size_t nb = 1; na && nb <= MAX; nb += 1 + nb / 7) {
        for (int smallest = 0; smallest < 2; smallest++) {
            t->star_extremes(na, units, nb, units + MAX, smallest, found);
            for (size_t c = 0; c < na + nb - 1; c++) {
                sums[c] = sums[c] / 3 + found[c];
            }
            sums[2 * MAX + smallest] += t->star_pairs(na, units, nb, units + MAX, smallest, 300, 7);
        }
    }
}

static void far_corners(const koksma__kernel_table *t, size_t count, void *out)
{
    int16_t counts[MAX];
    float xs[MAX];
    uint32_t found[MAX + 1], *to = out;
    for (size_t k = 0; k < count; k++) {
        counts[k] = (int16_t)(100 * units[k]);
        xs[k] = (float)(100 * units[MAX + k]);
    }
    for (int way = 0; way < 4; way++) {
        const float sign = way % 2 ? 1 : -1;
        *to = (uint32_t)t->far_corners(count, counts, xs, sign, sign * 1.01F, way < 2 ? 80 : 20, found);
        memcpy(to + 1, found, *to * sizeof *found);
        to += *to + 1;
    }
}

/* The rows of all L2 discrepancies have such factors; the products are double-doubles to the last bit. */
static void l2_linear(const koksma__kernel_table *t, size_t count, void *out)
{
    static const double rows[][4] = {{9, -12, -12, 0}, {25, 0, -12, 12}, {40, 0, 0, 0}, {37, 0, 6, -6}, {1, 0, 0, 3}};
    double u[2 * MAX], *at = out;
    for (size_t i = 0; i < 2 * MAX; i++) {
        u[i] = i % 11 == 3 ? 0.5 : i % 13 == 5 ? 1 : units[i];
    }
    for (size_t r = 0; r < 5; r++, at += 2 * count) {
        t->l2_linear(count, 1 + (int)(count % 5), u, 100, rows[r], at, at + count);
    }
}

/* The fast forms agree with each other bit for bit. */
TEST_CASE(l2_pairs_equal_reference)
{
    double g[2 * MAX], expected[2], got[2], first[2];
    for (size_t i = 0; i < 2 * MAX; i++) {
        g[i] = units[2 * MAX - 1 - i] - 0.3;
    }
    for (size_t n = 1; n <= MAX; n += 1 + n / 6) {
        const int dim = 1 + (int)(n % (n <= 120 ? 5 : 2)); /* of 2 MAX numbers */
        koksma__kernels_find("ref")->l2_pairs(n / 3, n, n, dim, units, g, -0.75, 0.5, expected);
        for (size_t isa = 0; isa < 3; isa++) {
            const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
            if (fast) {
                fast->l2_pairs(n / 3, n, n, dim, units, g, -0.75, 0.5, got);
                memcpy(first, isa ? first : got, sizeof first);
                assert_memory_equal(first, got, sizeof got);
                assert_near(expected[0] + expected[1], got[0] + got[1], 1e-15 * (double)(n * n));
            }
        }
    }
}

#define TEST(name, most)                                                                                             \
    TEST_CASE(name##_equals_reference)                                                                               \
    {                                                                                                                \
        assert_equal_to_reference(name, most);                                                                       \
    }

TEST(uniform, MAX)
TEST(words_and_draws, MAX)
TEST(permutation, 8 * MAX)
TEST(nested_bits, MAX)
TEST(cells_2d, MAX)
TEST(star_sweep, 100)
TEST(star_partition, MAX)
TEST(far_corners, MAX)
TEST(l2_linear, 120)
TEST(quotients, MAX)
TEST(steps, MAX)
TEST(fractions, MAX)
TEST(fraction_rows, 150)
TEST(digital, MAX)
TEST(digital_rows, MAX)
TEST(digital_at, MAX)
TEST(owen_hash, MAX)
TEST(pascal, MAX)
TEST(grow, MAX)
TEST(covers, 250)
TEST(dart_cells, 200)
TEST(nearest_offset, MAX)
TEST(pair_counts, MAX)
TEST(mask_growth, MAX)
TEST(nested_digits, MAX)
TEST(permute, MAX)
TEST(rooks_2d, 120)
TEST(truncated_normals, MAX)
TEST(gauss_force, MAX)
TEST(rows_of_columns, 150)

TEST_GROUP(setup, NULL)

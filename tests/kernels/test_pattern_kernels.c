/* SPDX-License-Identifier: Apache-2.0 */
/* The kernels of patterns against their twins, bit for bit, for odd counts. */
#include <math.h>
#include <string.h>

#include "core/random.h"
#include "kernels/kernels.h"
#include "patterns/nets/nets.h"
#include "test.h"

enum { MAX = 300 };

static const char *const isas[] = {"baseline", "avx2", "avx512"};

static uint32_t words[4 * MAX];
static double units[2 * MAX];

static int setup(void **state)
{
    (void)state;
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    ref->words(5, KOKSMA__PURPOSE_TEST, 0, 0, MAX, words);
    ref->uniform(6, KOKSMA__PURPOSE_TEST, 0, 0, MAX, units);
    words[0] = 0;
    words[1] = UINT32_MAX;
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

#define TEST(name, most)                                                                                             \
    TEST_CASE(name##_equals_reference)                                                                               \
    {                                                                                                                \
        assert_equal_to_reference(name, most);                                                                       \
    }

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

/* SPDX-License-Identifier: Apache-2.0 */
/* The kernels of random numbers against their twins, which are Random123's own Philox: bit for bit. */
#include <string.h>

#include "core/random.h"
#include "kernels/kernels.h"
#include "patterns/grids/grids.h"
#include "test.h"

enum { MAX = 200 };

static const char *const isas[] = {"baseline", "avx2", "avx512"};

TEST_CASE(uniform_equals_reference)
{
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    for (size_t isa = 0; isa < 3; isa++) {
        const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
        for (size_t count = 0; fast && count <= MAX; count += 1 + count / 9) {
            double a[2 * MAX + 1] = {0}, b[2 * MAX + 1] = {0};
            ref->uniform(count * 77, 3, 0xfffffff0u + count, 5, count, a);
            fast->uniform(count * 77, 3, 0xfffffff0u + count, 5, count, b);
            assert_memory_equal(a, b, sizeof a);
        }
    }
}

TEST_CASE(words_equal_reference)
{
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    for (size_t isa = 0; isa < 3; isa++) {
        const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
        for (size_t count = 0; fast && count <= MAX; count += 1 + count / 9) {
            uint32_t a[4 * MAX + 32] = {0}, b[4 * MAX + 32] = {0};
            ref->words(~count, 9, 0xfffffffffull, 1, count, a);
            fast->words(~count, 9, 0xfffffffffull, 1, count, b);
            assert_memory_equal(a, b, sizeof a);
            ref->draws(~count, 9, 0xfffffffffull, 1, count, a);
            fast->draws(~count, 9, 0xfffffffffull, 1, count, b);
            assert_memory_equal(a, b, 4 * count * sizeof *a);
        }
    }
}

TEST_CASE(permutation_equals_reference)
{
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    for (size_t isa = 0; isa < 3; isa++) {
        const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
        for (uint32_t n = 0; fast && n <= 4 * MAX; n += 1 + n / 9) {
            uint32_t a[4 * MAX + 1] = {0}, b[4 * MAX + 1] = {0};
            ref->permutation(n, 3, n, a);
            fast->permutation(n, 3, n, b);
            assert_memory_equal(a, b, sizeof a);
        }
    }
}

TEST_CASE(cells_equal_reference)
{
    static const size_t sizes[][2] = {{1, 1}, {4, 4}, {8, 8}, {3, 5}, {7, 2}, {16, 3}, {5, 16}, {13, 13}};
    for (size_t isa = 0; isa < 3; isa++) {
        const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
        for (size_t s = 0; fast && s < sizeof sizes / sizeof *sizes; s++) {
            const size_t nx = sizes[s][0], ny = sizes[s][1];
            double a[2 * 169], b[2 * 169], c[2 * 169];
            koksma__kernels_find("ref")->uniform(s, 3, 0, 0, nx * ny, a);
            a[1] = 1 - 0x1p-53; /* must not round into the next cell */
            memcpy(b, a, sizeof b);
            memcpy(c, a, sizeof c);
            koksma__kernels_find("ref")->cells_2d(0.25, 0.5, nx, ny, a);
            fast->cells_2d(0.25, 0.5, nx, ny, b);
            assert_memory_equal(a, b, 2 * nx * ny * sizeof *a);
            memcpy(b, c, sizeof b);
            fast->cells_2d(0, 1, nx, ny, b);
            for (size_t i = 0; i < nx * ny; i++) {
                assert_near(b[2 * i], koksma__in_cell((double)(i / ny), c[2 * i], (double)nx), 0);
                assert_near(b[2 * i + 1], koksma__in_cell((double)(i % ny), c[2 * i + 1], (double)ny), 0);
            }
        }
    }
}

/* Counts with every remainder of the vectors; seeds and lanes with high bits. */
TEST_CASE(nested_bits_equal_reference)
{
    const koksma__kernel_table *ref = koksma__kernels_find("ref");
    koksma__nested_node first[1 << KOKSMA__NESTED_LEVELS];
    uint64_t x[MAX];
    for (size_t d = 0; d < sizeof first / sizeof *first; d++) {
        first[d] = koksma__nested_node_of(koksma__random(8, KOKSMA__PURPOSE_TEST, d, 0));
        first[d].flips = (uint64_t)d * 37 % 128;
    }
    for (size_t i = 0; i < MAX; i++) {
        const koksma__words r = koksma__random(9, KOKSMA__PURPOSE_TEST, i, 0);
        x[i] = (r.w[0] | (uint64_t)r.w[1] << 32) >> (i % 3 ? 11 : 30);
    }
    x[0] = 0;
    x[1] = ((uint64_t)1 << KOKSMA__NESTED_DIGITS) - 1;
    for (size_t isa = 0; isa < 3; isa++) {
        const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
        for (size_t count = 0; fast && count <= MAX; count += 1 + count / 40) {
            const uint64_t seed = count % 2 ? UINT64_MAX - count : 0x123456789abcdefu * count;
            const uint32_t lane = count % 3 ? (uint32_t)count : UINT32_MAX;
            uint64_t a[MAX], b[MAX];
            memcpy(a, x, sizeof a);
            memcpy(b, x, sizeof b);
            ref->nested_bits(seed, lane, first, count, a);
            fast->nested_bits(seed, lane, first, count, b);
            assert_memory_equal(a, b, sizeof a);
        }
    }
}

/* The definition of nested scrambling, digit by digit: two numbers that agree in exactly their first m digits agree in
   exactly these afterwards, and the flip of digit m depends on the digits before it alone. */
TEST_CASE(nested_bits_keep_prefixes)
{
    koksma__nested_node first[1 << KOKSMA__NESTED_LEVELS];
    for (size_t d = 0; d < sizeof first / sizeof *first; d++) {
        first[d] = koksma__nested_node_of(koksma__random(8, KOKSMA__PURPOSE_TEST, d, 0));
        first[d].flips = 77;
    }
    for (int m = KOKSMA__NESTED_LEVELS; m < KOKSMA__NESTED_DIGITS; m++) {
        const koksma__words r = koksma__random(10, KOKSMA__PURPOSE_TEST, (uint64_t)m, 0);
        const uint64_t digit = (uint64_t)1 << (KOKSMA__NESTED_DIGITS - 1 - m);
        const uint64_t x = (r.w[0] | (uint64_t)r.w[1] << 32) >> 11, other = x ^ digit ^ (r.w[2] & (digit - 1));
        for (size_t isa = 0; isa < 3; isa++) {
            const koksma__kernel_table *fast = koksma__kernels_find(isas[isa]);
            uint64_t pair[2] = {x, other};
            if (fast) {
                fast->nested_bits(3, 4, first, 2, pair);
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

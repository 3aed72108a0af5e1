/* SPDX-License-Identifier: Apache-2.0 */
/* koksma/sampler.h gives the bits of the library's bulk generators. */
#include <koksma/sampler.h>

#include <string.h>

#include "core/random.h"
#include "test.h"

enum { N = 1000 };

static uint32_t cmj_rows; /* of the grid of 25 columns that cmj draws from */

TEST_CASE(words_are_the_librarys)
{
    for (uint32_t i = 0; i < 100; i++) {
        uint32_t words[4];
        const uint64_t key = 0x123456789abcdefu * i;
        koksma_words(key, i % 7, (uint64_t)i << 33 | i, 5 * i, words);
        const koksma__words expected = koksma__random(key, i % 7, (uint64_t)i << 33 | i, 5 * i);
        assert_memory_equal(words, expected.w, sizeof words);
    }
    assert_int_equal(KOKSMA_FOR_POINT, KOKSMA__PURPOSE_POINT);
    assert_int_equal(KOKSMA_FOR_SHUFFLE, KOKSMA__PURPOSE_SHUFFLE);
    assert_int_equal(KOKSMA_FOR_SHIFT, KOKSMA__PURPOSE_SHIFT);
    assert_int_equal(KOKSMA_FOR_SCRAMBLE, KOKSMA__PURPOSE_SCRAMBLE);
}

static void sobol(koksma_domain domain, uint32_t i, double *xs)
{
    koksma_sobol_2d(domain, i, xs);
}

static void sobol4(koksma_domain domain, uint32_t i, double *xs)
{
    koksma_sobol_4d(domain, i, xs);
}

static void pmj02(koksma_domain domain, uint32_t i, double *xs)
{
    koksma_pmj02_2d(domain, i, xs);
}

static void cmj(koksma_domain domain, uint32_t i, double *xs)
{
    koksma_cmj_2d(domain, i, 25, cmj_rows, xs);
}

static void r(koksma_domain domain, uint32_t i, double *xs)
{
    koksma_r_2d(domain, i, xs);
}

TEST_CASE(samples_are_the_librarys)
{
    static const struct {
        const char *pattern;
        int dim;
        void (*f)(koksma_domain domain, uint32_t i, double *xs);
    } pairs[] = {
        {"sobol:scramble=hash-owen,shuffle=1", 2, sobol},
        {"sobol:scramble=hash-owen,shuffle=1", 4, sobol4},
        {"pmj02:shuffle=1", 2, pmj02},
        {"correlated-multi-jittered:columns=25", 2, cmj},
        {"r-sequence:shuffle=1,shift=1", 2, r},
    };
    for (size_t t = 0; t < 2 * sizeof pairs / sizeof *pairs; t++) {
        const size_t p = t / 2;
        const uint32_t n = t % 2 ? 70 * N : N; /* few, and more than the bulk generators make at once */
        const koksma_domain domain = koksma_domain_of_use(koksma_domain_of_pixel(9, 3, 4), (uint32_t)t);
        koksma_points points = test_points(pairs[p].pattern, n, pairs[p].dim, domain.key);
        cmj_rows = n / 25;
        for (uint32_t i = 0; i < n; i += t % 2 ? 61 : 1) {
            double xs[4];
            pairs[p].f(domain, i, xs);
            assert_that(!memcmp(xs, points.xs + i * (size_t)pairs[p].dim, (size_t)pairs[p].dim * sizeof *xs),
                        "%s: point %u", pairs[p].pattern, i);
        }
        koksma_points_fini(&points);
    }
}

/* r-sequence and koksma_r_2d are the same also beyond point 2^32, where each part has another order. */
TEST_CASE(late_samples_are_the_librarys)
{
    static const uint64_t firsts[] = {((uint64_t)1 << 32) - 300, ((uint64_t)7 << 40) + 12345, KOKSMA_MAX_INDEX - N};
    const koksma_domain domain = koksma_domain_of_pixel(9, 3, 4);
    koksma_points points = test_points("r-sequence:shuffle=1,shift=1", N, 2, 0);
    koksma_spec spec;
    assert_ok(koksma_pattern_spec("r-sequence:shuffle=1,shift=1", &spec));
    for (size_t f = 0; f < sizeof firsts / sizeof *firsts; f++) {
        assert_ok(koksma_generate_range(&spec, domain.key, 0, firsts[f], NULL, &points));
        for (size_t i = 0; i < N; i++) {
            double xs[2];
            koksma_r_2d(domain, firsts[f] + i, xs);
            assert_memory_equal(xs, points.xs + 2 * i, sizeof xs);
        }
    }
    koksma_points_fini(&points);
}

TEST_CASE(permutations_are_permutations)
{
    for (uint32_t n = 1; n < 300; n += 1 + n / 8) {
        unsigned char seen[300] = {0};
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t j = koksma_permute(i, n, 0x9e3779b97f4a7c15u * n);
            assert_true(j < n && !seen[j]);
            seen[j] = 1;
        }
    }
    static const uint32_t large[] = {1u << 30, (1u << 30) + 1, 0x7fffffffu};
    for (size_t s = 0; s < sizeof large / sizeof *large; s++) {
        uint32_t to[60];
        for (uint32_t i = 0; i < 60; i++) {
            to[i] = koksma_permute(i < 30 ? i : large[s] - 1 - (i - 30), large[s], 77);
            assert_true(to[i] < large[s]);
            for (uint32_t j = 0; j < i; j++) {
                assert_true(to[j] != to[i]);
            }
        }
    }
}

/* Over keys, the places of two elements are nearly uniform: what is above the noise is below 2 % for few elements. */
TEST_CASE(pairs_of_places_are_nearly_uniform)
{
    enum { KEYS = 100000, MOST = 9 };
    for (uint32_t n = 3; n <= MOST; n++) {
        static int counts[MOST][MOST][MOST][MOST];
        memset(counts, 0, sizeof counts);
        for (uint32_t key = 0; key < KEYS; key++) {
            const koksma__words w = koksma__random(key, KOKSMA__PURPOSE_TEST, 1, n);
            uint32_t place[MOST];
            for (uint32_t i = 0; i < n; i++) {
                place[i] = koksma_permute(i, n, (uint64_t)w.w[0] << 32 | w.w[1]);
            }
            for (uint32_t i = 0; i < n * n; i++) {
                counts[i / n][i % n][place[i / n]][place[i % n]]++;
            }
        }
        const double pairs = n * (n - 1.0), expected = KEYS / pairs;
        double square = 0;
        for (uint32_t i = 0; i < n * n * n * n; i++) {
            const uint32_t a = i % n, b = i / n % n, c = i / n / n % n, d = i / n / n / n;
            const double off = a != b && c != d ? counts[a][b][c][d] / expected - 1 : 0;
            square += off * off / (pairs * pairs);
        }
        const double above_noise = square - 1 / expected;
        assert_true(above_noise < (n < 9 ? 0.02 * 0.02 : 0.005 * 0.005));
    }
}

TEST_CASE(floats_stay_below_one)
{
    assert_true(koksma_to_float(1 - 0x1p-53) < 1.0f);
    assert_true(koksma_to_float(0.75) == 0.75f);
    assert_true((float)(1 - 0x1p-53) == 1.0f);
}

/* A number of any size up to `bits` bits. */
static uint32_t of_any_size(uint32_t i, uint32_t lane, uint32_t bits)
{
    const koksma__words w = koksma__random(9, KOKSMA__PURPOSE_TEST, i, lane);
    const uint32_t size = koksma__below(w.w[1], bits + 1);
    return size ? w.w[0] >> (32 - size) : 0;
}

static void assert_in_unit(const double *xs, int count)
{
    for (int k = 0; k < count; k++) {
        assert_true(xs[k] >= 0 && xs[k] < 1);
    }
}

/* Whatever the index, the pixel and the grid are. */
TEST_CASE(all_arguments_serve)
{
    for (uint32_t i = 0; i < 20000; i++) {
        const koksma_domain pixel = koksma_domain_of_pixel(i, of_any_size(i, 0, 32), of_any_size(i, 1, 32));
        const koksma_domain domain = koksma_domain_of_use(pixel, of_any_size(i, 2, 32));
        const uint32_t index = of_any_size(i, 3, 32), columns = of_any_size(i, 4, 30) + 1;
        const uint32_t rows = of_any_size(i, 5, 30) % (0x7fffffffu / columns) + 1;
        const int levels = (int)(i % 17);
        double xs[4];
        koksma_sobol_2d(domain, index, xs);
        assert_in_unit(xs, 2);
        koksma_sobol_4d(domain, index, xs);
        assert_in_unit(xs, 4);
        koksma_pmj02_2d(domain, index, xs);
        assert_in_unit(xs, 2);
        koksma_r_2d(domain, (uint64_t)index << i % 33, xs);
        assert_in_unit(xs, 2);
        koksma_cmj_2d(domain, index % (columns * rows), columns, rows, xs);
        assert_in_unit(xs, 2);
        const uint32_t side = 1u << levels;
        assert_true((uint64_t)koksma_z_rank(domain, index % side, columns % side, levels) < (uint64_t)side * side);
    }
}

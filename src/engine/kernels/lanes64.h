/* SPDX-License-Identifier: Apache-2.0 */
/* Vectors of 64-bit lanes, for operations that compilers do not turn into one instruction by themselves. The most
   important is lanes64_product, the 64-bit product of the 32-bit numbers in the lower halves of lanes, which ignores
   the upper halves. */
#ifndef KOKSMA_KERNELS_LANES64_H
#define KOKSMA_KERNELS_LANES64_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#if defined(__AVX512F__)
#include <immintrin.h>
enum { LANES64 = 8 };
typedef __m512i lanes64;
static inline lanes64 lanes64_product(lanes64 a, lanes64 b)
{
    return _mm512_mul_epu32(a, b);
}
#elif defined(__AVX2__)
#include <immintrin.h>
enum { LANES64 = 4 };
typedef __m256i lanes64;
static inline lanes64 lanes64_product(lanes64 a, lanes64 b)
{
    return _mm256_mul_epu32(a, b);
}
#elif defined(__SSE2__)
#include <emmintrin.h>
enum { LANES64 = 2 };
typedef __m128i lanes64;
static inline lanes64 lanes64_product(lanes64 a, lanes64 b)
{
    return _mm_mul_epu32(a, b);
}
#else
enum { LANES64 = 2 };
typedef uint64_t lanes64 __attribute__((vector_size(16)));
static inline lanes64 lanes64_product(lanes64 a, lanes64 b)
{
    return (a & 0xffffffffu) * (b & 0xffffffffu);
}
#endif

/* Vectors of 64-bit unsigned integers, signed integers and doubles, to which the compiler's operators apply. */
typedef uint64_t lanes64_u __attribute__((vector_size(8 * LANES64)));
typedef int64_t lanes64_i __attribute__((vector_size(8 * LANES64)));
typedef double lanes64_d __attribute__((vector_size(8 * LANES64)));

/* Returns x in every lane. */
static inline lanes64_u lanes64_splat(uint64_t x)
{
    return x - (lanes64_u){0};
}

static inline lanes64_d lanes64_splat_d(double x)
{
    return x - (lanes64_d){0};
}

static inline lanes64_d lanes64_load_d(const double *from)
{
    lanes64_d v;
    memcpy(&v, from, sizeof v);
    return v;
}

/* 0, 1, 2, ... */
static inline lanes64_u lanes64_count(void)
{
#if defined(__AVX512F__)
    return (lanes64_u){0, 1, 2, 3, 4, 5, 6, 7};
#elif defined(__AVX2__)
    return (lanes64_u){0, 1, 2, 3};
#else
    return (lanes64_u){0, 1};
#endif
}

/* Returns 0 .. LANES64 - 1 in the order of lanes that lanes64_pairs expects. */
static inline lanes64_u lanes64_count_pairs(void)
{
#if defined(__AVX512F__)
    return (lanes64_u){0, 4, 1, 5, 2, 6, 3, 7};
#elif defined(__AVX2__)
    return (lanes64_u){0, 2, 1, 3};
#else
    return (lanes64_u){0, 1};
#endif
}

/* low, high = x[0], y[0], x[1], y[1], ..., where the lanes of x and y are in the order of lanes64_count_pairs: one
   instruction for each result. */
static inline void lanes64_pairs(lanes64_d x, lanes64_d y, lanes64_d *low, lanes64_d *high)
{
#if defined(__AVX512F__)
    *low = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
    *high = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
#elif defined(__AVX2__)
    *low = __builtin_shufflevector(x, y, 0, 4, 2, 6);
    *high = __builtin_shufflevector(x, y, 1, 5, 3, 7);
#else
    *low = __builtin_shufflevector(x, y, 0, 2);
    *high = __builtin_shufflevector(x, y, 1, 3);
#endif
}

/* Each lane of the result has the lower half of the lane of `low` and the upper half of the lane of `high`. */
static inline lanes64_u lanes64_halves(lanes64_u low, lanes64_u high)
{
#if defined(__AVX2__) && !defined(__AVX512F__)
    return (lanes64_u)_mm256_blend_epi32((__m256i)low, (__m256i)high, 0xaa);
#else
    return (low & 0xffffffffu) | (high & 0xffffffff00000000u);
#endif
}

/* For lanes loaded from an array of words: returns the words of even index (lanes64_odd_words: of odd index) in the
   lower halves of lanes; the upper halves are meaningless. */
static inline lanes64_u lanes64_even_words(lanes64_u lanes)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return lanes;
#else
    return lanes >> 32;
#endif
}

static inline lanes64_u lanes64_odd_words(lanes64_u lanes)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return lanes >> 32;
#else
    return lanes;
#endif
}

/* For lanes loaded from an array of words: returns the words of even index (lanes64_odd_upper: of odd index) in the
   upper halves of lanes; the lower halves are meaningless. */
static inline lanes64_u lanes64_even_upper(lanes64_u lanes)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return lanes << 32;
#else
    return lanes;
#endif
}

static inline lanes64_u lanes64_odd_upper(lanes64_u lanes)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return lanes;
#else
    return lanes << 32;
#endif
}

/* Return lanes of two words each: first in memory the word from `even`, then the word from `odd`. lanes64_words takes
   the lower halves of its arguments, lanes64_upper_words the upper halves. */
static inline lanes64_u lanes64_words(lanes64_u even, lanes64_u odd)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return lanes64_halves(even, odd << 32);
#else
    return lanes64_halves(odd, even << 32);
#endif
}

static inline lanes64_u lanes64_upper_words(lanes64_u even, lanes64_u odd)
{
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    return lanes64_halves(even >> 32, odd);
#else
    return lanes64_halves(odd >> 32, even);
#endif
}

/* Returns x >> counts, lane by lane; counts are below 64. SSE2 shifts both lanes by the same count. */
static inline lanes64_u lanes64_shifted(lanes64_u x, lanes64_u counts)
{
#if defined(__SSE2__) && !defined(__AVX2__)
    const __m128i low = _mm_srl_epi64((__m128i)x, (__m128i)counts);
    const __m128i high = _mm_srl_epi64((__m128i)x, _mm_unpackhi_epi64((__m128i)counts, (__m128i)counts));
    return (lanes64_u)_mm_castpd_si128(_mm_move_sd(_mm_castsi128_pd(high), _mm_castsi128_pd(low)));
#else
    return x >> counts;
#endif
}

/* Returns table[3 i] for each lane i of `index`. */
static inline lanes64_u lanes64_of_triples(const uint64_t *table, lanes64_u index)
{
    const lanes64_u at = index + index + index;
#if defined(__AVX512F__)
    return (lanes64_u)_mm512_i64gather_epi64((__m512i)at, table, 8);
#elif defined(__AVX2__)
    return (lanes64_u)_mm256_i64gather_epi64((const long long *)table, (__m256i)at, 8);
#else
    return (lanes64_u){table[at[0]], table[at[1]]};
#endif
}

/* Returns whether the mask is set in any lane. */
static inline bool lanes64_any(lanes64_i mask)
{
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask((__m512i)mask, (__m512i)mask) != 0;
#elif defined(__AVX2__)
    return !_mm256_testz_si256((__m256i)mask, (__m256i)mask);
#elif defined(__SSE2__)
    return _mm_movemask_epi8((__m128i)mask) != 0;
#else
    return (mask[0] | mask[1]) != 0;
#endif
}

/* Returns the lanes of x where the mask is set, and 0 in the other lanes. */
static inline lanes64_d lanes64_masked(lanes64_i mask, lanes64_d x)
{
    return (lanes64_d)((lanes64_i)x & mask);
}

/* Returns the lanes of x where the mask is set, and those of y elsewhere. */
static inline lanes64_d lanes64_chosen(lanes64_i mask, lanes64_d x, lanes64_d y)
{
    return (lanes64_d)(((lanes64_i)x & mask) | ((lanes64_i)y & ~mask));
}

/* Converts whole numbers below 2^52 to doubles. */
static inline lanes64_d lanes64_whole(lanes64_u x)
{
    return (lanes64_d)(x | 0x4330000000000000u) - 0x1p52;
}

/* Returns the floor of each lane, for numbers in [0, 2^52). */
static inline lanes64_d lanes64_floor(lanes64_d x)
{
#if defined(__AVX2__) && !defined(__AVX512F__)
    return (lanes64_d)_mm256_floor_pd((__m256d)x);
#else
    const lanes64_d nearest = (x + 0x1p52) - 0x1p52;
    return nearest - lanes64_masked((lanes64_i)(nearest > x), lanes64_splat_d(1));
#endif
}

/* low, high = x[0], y[0], x[1], y[1], ... */
static inline void lanes64_zip(lanes64_d x, lanes64_d y, lanes64_d *low, lanes64_d *high)
{
#if defined(__AVX512F__)
    *low = __builtin_shufflevector(x, y, 0, 8, 1, 9, 2, 10, 3, 11);
    *high = __builtin_shufflevector(x, y, 4, 12, 5, 13, 6, 14, 7, 15);
#elif defined(__AVX2__)
    lanes64_d even, odd;
    lanes64_pairs(x, y, &even, &odd);
    *low = __builtin_shufflevector(even, odd, 0, 1, 4, 5);
    *high = __builtin_shufflevector(even, odd, 2, 3, 6, 7);
#else
    *low = __builtin_shufflevector(x, y, 0, 2);
    *high = __builtin_shufflevector(x, y, 1, 3);
#endif
}

/* lanes64_min is x < y ? x : y in each lane, lanes64_max is x > y ? x : y. */
static inline lanes64_d lanes64_min(lanes64_d x, lanes64_d y)
{
#if defined(__AVX512F__)
    return (lanes64_d)_mm512_min_pd((__m512d)x, (__m512d)y);
#elif defined(__AVX2__)
    return (lanes64_d)_mm256_min_pd((__m256d)x, (__m256d)y);
#elif defined(__SSE2__)
    return (lanes64_d)_mm_min_pd((__m128d)x, (__m128d)y);
#else
    return (lanes64_d){x[0] < y[0] ? x[0] : y[0], x[1] < y[1] ? x[1] : y[1]};
#endif
}

static inline lanes64_d lanes64_max(lanes64_d x, lanes64_d y)
{
#if defined(__AVX512F__)
    return (lanes64_d)_mm512_max_pd((__m512d)x, (__m512d)y);
#elif defined(__AVX2__)
    return (lanes64_d)_mm256_max_pd((__m256d)x, (__m256d)y);
#elif defined(__SSE2__)
    return (lanes64_d)_mm_max_pd((__m128d)x, (__m128d)y);
#else
    return (lanes64_d){x[0] > y[0] ? x[0] : y[0], x[1] > y[1] ? x[1] : y[1]};
#endif
}

static inline lanes64_d lanes64_sqrt(lanes64_d x)
{
#if defined(__AVX512F__)
    return (lanes64_d)_mm512_sqrt_pd((__m512d)x);
#elif defined(__AVX2__)
    return (lanes64_d)_mm256_sqrt_pd((__m256d)x);
#elif defined(__SSE2__)
    return (lanes64_d)_mm_sqrt_pd((__m128d)x);
#else
    return (lanes64_d){sqrt(x[0]), sqrt(x[1])};
#endif
}

static inline lanes64_d lanes64_abs(lanes64_d x)
{
    return (lanes64_d)((lanes64_u)x & 0x7fffffffffffffffu);
}

/* Returns the value of the largest lane. */
static inline double lanes64_largest(lanes64_d v)
{
#if defined(__AVX512F__)
    return _mm512_reduce_max_pd((__m512d)v);
#elif defined(__AVX2__)
    const __m128d two = _mm_max_pd(_mm256_castpd256_pd128((__m256d)v), _mm256_extractf128_pd((__m256d)v, 1));
    return _mm_cvtsd_f64(_mm_max_pd(two, _mm_unpackhi_pd(two, two)));
#elif defined(__SSE2__)
    return _mm_cvtsd_f64(_mm_max_pd((__m128d)v, _mm_unpackhi_pd((__m128d)v, (__m128d)v)));
#else
    return v[0] > v[1] ? v[0] : v[1];
#endif
}

/* Stores a vector. If stream is set, the write bypasses the caches, and `out` must be aligned to 16 bytes. */
static inline void lanes64_store(lanes64_d v, bool stream, double *out)
{
#if defined(__SSE2__)
    if (stream) {
        __m128d parts[LANES64 / 2];
        memcpy(parts, &v, sizeof parts);
        for (int p = 0; p < LANES64 / 2; p++) {
            _mm_stream_pd(out + 2 * p, parts[p]);
        }
        return;
    }
#endif
    (void)stream;
    memcpy(out, &v, sizeof v);
}

/* Stores LANES64 points of dim = 2 or 4 coordinates, given as dim vectors, one for each coordinate. */
static inline __attribute__((always_inline)) void lanes64_store_rows(const lanes64_d *columns, int dim, bool stream,
                                                                     double *out)
{
    lanes64_d v[8];
    if (dim == 2) {
        lanes64_zip(columns[0], columns[1], &v[0], &v[1]);
        lanes64_store(v[0], stream, out);
        lanes64_store(v[1], stream, out + LANES64);
        return;
    }
#if defined(__AVX2__) && !defined(__AVX512F__)
    lanes64_pairs(columns[0], columns[1], &v[0], &v[1]);
    lanes64_pairs(columns[2], columns[3], &v[2], &v[3]);
    v[4] = __builtin_shufflevector(v[0], v[2], 0, 1, 4, 5);
    v[5] = __builtin_shufflevector(v[1], v[3], 0, 1, 4, 5);
    v[6] = __builtin_shufflevector(v[0], v[2], 2, 3, 6, 7);
    v[7] = __builtin_shufflevector(v[1], v[3], 2, 3, 6, 7);
#else
    lanes64_zip(columns[0], columns[2], &v[0], &v[1]);
    lanes64_zip(columns[1], columns[3], &v[2], &v[3]);
    lanes64_zip(v[0], v[2], &v[4], &v[5]);
    lanes64_zip(v[1], v[3], &v[6], &v[7]);
#endif
    for (int p = 0; p < 4; p++) {
        lanes64_store(v[4 + p], stream, out + p * LANES64);
    }
}

/* Call this after the last streaming store. */
static inline void lanes64_stored(void)
{
#if defined(__SSE2__)
    _mm_sfence();
#endif
}

#endif

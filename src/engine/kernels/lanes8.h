/* SPDX-License-Identifier: Apache-2.0 */
/* Vectors of eight words of two 16-bit numbers each, with operations that compilers do not turn into one instruction
   by themselves: the sum of the squares of the two numbers, a mask with one bit for each lane, and packing the chosen
   lanes of a vector. Without AVX2 a vector is a pair of 128-bit vectors (SSE2), or the compiler chooses the
   instructions. */
#ifndef KOKSMA_KERNELS_LANES8_H
#define KOKSMA_KERNELS_LANES8_H

#include <stdint.h>
#include <string.h>

#if defined(__AVX2__)
#include <immintrin.h>
#define LANES8_AVX2
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

typedef int32_t lanes8 __attribute__((vector_size(32)));
typedef uint32_t lanes8_u __attribute__((vector_size(32)));
typedef uint16_t lanes8_pairs __attribute__((vector_size(32)));
typedef uint32_t lanes4 __attribute__((vector_size(16)));

#define LANES8_INLINE static inline __attribute__((always_inline))

LANES8_INLINE void lanes8_load(const uint32_t *from, lanes8_pairs *v)
{
    memcpy(v, from, sizeof *v);
}

/* Loads the first four words from `low` and the last four from `high`. */
LANES8_INLINE void lanes8_load_halves(const uint32_t *low, const uint32_t *high, lanes8_pairs *v)
{
    uint32_t words[8];
    memcpy(words, low, 4 * sizeof *words);
    memcpy(words + 4, high, 4 * sizeof *words);
    memcpy(v, words, sizeof words);
}

/* Returns the same word in all lanes. */
LANES8_INLINE void lanes8_splat(uint32_t word, lanes8_pairs *v)
{
    *v = (lanes8_pairs)(word - (lanes8_u){0});
}

/* Returns the sum of the squares of both numbers of each lane, which is below 2^31. */
LANES8_INLINE void lanes8_squares(const lanes8_pairs *v, lanes8 *sums)
{
#if defined(LANES8_AVX2)
    *sums = (lanes8)_mm256_madd_epi16((__m256i)*v, (__m256i)*v);
#elif defined(__SSE2__)
    __m128i parts[2];
    memcpy(parts, v, sizeof parts);
    parts[0] = _mm_madd_epi16(parts[0], parts[0]);
    parts[1] = _mm_madd_epi16(parts[1], parts[1]);
    memcpy(sums, parts, sizeof parts);
#else
    const lanes8 words = (lanes8)*v, high = words >> 16, low = (lanes8)((lanes8_u)words << 16) >> 16;
    *sums = high * high + low * low;
#endif
}

/* Replaces both signed numbers of each lane by their absolute values. */
LANES8_INLINE void lanes8_absolute(lanes8_pairs *v)
{
#ifdef LANES8_AVX2
    *v = (lanes8_pairs)_mm256_abs_epi16((__m256i)*v);
#else
    const lanes8_pairs sign = 0 - (*v >> 15);
    *v = (*v ^ sign) - sign;
#endif
}

/* Sets each lane of `least` to the smaller of this lane of x and of least. */
LANES8_INLINE void lanes8_min(const lanes8 *x, lanes8 *least)
{
#ifdef LANES8_AVX2
    *least = (lanes8)_mm256_min_epi32((__m256i)*x, (__m256i)*least);
#else
    const lanes8 below = (lanes8)(*x < *least);
    *least = (*x & below) | (*least & ~below);
#endif
}

LANES8_INLINE int32_t lanes8_least(const lanes8 *v)
{
#ifdef LANES8_AVX2
    __m128i four = _mm_min_epi32(_mm256_castsi256_si128((__m256i)*v), _mm256_extracti128_si256((__m256i)*v, 1));
    four = _mm_min_epi32(four, _mm_shuffle_epi32(four, 0x4e));
    four = _mm_min_epi32(four, _mm_shuffle_epi32(four, 0xb1));
    return _mm_cvtsi128_si32(four);
#else
    int32_t least = (*v)[0];
    for (int l = 1; l < 8; l++) {
        least = (*v)[l] < least ? (*v)[l] : least;
    }
    return least;
#endif
}

/* Bit l of the result is set if lane l is negative. */
LANES8_INLINE unsigned lanes8_signs(const lanes8 *v)
{
#if defined(LANES8_AVX2)
    return (unsigned)_mm256_movemask_ps((__m256)*v);
#elif defined(__SSE2__)
    __m128 parts[2];
    memcpy(parts, v, sizeof parts);
    return (unsigned)_mm_movemask_ps(parts[0]) | (unsigned)_mm_movemask_ps(parts[1]) << 4;
#else
    unsigned bits = 0;
    for (int l = 0; l < 8; l++) {
        bits |= (unsigned)((*v)[l] < 0) << l;
    }
    return bits;
#endif
}

/* Bit q < 4 of the result is set if some lane of v[q] is below the limit. */
LANES8_INLINE unsigned lanes8_below(const lanes8 v[4], int32_t limit)
{
#ifdef LANES8_AVX2
    const __m256i a = (__m256i)v[0], b = (__m256i)v[1], c = (__m256i)v[2], d = (__m256i)v[3];
    const __m256i ab = _mm256_min_epi32(_mm256_unpacklo_epi32(a, b), _mm256_unpackhi_epi32(a, b));
    const __m256i cd = _mm256_min_epi32(_mm256_unpacklo_epi32(c, d), _mm256_unpackhi_epi32(c, d));
    const __m256i all = _mm256_min_epi32(_mm256_unpacklo_epi64(ab, cd), _mm256_unpackhi_epi64(ab, cd));
    const __m128i least = _mm_min_epi32(_mm256_castsi256_si128(all), _mm256_extracti128_si256(all, 1));
    return (unsigned)_mm_movemask_ps(_mm_castsi128_ps(_mm_cmplt_epi32(least, _mm_set1_epi32(limit))));
#else
    unsigned bits = 0;
    for (int q = 0; q < 4; q++) {
        const lanes8 lower = v[q] - limit;
        bits |= (unsigned)(lanes8_signs(&lower) != 0) << q;
    }
    return bits;
#endif
}

/* Writes to out, without gaps, those of the first five lanes whose bit is set; out has capacity for eight words. */
LANES8_INLINE void lanes8_pick5(const lanes8_pairs *v, unsigned bits, uint32_t *out)
{
#ifdef LANES8_AVX2
    static const uint64_t order[32] = {0x0,     0x0,       0x1,       0x100,      0x2,     0x200,   0x201,
                                       0x20100, 0x3,       0x300,     0x301,      0x30100, 0x302,   0x30200,
                                       0x30201, 0x3020100, 0x4,       0x400,      0x401,   0x40100, 0x402,
                                       0x40200, 0x40201,   0x4020100, 0x403,      0x40300, 0x40301, 0x4030100,
                                       0x40302, 0x4030200, 0x4030201, 0x403020100};
    const __m256i from = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)order[bits]));
    _mm256_storeu_si256((__m256i *)out, _mm256_permutevar8x32_epi32((__m256i)*v, from));
#else
    uint32_t words[8];
    memcpy(words, v, sizeof words);
    int count = 0;
    for (int l = 0; l < 5; l++) {
        out[count] = words[l];
        count += (int)(bits >> l & 1);
    }
#endif
}

/* Writes to out, without gaps, those of the four lanes whose bit is set; out has capacity for four words. */
LANES8_INLINE void lanes4_pick(const lanes4 *v, unsigned bits, uint32_t *out)
{
#ifdef LANES8_AVX2
    static const uint32_t order[16] = {0x0, 0x0,   0x1,   0x100,   0x2,   0x200,   0x201,   0x20100,
                                       0x3, 0x300, 0x301, 0x30100, 0x302, 0x30200, 0x30201, 0x3020100};
    const __m128i from = _mm_cvtepu8_epi32(_mm_cvtsi32_si128((int)order[bits]));
    _mm_storeu_ps((float *)out, _mm_permutevar_ps((__m128)*v, from));
#else
    int count = 0;
    for (int l = 0; l < 4; l++) {
        out[count] = (*v)[l];
        count += (int)(bits >> l & 1);
    }
#endif
}

#endif

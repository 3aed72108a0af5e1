/* SPDX-License-Identifier: Apache-2.0 */
/* Eight floats, and what compilers don't find by themselves: which lanes of a mask are set, and a vector's chosen
   lanes side by side. Without AVX2 they are two vectors, or whatever the compiler makes of them. */
#ifndef KOKSMA_KERNELS_LANES8_H
#define KOKSMA_KERNELS_LANES8_H

#include <stdint.h>
#include <string.h>

#if defined(__AVX2__) && defined(__BMI2__)
#include <immintrin.h>
#define LANES8_AVX2
#endif

typedef float lanes8 __attribute__((vector_size(32)));
typedef int32_t lanes8_i __attribute__((vector_size(32)));

static inline __attribute__((always_inline)) void lanes8_load(const float *from, lanes8 *v)
{
    memcpy(v, from, sizeof *v);
}

/* The lower of x and least, lane by lane. */
static inline __attribute__((always_inline)) void lanes8_min(const lanes8 *x, lanes8 *least)
{
#ifdef LANES8_AVX2
    *least = (lanes8)_mm256_min_ps((__m256)*x, (__m256)*least);
#else
    const lanes8_i below = (lanes8_i)(*x < *least);
    *least = (lanes8)(((lanes8_i)*x & below) | ((lanes8_i)*least & ~below));
#endif
}

/* Bit l: whether lane l is -1; lanes are 0 or -1. */
static inline __attribute__((always_inline)) unsigned lanes8_bits(const lanes8_i *mask)
{
#ifdef LANES8_AVX2
    return (unsigned)_mm256_movemask_ps((__m256)*mask);
#else
    unsigned bits = 0;
    for (int l = 0; l < 8; l++) {
        bits |= (unsigned)(*mask)[l] & 1u << l;
    }
    return bits;
#endif
}

/* Whether any lane is -1. */
static inline __attribute__((always_inline)) unsigned lanes8_any(const lanes8_i *mask)
{
#ifdef LANES8_AVX2
    return !_mm256_testz_si256((__m256i)*mask, (__m256i)*mask);
#else
    uint64_t parts[4];
    memcpy(parts, mask, sizeof parts);
    return (parts[0] | parts[1] | parts[2] | parts[3]) != 0;
#endif
}

/* The lanes of x and y with a bit, side by side at xs and ys, which have room for eight. */
static inline __attribute__((always_inline)) void lanes8_pick(const lanes8 *x, const lanes8 *y, unsigned bits,
                                                              float *xs, float *ys)
{
#ifdef LANES8_AVX2
    const uint64_t bytes = _pdep_u64(bits, 0x0101010101010101u) * 0xff;
    const uint64_t lanes = _pext_u64(0x0706050403020100u, bytes);
    const __m256i from = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)lanes));
    _mm256_storeu_ps(xs, _mm256_permutevar8x32_ps((__m256)*x, from));
    _mm256_storeu_ps(ys, _mm256_permutevar8x32_ps((__m256)*y, from));
#else
    int count = 0;
    for (int l = 0; l < 8; l++) {
        xs[count] = (*x)[l];
        ys[count] = (*y)[l];
        count += (int)(bits >> l & 1);
    }
#endif
}

#endif

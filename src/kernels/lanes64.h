/* SPDX-License-Identifier: Apache-2.0 */
/* Vectors of 64-bit lanes for the one thing that compilers don't find by themselves: the product of two 32-bit
   numbers in 64-bit lanes as one instruction. What the upper half of a lane holds does not matter to it. */
#ifndef KOKSMA_KERNELS_LANES64_H
#define KOKSMA_KERNELS_LANES64_H

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

/* The same lanes as unsigned integers and as doubles, for the operators of the compiler's vector types. */
typedef uint64_t lanes64_u __attribute__((vector_size(8 * LANES64)));
typedef double lanes64_d __attribute__((vector_size(8 * LANES64)));

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

/* low, high = x[0], y[0], x[1], y[1], ... */
static inline void lanes64_zip(lanes64_d x, lanes64_d y, lanes64_d *low, lanes64_d *high)
{
#if defined(__AVX512F__)
    *low = __builtin_shufflevector(x, y, 0, 8, 1, 9, 2, 10, 3, 11);
    *high = __builtin_shufflevector(x, y, 4, 12, 5, 13, 6, 14, 7, 15);
#elif defined(__AVX2__)
    *low = __builtin_shufflevector(x, y, 0, 4, 1, 5);
    *high = __builtin_shufflevector(x, y, 2, 6, 3, 7);
#else
    *low = __builtin_shufflevector(x, y, 0, 2);
    *high = __builtin_shufflevector(x, y, 1, 3);
#endif
}

/* out = x[0], y[0], x[1], y[1], ...: the bits of 2 LANES64 doubles. */
static inline void lanes64_interleave(lanes64_d x, lanes64_d y, void *out)
{
    lanes64_d low, high;
    lanes64_zip(x, y, &low, &high);
    memcpy(out, &low, sizeof low);
    memcpy((char *)out + sizeof low, &high, sizeof high);
}

/* Stores a vector; with stream, past the caches, for which `out` is aligned to 16 bytes. */
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

/* After the last streaming store. */
static inline void lanes64_stored(void)
{
#if defined(__SSE2__)
    _mm_sfence();
#endif
}

#endif

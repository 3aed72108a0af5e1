/* SPDX-License-Identifier: Apache-2.0 */
/* Included by the files that are compiled once for each instruction set: declares the kernels under their names
   for this instruction set, and macros for loops over lanes. */
#ifndef KOKSMA_RENDER_PIPELINES_BATCH_KERNEL_H
#define KOKSMA_RENDER_PIPELINES_BATCH_KERNEL_H

#include <string.h>

#include "render/pipelines/batch.h"

#ifdef __AVX512F__
#include <immintrin.h>
#endif

#define KERNEL(result, name, arguments) result BATCH_NAME(name) arguments;
#include "render/pipelines/batch.def"
#undef KERNEL

/* rounds n down to a multiple of KOKSMA__LANE_STEP, so that the compiler adds no remainder loop */
#define STEP(n) ((n) & ~(KOKSMA__LANE_STEP - 1))

/* Marks a loop over lanes whose iterations are independent: no lane reads what another lane writes. gcc gives up
   checking this for loops over many arrays. */
#if defined(__GNUC__) && !defined(__clang__)
#define LANES_APART _Pragma("GCC ivdep")
#else
#define LANES_APART
#endif

/* Forces inlining of functions that are compiled once for each value of a constant argument. */
#define INLINE static inline __attribute__((always_inline))

/* Returns how many of the first n rays have their closest hit on the primitive. */
INLINE int koksma__batch_count_hits(const koksma__hits *h, int32_t id, int n)
{
    int count = 0;
    for (int i = 0; i < STEP(n); i++) {
        count += h->primitive[i] == id;
    }
    return count;
}

/* Lanes that were picked from a block, ascending. */
typedef struct koksma__picks {
    int n;
    KOKSMA__LANES(int32_t, lane);
    uint16_t steps[KOKSMA__BLOCK / 16]; /* bit i % 16 of number i / 16 is lane i; only with AVX-512 */
} koksma__picks;

/* Picks the lanes whose flag is not 0 from n lanes. */
INLINE void koksma__batch_pick(const int32_t *restrict flags, int n, koksma__picks *restrict to)
{
    int count = 0;
#ifdef __AVX512F__
    __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    memset(to->steps, 0, sizeof to->steps);
    for (int i = 0; i < STEP(n); i += 16) {
        const __m512i flag = _mm512_load_si512(flags + i);
        const __mmask16 picked = _mm512_test_epi32_mask(flag, flag);
        _mm512_storeu_si512(to->lane + count, _mm512_maskz_compress_epi32(picked, lanes));
        lanes = _mm512_add_epi32(lanes, _mm512_set1_epi32(16));
        to->steps[i / 16] = picked;
        count += __builtin_popcount(picked);
    }
#else
    for (int i = 0; i < STEP(n); i++) {
        to->lane[count] = i;
        count += flags[i] != 0;
    }
#endif
    to->n = count;
}

/* Copies picked lanes of an array of 32-bit numbers; the other lanes of `to` become undefined. */
INLINE void koksma__batch_pull(const void *restrict from, const koksma__picks *restrict p, void *restrict to)
{
    /* volatile, because compilers would put vectors together number by number, which takes longer */
    const volatile uint32_t *restrict x = from;
    uint32_t *restrict y = to;
#ifdef __AVX512F__
    if (p->n > KOKSMA__BLOCK / 5) {
        for (int i = 0, at = 0; i < KOKSMA__BLOCK / 16; i++) {
            const __m512i v = _mm512_load_si512((const uint32_t *)from + 16 * i);
            _mm512_storeu_si512(y + at, _mm512_maskz_compress_epi32(p->steps[i], v));
            at += __builtin_popcount(p->steps[i]);
        }
        return;
    }
#endif
    for (int j = 0; j < p->n; j++) {
        y[j] = x[p->lane[j]];
    }
}

/* Copies lanes back to where they were picked from. */
INLINE void koksma__batch_push(const void *restrict from, const koksma__picks *restrict p, void *restrict to)
{
    const uint32_t *restrict x = from;
    volatile uint32_t *restrict y = to;
    for (int j = 0; j < p->n; j++) {
        y[p->lane[j]] = x[j];
    }
}

#endif

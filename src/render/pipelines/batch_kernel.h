/* SPDX-License-Identifier: Apache-2.0 */
/* Included by the files that are compiled once for each instruction set: declares the kernels under their names
   for this instruction set, and macros for loops over lanes. */
#ifndef KOKSMA_RENDER_PIPELINES_BATCH_KERNEL_H
#define KOKSMA_RENDER_PIPELINES_BATCH_KERNEL_H

#include <math.h>
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

/* Copies at most half of a block, and the last of the picked lanes up to a whole step. */
INLINE void koksma__batch_pull_whole(const void *restrict from, const koksma__picks *restrict p, void *restrict to)
{
    uint32_t *last = (uint32_t *)to + p->n;
    koksma__batch_pull(from, p, to);
    for (int j = 0; j < KOKSMA__LANE_STEP; j++) {
        last[j] = last[-1];
    }
}

/* The number of lanes of whole steps. */
INLINE int koksma__batch_pulled(const koksma__picks *p)
{
    return STEP(p->n + KOKSMA__LANE_STEP - 1);
}

/* ---- Bundles ---------------------------------------------------------------------------------------------------- */

/*
 * A hit that a loop of a shape or triangle reports lies at o + t d within a few rounding errors of it, relative to |o| and
 * its coordinates; 2^-15 is some hundred times as much. The ray comes as near to the box in the interval of t where it
 * is between low - margin and high + margin, in all coordinates: it meets what is in the box nowhere else.
 */
#define KOKSMA__BOX_MARGIN 0x1p-15f

typedef struct koksma__slabs {
    _Alignas(64) float above[3][KOKSMA__BLOCK]; /* the origin plus the margin */
    _Alignas(64) float below[3][KOKSMA__BLOCK];
    _Alignas(64) float inverse[3][KOKSMA__BLOCK]; /* of the direction, whose coordinates are not 0 */
} koksma__slabs;

INLINE float koksma__smaller(float a, float b)
{
    return a < b ? a : b;
}

INLINE float koksma__larger(float a, float b)
{
    return a > b ? a : b;
}

/* 1 / d, where |d| counts as at least `least`. */
INLINE float koksma__bounded_inverse(float d, float least)
{
    const float size = koksma__larger(fabsf(d), least);
    return 1 / (d < 0 ? -size : size);
}

/* size: that of koksma__batch_shapes. */
INLINE void koksma__slabs_of(const float *const o[3], const float *const d[3], float size, int n,
                             koksma__slabs *restrict to)
{
    const float *restrict ox = o[0], *restrict oy = o[1], *restrict oz = o[2];
    const float *restrict dx = d[0], *restrict dy = d[1], *restrict dz = d[2];
    for (int i = 0; i < STEP(n); i++) {
        const float margin = KOKSMA__BOX_MARGIN * (fabsf(ox[i]) + fabsf(oy[i]) + fabsf(oz[i]) + size);
        const float most = koksma__larger(koksma__larger(fabsf(dx[i]), fabsf(dy[i])), fabsf(dz[i]));
        const float least = koksma__larger(0x1p-24f * most, 1e-30f);
        to->above[0][i] = ox[i] + margin;
        to->above[1][i] = oy[i] + margin;
        to->above[2][i] = oz[i] + margin;
        to->below[0][i] = ox[i] - margin;
        to->below[1][i] = oy[i] - margin;
        to->below[2][i] = oz[i] - margin;
        to->inverse[0][i] = koksma__bounded_inverse(dx[i], least);
        to->inverse[1][i] = koksma__bounded_inverse(dy[i], least);
        to->inverse[2][i] = koksma__bounded_inverse(dz[i], least);
    }
}

/* Picks the lanes that may meet what is in a bundle before t = end; NULL: before a shadow ray ends. `wanted` is 0 in lanes
   that do not count; NULL: all count. */
INLINE void koksma__near_bundle(const koksma__batch_bundle *restrict b, const koksma__slabs *restrict s,
                                const float *restrict end, const float *restrict wanted, int n,
                                koksma__picks *restrict to)
{
    KOKSMA__LANES(int32_t, flags);
    const float lx = b->low[0], ly = b->low[1], lz = b->low[2], hx = b->high[0], hy = b->high[1], hz = b->high[2];
    for (int i = 0; i < STEP(n); i++) {
        const float x0 = (lx - s->above[0][i]) * s->inverse[0][i], x1 = (hx - s->below[0][i]) * s->inverse[0][i];
        const float y0 = (ly - s->above[1][i]) * s->inverse[1][i], y1 = (hy - s->below[1][i]) * s->inverse[1][i];
        const float z0 = (lz - s->above[2][i]) * s->inverse[2][i], z1 = (hz - s->below[2][i]) * s->inverse[2][i];
        const float in = koksma__larger(koksma__larger(koksma__smaller(x0, x1), koksma__smaller(y0, y1)),
                                        koksma__larger(koksma__smaller(z0, z1), 0));
        const float last = end ? end[i] : KOKSMA__SHADOW_END;
        const float out = koksma__smaller(koksma__smaller(koksma__larger(x0, x1), koksma__larger(y0, y1)),
                                          koksma__smaller(koksma__larger(z0, z1), last));
        flags[i] = (in <= out) & (wanted ? wanted[i] != 0 : 1);
    }
    koksma__batch_pick(flags, n, to);
}

#endif

/* SPDX-License-Identifier: Apache-2.0 */
/* Included by the files that are compiled once for each instruction set: declares the kernels under their names
   for this instruction set, and macros for loops over lanes. */
#ifndef KOKSMA_RENDER_PIPELINES_BATCH_KERNEL_H
#define KOKSMA_RENDER_PIPELINES_BATCH_KERNEL_H

#include <math.h>
#include <string.h>

#include "render/pipelines/batch.h"
#include "render/vector3.h"

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

/* The vector of lane i of three arrays. */
#define AT(a, i) ((koksma__v3){(a)[0][i], (a)[1][i], (a)[2][i]})

INLINE float koksma__smaller(float a, float b)
{
    return a < b ? a : b;
}

INLINE float koksma__larger(float a, float b)
{
    return a > b ? a : b;
}

INLINE koksma__v3 koksma__either(int first, koksma__v3 a, koksma__v3 b)
{
    return (koksma__v3){first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

/* Stores a vector in lane i where `mine`. */
INLINE void koksma__put(koksma__lanes *restrict to, int i, int mine, koksma__v3 v)
{
    to[0][i] = mine ? v.x : to[0][i];
    to[1][i] = mine ? v.y : to[1][i];
    to[2][i] = mine ? v.z : to[2][i];
}

/* Stores the hit of lane i, but for t and the primitive, where `mine`; on a surface of normal n, of which `side` is -1
   where the ray meets the back. */
INLINE void koksma__put_hit(koksma__hits *restrict h, int i, int mine, koksma__v3 p, koksma__v3 n, float side,
                            float u, float v, int32_t material)
{
    koksma__put(h->p, i, mine, p);
    koksma__put(h->n, i, mine, koksma__v3_scale(n, side));
    h->u[i] = mine ? u : h->u[i];
    h->v[i] = mine ? v : h->v[i];
    h->back[i] = mine ? side < 0 : h->back[i];
    h->material[i] = mine ? material : h->material[i];
}

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

INLINE void koksma__batch_pull_three(const koksma__lanes *restrict from, const koksma__picks *restrict p,
                                     koksma__lanes *restrict to)
{
    for (int k = 0; k < 3; k++) {
        koksma__batch_pull_whole(from[k], p, to[k]);
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
    _Alignas(64) koksma__lanes above[3]; /* the origin plus the margin */
    _Alignas(64) koksma__lanes below[3];
    _Alignas(64) koksma__lanes inverse[3]; /* of the direction, whose coordinates are not 0 */
} koksma__slabs;

/* 1 / d, where |d| counts as at least `least`. */
INLINE float koksma__bounded_inverse(float d, float least)
{
    const float size = koksma__larger(fabsf(d), least);
    return 1 / (d < 0 ? -size : size);
}

/* size: that of koksma__batch_shapes. */
INLINE void koksma__slabs_of(const koksma__lanes *restrict o, const koksma__lanes *restrict d, float size, int n,
                             koksma__slabs *restrict to)
{
    for (int i = 0; i < STEP(n); i++) {
        const float margin = KOKSMA__BOX_MARGIN * (fabsf(o[0][i]) + fabsf(o[1][i]) + fabsf(o[2][i]) + size);
        const float most = koksma__larger(koksma__larger(fabsf(d[0][i]), fabsf(d[1][i])), fabsf(d[2][i]));
        const float least = koksma__larger(0x1p-24f * most, 1e-30f);
        for (int k = 0; k < 3; k++) {
            to->above[k][i] = o[k][i] + margin;
            to->below[k][i] = o[k][i] - margin;
            to->inverse[k][i] = koksma__bounded_inverse(d[k][i], least);
        }
    }
}

/* Picks the lanes that may meet what is in a bundle before t = end; NULL: before a shadow ray ends. `wanted` is 0 in lanes
   that do not count; NULL: all count. */
INLINE void koksma__near_bundle(const koksma__batch_bundle *restrict b, const koksma__slabs *restrict s,
                                const float *restrict end, const float *restrict wanted, int n,
                                koksma__picks *restrict to)
{
    KOKSMA__LANES(int32_t, flags);
    const koksma__batch_bundle box = *b;
    for (int i = 0; i < STEP(n); i++) {
        float in = 0, out = end ? end[i] : KOKSMA__SHADOW_END;
        for (int k = 0; k < 3; k++) {
            const float one = (box.low[k] - s->above[k][i]) * s->inverse[k][i];
            const float other = (box.high[k] - s->below[k][i]) * s->inverse[k][i];
            in = koksma__larger(in, koksma__smaller(one, other));
            out = koksma__smaller(out, koksma__larger(one, other));
        }
        flags[i] = (in <= out) & (wanted ? wanted[i] != 0 : 1);
    }
    koksma__batch_pick(flags, n, to);
}

#endif

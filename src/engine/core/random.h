/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Counter-based random numbers: every number is a hash of its key (seed, purpose, index, lane), where lane is a
 * second index, so the same arguments give the same bits in any order and on any number of threads. The generator is
 * Philox4x32-10 (Salmon et al. 2011), from Random123. The kernel `uniform` gives the same bits for many indices at
 * once.
 */
#ifndef KOKSMA_CORE_RANDOM_H
#define KOKSMA_CORE_RANDOM_H

#define R123_USE_SSE 0 /* Philox uses none, and all intrinsics take a compiler .3 s a file */
#include <Random123/philox.h>
#include <stdint.h>

#include "core/visibility.h"

/* What a random number is used for. Numbers with different purposes are independent. Add new purposes at the end
   only: the bits of every pattern depend on these numbers. */
typedef enum koksma__purpose {
    KOKSMA__PURPOSE_SEED = 1, /* derives a seed from another seed */
    KOKSMA__PURPOSE_POINT,    /* the position of a point in the cube or in its cell */
    KOKSMA__PURPOSE_SHUFFLE,  /* a random permutation */
    KOKSMA__PURPOSE_DART,     /* a candidate point that may be rejected */
    KOKSMA__PURPOSE_SHIFT,    /* a toroidal or digital shift */
    KOKSMA__PURPOSE_SCRAMBLE, /* scrambling of digits */
    KOKSMA__PURPOSE_SEARCH,   /* a random search that a measure makes */
    KOKSMA__PURPOSE_TEST,     /* tests and benchmarks */
    KOKSMA__PURPOSE_AUDIT,    /* which rows of a study are checked */
    KOKSMA__PURPOSE_NESTED,   /* from here to MIRROR: the modifiers owen, digital-shift, axes and mirror */
    KOKSMA__PURPOSE_DIGITS,
    KOKSMA__PURPOSE_AXES,
    KOKSMA__PURPOSE_MIRROR,
    KOKSMA__PURPOSE_PIXEL, /* the samples of a pixel (koksma__random_draw) */
    KOKSMA__PURPOSE_BASE   /* the modifier owen-base */
} koksma__purpose;

typedef struct koksma__words {
    uint32_t w[4];
} koksma__words;

/* 128 random bits. */
static inline koksma__words koksma__random(uint64_t seed, uint32_t purpose, uint64_t index, uint32_t lane)
{
    const philox4x32_ctr_t counter = {{(uint32_t)index, (uint32_t)(index >> 32), lane, purpose}};
    const philox4x32_key_t key = {{(uint32_t)seed, (uint32_t)(seed >> 32)}};
    const philox4x32_ctr_t r = philox4x32(counter, key);
    return (koksma__words){{r.v[0], r.v[1], r.v[2], r.v[3]}};
}

/* Returns 128 random bits by 7 rounds, the smallest number of rounds that passes BigCrush (Salmon et al. 2011, table
   2). For the renderer, which draws more random numbers than any other part of the library. */
static inline koksma__words koksma__random_draw(uint64_t seed, uint32_t purpose, uint64_t index, uint32_t lane)
{
    const philox4x32_ctr_t counter = {{(uint32_t)index, (uint32_t)(index >> 32), lane, purpose}};
    const philox4x32_key_t key = {{(uint32_t)seed, (uint32_t)(seed >> 32)}};
    const philox4x32_ctr_t r = philox4x32_R(7, counter, key);
    return (koksma__words){{r.v[0], r.v[1], r.v[2], r.v[3]}};
}

/* Returns a double in [0,1) with 53 random bits. */
static inline double koksma__unit(uint32_t high, uint32_t low)
{
    return (double)(((uint64_t)high << 21) | (low >> 11)) * 0x1p-53;
}

/* Computes two doubles in [0,1): the pair that the kernel `uniform` gives at `index`. */
static inline void koksma__random_pair(uint64_t seed, uint32_t purpose, uint64_t index, uint32_t lane, double pair[2])
{
    const koksma__words r = koksma__random(seed, purpose, index, lane);
    pair[0] = koksma__unit(r.w[0], r.w[1]);
    pair[1] = koksma__unit(r.w[2], r.w[3]);
}

/* Derives a new seed from `seed`: seeds for different (index, lane) are independent. */
static inline uint64_t koksma__random_seed(uint64_t seed, uint64_t index, uint32_t lane)
{
    const koksma__words r = koksma__random(seed, KOKSMA__PURPOSE_SEED, index, lane);
    return (uint64_t)r.w[1] << 32 | r.w[0];
}

/* Returns a whole number below n < 2^32, computed from 32 random bits (multiply-shift: the bias is below n / 2^32).
   */
static inline uint32_t koksma__below(uint32_t word, uint32_t n)
{
    return (uint32_t)(((uint64_t)word * n) >> 32);
}

/* Fills permutation with a random order of 0 .. n-1, n < 2^32 (Fisher-Yates; Durstenfeld 1964). */
KOKSMA__LAB void koksma__random_permutation(uint64_t seed, uint32_t lane, uint32_t n, uint32_t *permutation);

#endif
